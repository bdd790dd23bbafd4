-- Models handed out as files.

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

SELECT occlusion.create_scene('regress_models', 28992);
CREATE TEMP TABLE house (name text, footprint polygon, height float8);
INSERT INTO house VALUES
    ('front', '((85000,447000),(85010,447000),(85010,447010),(85000,447010))', 1),
    ('behind', '((85000,447100),(85010,447100),(85010,447110),(85000,447110))', 5),
    ('bare', '((85500,447100),(85510,447100),(85510,447110),(85500,447110))', 5);
SELECT occlusion.import_features('regress_models', 'house');
-- One that has models of its own, at two levels, and one without anything.
INSERT INTO regress_models.model (feature, level_of_detail, format, content, geometric_error)
SELECT id, 1, 'obj', convert_to(E'v 85000 447100 0\nv 85010 447100 0\nv 85010 447110 5\nf 1 2 3\n', 'UTF8'), 2
FROM regress_models.feature WHERE name = 'behind'
UNION ALL
SELECT id, 2, 'obj', convert_to(E'v 85000 447100 0\nv 85010 447100 0\nv 85010 447110 5\nv 85000 447110 5\nf 1 2 3\nf 1 3 4\n', 'UTF8'), 0
FROM regress_models.feature WHERE name = 'behind';
DELETE FROM regress_models.mesh WHERE feature = (SELECT id FROM regress_models.feature WHERE name = 'bare');

SELECT f.name, m.level_of_detail, substr(m.content, 1, 4) = 'glTF'::bytea AS is_glb
FROM occlusion.feature_models('regress_models', (SELECT array_agg(id ORDER BY name) FROM regress_models.feature)) AS m
JOIN regress_models.feature AS f ON f.id = m.feature_id;
-- A level is the best not above the one wanted; the lowest where all are above; the coarsest whose error is small enough.
SELECT w.level, m.level_of_detail
FROM (VALUES (NULL::float8), (9), (2), (1.5), (1), (0.5)) AS w (level),
     LATERAL occlusion.feature_models('regress_models', (SELECT array_agg(id) FROM regress_models.feature WHERE name = 'behind'), 'cityjson', w.level) AS m;
SELECT w.error, m.level_of_detail
FROM (VALUES (NULL::float8), (0), (1.9), (2)) AS w (error),
     LATERAL occlusion.feature_models('regress_models', (SELECT array_agg(id) FROM regress_models.feature WHERE name = 'behind'), 'cityjson', NULL, ARRAY[w.error]) AS m;

-- The model of what is seen, the nearest first.
SELECT f.name, v.class, round(v.distance) AS distance, v.level_of_detail, octet_length(v.content) > 0 AS has_content
FROM occlusion.visible_models('regress_models', occlusion.view_cone('POINT(85005 446990 1.75)', 0, 60, 300)) AS v
JOIN regress_models.feature AS f ON f.id = v.feature_id ORDER BY v.distance;
SELECT count(*) = 2 AS t FROM occlusion.visible_models('regress_models', occlusion.view_sector('POINT(85005 446990 1.75)', 0, 60, 300), 'vrml97');
SELECT count(*) = 3 AND count(content) = 2 AS t FROM occlusion.visible_models('regress_models', 'POINT(85005 446990 1.75)', 2000, 'cityjson');
-- Far enough away the coarse level will do.
SELECT v.level_of_detail
FROM occlusion.visible_models('regress_models', 'POINT(85005 446990 1.75)', 2000, error_angle => 1.5) AS v
JOIN regress_models.feature AS f ON f.id = v.feature_id WHERE f.name = 'behind';

-- All in one file.
SELECT substr(g, 1, 4) = 'glTF'::bytea AND position('behind'::bytea IN g) > 0 AND position('"bare"'::bytea IN g) = 0 AS t
FROM occlusion.visible_glb('regress_models', occlusion.point3d(85005, 446990, 1.75), 2000) AS g;
SELECT position('behind'::bytea IN g) > 0 AS t FROM occlusion.visible_glb('regress_models', occlusion.view_cone('POINT(85005 446990 1.75)', 0, 60, 300)) AS g;
SELECT position('behind'::bytea IN g) > 0 AS t FROM occlusion.visible_glb('regress_models', occlusion.view_sector('POINT(85005 446990 1.75)', 0, 60, 300)) AS g;
-- Nothing seen is an empty file.
SELECT substr(g, 1, 4) = 'glTF'::bytea AS t FROM occlusion.visible_glb('regress_models', occlusion.point3d(0, 0, 0), 1) AS g;
SELECT convert_from(occlusion.merged_models('regress_models', array_agg(id ORDER BY id), 'vrml97'), 'UTF8') LIKE '#VRML V2.0 utf8%front%behind%' AS t FROM regress_models.feature;
SELECT convert_from(m, 'UTF8')::jsonb ->> 'type' AS type, (SELECT count(*) FROM jsonb_object_keys(convert_from(m, 'UTF8')::jsonb -> 'CityObjects')) AS objects
FROM (SELECT occlusion.merged_models('regress_models', array_agg(id ORDER BY id), 'cityjson') FROM regress_models.feature) AS f (m);
SELECT count(*) AS lines
FROM regexp_split_to_table(rtrim(convert_from((SELECT occlusion.merged_models('regress_models', array_agg(id), 'cityjsonseq') FROM regress_models.feature), 'UTF8'), E'\n'), E'\n');

-- Refusals.
SELECT pg_temp.outcome($$SELECT occlusion.merged_models('regress_models', '{1}', 'dwg')$$);
SELECT pg_temp.outcome($$SELECT occlusion.merged_models('regress_models', '{1}', NULL)$$);
SELECT pg_temp.outcome($$SELECT occlusion.merged_models('regress_none', '{1}')$$);
UPDATE regress_models.model SET content = 'v 1 2' WHERE level_of_detail = 2;
SELECT pg_temp.outcome($$SELECT * FROM occlusion.visible_models('regress_models', 'POINT(85005 446990 1.75)', 2000)$$);
INSERT INTO regress_models.model (feature, level_of_detail, format, content) SELECT id, 3, 'packed', '\x00ff' FROM regress_models.feature WHERE name = 'behind';
SELECT pg_temp.outcome($$SELECT * FROM occlusion.visible_models('regress_models', 'POINT(85005 446990 1.75)', 2000)$$);
-- A model has content of its own, or is an instance.
SELECT pg_temp.outcome($$INSERT INTO regress_models.model (feature, level_of_detail, format) SELECT min(id), 4, 'packed' FROM regress_models.feature$$) LIKE '23514%' AS t;

SELECT occlusion.drop_scene('regress_models');
