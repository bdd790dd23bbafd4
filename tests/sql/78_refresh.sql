-- Deleted features concern only the view cells that see them, and refresh computes what edits concern.
\pset format unaligned
SET search_path = public, occlusion;

-- Houses of 10 m in a row along y = 0 to 10, sheds behind them, and streets on both sides.
SELECT occlusion.create_scene('regress_refresh');
INSERT INTO regress_refresh.feature (id, class, envelope)
SELECT i, 'Building', occlusion.box3d(occlusion.point3d(10 * i, 0, 0), occlusion.point3d(10 * i + 10, 10, 9))
FROM generate_series(1, 20) AS i
UNION ALL
SELECT 100 + i, 'Shed', occlusion.box3d(occlusion.point3d(10 * i + 4, 14, 0), occlusion.point3d(10 * i + 6, 16, 2))
FROM generate_series(1, 20) AS i;
INSERT INTO regress_refresh.inner_envelope SELECT id, envelope, true FROM regress_refresh.feature WHERE class = 'Building';
INSERT INTO regress_refresh.street (name, area, eye_low, eye_high) VALUES
    ('south', ARRAY['((0,-20),(230,-20),(230,-8),(0,-8))'::polygon], 1.5, 2),
    ('north', ARRAY['((0,20),(230,20),(230,32),(0,32))'::polygon], 1.5, 2);
SELECT features, solid_columns, streets, tiles, edits, squares, right_squares, right_share, view_cells, proven_share, changes, computed, bytes > 0 AS t
FROM occlusion.scene_status('regress_refresh');
CALL occlusion.refresh('regress_refresh');

-- Refused.
CALL occlusion.refresh(NULL);
\echo :SQLSTATE
CALL occlusion.refresh('regress_nowhere');
\echo :SQLSTATE
SELECT occlusion.scene_status('regress_nowhere');
\echo :SQLSTATE
BEGIN;
CALL occlusion.refresh('regress_refresh');
\echo :SQLSTATE
ROLLBACK;
SET default_transaction_isolation = 'repeatable read';
CALL occlusion.refresh('regress_refresh');
\echo :SQLSTATE
RESET default_transaction_isolation;

SET client_min_messages = warning;
CALL occlusion.generate_view_cells('regress_refresh', range => 100);
CREATE TEMP TABLE eye AS
SELECT occlusion.point3d(x, y, z) AS eye
FROM generate_series(1, 230, 2.5) AS x, (VALUES (-19), (-11.3), (21), (25.1)) AS y (y), (VALUES (1.5), (1.9)) AS z (z);
-- How many eyes south and north have a cell that counts; whether all that is seen from them is in its set.
CREATE FUNCTION pg_temp.known(OUT south bigint, OUT north bigint, OUT whole boolean) LANGUAGE sql AS $$
    SELECT count(*) FILTER (WHERE occlusion.y(e.eye) < 0), count(*) FILTER (WHERE occlusion.y(e.eye) > 0),
           bool_and(occlusion.feature_set('regress_refresh', ARRAY(
               SELECT v.feature_id FROM occlusion.visible_features('regress_refresh', e.eye, 100) AS v)) <@ s.visible)
    FROM eye AS e CROSS JOIN LATERAL occlusion.visible_set('regress_refresh', e.eye) AS s
$$;
CREATE FUNCTION pg_temp.status(OUT share text, OUT edits bigint, OUT changes bigint) LANGUAGE sql AS $$
    SELECT CASE s.right_share WHEN 0 THEN 'none' WHEN 1 THEN 'all' ELSE 'some' END, s.edits, s.changes
    FROM occlusion.scene_status('regress_refresh') AS s
$$;
SELECT * FROM pg_temp.known();
SELECT * FROM pg_temp.status();
SELECT squares = right_squares AS t, view_cells = (SELECT count(*) FROM regress_refresh.view_cell) AS t,
       proven_share = occlusion.proven_share('regress_refresh') AS t, computed <= now() AS t
FROM occlusion.scene_status('regress_refresh');

-- A shed that is gone concerns nobody in the south, who never saw it; a house does.
BEGIN;
DELETE FROM regress_refresh.feature WHERE id = 101;
SELECT south = 736 / 2 AS t, north BETWEEN 1 AND 735 / 2 AS t, whole FROM pg_temp.known();
SELECT DISTINCT slot IS NOT NULL AS t FROM regress_refresh.change WHERE place IS NOT NULL;
DELETE FROM regress_refresh.feature WHERE id = 1;
SELECT south BETWEEN 1 AND 735 / 2 AS t, north BETWEEN 1 AND 735 / 2 AS t, whole FROM pg_temp.known();
ROLLBACK;
SELECT * FROM pg_temp.known();
-- What comes back where something was deleted may hide, and be seen.
BEGIN;
CREATE TEMP TABLE kept ON COMMIT DROP AS SELECT * FROM regress_refresh.feature WHERE id = 101;
DELETE FROM regress_refresh.feature WHERE id = 101;
INSERT INTO regress_refresh.feature (id, class, envelope, slot) SELECT id, class, envelope, slot FROM kept;
SELECT south BETWEEN 1 AND 735 / 2 AS t, whole FROM pg_temp.known();
ROLLBACK;
-- Moved first, it concerns both places.
BEGIN;
UPDATE regress_refresh.feature SET envelope = 'BOX3D(14 -7 0, 16 -5 2)' WHERE id = 101;
DELETE FROM regress_refresh.feature WHERE id = 101;
SELECT south BETWEEN 1 AND 735 / 2 AS t, whole FROM pg_temp.known();
ROLLBACK;
-- A part of a transaction that failed leaves nothing behind.
BEGIN;
SAVEPOINT before;
DELETE FROM regress_refresh.feature WHERE id = 101;
ROLLBACK TO before;
SELECT * FROM pg_temp.known();
DELETE FROM regress_refresh.feature WHERE id = 101;
SELECT south = 736 / 2 AS t, north BETWEEN 1 AND 735 / 2 AS t, whole FROM pg_temp.known();
COMMIT;

-- Only what is concerned is computed.
CREATE TEMP TABLE computed AS
SELECT b.id, b.xmin::text AS row, (SELECT max(c.xmin::text::bigint) FROM regress_refresh.view_cell AS c WHERE c.id >> 22 = b.id) AS cells
FROM regress_refresh.view_cell_block AS b;
SELECT * FROM pg_temp.status();
CALL occlusion.refresh('regress_refresh');
SELECT * FROM pg_temp.status();
SELECT * FROM pg_temp.known();
SELECT count(*) FILTER (WHERE c.cells = n.cells) > 0 AS kept, count(*) FILTER (WHERE c.cells < n.cells) > 0 AS computed,
       bool_and(c.cells = n.cells OR occlusion.y(occlusion.lower(b.box)) > 0) AS t
FROM computed AS c JOIN regress_refresh.view_cell_block AS b USING (id)
CROSS JOIN LATERAL (SELECT max(c.xmin::text::bigint) AS cells FROM regress_refresh.view_cell AS c WHERE c.id >> 22 = b.id) AS n;
-- Once more there is nothing to do.
TRUNCATE computed;
INSERT INTO computed SELECT id, xmin::text, 0 FROM regress_refresh.view_cell_block;
CALL occlusion.refresh('regress_refresh');
SELECT bool_and(c.row = b.xmin::text) AS t FROM computed AS c JOIN regress_refresh.view_cell_block AS b USING (id);

-- A house that is gone, one that is new, and a street where none was.
DELETE FROM regress_refresh.feature WHERE id = 10;
INSERT INTO regress_refresh.feature (id, class, envelope) VALUES (300, 'Building', 'BOX3D(50 -6 0, 60 -2 9)');
INSERT INTO regress_refresh.inner_envelope VALUES (300, 'BOX3D(50 -6 0, 60 -2 9)', true);
INSERT INTO regress_refresh.street (name, area, eye_low, eye_high) VALUES ('east', ARRAY['((240,-20),(260,-20),(260,32),(240,32))'::polygon], 1.5, 2);
INSERT INTO eye SELECT occlusion.point3d(250, y, 1.7) FROM generate_series(-19, 31, 5) AS y;
SELECT south < 368 AS t, north < 368 AS t, whole FROM pg_temp.known();
CALL occlusion.refresh('regress_refresh');
SELECT * FROM pg_temp.known();
SELECT * FROM pg_temp.status();
SELECT count(*) > 0 AS seen FROM occlusion.visible_from('regress_refresh', 300);
-- Where all stood within a house there were no cells; without it there are.
INSERT INTO regress_refresh.street (name, area, eye_low, eye_high) VALUES ('indoors', ARRAY['((152,2),(158,2),(158,8),(152,8))'::polygon], 1.5, 2);
CALL occlusion.refresh('regress_refresh');
SELECT count(*) FROM occlusion.visible_set('regress_refresh', 'POINT(155 5 1.7)');
DELETE FROM regress_refresh.feature WHERE id = 15;
SELECT count(*) FROM occlusion.visible_set('regress_refresh', 'POINT(155 5 1.7)');
CALL occlusion.refresh('regress_refresh');
SELECT count(*) FROM occlusion.visible_set('regress_refresh', 'POINT(155 5 1.7)');
SELECT * FROM pg_temp.status();

-- Cells of another cluster are computed again.
UPDATE regress_refresh.view_cell_block SET cluster = cluster + 1;
SELECT * FROM pg_temp.status();
CALL occlusion.refresh('regress_refresh');
SELECT * FROM pg_temp.status();
SELECT occlusion.drop_scene('regress_refresh');
