-- visible_features through view cells: as live, and live wherever a cell may be out of date.
\pset format unaligned
SET search_path = public, occlusion;
SET client_min_messages = warning;

-- Houses of 10 m with gaps of 2 m, sheds behind them, and streets on both sides.
SELECT occlusion.create_scene('regress_through');
INSERT INTO regress_through.feature (id, class, envelope)
SELECT i, 'Building', occlusion.box3d(occlusion.point3d(12 * i, 0, 0), occlusion.point3d(12 * i + 10, 10, 7 + i % 3))
FROM generate_series(1, 16) AS i
UNION ALL
SELECT 100 + i, 'Shed', occlusion.box3d(occlusion.point3d(12 * i + 4, 14, 0), occlusion.point3d(12 * i + 6, 16, 2))
FROM generate_series(1, 16) AS i;
INSERT INTO regress_through.inner_envelope SELECT id, envelope, true FROM regress_through.feature;
INSERT INTO regress_through.street (name, area, eye_low, eye_high) VALUES
    ('south', ARRAY['((0,-20),(216,-20),(216,-8),(0,-8))'::polygon], 1.5, 2),
    ('north', ARRAY['((0,20),(216,20),(216,32),(0,32))'::polygon], 1.5, 2);
CREATE TEMP TABLE eye AS
SELECT row_number() OVER () AS number, occlusion.point3d(x, y, z) AS eye
FROM generate_series(0.5, 215.5, 4.3) AS x, (VALUES (-19.5), (-9), (20), (31)) AS y (y), (VALUES (1.5), (1.9)) AS z (z);

-- What a query looks at, but for the number of the cell.
CREATE FUNCTION pg_temp.account(observer occlusion.point3d, range float8 DEFAULT 400) RETURNS SETOF text LANGUAGE sql AS $$
    SELECT regexp_replace(line, 'Cell: \d+', 'Cell: #') FROM occlusion.explain_sight('regress_through', observer, range) AS line
$$;
CREATE FUNCTION pg_temp.cell(observer occlusion.point3d DEFAULT 'POINT(50 -12 1.75)', range float8 DEFAULT 400) RETURNS text LANGUAGE sql AS $$
    SELECT * FROM pg_temp.account(observer, range) LIMIT 1
$$;
-- What is seen from all eyes: rows that are there only through cells, rows that are there only live, and
-- features that a sight line to a corner meets and that are missing.
CREATE FUNCTION pg_temp.compare(OUT only_through bigint, OUT only_live bigint, OUT missing bigint, OUT rows boolean) LANGUAGE plpgsql AS $$
BEGIN
    SET LOCAL pg_occlusion.use_cells = on;
    CREATE TEMP TABLE through AS
    SELECT e.number, v.* FROM eye AS e CROSS JOIN LATERAL occlusion.visible_features('regress_through', e.eye, 400) AS v;
    SET LOCAL pg_occlusion.use_cells = off;
    CREATE TEMP TABLE live AS
    SELECT e.number, v.* FROM eye AS e CROSS JOIN LATERAL occlusion.visible_features('regress_through', e.eye, 400) AS v;
    SELECT count(*) INTO only_through FROM (TABLE through EXCEPT TABLE live) AS t;
    SELECT count(*) INTO only_live FROM (TABLE live EXCEPT TABLE through) AS t;
    SELECT count(*) INTO missing
    FROM eye AS e CROSS JOIN regress_through.feature AS f
    CROSS JOIN LATERAL (VALUES (occlusion.lower(f.envelope)), (occlusion.upper(f.envelope))) AS c (corner)
    WHERE e.number % 7 = 0 AND NOT EXISTS (SELECT FROM through AS t WHERE (t.number, t.feature_id) = (e.number, f.id))
      AND (SELECT l.visible FROM occlusion.line_of_sight('regress_through', e.eye, c.corner) AS l);
    SELECT count(*) > 1000 INTO rows FROM through;
    DROP TABLE through, live;
END
$$;

-- Off unless asked for; live without tiles.
SHOW pg_occlusion.use_cells;
CALL occlusion.generate_view_cells('regress_through', range => 400);
SELECT pg_temp.cell();
SET pg_occlusion.use_cells = on;
SELECT pg_temp.cell();
SELECT occlusion.pack_tiles('regress_through') > 0 AS t;
SELECT pg_temp.account('POINT(50 -12 1.75)');
SELECT pg_temp.account('POINT(50 -12 1.75)');
SELECT * FROM pg_temp.compare();

-- Beyond the range of the cell, outside of streets, over them and in a house it is live.
SELECT pg_temp.cell(range => 400.0001), pg_temp.cell('POINT(50 -7 1.75)'), pg_temp.cell('POINT(50 -12 2.1)'), pg_temp.cell('POINT(50 5 1.75)');
SELECT pg_temp.cell(range => 0), count(*) FROM occlusion.visible_features('regress_through', 'POINT(50 -12 1.75)', 0);
-- Fields of view.
CREATE FUNCTION pg_temp.fields() RETURNS text LANGUAGE sql AS $$
    SELECT string_agg(found::text, ' ' ORDER BY found::text) FROM (
        SELECT 'cone', v.* FROM occlusion.visible_features('regress_through', view_cone('POINT(50 -12 1.75)', 20, 50, 150)) AS v
        UNION ALL
        SELECT 'sector', v.* FROM occlusion.visible_features('regress_through', view_sector('POINT(50 22 1.75)', 200, 70, 150)) AS v
        UNION ALL
        SELECT 'frustum', v.* FROM occlusion.visible_features('regress_through', frustum('POINT(50 -12 1.75)', 20, 5, 0, 60, 1.5, 0.1, 100)) AS v
    ) AS found
$$;
CREATE TEMP TABLE field AS SELECT pg_temp.fields() AS through;
SELECT regexp_replace(line, 'Cell: \d+', 'Cell: #') AS line FROM occlusion.explain_sight('regress_through', view_cone('POINT(50 -12 1.75)', 20, 50, 150)) AS line LIMIT 1;
SET pg_occlusion.use_cells = off;
SELECT length(through) > 500 AS t, through = pg_temp.fields() AS t FROM field;
SET pg_occlusion.use_cells = on;
SELECT count(*) FROM occlusion.explain_visible_features('regress_through', 'POINT(50 -12 1.75)', 400) AS line WHERE line LIKE 'View Cell: _%  Features: _%';

-- An edit near a cell counts at once, and is undone by a rollback.
CREATE FUNCTION pg_temp.classes() RETURNS text LANGUAGE sql AS $$
    SELECT string_agg(DISTINCT class, ' ' ORDER BY class) FROM occlusion.visible_features('regress_through', 'POINT(50 -12 1.75)', 400)
$$;
BEGIN;
UPDATE regress_through.feature SET class = 'Palace' WHERE id = 4;
SELECT pg_temp.cell(), pg_temp.classes();
ROLLBACK;
SELECT pg_temp.cell(), pg_temp.classes();
BEGIN;
SAVEPOINT before;
DELETE FROM regress_through.feature WHERE id BETWEEN 1 AND 12;
SELECT pg_temp.cell(), pg_temp.classes();
ROLLBACK TO before;
SELECT pg_temp.cell(), pg_temp.classes();
INSERT INTO regress_through.feature (id, class, envelope) VALUES (200, 'Tower', 'BOX3D(3000 0 0, 3010 10 90)');
SELECT pg_temp.cell() <> 'View Cell: none' AS t;
UPDATE regress_through.feature SET envelope = 'BOX3D(300 -14 0, 310 -4 90)' WHERE id = 200;
SELECT pg_temp.cell(), pg_temp.classes();
ROLLBACK;
BEGIN;
UPDATE regress_through.inner_envelope SET grounded = false WHERE feature BETWEEN 1 AND 12;
SELECT pg_temp.cell(), pg_temp.classes();
SELECT * FROM pg_temp.compare();
ROLLBACK;
BEGIN;
UPDATE regress_through.street SET eye_high = 3 WHERE name = 'south';
SELECT pg_temp.cell(), pg_temp.cell('POINT(50 22 1.75)') <> 'View Cell: none' AS t;
ROLLBACK;

-- Committed, it is live until the cells are computed anew. Then the tiles, still packed as they were, and the cells
-- that were used before are out of date, and the answer is not.
SELECT pg_temp.cell() <> 'View Cell: none' AS t;
UPDATE regress_through.feature SET class = 'Palace' WHERE id = 3;
DELETE FROM regress_through.inner_envelope WHERE feature = 4;
UPDATE regress_through.feature SET envelope = occlusion.translate(envelope, 0, -2, 0) WHERE id IN (5, 6);
UPDATE regress_through.inner_envelope SET box = occlusion.translate(box, 0, -2, 0) WHERE feature IN (5, 6);
DELETE FROM regress_through.feature WHERE id = 7;
SELECT pg_temp.cell(), pg_temp.classes();
CALL occlusion.generate_view_cells('regress_through', range => 400);
SELECT pg_temp.account('POINT(50 -12 1.75)');
SELECT pg_temp.classes(), pg_temp.cell();
SELECT * FROM pg_temp.compare();
SELECT occlusion.pack_tiles('regress_through') > 0 AS t;
-- With no room for tiles each query reads and gathers its own.
SET pg_occlusion.cache_size = 0;
SELECT * FROM pg_temp.compare();
SELECT pg_temp.account('POINT(50 -12 1.75)') LIMIT 2;
SELECT pg_temp.account('POINT(50 -12 1.75)') LIMIT 2;
RESET pg_occlusion.cache_size;
SELECT pg_temp.cell() <> 'View Cell: none' AS t, pg_temp.classes();
SELECT * FROM pg_temp.compare();

-- Cells that were written by hand: a set that was changed is not taken for what it was, and of a slot that nobody has
-- nothing is known.
CREATE TEMP TABLE features AS SELECT pg_temp.cell() AS line;
BEGIN;
UPDATE regress_through.view_cell SET visible = visible - (SELECT occlusion.feature_set('regress_through', ARRAY[16]));
SELECT pg_temp.cell() <> line AS t, pg_temp.cell() <> 'View Cell: none' AS t FROM features;
ROLLBACK;
BEGIN;
UPDATE regress_through.view_cell SET visible = visible | '{100000}';
SELECT pg_temp.cell(), pg_temp.classes();
UPDATE regress_through.view_cell SET visible = '{-1,99999999999}';
SELECT pg_temp.cell(), pg_temp.classes();
UPDATE regress_through.view_cell SET visible = '{}';
SELECT pg_temp.cell(), pg_temp.classes();
ROLLBACK;
SELECT pg_temp.cell() = line AS t FROM features;
BEGIN;
UPDATE regress_through.view_cell_block SET cluster = cluster + 1;
SELECT pg_temp.cell();
ROLLBACK;

-- Who may not read cells, or not all that they speak of, is answered live.
CREATE ROLE regress_through_reader;
GRANT USAGE ON SCHEMA occlusion, regress_through TO regress_through_reader;
GRANT SELECT ON ALL TABLES IN SCHEMA regress_through TO regress_through_reader;
SELECT pg_temp.cell() <> 'View Cell: none' AS t;
SET ROLE regress_through_reader;
SELECT pg_temp.cell() <> 'View Cell: none' AS t;
RESET ROLE;
BEGIN;
REVOKE SELECT ON regress_through.view_cell FROM regress_through_reader;
SET LOCAL ROLE regress_through_reader;
SELECT pg_temp.cell(), pg_temp.classes();
ROLLBACK;
BEGIN;
REVOKE SELECT ON regress_through.mesh FROM regress_through_reader;
SET LOCAL ROLE regress_through_reader;
SELECT pg_temp.cell(), pg_temp.classes();
ROLLBACK;
BEGIN;
ALTER TABLE regress_through.feature ENABLE ROW LEVEL SECURITY;
CREATE POLICY no_palace ON regress_through.feature USING (class <> 'Palace');
SET LOCAL ROLE regress_through_reader;
SELECT pg_temp.cell(), pg_temp.classes();
ROLLBACK;
BEGIN;
CREATE TABLE public.more_houses () INHERITS (regress_through.feature);
SELECT pg_temp.cell(), pg_temp.classes();
ROLLBACK;
BEGIN;
TRUNCATE regress_through.feature CASCADE;
SELECT pg_temp.cell(), pg_temp.classes() IS NULL AS t;
ROLLBACK;

RESET pg_occlusion.use_cells;
SELECT occlusion.drop_scene('regress_through');
DROP OWNED BY regress_through_reader;
DROP ROLE regress_through_reader;
