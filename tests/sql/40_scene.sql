-- Scenes: made, described, refused, dropped; and what the extension installs as a whole.

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

SELECT occlusion.create_scene('regress_scene', 28992);
\pset format unaligned
SELECT table_name, string_agg(column_name || ' ' || replace(data_type, 'USER-DEFINED', udt_name), ', ' ORDER BY ordinal_position)
FROM information_schema.columns WHERE table_schema = 'regress_scene' GROUP BY table_name ORDER BY table_name;
SELECT count(*) = 1 AND min(srid) = 28992 AND min(format_version) = 2 AND min(ground) IS NULL AS t FROM regress_scene.scene_info;
SELECT indexname FROM pg_indexes WHERE schemaname = 'regress_scene' AND indexdef LIKE '%gist%' ORDER BY indexname;
-- A scene has all that functions look for.
SELECT count(*) = 0 AS t
FROM occlusion.scene_columns() AS s
LEFT JOIN information_schema.columns AS c
       ON c.table_schema = 'regress_scene' AND c.table_name = s.table_name AND c.column_name = s.column_name
WHERE c.column_name IS NULL;
SELECT occlusion.require_scene('regress_scene');

-- Everything is described.
SELECT obj_description('regress_scene'::regnamespace) IS NOT NULL AS t;
SELECT c.relname, a.attname
FROM pg_class AS c
LEFT JOIN pg_attribute AS a ON a.attrelid = c.oid AND a.attnum > 0 AND NOT a.attisdropped
WHERE c.relnamespace = 'regress_scene'::regnamespace AND c.relkind = 'r'
  AND (obj_description(c.oid, 'pg_class') IS NULL OR col_description(c.oid, a.attnum) IS NULL);
SELECT pg_describe_object(d.classid, d.objid, d.objsubid) AS lacks_comment
FROM pg_depend AS d
LEFT JOIN pg_description AS t ON t.classoid = d.classid AND t.objoid = d.objid AND t.objsubid = 0
WHERE d.refclassid = 'pg_extension'::regclass AND d.deptype = 'e' AND t.description IS NULL
  AND d.refobjid = (SELECT oid FROM pg_extension WHERE extname = 'pg_occlusion')
  -- arrays, rows and families come with their types, views and classes; input, output and support functions
  -- belong to them, like those of core, and are called by nobody
  AND NOT (d.classid = 'pg_type'::regclass AND EXISTS (SELECT FROM pg_type WHERE oid = d.objid AND (typelem <> 0 OR typrelid <> 0)))
  AND d.classid <> 'pg_opfamily'::regclass
  AND NOT (d.classid = 'pg_proc'::regclass AND EXISTS (
      SELECT FROM pg_proc WHERE oid = d.objid AND proname ~ '(_in|_out|_recv|_send|3d_(gist|spgist|brin)_[a-z_]+)$'))
ORDER BY 1;

-- How functions may be used: C and queries in parallel, nothing that writes declared stable.
SELECT proname, pg_get_function_arguments(oid) AS arguments, provolatile, proparallel, proisstrict
FROM pg_proc
WHERE pronamespace = 'occlusion'::regnamespace
  AND NOT (provolatile = 'i' AND proparallel = 's' AND proisstrict AND prolang = (SELECT oid FROM pg_language WHERE lanname = 'c'))
ORDER BY proname, arguments;
-- None runs with the rights of somebody else; all in an SQL language fix the search path, or are bound already.
SELECT count(*) = 0 AS t FROM pg_proc WHERE pronamespace = 'occlusion'::regnamespace AND prosecdef;
SELECT proname FROM pg_proc
WHERE pronamespace = 'occlusion'::regnamespace
  AND prolang <> (SELECT oid FROM pg_language WHERE lanname = 'c')
  AND prosqlbody IS NULL -- bound when it was created
  AND prokind <> 'a'
  AND proconfig IS DISTINCT FROM '{"search_path=pg_catalog, pg_temp"}'
ORDER BY proname;

-- Refused.
CREATE SCHEMA regress_plain;
CREATE TABLE regress_plain.feature (id bigint);
SELECT pg_temp.outcome(statement)
FROM (VALUES
    ($$SELECT occlusion.create_scene('regress_scene')$$),
    ($$SELECT occlusion.create_scene('regress_plain')$$),
    ($$SELECT occlusion.create_scene(repeat('x', 64))$$),
    ($$SELECT occlusion.create_scene(repeat('é', 32))$$),
    ($$SELECT occlusion.create_scene('')$$),
    ($$SELECT occlusion.create_scene('pg_scene')$$),
    ($$SELECT occlusion.drop_scene('regress_plain')$$),
    ($$SELECT occlusion.drop_scene('regress_plain', true)$$),
    ($$SELECT occlusion.drop_scene('pg_catalog', true)$$),
    ($$SELECT occlusion.drop_scene('occlusion', true)$$),
    ($$SELECT occlusion.drop_scene('regress_nowhere')$$),
    ($$SELECT occlusion.drop_scene('regress_nowhere', true)$$),
    ($$SELECT occlusion.drop_scene(repeat('x', 64))$$),
    ($$SELECT occlusion.require_scene('regress_plain')$$),
    ($$SELECT occlusion.require_scene('Regress_Scene')$$),
    ($$SELECT occlusion.require_scene('regress_scene.feature')$$),
    ($$SELECT occlusion.progress('regress_plain')$$),
    ($$SELECT occlusion.visible_features('regress_plain', 'POINT(0 0 0)', 10)$$),
    ($$SELECT occlusion.visible_features('regress_nowhere', 'VIEW_CONE(0 0 0, 0, 60, 10, 0)'::occlusion.view_cone)$$),
    ($$SELECT occlusion.visible_features('', 'VIEW_SECTOR(0 0 0, 0, 60, 10)'::occlusion.view_sector)$$),
    ($$SELECT occlusion.visible_features('regress_scene', 'POINT(0 0 0)', -1)$$),
    ($$SELECT occlusion.visible_features('regress_scene', 'POINT(0 0 0)', 'NaN')$$),
    ($$SELECT occlusion.explain_visible_features('regress_scene', 'POINT(0 0 0)', 'Infinity')$$),
    ($$SELECT occlusion.explain_visible_features('regress_plain', 'POINT(0 0 0)', 10)$$)
) AS refused (statement);
SELECT occlusion.create_scene(NULL) IS NULL AS t, occlusion.drop_scene(NULL) IS NULL AS t;

-- A name of 63 bytes is whole; one byte more was refused, not cut.
SELECT occlusion.create_scene(repeat('y', 63));
SELECT occlusion.drop_scene(repeat('y', 63));

-- Names that need quotes.
CREATE FUNCTION pg_temp.works(name text) RETURNS boolean LANGUAGE plpgsql AS $$
BEGIN
    PERFORM occlusion.create_scene(name);
    ASSERT occlusion.generate_city(name, 'scattered', 5) = 5;
    ASSERT occlusion.generate_view_region(name) > 0;
    ASSERT (SELECT count(*) FROM occlusion.visible_features(name, 'POINT(500 500 1.75)', 2000)) = 5;
    ASSERT (SELECT count(*) FROM occlusion.explain_visible_features(name, 'POINT(500 500 1.75)', 2000)) > 5;
    ASSERT (SELECT count(*) FROM occlusion.progress(name)) = 0;
    PERFORM occlusion.drop_scene(name);
    RETURN to_regnamespace(quote_ident(name)) IS NULL;
END
$$;
SELECT name, pg_temp.works(name) AS t
FROM (VALUES ($n$O'Br"ien x$n$), ('select'), ('Ütrecht; --'), ('a.b'), ('%s %I'), ('$1'), (' '), (E'line\tbreak')) AS n (name);
SELECT occlusion.create_scene($n$O'Br"ien x$n$);
SELECT occlusion.generate_city($n$O'Br"ien x$n$, 'scattered', 20);
SET client_min_messages = warning;
CALL occlusion.generate_occlusion_volumes($n$O'Br"ien x$n$);
RESET client_min_messages;
SELECT count(*) > 0 AS t FROM "O'Br""ien x".occlusion_volume;
-- A refusal quotes them as they are.
SELECT pg_temp.outcome($$SELECT occlusion.create_scene($n$O'Br"ien x$n$)$$);
SELECT occlusion.drop_scene($n$O'Br"ien x$n$);
SELECT pg_temp.outcome($$SELECT occlusion.drop_scene($n$O'Br"ien x$n$)$$);

-- A scene with another's objects in it, or views on it outside, stays unless forced.
CREATE TABLE regress_scene.note (text text);
SELECT pg_temp.outcome($$SELECT occlusion.drop_scene('regress_scene')$$);
DROP TABLE regress_scene.note;
CREATE FUNCTION regress_scene.note() RETURNS int LANGUAGE sql AS 'SELECT 1';
SELECT pg_temp.outcome($$SELECT occlusion.drop_scene('regress_scene')$$);
DROP FUNCTION regress_scene.note();
CREATE VIEW regress_plain.building AS SELECT id FROM regress_scene.feature;
SELECT pg_temp.outcome($$SELECT occlusion.drop_scene('regress_scene')$$);
SELECT count(*) = 0 AS t FROM regress_plain.building;
SELECT pg_temp.outcome($$SELECT occlusion.drop_scene('regress_scene', NULL)$$), 'regress_scene'::regnamespace;
SET client_min_messages = warning;
SELECT occlusion.drop_scene('regress_scene', force => true);
RESET client_min_messages;
SELECT to_regnamespace('regress_scene') IS NULL AS t, to_regclass('regress_plain.building') IS NULL AS t,
       to_regclass('regress_plain.feature') IS NOT NULL AS t;

-- A scene takes columns, indexes, statistics and rights of its owner's, and is still a scene, under a new name too.
SELECT occlusion.create_scene('regress_scene');
ALTER TABLE regress_scene.feature ADD height float8;
CREATE INDEX ON regress_scene.feature (class);
SELECT occlusion.generate_city('regress_scene', 'scattered', 10);
ALTER SCHEMA regress_scene RENAME TO regress_renamed;
SELECT count(*) = 10 AS t FROM occlusion.visible_features('regress_renamed', 'POINT(500 500 900)', 3000);
-- One whose mark is damaged is dropped by force only.
DROP TABLE regress_renamed.street;
SELECT pg_temp.outcome($$SELECT occlusion.visible_features('regress_renamed', 'POINT(500 500 900)', 3000)$$);
SELECT pg_temp.outcome($$SELECT occlusion.drop_scene('regress_renamed')$$);
SET client_min_messages = warning;
SELECT occlusion.drop_scene('regress_renamed', true);
DROP SCHEMA regress_plain CASCADE;
