-- Features from rows of a table, what hides in them, and what is said of the rest.

-- How a statement ends, without the lines that change with the server's version.
CREATE FUNCTION pg_temp.outcome(statement text) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    message text;
    detail text;
    hint text;
BEGIN
    EXECUTE statement;
    RETURN 'done';
EXCEPTION WHEN OTHERS THEN
    GET STACKED DIAGNOSTICS message = MESSAGE_TEXT, detail = PG_EXCEPTION_DETAIL, hint = PG_EXCEPTION_HINT;
    RETURN concat_ws(' | ', SQLSTATE, message, nullif(detail, ''), nullif(hint, ''));
END
$$;
\pset format unaligned

SELECT occlusion.create_scene('regress_import', 28992);
CREATE TEMP TABLE house (name text, class text, footprint polygon[], bottom float8, top float8, storeys int);
INSERT INTO house VALUES
    ('plain', NULL, '{"((85000,447000),(85010,447000),(85010,447008),(85000,447008))"}', 0, 9, 3),
    ('clockwise', 'Building', '{"((85020,447000),(85020,447010),(85030,447010),(85030,447000))"}', 0.25, 7.5, 2),
    ('court', 'Building', '{"((85100,447000),(85140,447000),(85140,447040),(85100,447040))","((85110,447010),(85130,447010),(85130,447030),(85110,447030))"}', 0, 15, 5),
    ('skywalk', 'Building', '{"((85010,447002),(85020,447002),(85020,447004),(85010,447004))"}', 5, 7, 1),
    ('wall', 'Wall', '{"((85050,447000),(85060,447000),(85060,447000.3),(85050,447000.3))"}', 0, 2, NULL),
    ('bow', 'Building', '{"((85200,447000),(85210,447010),(85210,447000),(85200,447010))"}', 0, 3, 1),
    ('line', 'Building', '{"((85200,447000),(85210,447010),(85220,447020))"}', 0, 3, 1),
    ('flat', 'Building', '{"((85200,447000),(85210,447000),(85210,447010))"}', 3, 3, 1),
    ('nan', 'Building', '{"((85200,447000),(85210,447000),(85210,447010))"}', 0, 'NaN', 1),
    ('no height', 'Building', '{"((85200,447000),(85210,447000),(85210,447010))"}', 0, NULL, 1),
    ('nothing', 'Building', NULL, 0, 3, 1);
SELECT occlusion.import_features('regress_import', 'house');

SELECT f.name, f.class, f.envelope, f.attributes, f.outline IS NOT NULL AS has_outline
FROM regress_import.feature AS f ORDER BY f.name;
-- The footprint is the column, bit for bit, its outer ring turned anticlockwise.
SELECT f.name, c.footprint, c.bottom, c.top, c.grounded
FROM regress_import.solid_column AS c JOIN regress_import.feature AS f ON f.id = c.feature ORDER BY f.name;
SELECT f.name, i.box, i.grounded
FROM regress_import.inner_envelope AS i JOIN regress_import.feature AS f ON f.id = i.feature ORDER BY f.name;
SELECT count(*) = 5 AND bool_and(defect IS NULL AND repair IS NULL AND cardinality(triangles) >= 36) AS t
FROM regress_import.mesh;
SELECT * FROM occlusion.import_report('regress_import');

-- By a height above the bottom, and under other names.
CREATE TEMP TABLE shed (label text, kind text, plan polygon, rise float8);
INSERT INTO shed VALUES ('shed', 'Shed', '((85300,447000),(85305,447000),(85305,447005),(85300,447005))', 2.5), ('empty', NULL, NULL, 3);
SELECT occlusion.import_features('regress_import', 'shed', footprint => 'plan', height => 'rise', name => 'label', class => 'kind');
SELECT class, envelope, attributes FROM regress_import.feature WHERE name = 'shed';

-- What cannot be imported is refused as a whole.
SELECT pg_temp.outcome($$SELECT occlusion.import_features('regress_import', 'house')$$);
SELECT pg_temp.outcome($$SELECT occlusion.import_features('regress_import', 'house', footprint => 'storeys')$$);
SELECT pg_temp.outcome($$SELECT occlusion.import_features('regress_import', 'house', footprint => 'area')$$);
SELECT pg_temp.outcome($$SELECT occlusion.import_features('regress_import', 'house', top => 'peak', height => 'rise')$$);
SELECT pg_temp.outcome($$SELECT occlusion.import_features('regress_none', 'house')$$);
SELECT count(*) FROM regress_import.feature;

-- An eye in the courtyard is in the view region; one in the building, on its wall or under its roof is not.
INSERT INTO regress_import.street (area, eye_low, eye_high)
VALUES ('{"((84990,446990),(85400,446990),(85400,447050),(84990,447050))"}', 1.5, 2);
INSERT INTO regress_import.occlusion_volume
SELECT w.id, s.id, 'BOX3D(84990 446990 0,85400 447050 20)'
FROM regress_import.feature AS w, regress_import.feature AS s WHERE w.name = 'wall' AND s.name = 'shed';
SELECT eye::text, count(*) FILTER (WHERE f.feature_id = s.id) = 1 AS shed_is_returned
FROM regress_import.feature AS s,
     unnest(ARRAY['POINT(85120 447020 1.75)', 'POINT(85105 447020 1.75)', 'POINT(85110 447020 1.75)',
                  'POINT(85140.0005 447020 1.75)', 'POINT(85140.1 447020 1.75)']::occlusion.point3d[]) AS eye,
     LATERAL occlusion.visible_features('regress_import', eye, 500) AS f
WHERE s.name = 'shed' GROUP BY eye::text ORDER BY eye::text;

-- Columns that change drop the volumes that their feature casts.
SELECT count(*) FROM regress_import.occlusion_volume;
BEGIN;
UPDATE regress_import.solid_column SET top = 1.5 WHERE feature = (SELECT id FROM regress_import.feature WHERE name = 'wall');
SELECT count(*) FROM regress_import.occlusion_volume;
ROLLBACK;
BEGIN;
DELETE FROM regress_import.solid_column WHERE feature = (SELECT id FROM regress_import.feature WHERE name = 'wall');
SELECT count(*) FROM regress_import.occlusion_volume;
ROLLBACK;
BEGIN;
TRUNCATE regress_import.solid_column;
SELECT count(*) FROM regress_import.occlusion_volume;
ROLLBACK;
-- A column more hides more: what was found stays right.
INSERT INTO regress_import.solid_column (feature, footprint, bottom, top)
SELECT id, '{"((85050,447000),(85060,447000),(85060,447000.3))"}', 0, 1 FROM regress_import.feature WHERE name = 'wall';
SELECT count(*) FROM regress_import.occlusion_volume;
-- Somebody else's columns change nothing here.
UPDATE regress_import.solid_column SET top = 8 WHERE feature = (SELECT id FROM regress_import.feature WHERE name = 'plain');
SELECT count(*) FROM regress_import.occlusion_volume;

SELECT occlusion.drop_scene('regress_import');
