-- Safety: no object that somebody put in the way is ever used, and rights count.
\pset format unaligned

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

-- Whatever runs of the hostile objects below raises an error and turns this counter, which no
-- rollback turns back.
CREATE SEQUENCE public.ran;
GRANT ALL ON SEQUENCE public.ran TO PUBLIC;
CREATE FUNCTION public.note(what text) RETURNS boolean LANGUAGE plpgsql AS $$
BEGIN
    PERFORM pg_catalog.nextval('public.ran');
    RAISE EXCEPTION 'hostile % ran', what;
END
$$;

-- Houses in a row, a street on each side; house 2 hides a shed from the north side.
CREATE FUNCTION public.make_row(scene text) RETURNS void LANGUAGE plpgsql AS $$
BEGIN
    PERFORM occlusion.create_scene(scene);
    EXECUTE format($q$
        INSERT INTO %1$I.feature (id, class, envelope) VALUES
            (1, 'Building', 'BOX3D(0 0 0, 10 10 10)'), (2, 'Building', 'BOX3D(10 0 0, 20 10 10)'),
            (3, 'Building', 'BOX3D(20 0 0, 30 10 10)'), (4, 'Shed', 'BOX3D(14 -3 0, 16 -1 2)');
        INSERT INTO %1$I.inner_envelope SELECT id, envelope, true FROM %1$I.feature;
        INSERT INTO %1$I.street (area, eye_low, eye_high) VALUES
            (ARRAY['((0,12),(30,12),(30,20),(0,20))'::polygon], 1.5, 2),
            (ARRAY['((0,-20),(30,-20),(30,-10),(0,-10))'::polygon], 1.5, 2);
    $q$, scene);
END
$$;
SELECT public.make_row('regress_row');
SET client_min_messages = warning;
CALL occlusion.generate_occlusion_volumes('regress_row');
RESET client_min_messages;
CREATE TABLE public.expected AS
SELECT 'all round' AS how, array_agg(feature_id ORDER BY feature_id) AS features
FROM occlusion.visible_features('regress_row', 'POINT(15 15 1.75)', 100)
UNION ALL
SELECT 'cone', array_agg(feature_id ORDER BY feature_id)
FROM occlusion.visible_features('regress_row', 'VIEW_CONE(15 15 1.75, 180, 60, 100, 0)'::occlusion.view_cone)
UNION ALL
SELECT 'sector', array_agg(feature_id ORDER BY feature_id)
FROM occlusion.visible_features('regress_row', 'VIEW_SECTOR(15 15 1.75, 180, 60, 100)'::occlusion.view_sector);
TABLE public.expected;
CREATE TABLE public.volumes AS SELECT occluder, occludee, box::text FROM regress_row.occlusion_volume;
SELECT count(*) > 0 AS t FROM public.volumes;
GRANT SELECT ON public.expected, public.volumes TO PUBLIC;

CREATE FUNCTION public.same_answers() RETURNS boolean LANGUAGE plpgsql AS $$
BEGIN
    RETURN (SELECT pg_catalog.bool_and(pg_catalog.array_eq(s.answer, e.features)) AND pg_catalog.count(*) OPERATOR(pg_catalog.=) 3
            FROM public.expected AS e
            CROSS JOIN LATERAL (SELECT CASE pg_catalog.left(e.how, 1)
                WHEN 'a'::pg_catalog.text THEN (SELECT pg_catalog.array_agg(f.feature_id ORDER BY f.feature_id)
                    FROM occlusion.visible_features('regress_row', 'POINT(15 15 1.75)'::occlusion.point3d, 100) AS f)
                WHEN 'c'::pg_catalog.text THEN (SELECT pg_catalog.array_agg(f.feature_id ORDER BY f.feature_id)
                    FROM occlusion.visible_features('regress_row', 'VIEW_CONE(15 15 1.75, 180, 60, 100, 0)'::occlusion.view_cone) AS f)
                WHEN 's'::pg_catalog.text THEN (SELECT pg_catalog.array_agg(f.feature_id ORDER BY f.feature_id)
                    FROM occlusion.visible_features('regress_row', 'VIEW_SECTOR(15 15 1.75, 180, 60, 100)'::occlusion.view_sector) AS f)
            END) AS s (answer));
END
$$;
ALTER FUNCTION public.same_answers() SET search_path = pg_catalog, pg_temp;
SELECT public.same_answers() AS t;

-- Tables, views and types of a scene's names in pg_temp and public.
CREATE TEMPORARY TABLE feature (id bigint, class text, envelope occlusion.box3d);
CREATE TEMPORARY TABLE occlusion_volume (occluder bigint, occludee bigint, box occlusion.box3d);
INSERT INTO feature VALUES (666, 'Hostile', 'BOX3D(0 0 0, 10 10 10)');
INSERT INTO occlusion_volume SELECT 666, id, 'BOX3D(-99 -99 -99, 99 99 99)' FROM regress_row.feature;
CREATE TEMPORARY TABLE inner_envelope (feature bigint, box occlusion.box3d, grounded boolean);
CREATE TEMPORARY TABLE job (task text);
CREATE TEMPORARY VIEW street AS SELECT ARRAY['((0,0),(1,1),(1,0))'::polygon] AS area, 0::float8 AS eye_low,
    1::float8 AS eye_high, 'BOX3D(0 0 0, 1 1 1)'::occlusion.box3d AS envelope WHERE public.note('view street');
CREATE VIEW public.feature AS SELECT 666::bigint AS id WHERE public.note('view feature');
-- Catalogs too: pg_temp comes before pg_catalog unless named after it.
CREATE TEMPORARY VIEW pg_class AS SELECT * FROM pg_catalog.pg_class WHERE public.note('view pg_class');
CREATE TEMPORARY VIEW pg_namespace AS SELECT * FROM pg_catalog.pg_namespace WHERE public.note('view pg_namespace');
SET search_path = pg_temp, regress_row, public, pg_catalog;
SELECT public.same_answers() AS t;

-- Functions, operators and types of better fitting arguments, in public and in the scene's schema, put first.
CREATE FUNCTION regress_row.hostile(occlusion.box3d, occlusion.view_cone) RETURNS boolean LANGUAGE sql AS $$SELECT public.note('&& view_cone')$$;
CREATE FUNCTION regress_row.hostile(occlusion.box3d, occlusion.view_sector) RETURNS boolean LANGUAGE sql AS $$SELECT public.note('&& view_sector')$$;
CREATE FUNCTION regress_row.hostile(occlusion.box3d, occlusion.box3d) RETURNS boolean LANGUAGE sql AS $$SELECT public.note('&& box3d')$$;
CREATE FUNCTION regress_row.hostile(occlusion.box3d, occlusion.point3d) RETURNS boolean LANGUAGE sql AS $$SELECT public.note('@> point3d')$$;
CREATE FUNCTION regress_row.hostile(polygon, point) RETURNS boolean LANGUAGE sql AS $$SELECT public.note('polygon @> point')$$;
CREATE FUNCTION regress_row.hostile(bigint, bigint) RETURNS boolean LANGUAGE sql AS $$SELECT public.note('bigint = bigint')$$;
CREATE FUNCTION regress_row.hostile(text, text) RETURNS boolean LANGUAGE sql AS $$SELECT public.note('text = text')$$;
CREATE FUNCTION regress_row.hostile(name, text) RETURNS boolean LANGUAGE sql AS $$SELECT public.note('name = text')$$;
CREATE FUNCTION regress_row.hostile(float8, float8) RETURNS boolean LANGUAGE sql AS $$SELECT public.note('float8 <= float8')$$;
CREATE FUNCTION regress_row.hostile_distance(occlusion.box3d, occlusion.point3d) RETURNS float8 LANGUAGE sql AS $$SELECT public.note('<->')::int::float8$$;
CREATE OPERATOR regress_row.&& (LEFTARG = occlusion.box3d, RIGHTARG = occlusion.view_cone, FUNCTION = regress_row.hostile);
CREATE OPERATOR regress_row.&& (LEFTARG = occlusion.box3d, RIGHTARG = occlusion.view_sector, FUNCTION = regress_row.hostile);
CREATE OPERATOR regress_row.&& (LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = regress_row.hostile);
CREATE OPERATOR regress_row.= (LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = regress_row.hostile);
CREATE OPERATOR regress_row.@> (LEFTARG = occlusion.box3d, RIGHTARG = occlusion.point3d, FUNCTION = regress_row.hostile);
CREATE OPERATOR regress_row.@> (LEFTARG = polygon, RIGHTARG = point, FUNCTION = regress_row.hostile);
CREATE OPERATOR regress_row.= (LEFTARG = bigint, RIGHTARG = bigint, FUNCTION = regress_row.hostile);
CREATE OPERATOR regress_row.= (LEFTARG = text, RIGHTARG = text, FUNCTION = regress_row.hostile);
CREATE OPERATOR regress_row.= (LEFTARG = name, RIGHTARG = text, FUNCTION = regress_row.hostile);
CREATE OPERATOR regress_row.<= (LEFTARG = float8, RIGHTARG = float8, FUNCTION = regress_row.hostile);
CREATE OPERATOR regress_row.<-> (LEFTARG = occlusion.box3d, RIGHTARG = occlusion.point3d, FUNCTION = regress_row.hostile_distance);
CREATE FUNCTION regress_row.point(float8, float8) RETURNS point LANGUAGE sql AS $$SELECT CASE WHEN public.note('point') THEN NULL::point END$$;
CREATE FUNCTION regress_row.x(occlusion.point3d) RETURNS float8 LANGUAGE sql AS $$SELECT public.note('x')::int::float8$$;
CREATE FUNCTION regress_row.expand(occlusion.box3d, float8) RETURNS occlusion.box3d LANGUAGE sql AS $$SELECT CASE WHEN public.note('expand') THEN NULL::occlusion.box3d END$$;
CREATE FUNCTION regress_row.unnest(anyarray) RETURNS SETOF anyelement LANGUAGE sql AS $$SELECT $1[1] WHERE public.note('unnest')$$;
CREATE FUNCTION regress_row.format(text, VARIADIC text[]) RETURNS text LANGUAGE sql AS $$SELECT public.note('format')::text$$;
CREATE FUNCTION regress_row.quote_ident(text) RETURNS text LANGUAGE sql AS $$SELECT public.note('quote_ident')::text$$;
CREATE FUNCTION regress_row.octet_length(text) RETURNS int LANGUAGE sql AS $$SELECT public.note('octet_length')::int$$;
CREATE FUNCTION regress_row.pg_backend_pid() RETURNS int LANGUAGE sql AS $$SELECT public.note('pg_backend_pid')::int$$;
CREATE FUNCTION regress_row.require_scene(text) RETURNS void LANGUAGE sql AS $$SELECT public.note('require_scene')$$;
CREATE DOMAIN regress_row.text AS pg_catalog.text CHECK (public.note('type text'));
CREATE DOMAIN regress_row.polygon AS pg_catalog.polygon CHECK (public.note('type polygon'));
CREATE DOMAIN regress_row.point AS pg_catalog.point CHECK (public.note('type point'));
CREATE DOMAIN regress_row.box3d AS occlusion.box3d CHECK (public.note('type box3d'));
-- They would run: this is how the session sees them.
SET search_path = regress_row, public, pg_catalog, pg_temp;
\set VERBOSITY terse
SELECT 'BOX3D(0 0 0, 1 1 1)'::occlusion.box3d && 'VIEW_CONE(0 0 0, 0, 60, 5, 0)'::occlusion.view_cone;
SELECT point(1::float8, 2::float8);
SELECT 'x'::text;
SELECT pg_catalog.setval('public.ran', 1, false);
SELECT public.same_answers() AS t;
CREATE TEMPORARY TABLE explained AS
SELECT * FROM occlusion.explain_visible_features('regress_row', 'POINT(15 15 1.75)', 100);
-- Nothing of it runs when scenes are made, filled, computed, changed and dropped either.
SET client_min_messages = warning;
CALL occlusion.generate_occlusion_volumes('regress_row');
RESET client_min_messages;
SELECT progress.state OPERATOR(pg_catalog.=) 'finished'::pg_catalog.text AS t FROM occlusion.progress('regress_row') AS progress;
SELECT occlusion.create_scene('regress_other');
SELECT occlusion.generate_city('regress_other', 'scattered', 5) OPERATOR(pg_catalog.=) 5::bigint AS t;
SELECT occlusion.generate_view_region('regress_other') OPERATOR(pg_catalog.>) 0::bigint AS t;
UPDATE regress_other.feature SET envelope = 'BOX3D(0 0 0, 1 1 1)' WHERE id OPERATOR(pg_catalog.=) 1::bigint;
DELETE FROM regress_other.inner_envelope WHERE feature OPERATOR(pg_catalog.=) 2::bigint;
TRUNCATE regress_other.inner_envelope;
SELECT occlusion.drop_scene('regress_other');
SET search_path = pg_catalog, public;
\set VERBOSITY default
SELECT NOT is_called AS t FROM public.ran;
SELECT count(*) = 0 AS t FROM (
    (SELECT occluder, occludee, box::text FROM regress_row.occlusion_volume EXCEPT ALL TABLE public.volumes)
    UNION ALL (TABLE public.volumes EXCEPT ALL SELECT occluder, occludee, box::text FROM regress_row.occlusion_volume)) AS changed;
-- A scene that holds such things is dropped by force only.
SELECT left(pg_temp.outcome($$SELECT occlusion.drop_scene('regress_row')$$), 68);
SET client_min_messages = warning;
SELECT occlusion.drop_scene('regress_row', true);
DROP VIEW public.feature, pg_temp.street, pg_temp.pg_class, pg_temp.pg_namespace;
DROP TABLE pg_temp.feature, pg_temp.occlusion_volume, pg_temp.inner_envelope, pg_temp.job;
RESET client_min_messages;

-- What is no real table, or has another type, is not read: views, materialised views, foreign tables.
SELECT public.make_row('regress_row');
CREATE FUNCTION pg_temp.asked() RETURNS SETOF text LANGUAGE sql AS $$
    SELECT pg_temp.outcome(statement)
    FROM (VALUES
        ($q$SELECT occlusion.visible_features('regress_row', 'POINT(15 15 1.75)', 100)$q$),
        ($q$SELECT occlusion.visible_features('regress_row', 'VIEW_CONE(15 15 1.75, 180, 60, 100, 0)'::occlusion.view_cone)$q$),
        ($q$SELECT occlusion.generate_view_region('regress_row')$q$)
    ) AS s (statement)
$$;
ALTER TABLE regress_row.feature RENAME TO real_feature;
CREATE VIEW regress_row.feature AS SELECT * FROM regress_row.real_feature WHERE public.note('view in place of a table');
SELECT * FROM pg_temp.asked();
CALL occlusion.generate_occlusion_volumes('regress_row');
DROP VIEW regress_row.feature;
CREATE MATERIALIZED VIEW regress_row.feature AS SELECT * FROM regress_row.real_feature;
SELECT * FROM pg_temp.asked();
DROP MATERIALIZED VIEW regress_row.feature;
SELECT * FROM pg_temp.asked();
ALTER TABLE regress_row.real_feature RENAME TO feature;
ALTER TABLE regress_row.street RENAME TO real_street;
CREATE VIEW regress_row.street AS SELECT * FROM regress_row.real_street WHERE public.note('view in place of a table');
SELECT * FROM pg_temp.asked();
DROP VIEW regress_row.street;
ALTER TABLE regress_row.real_street RENAME TO street;
-- A type of another's making.
CREATE DOMAIN public.box3d AS occlusion.box3d;
ALTER TABLE regress_row.inner_envelope ALTER box TYPE public.box3d;
SELECT * FROM pg_temp.asked();
ALTER TABLE regress_row.inner_envelope ALTER box TYPE occlusion.box3d;
ALTER TABLE regress_row.feature ALTER class TYPE varchar;
SELECT * FROM pg_temp.asked();
ALTER TABLE regress_row.feature ALTER class TYPE text;
ALTER TABLE regress_row.occlusion_volume RENAME box TO place;
SELECT * FROM pg_temp.asked();
ALTER TABLE regress_row.occlusion_volume RENAME place TO box;
-- A view as the mark of a scene.
ALTER TABLE regress_row.scene_info RENAME TO real_info;
CREATE VIEW regress_row.scene_info AS SELECT * FROM regress_row.real_info WHERE public.note('view in place of a table');
SELECT * FROM pg_temp.asked();
SELECT pg_temp.outcome($$SELECT occlusion.drop_scene('regress_row')$$);
SELECT pg_temp.outcome($$SELECT occlusion.drop_scene('regress_row', true)$$);
DROP VIEW regress_row.scene_info;
ALTER TABLE regress_row.real_info RENAME TO scene_info;
SELECT * FROM pg_temp.asked();
SELECT NOT is_called AS t FROM public.ran;
DROP DOMAIN public.box3d;

-- Rights: a role without any, a reader, and a reader whom row security keeps from some rows.
SELECT occlusion.drop_scene('regress_row');
SELECT public.make_row('regress_row');
SET client_min_messages = warning;
CALL occlusion.generate_occlusion_volumes('regress_row');
CREATE ROLE regress_nobody;
CREATE ROLE regress_reader;
RESET client_min_messages;
GRANT USAGE ON SCHEMA occlusion TO regress_nobody, regress_reader;
GRANT USAGE ON SCHEMA regress_row TO regress_reader;
GRANT SELECT ON ALL TABLES IN SCHEMA regress_row TO regress_reader;
CREATE FUNCTION pg_temp.all_calls() RETURNS TABLE (call text, outcome text) LANGUAGE sql AS $$
    SELECT replace(statement, 'SELECT occlusion.', ''), pg_temp.outcome(statement)
    FROM (VALUES
        ($q$SELECT occlusion.visible_features('regress_row', 'POINT(15 15 1.75)', 100)$q$),
        ($q$SELECT occlusion.visible_features('regress_row', 'VIEW_CONE(15 15 1.75, 180, 60, 100, 0)'::occlusion.view_cone)$q$),
        ($q$SELECT occlusion.visible_features('regress_row', 'VIEW_SECTOR(15 15 1.75, 180, 60, 100)'::occlusion.view_sector)$q$),
        ($q$SELECT occlusion.explain_visible_features('regress_row', 'POINT(15 15 1.75)', 100)$q$),
        ($q$SELECT occlusion.progress('regress_row')$q$),
        ($q$SELECT occlusion.generate_city('regress_row')$q$),
        ($q$SELECT occlusion.generate_view_region('regress_row')$q$),
        ($q$SELECT occlusion.create_scene('regress_theirs')$q$),
        ($q$SELECT occlusion.drop_scene('regress_row')$q$),
        ($q$SELECT occlusion.drop_scene('regress_row', true)$q$),
        ($q$INSERT INTO regress_row.feature (envelope) VALUES ('BOX3D(0 0 0, 1 1 1)')$q$)
    ) AS s (statement)
$$;
SET ROLE regress_nobody;
SELECT * FROM pg_temp.all_calls();
CALL occlusion.generate_occlusion_volumes('regress_row');
SET ROLE regress_reader;
SELECT * FROM pg_temp.all_calls();
CALL occlusion.generate_occlusion_volumes('regress_row');
SELECT public.same_answers() AS t;
RESET ROLE;
SELECT count(*) > 0 AS t FROM regress_row.occlusion_volume;

-- Each table that a query reads must be readable.
SELECT table_name, pg_temp.outcome(format($$
    REVOKE SELECT ON regress_row.%1$I FROM regress_reader;
    SET LOCAL ROLE regress_reader;
    SELECT count(*) FROM occlusion.visible_features('regress_row', 'POINT(15 15 1.75)', 100)
$$, table_name))
FROM (VALUES ('feature'), ('occlusion_volume'), ('inner_envelope'), ('street'), ('model')) AS t (table_name);

-- Row security.
ALTER TABLE regress_row.feature ENABLE ROW LEVEL SECURITY;
CREATE POLICY not_first ON regress_row.feature USING (id <> 1);
SET ROLE regress_reader;
SELECT array_agg(feature_id ORDER BY feature_id) = '{2,3}' AS t
FROM occlusion.visible_features('regress_row', 'POINT(15 15 1.75)', 100);
SELECT array_agg(feature_id ORDER BY feature_id) = '{2,3,4}' AS t
FROM occlusion.visible_features('regress_row', 'POINT(15 -5 1.75)', 100);
RESET ROLE;
SELECT public.same_answers() AS t;

-- Volumes that row security hides from an editor must not survive its edit: the edit is refused.
GRANT SELECT, UPDATE ON regress_row.feature TO regress_reader;
GRANT SELECT, DELETE ON regress_row.occlusion_volume TO regress_reader;
ALTER TABLE regress_row.occlusion_volume ENABLE ROW LEVEL SECURITY;
CREATE POLICY none ON regress_row.occlusion_volume USING (false);
SET ROLE regress_reader;
SELECT pg_temp.outcome($$UPDATE regress_row.feature SET envelope = 'BOX3D(14 -3 0, 16 -1 200)' WHERE id = 4$$);
RESET ROLE;
SELECT envelope OPERATOR(occlusion.=) 'BOX3D(14 -3 0, 16 -1 2)'::occlusion.box3d AS t FROM regress_row.feature WHERE id = 4;

SELECT NOT is_called AS t FROM public.ran;
SELECT occlusion.drop_scene('regress_row');
REVOKE USAGE ON SCHEMA occlusion FROM regress_nobody, regress_reader;
DROP ROLE regress_nobody, regress_reader;
DROP TABLE public.expected, public.volumes;
DROP SEQUENCE public.ran;
DROP FUNCTION public.note, public.make_row, public.same_answers;
