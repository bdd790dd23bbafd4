-- View cells: computed, asked, and unused at once where they may be out of date.
\pset format unaligned
SET search_path = public, occlusion;

-- Houses of 10 m in a row along y = 0 to 10, sheds behind them, and streets on both sides.
SELECT occlusion.create_scene('regress_cells');
INSERT INTO regress_cells.feature (id, class, envelope)
SELECT i, 'Building', occlusion.box3d(occlusion.point3d(10 * i, 0, 0), occlusion.point3d(10 * i + 10, 10, 9))
FROM generate_series(1, 20) AS i
UNION ALL
SELECT 100 + i, 'Shed', occlusion.box3d(occlusion.point3d(10 * i + 4, 14, 0), occlusion.point3d(10 * i + 6, 16, 2))
FROM generate_series(1, 20) AS i;
INSERT INTO regress_cells.inner_envelope SELECT id, envelope, true FROM regress_cells.feature WHERE class = 'Building';

-- Refused.
CALL occlusion.generate_view_cells('regress_cells');
\echo :SQLSTATE
INSERT INTO regress_cells.street (name, area, eye_low, eye_high) VALUES
    ('south', ARRAY['((0,-20),(230,-20),(230,-8),(0,-8))'::polygon], 1.5, 2),
    ('north', ARRAY['((0,20),(230,20),(230,32),(0,32))'::polygon, '((100,24),(110,24),(110,28),(100,28))'::polygon], 1.5, 2);
CALL occlusion.generate_view_cells(NULL);
\echo :SQLSTATE
CALL occlusion.generate_view_cells('regress_cells', range => NULL);
\echo :SQLSTATE
CALL occlusion.generate_view_cells('regress_cells', range => 0);
CALL occlusion.generate_view_cells('regress_cells', range => 'Infinity');
CALL occlusion.generate_view_cells('regress_cells', smallest => -1);
CALL occlusion.generate_view_cells('regress_cells', largest => 'NaN');
CALL occlusion.generate_view_cells('regress_cells', finest => 0);
CALL occlusion.generate_view_cells('regress_cells', smallest => 8, largest => 4);
\echo :SQLSTATE
CALL occlusion.generate_view_cells('regress_nowhere');
\echo :SQLSTATE
BEGIN;
CALL occlusion.generate_view_cells('regress_cells');
\echo :SQLSTATE
ROLLBACK;
SET default_transaction_isolation = 'repeatable read';
CALL occlusion.generate_view_cells('regress_cells');
\echo :SQLSTATE
RESET default_transaction_isolation;
SELECT count(*) = 0 AS t FROM regress_cells.view_cell;
-- Before any was computed, nothing is logged, and nothing known: a feature may be seen from all streets.
SELECT count(*) = 0 AS t FROM regress_cells.change;
SELECT count(*) = 0 AS t FROM occlusion.visible_set('regress_cells', 'POINT(50 -10 1.75)');
SELECT bool_or(proven) AS f, count(*) = (SELECT count(*) FROM regress_cells.street) AS t FROM occlusion.visible_from('regress_cells', 3);
SELECT count(*) = 0 AS t FROM occlusion.landmarks('regress_cells');

SET client_min_messages = warning;
CALL occlusion.generate_view_cells('regress_cells', range => 400);
RESET client_min_messages;
SELECT task, done = total AND total > 0 AS t, made = (SELECT count(*) FROM regress_cells.view_cell) AS t, state
FROM occlusion.progress('regress_cells');
SELECT bool_and(done) AS t, count(DISTINCT range) FROM regress_cells.view_cell_block;
SELECT min(occlusion.x(occlusion.size(box))) >= 4 AS t, max(occlusion.x(occlusion.size(box))) = 16 AS t,
       bool_and(occlusion.z(occlusion.lower(box)) = 1.5 AND occlusion.z(occlusion.upper(box)) = 2) AS t
FROM regress_cells.view_cell;

-- Every eye of the streets is in a cell, those on borders too, and what is seen from it is in the set.
CREATE TEMP TABLE eye AS
SELECT occlusion.point3d(x, y, z) AS eye
FROM generate_series(0, 230, 2.5) AS x, (VALUES (-20), (-16), (-11.3), (-8), (20), (25.1), (32)) AS y (y), (VALUES (1.5), (1.9)) AS z (z)
WHERE NOT (x BETWEEN 100 AND 110 AND y BETWEEN 24 AND 28);
SELECT count(*), count(s.box), bool_and(s.box @> e.eye) AS t
FROM eye AS e LEFT JOIN LATERAL occlusion.visible_set('regress_cells', e.eye) AS s ON true;
SELECT bool_and(occlusion.feature_set('regress_cells', ARRAY(
           SELECT v.feature_id FROM occlusion.visible_features('regress_cells', e.eye, 400) AS v)) <@ s.visible) AS t,
       min(occlusion.cardinality(s.visible)) < 30 AS t
FROM eye AS e CROSS JOIN LATERAL occlusion.visible_set('regress_cells', e.eye) AS s;
-- From the south no shed is seen.
SELECT array_agg(DISTINCT f.class ORDER BY f.class) AS classes
FROM occlusion.visible_set('regress_cells', 'POINT(115 -14 1.75)') AS s
JOIN regress_cells.feature AS f ON s.visible @> f.slot::bigint;
-- Not outside of the streets, in a hole of one, or over them.
SELECT count(*) = 0 AS t
FROM (VALUES ('POINT(50 -7.9 1.75)'), ('POINT(105 26 1.75)'), ('POINT(50 -10 3)'), ('POINT(50 -10 1.4)')) AS e (eye)
CROSS JOIN LATERAL occlusion.visible_set('regress_cells', e.eye::occlusion.point3d) AS s;

-- From one cell to another.
SELECT occlusion.cardinality(c.disappearing) > 0 AS t, c.appearing = '{}' AS t, c.box @> 'POINT(115 -14 1.75)'::occlusion.point3d AS t
FROM occlusion.visible_set_change('regress_cells', 'POINT(115 26 1.75)', 'POINT(115 -14 1.75)') AS c;
SELECT (h.visible - c.disappearing) | c.appearing = t.visible AS t
FROM occlusion.visible_set('regress_cells', 'POINT(15 22 1.75)') AS h,
     occlusion.visible_set('regress_cells', 'POINT(215 -14 1.75)') AS t,
     occlusion.visible_set_change('regress_cells', 'POINT(15 22 1.75)', 'POINT(215 -14 1.75)') AS c;

-- The inverse says the same.
SELECT bool_and(array_agg = ids) AS t FROM (
    SELECT c.id, occlusion.feature_ids('regress_cells', c.visible) AS ids,
           (SELECT array_agg(f.id ORDER BY f.id) FROM regress_cells.feature AS f
            WHERE EXISTS (SELECT FROM occlusion.visible_from('regress_cells', f.id) AS v WHERE v.box = c.box))
    FROM regress_cells.view_cell AS c
) AS inverse;
SELECT min(occlusion.y(occlusion.lower(box))) > 10 AS t FROM occlusion.visible_from('regress_cells', 110);
-- The plan of the cells: as large, and of no cell twice.
SELECT count(*) AS features, bool_and(abs(a.area - c.area) < 1e-6) AS t, bool_and(a.polygons < c.cells) AS t
FROM (SELECT f.id, v.proven, sum(occlusion.x(s) * occlusion.y(s)) AS area, count(*) AS cells
      FROM regress_cells.feature AS f CROSS JOIN LATERAL occlusion.visible_from('regress_cells', f.id) AS v
      CROSS JOIN LATERAL occlusion.size(v.box) AS s WHERE f.id BETWEEN 5 AND 8 GROUP BY f.id, v.proven) AS c
JOIN (SELECT f.id, v.proven, count(*) AS polygons,
             sum((SELECT abs(area(r.ring::path)) FROM unnest(v.area) WITH ORDINALITY AS r (ring, n) WHERE n = 1)
                 - coalesce((SELECT sum(abs(area(r.ring::path))) FROM unnest(v.area) WITH ORDINALITY AS r (ring, n) WHERE n > 1), 0)) AS area
      FROM regress_cells.feature AS f CROSS JOIN LATERAL occlusion.visible_from_area('regress_cells', f.id) AS v
      WHERE f.id BETWEEN 5 AND 8 GROUP BY f.id, v.proven) AS a USING (id, proven);
SELECT occlusion.visible_from_area('regress_cells', 999);
\echo :SQLSTATE
-- Proven is what has a surface that a line meets; of the sheds nothing but their envelopes is known.
SELECT f.class, bool_or(v.proven) AS proven
FROM regress_cells.feature AS f CROSS JOIN LATERAL occlusion.visible_from('regress_cells', f.id) AS v GROUP BY f.class ORDER BY f.class;
SELECT bool_and(c.visible = occlusion.cardinality(s.visible) AND c.proven = c.visible - occlusion.cardinality(s.unproven)) AS t,
       bool_and(s.unproven <@ s.visible) AS t, bool_and(c.share = c.proven::float8 / c.visible) AS t,
       sum(c.proven) / sum(c.visible) = occlusion.proven_share('regress_cells') AS t
FROM occlusion.view_cells('regress_cells') AS c JOIN regress_cells.view_cell AS s ON s.id = c.cell;
SELECT bool_and(w.eye IS NOT NULL AND c.box @> w.eye AND s.visible) AS t, count(*) = sum(c.proven) / count(DISTINCT w.feature_id) AS t, count(*) > 0 AS t
FROM (SELECT * FROM occlusion.view_cells('regress_cells') ORDER BY cell LIMIT 1) AS c
CROSS JOIN LATERAL occlusion.witnesses('regress_cells', c.cell) AS w
CROSS JOIN LATERAL occlusion.line_of_sight('regress_cells', w.eye,
    occlusion.point3d(0.99 * occlusion.x(w.target) + 0.01 * occlusion.x(w.eye), 0.99 * occlusion.y(w.target) + 0.01 * occlusion.y(w.eye),
                      0.99 * occlusion.z(w.target) + 0.01 * occlusion.z(w.eye))) AS s;
SELECT occlusion.witnesses('regress_cells', -1);
\echo :SQLSTATE
SELECT occlusion.proven_share('regress_nowhere');
\echo :SQLSTATE
BEGIN;
DELETE FROM regress_cells.inner_envelope;
SELECT count(*) = 0 AS t FROM occlusion.view_cells('regress_cells');
SELECT occlusion.proven_share('regress_cells') IS NULL AS t;
SELECT count(*) > 0 AS t, count(w.eye) = 0 AS t FROM occlusion.witnesses('regress_cells', (SELECT min(id) FROM regress_cells.view_cell)) AS w;
ROLLBACK;
SELECT occlusion.visible_from('regress_cells', 999);
\echo :SQLSTATE
SELECT count(*) = 40 AS t, bool_and(share > 0 AND share <= 1) AS t, max(cells) <= (SELECT count(*) FROM regress_cells.view_cell) AS t
FROM occlusion.landmarks('regress_cells');

-- An edit counts in its own transaction at once, and is undone by a rollback. What is far away stays.
CREATE FUNCTION pg_temp.known() RETURNS bigint LANGUAGE sql AS $$
    SELECT count(*) FROM eye AS e CROSS JOIN LATERAL occlusion.visible_set('regress_cells', e.eye) AS s
$$;
CREATE TEMP TABLE at_first AS SELECT pg_temp.known() AS eyes;
BEGIN;
DELETE FROM regress_cells.feature WHERE id = 7;
SELECT pg_temp.known();
SELECT bool_or(proven) AS f, count(*) = (SELECT count(*) FROM regress_cells.view_cell_block) AS t FROM occlusion.visible_from('regress_cells', 8);
ROLLBACK;
SELECT pg_temp.known() = eyes AS t FROM at_first;
BEGIN;
SAVEPOINT before;
UPDATE regress_cells.inner_envelope SET grounded = false WHERE feature = 7;
SELECT pg_temp.known();
ROLLBACK TO before;
SELECT pg_temp.known() = eyes AS t FROM at_first;
INSERT INTO regress_cells.feature (id, class, envelope) VALUES (200, 'Tower', 'BOX3D(3000 0 0, 3010 10 90)');
SELECT pg_temp.known() = eyes AS t FROM at_first;
UPDATE regress_cells.feature SET envelope = 'BOX3D(600 0 0, 610 10 90)' WHERE id = 200;
SELECT pg_temp.known() < eyes AND pg_temp.known() > 0 AS t FROM at_first;
ROLLBACK;
-- So do streets, where they are.
BEGIN;
UPDATE regress_cells.street SET area = ARRAY['((0,-20),(230,-20),(230,-7),(0,-7))'::polygon] WHERE name = 'south';
SELECT count(s.box) FILTER (WHERE occlusion.y(e.eye) < 0), count(s.box) FILTER (WHERE occlusion.y(e.eye) > 0) > 0 AS t
FROM eye AS e LEFT JOIN LATERAL occlusion.visible_set('regress_cells', e.eye) AS s ON true;
ROLLBACK;
BEGIN;
TRUNCATE regress_cells.feature CASCADE;
SELECT pg_temp.known(), (SELECT count(*) FROM regress_cells.view_cell);
ROLLBACK;
-- What view cells do not tell apart leaves them in use.
BEGIN;
UPDATE regress_cells.feature SET attributes = '{"colour": "red"}' WHERE id = 7;
SELECT pg_temp.known() = eyes AS t FROM at_first;
ROLLBACK;
-- Sets name features by their slots: one that is given anew counts, one that is given first does not.
BEGIN;
UPDATE regress_cells.feature SET slot = 1000 WHERE id = 7;
SELECT pg_temp.known();
ROLLBACK;
BEGIN;
INSERT INTO regress_cells.feature (id, class, envelope) VALUES (200, 'Tower', 'BOX3D(3000 0 0, 3010 10 90)');
SELECT occlusion.assign_slots('regress_cells');
SELECT pg_temp.known() = eyes AS t, (SELECT count(*) FROM regress_cells.change) FROM at_first;
ROLLBACK;
-- Snapshots of another cluster mean nothing.
BEGIN;
UPDATE regress_cells.view_cell_block SET cluster = cluster + 1;
SELECT pg_temp.known();
SELECT bool_or(proven) AS f, count(*) > 0 AS t FROM occlusion.visible_from('regress_cells', 8);
ROLLBACK;

-- Committed, and computed anew: the log is forgotten then.
DELETE FROM regress_cells.feature WHERE id = 7;
SELECT pg_temp.known(), (SELECT count(*) > 0 FROM regress_cells.change) AS t;
SET client_min_messages = warning;
CALL occlusion.generate_view_cells('regress_cells', range => 400);
RESET client_min_messages;
SELECT pg_temp.known() = eyes AS t, (SELECT count(*) FROM regress_cells.change) FROM at_first;
SELECT array_agg(DISTINCT f.class ORDER BY f.class) AS classes
FROM occlusion.visible_set('regress_cells', 'POINT(75 -14 1.75)') AS s
JOIN regress_cells.feature AS f ON s.visible @> f.slot::bigint;

-- A reader needs SELECT, and to see all rows.
CREATE ROLE regress_cells_reader;
GRANT USAGE ON SCHEMA occlusion, regress_cells TO regress_cells_reader;
GRANT SELECT ON ALL TABLES IN SCHEMA regress_cells TO regress_cells_reader;
SET ROLE regress_cells_reader;
SELECT count(*) FROM occlusion.visible_set('regress_cells', 'POINT(50 -10 1.75)');
SELECT count(*) > 0 AS t FROM occlusion.visible_from('regress_cells', 8);
RESET ROLE;
ALTER TABLE regress_cells.feature ENABLE ROW LEVEL SECURITY;
CREATE POLICY but_one ON regress_cells.feature USING (id <> 8);
SET ROLE regress_cells_reader;
SELECT count(*) FROM occlusion.visible_set('regress_cells', 'POINT(50 -10 1.75)');
SELECT occlusion.visible_from('regress_cells', 8);
\echo :SQLSTATE
SELECT occlusion.landmarks('regress_cells');
\echo :SQLSTATE
RESET ROLE;
ALTER TABLE regress_cells.feature DISABLE ROW LEVEL SECURITY;
REVOKE SELECT ON regress_cells.view_cell FROM regress_cells_reader;
SET ROLE regress_cells_reader;
SELECT occlusion.visible_set('regress_cells', 'POINT(50 -10 1.75)');
\echo :SQLSTATE
RESET ROLE;

-- Cells without their squares are not relied on.
BEGIN;
DELETE FROM regress_cells.view_cell_block;
SELECT pg_temp.known();
ROLLBACK;

-- Where edits would go unnoticed, none are computed, and none are in use.
CREATE TABLE public.more_streets () INHERITS (regress_cells.street);
SELECT count(*) FROM occlusion.visible_set('regress_cells', 'POINT(50 -10 1.75)');
CALL occlusion.generate_view_cells('regress_cells');
\echo :SQLSTATE
DROP TABLE public.more_streets;

SELECT occlusion.drop_scene('regress_cells');
DROP OWNED BY regress_cells_reader;
DROP ROLE regress_cells_reader;
