-- The bridge to PostGIS.

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
SET client_min_messages = warning;

-- PostGIS in a schema of its own, after pg_occlusion; the bridge is of no use without it.
SELECT pg_temp.outcome('CREATE EXTENSION pg_occlusion_postgis') LIKE '42704 | required extension "postgis" is not installed%' AS t;
CREATE SCHEMA regress_gis;
CREATE EXTENSION postgis SCHEMA regress_gis;
CREATE EXTENSION pg_occlusion_postgis;
SELECT pg_describe_object(d.classid, d.objid, d.objsubid) AS lacks_comment
FROM pg_depend AS d
LEFT JOIN pg_description AS t ON t.classoid = d.classid AND t.objoid = d.objid AND t.objsubid = 0
WHERE d.refclassid = 'pg_extension'::regclass AND d.deptype = 'e' AND t.description IS NULL
  AND d.refobjid = (SELECT oid FROM pg_extension WHERE extname = 'pg_occlusion_postgis')
  AND d.classid <> 'pg_cast'::regclass;
SET search_path = public, regress_gis;

-- Casts, there and back.
SELECT 'POINT Z (85000.123 447000.456 7)'::geometry::occlusion.point3d AS z, 'POINT(1 2)'::geometry::occlusion.point3d AS flat, 'POINT EMPTY'::geometry::occlusion.point3d IS NULL AS empty;
SELECT ST_AsText(occlusion.point3d(1, 2, 3)::geometry);
SELECT 'LINESTRING Z (3 2 1, 1 5 9)'::geometry::occlusion.box3d, 'LINESTRING(3 2, 1 5)'::geometry::occlusion.box3d, 'POLYGON EMPTY'::geometry::occlusion.box3d IS NULL AS empty;
SELECT ST_AsText('BOX3D(0 0 0,1 2 3)'::occlusion.box3d::geometry);
SELECT 'BOX3D(0 0 0,1 2 3)'::occlusion.box3d::geometry::occlusion.box3d;
SELECT 'BOX3D(0 1 2,3 4 5)'::regress_gis.box3d::occlusion.box3d, 'BOX3D(0 1 2,3 4 5)'::occlusion.box3d::regress_gis.box3d;
SELECT ST_AsText('{"((0,0),(9,0),(9,9),(0,9))","((1,1),(2,1),(2,2))"}'::polygon[]::geometry);
SELECT pg_temp.outcome($$SELECT 'LINESTRING(3 2, 1 5)'::geometry::occlusion.point3d$$) LIKE '%Argument to ST_X() must%' AS t;

-- Import: faces in space, level footprints, footprints of several parts, and what is none.
CREATE TABLE regress_gis.house (name text, class text, geom geometry, bottom float8, height float8, owner text);
INSERT INTO regress_gis.house VALUES
    ('box', 'Building', ST_SetSRID('BOX3D(85000 447000 0,85010 447010 9)'::occlusion.box3d::geometry, 28992), NULL, NULL, 'a'),
    ('raised', NULL, 'SRID=28992;POLYGON((85020 447000,85030 447000,85030 447010,85020 447010,85020 447000),(85022 447002,85024 447002,85024 447004,85022 447004,85022 447002))', NULL, 7, 'b'),
    ('level', 'Building', 'SRID=28992;POLYGON Z ((85040 447000 0.5,85050 447000 0.5,85050 447010 0.5,85040 447010 0.5,85040 447000 0.5))', NULL, 6, 'c'),
    ('parts', 'Building', 'SRID=28992;MULTIPOLYGON(((85060 447000,85065 447000,85065 447010,85060 447010,85060 447000)),((85070 447000,85075 447000,85075 447010,85070 447010,85070 447000)))', 0, 5, NULL),
    ('open', 'Building', 'SRID=28992;MULTIPOLYGON Z (((85080 447000 0,85090 447000 0,85090 447000 9,85080 447000 0)))', NULL, NULL, NULL),
    ('tin', 'Building', 'SRID=28992;TIN Z (((85100 447000 0,85100 447010 0,85110 447000 0,85100 447000 0)),((85100 447000 0,85110 447000 0,85100 447000 9,85100 447000 0)),((85110 447000 0,85100 447010 0,85100 447000 9,85110 447000 0)),((85100 447010 0,85100 447000 0,85100 447000 9,85100 447010 0)))', NULL, NULL, NULL),
    ('no height', 'Building', 'SRID=28992;POLYGON((85020 447000,85030 447000,85030 447010,85020 447000))', NULL, NULL, NULL),
    ('line', 'Building', 'SRID=28992;LINESTRING(85020 447000,85030 447000)', NULL, 3, NULL),
    ('nothing', 'Building', NULL, NULL, 3, NULL);
SELECT occlusion.create_scene('regress_bridge');
SELECT occlusion.import_geometries('regress_bridge', 'regress_gis.house');
SELECT srid FROM regress_bridge.scene_info;
SELECT f.name, f.class, f.envelope, f.attributes, count(c) AS columns, bool_and(c.grounded) AS grounded
FROM regress_bridge.feature AS f LEFT JOIN regress_bridge.solid_column AS c ON c.feature = f.id
GROUP BY f.id ORDER BY f.name;
SELECT * FROM occlusion.import_report('regress_bridge');
-- With geometries of PostGIS as a filter, by our index.
SELECT f.name FROM regress_bridge.feature AS f
WHERE f.envelope OPERATOR(occlusion.&&) 'POLYGON Z ((85015 446990 1,85045 446990 1,85045 447001 1,85015 446990 1))'::geometry::occlusion.box3d
ORDER BY f.name;

-- Refusals.
SELECT pg_temp.outcome($$SELECT occlusion.import_geometries('regress_bridge', 'regress_gis.house', geometry => 'owner')$$);
SELECT pg_temp.outcome($$SELECT occlusion.import_geometries('regress_bridge', 'regress_gis.house', geometry => 'shape')$$);
CREATE TABLE regress_gis.degrees AS SELECT 'a' AS name, 'SRID=4326;POLYGON((4 52,5 52,5 53,4 52))'::geometry AS geom, 3 AS height;
SELECT pg_temp.outcome($$SELECT occlusion.import_geometries('regress_bridge', 'regress_gis.degrees')$$);
CREATE TABLE regress_gis.elsewhere AS SELECT 'a' AS name, 'SRID=32631;POLYGON((4 52,5 52,5 53,4 52))'::geometry AS geom, 3 AS height;
SELECT pg_temp.outcome($$SELECT occlusion.import_geometries('regress_bridge', 'regress_gis.elsewhere')$$);
INSERT INTO regress_gis.elsewhere SELECT 'b', 'SRID=28992;POLYGON((4 52,5 52,5 53,4 52))', 3;
SELECT pg_temp.outcome($$SELECT occlusion.import_geometries('regress_bridge', 'regress_gis.elsewhere')$$);
SELECT pg_temp.outcome($$SELECT occlusion.import_features('regress_bridge', 'regress_gis.house', footprint => 'geom')$$);

SELECT occlusion.drop_scene('regress_bridge');
RESET search_path;
DROP EXTENSION pg_occlusion_postgis;
DROP SCHEMA regress_gis CASCADE;

-- The other order, by CASCADE, and the bridge gone with either.
\set here :DBNAME
CREATE DATABASE regress_other;
\c regress_other
SET client_min_messages = warning;
CREATE EXTENSION postgis;
CREATE EXTENSION pg_occlusion_postgis CASCADE;
SELECT extname FROM pg_extension WHERE extname ~ 'occlusion' ORDER BY extname;
SELECT 'POINT Z (1 2 3)'::geometry::occlusion.point3d, 'BOX3D(0 1 2,3 4 5)'::public.box3d::occlusion.box3d;
DROP EXTENSION pg_occlusion CASCADE;
SELECT count(*) = 0 AS t FROM pg_extension WHERE extname ~ 'occlusion';
\c :here
DROP DATABASE regress_other;
