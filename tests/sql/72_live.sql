-- Live answers: an occlusion horizon over packed tiles, under the snapshot of the query.
SET search_path = occlusion, public;
SET client_min_messages = warning;
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

-- Three houses in a row, the last one taller, and a wall aside.
SELECT create_scene('regress_live');
INSERT INTO regress_live.feature (id, class, envelope) VALUES
    (1, 'Building', 'BOX3D(85000 447000 0, 85010 447010 8)'), (2, 'Building', 'BOX3D(85000 447020 0, 85010 447030 8)'),
    (3, 'Tower', 'BOX3D(85000 447040 0, 85010 447050 60)'), (4, 'Wall', 'BOX3D(85100 447000 0, 85101 447300 2)');
INSERT INTO regress_live.solid_column (feature, footprint, bottom, top, grounded) VALUES
    (1, ARRAY[polygon '((85000,447000),(85010,447000),(85010,447010),(85000,447010))'], 0, 8, true);
CREATE FUNCTION pg_temp.seen() RETURNS bigint[] LANGUAGE sql AS $$
    SELECT coalesce(array_agg(feature_id ORDER BY feature_id), '{}') FROM visible_features('regress_live', 'POINT(85005 446990 1.75)', 500)
$$;
SELECT pg_temp.seen();
-- Packed, it is the same; the third is above the first, the second below it.
SELECT pack_tiles('regress_live');
SELECT pg_temp.seen();
SELECT * FROM explain_sight('regress_live', 'POINT(85005 446990 1.75)', 500);
SELECT * FROM explain_sight('regress_live', 'POINT(85005 446990 1.75)', 500) LIMIT 1;
SELECT feature_id, class, envelope, distance FROM visible_features('regress_live', 'POINT(85005 446990 1.75)', 20);

-- The log: what changes, once a transaction. What tiles do not hold is not logged.
CREATE FUNCTION pg_temp.log() RETURNS text LANGUAGE sql AS $$
    SELECT string_agg(feature || coalesce(' ' || place, ' anywhere'), ', ' ORDER BY feature, place::text) FROM regress_live.edit
$$;
BEGIN;
UPDATE regress_live.feature SET attributes = '{}', name = id, slot = id;
INSERT INTO regress_live.street (area, eye_low, eye_high) VALUES ('{"((0,0),(1,0),(1,1))"}', 1, 2);
SELECT pg_temp.log() IS NULL AS t;
DELETE FROM regress_live.solid_column;
SELECT pg_temp.seen(), pg_temp.log();
INSERT INTO regress_live.inner_envelope VALUES (1, 'BOX3D(85000 447000 0, 85010 447010 8)', true);
SELECT pg_temp.seen(), pg_temp.log();
SAVEPOINT before;
UPDATE regress_live.feature SET envelope = translate(envelope, 300, 0, 0) WHERE id = 1;
SELECT pg_temp.seen(), pg_temp.log();
ROLLBACK TO before;
SELECT pg_temp.seen(), pg_temp.log();
UPDATE regress_live.inner_envelope SET grounded = false;
SELECT pg_temp.seen(), pg_temp.log();
DELETE FROM regress_live.feature WHERE id = 1;
SELECT pg_temp.seen(), pg_temp.log();
INSERT INTO regress_live.feature (id, envelope) VALUES (5, 'BOX3D(85000 446995 0, 85010 446996 30)');
INSERT INTO regress_live.solid_column (feature, footprint, bottom, top, grounded) VALUES
    (5, ARRAY[polygon '((85000,446995),(85000,446996),(85010,446996),(85010,446995))'], 0, 30, true);
SELECT pg_temp.seen(), pg_temp.log();
-- Packed in the same transaction: nothing is left in the log, and what is edited then is logged again.
SELECT pack_tiles('regress_live') > 0 AS t, pg_temp.log() IS NULL AS t;
SELECT pg_temp.seen();
UPDATE regress_live.feature SET class = 'Fence' WHERE id = 5;
SELECT pg_temp.seen(), pg_temp.log();
ROLLBACK;
SELECT pg_temp.seen(), pg_temp.log() IS NULL AS t;
-- A row that a trigger keeps from changing was announced, and does no harm.
CREATE FUNCTION pg_temp.refuse() RETURNS trigger LANGUAGE plpgsql AS 'BEGIN RETURN NULL; END';
CREATE TRIGGER refuse BEFORE DELETE ON regress_live.feature FOR EACH ROW EXECUTE FUNCTION pg_temp.refuse();
BEGIN;
DELETE FROM regress_live.feature WHERE id = 1;
DELETE FROM regress_live.solid_column WHERE feature = 1;
SELECT pg_temp.seen(), pg_temp.log();
ROLLBACK;
DROP TRIGGER refuse ON regress_live.feature;
-- Inside a statement, too: a trigger of the user's sees what has changed so far.
CREATE FUNCTION pg_temp.look() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    RAISE WARNING '% %: %', TG_OP, coalesce(NEW.id, OLD.id), pg_temp.seen();
    RETURN NULL;
END
$$;
CREATE TRIGGER a_look AFTER INSERT OR UPDATE OR DELETE ON regress_live.feature FOR EACH ROW EXECUTE FUNCTION pg_temp.look();
BEGIN;
INSERT INTO regress_live.feature (id, envelope) VALUES (11, 'BOX3D(85000 446950 0, 85001 446951 1)'), (12, 'BOX3D(85002 446950 0, 85003 446951 1)');
UPDATE regress_live.feature SET envelope = translate(envelope, 0, -5000, 0) WHERE id IN (1, 11);
DELETE FROM regress_live.feature WHERE id IN (1, 12);
ROLLBACK;
DROP TRIGGER a_look ON regress_live.feature;
-- TRUNCATE, under the replication role too.
BEGIN;
SET LOCAL session_replication_role = replica;
TRUNCATE regress_live.solid_column;
SELECT pg_temp.seen(), (SELECT count(*) FROM regress_live.tile) AS tiles;
UPDATE regress_live.feature SET envelope = translate(envelope, 5000, 0, 0) WHERE id = 3;
SELECT pg_temp.seen(), pg_temp.log() IS NULL AS t;
ROLLBACK;
BEGIN;
SET LOCAL session_replication_role = replica;
DELETE FROM regress_live.solid_column;
SELECT pg_temp.seen(), pg_temp.log();
ROLLBACK;
SELECT pg_temp.seen();

-- Whoever may edit leaves a trace, whatever rights there are on the log.
CREATE ROLE regress_editor;
GRANT USAGE ON SCHEMA regress_live, occlusion TO regress_editor;
GRANT SELECT, INSERT, UPDATE, DELETE ON regress_live.feature, regress_live.solid_column TO regress_editor;
GRANT SELECT, DELETE ON regress_live.occlusion_volume TO regress_editor;
BEGIN;
ALTER TABLE regress_live.edit ENABLE ROW LEVEL SECURITY, FORCE ROW LEVEL SECURITY;
SET LOCAL ROLE regress_editor;
DELETE FROM regress_live.solid_column;
RESET ROLE;
SELECT pg_temp.seen(), pg_temp.log();
ROLLBACK;
-- Rights are asked before any tile is: of the tables themselves, as ever.
SELECT pg_temp.seen();
SET ROLE regress_editor;
SELECT pg_temp.outcome($$SELECT visible_features('regress_live', 'POINT(85005 446990 1.75)', 500)$$);
SELECT pg_temp.outcome($$SELECT pack_tiles('regress_live')$$);
SELECT pg_temp.outcome($$SELECT pack_tiles('regress_live', optional => true)$$);
RESET ROLE;
GRANT SELECT ON regress_live.inner_envelope, regress_live.street TO regress_editor;
SET ROLE regress_editor;
SELECT count(*) FROM visible_features('regress_live', 'POINT(85005 446990 1.75)', 500);
SELECT * FROM explain_sight('regress_live', 'POINT(85005 446990 1.75)', 500) LIMIT 1;
RESET ROLE;
GRANT SELECT ON regress_live.tile, regress_live.edit TO regress_editor;
-- Row security hides a feature from an answer, and what a hidden column hides is not hidden.
BEGIN;
ALTER TABLE regress_live.feature ENABLE ROW LEVEL SECURITY;
CREATE POLICY no_towers ON regress_live.feature TO regress_editor USING (class <> 'Tower');
SET LOCAL ROLE regress_editor;
SELECT array_agg(feature_id ORDER BY feature_id) FROM visible_features('regress_live', 'POINT(85005 446990 1.75)', 500);
SELECT pg_temp.outcome($$SELECT pack_tiles('regress_live')$$);
RESET ROLE;
ALTER TABLE regress_live.feature DISABLE ROW LEVEL SECURITY;
ALTER TABLE regress_live.solid_column ENABLE ROW LEVEL SECURITY;
SET LOCAL ROLE regress_editor;
SELECT array_agg(feature_id ORDER BY feature_id) FROM visible_features('regress_live', 'POINT(85005 446990 1.75)', 500);
RESET ROLE;
ALTER TABLE regress_live.solid_column DISABLE ROW LEVEL SECURITY;
DELETE FROM regress_live.solid_column;
ALTER TABLE regress_live.edit ENABLE ROW LEVEL SECURITY;
SET LOCAL ROLE regress_editor;
SELECT array_agg(feature_id ORDER BY feature_id) FROM visible_features('regress_live', 'POINT(85005 446990 1.75)', 500);
ROLLBACK;
REVOKE ALL ON SCHEMA regress_live, occlusion FROM regress_editor;
REVOKE ALL ON ALL TABLES IN SCHEMA regress_live FROM regress_editor;
DROP ROLE regress_editor;

-- Tables with heirs or parts are read themselves: rows of these come and go without triggers.
BEGIN;
CREATE TABLE public.regress_heir () INHERITS (regress_live.feature);
INSERT INTO public.regress_heir (id, class, envelope) VALUES (77, 'Building', 'BOX3D(85000 446950 0, 85001 446951 1)');
SELECT pg_temp.seen();
SELECT pg_temp.outcome($$SELECT pack_tiles('regress_live')$$);
ROLLBACK;
-- So is a table that became a part of another one.
BEGIN;
CREATE TABLE public.regress_whole (LIKE regress_live.solid_column INCLUDING GENERATED INCLUDING CONSTRAINTS) PARTITION BY LIST (grounded);
ALTER TABLE public.regress_whole ATTACH PARTITION regress_live.solid_column DEFAULT;
DELETE FROM public.regress_whole;
SELECT pg_temp.seen();
SELECT pg_temp.outcome($$SELECT pack_tiles('regress_live')$$);
ROLLBACK;
-- A first packing needs to see the latest.
SELECT create_scene('regress_late');
BEGIN ISOLATION LEVEL REPEATABLE READ;
SELECT pg_temp.outcome($$SELECT pack_tiles('regress_late')$$);
SELECT pack_tiles('regress_live') AS nothing_to_do;
COMMIT;
-- Nothing at all, and no range.
SELECT pack_tiles('regress_late') AS none;
SELECT count(*) FROM visible_features('regress_late', 'POINT(0 0 0)', 1000);
SELECT drop_scene('regress_late');
SELECT array_agg(feature_id) FROM visible_features('regress_live', 'POINT(85005 447005 1.75)', 0);
SELECT count(*) FROM visible_features('regress_live', 'POINT(85005 446999 1.75)', 0);
SELECT array_agg(feature_id ORDER BY feature_id) FROM visible_features('regress_live', 'POINT(85005 446990 1.75)', 1.7e308);
SELECT pg_temp.outcome(format('SELECT visible_features(%L, ''POINT(0 0 0)'', %s)', scene, range))
FROM (VALUES ('atlantis', '1'), ('public', '1'), ('regress_live', '-1'), ('regress_live', '''NaN'''), (repeat('x', 64), '1')) AS v (scene, range);
SELECT pg_temp.outcome($$SELECT pack_tiles('atlantis')$$), pg_temp.outcome($$SELECT upgrade_scene('public')$$);
SELECT pg_temp.outcome('SELECT log_edit()');
-- A tile of nobody's making is told, not believed.
BEGIN;
UPDATE regress_live.tile SET content = '\x00010203', version = gen_random_uuid();
SELECT pg_temp.outcome($$SELECT pg_temp.seen()$$);
ROLLBACK;

-- A scene that was made without tiles works on, and gets them by an upgrade.
BEGIN;
DROP TABLE regress_live.tile, regress_live.edit;
SELECT pg_temp.seen(), pg_temp.outcome($$SELECT pack_tiles('regress_live')$$);
DELETE FROM regress_live.solid_column;
SELECT pg_temp.seen();
ROLLBACK;
SELECT upgrade_scene('regress_live');

-- Not in a transaction that only reads; a parallel worker answers the same.
BEGIN READ ONLY;
SELECT pg_temp.seen();
COMMIT;
SELECT set_config(name, 'on', false) FROM pg_settings WHERE name IN ('force_parallel_mode', 'debug_parallel_query');
SELECT pg_temp.seen();
SELECT set_config(name, 'off', false) FROM pg_settings WHERE name IN ('force_parallel_mode', 'debug_parallel_query');
SELECT drop_scene('regress_live');

-- A city is answered from tiles as from its tables, while it is edited at random, packed in between and not.
SELECT generate_city('regress_live', 'blocks', 1500, 4);
CREATE TEMP TABLE eye AS
SELECT point3d(x(c) + 700 * (random() - 0.5), y(c) + 700 * (random() - 0.5), (ARRAY[1.7, 9, 40])[1 + i % 3]) AS eye
FROM (SELECT setseed(0.5)) AS s, (SELECT center(extent(envelope)) AS c FROM regress_live.feature) AS e, generate_series(1, 25) AS i;
CREATE FUNCTION pg_temp.answers() RETURNS text LANGUAGE sql AS $$
    SELECT md5(string_agg((eye, v.feature_id, v.class, v.envelope, v.distance)::text, ' ' ORDER BY eye, v.feature_id))
    FROM eye, visible_features('regress_live', eye, 250) AS v
$$;
-- Whether tiles answer as tables do: without tiles, what is undone again.
CREATE FUNCTION pg_temp.same() RETURNS boolean LANGUAGE plpgsql AS $$
DECLARE
    by_tiles text := pg_temp.answers();
    by_tables text;
BEGIN
    BEGIN
        TRUNCATE regress_live.tile;
        by_tables := pg_temp.answers();
        RAISE EXCEPTION USING ERRCODE = 'RB000';
    EXCEPTION WHEN SQLSTATE 'RB000' THEN
    END;
    RETURN by_tiles = by_tables;
END
$$;
SELECT count(*) > 10 AS t, sum(features) = 1500 AS t FROM regress_live.tile;
SELECT pg_temp.same() AS t;
-- An edit of a mesh is logged as one of columns is: roofs are made of meshes.
BEGIN;
DELETE FROM regress_live.mesh WHERE feature <= 3;
SELECT feature, place IS NULL AS anywhere FROM regress_live.edit ORDER BY 1;
ROLLBACK;
DO $$
DECLARE
    c occlusion.point3d := (SELECT center(extent(envelope)) FROM regress_live.feature);
    before text := pg_temp.answers();
    now text;
    differed int := 0;
    someone bigint;
BEGIN
    FOR round IN 1..60 LOOP
        SELECT id INTO someone FROM regress_live.feature
        WHERE envelope <-> c < 350 ORDER BY md5(id::text || round) LIMIT 1;
        CASE round % 7
        WHEN 0 THEN DELETE FROM regress_live.feature WHERE id = someone;
        WHEN 1 THEN
            UPDATE regress_live.feature SET envelope = translate(envelope, 40 * sin(round), 40 * cos(round), 0) WHERE id = someone;
        WHEN 2 THEN DELETE FROM regress_live.solid_column WHERE feature = someone;
        WHEN 6 THEN
            -- Its roof is all at the height of its eaves: it no longer reaches its envelope, so the prism counts.
            UPDATE regress_live.mesh
            SET vertices = ARRAY(SELECT CASE WHEN i % 3 = 0 THEN least(v, 3) ELSE v END
                                 FROM unnest(vertices) WITH ORDINALITY AS v (v, i) ORDER BY i)
            WHERE feature = someone;
        WHEN 3 THEN
            INSERT INTO regress_live.feature (id, envelope)
            SELECT 100000 + round, expand(box3d(p, p), 3) FROM point3d(x(c) + 200 * sin(round), y(c) + 200 * cos(round), 3) AS p;
        ELSE NULL;
        END CASE;
        IF round % 6 = 4 THEN
            UPDATE regress_live.solid_column SET top = (bottom + top) / 2 WHERE feature = someone;
            UPDATE regress_live.feature SET class = 'Odd' WHERE id = someone;
        END IF;
        ASSERT pg_temp.same(), format('round %s', round);
        now := pg_temp.answers();
        differed := differed + (now <> before)::int;
        before := now;
        IF round % 10 = 9 THEN
            PERFORM pack_tiles('regress_live');
            ASSERT pg_temp.answers() = now, format('packed in round %s', round);
            ASSERT NOT EXISTS (SELECT FROM regress_live.edit);
        END IF;
    END LOOP;
    ASSERT differed > 20, 'edits are seen';
    ASSERT (SELECT sum(features) FROM regress_live.tile) < (SELECT count(*) FROM regress_live.feature) + 10;
END
$$;
-- Packing all anew gives the same answers, in no more tiles.
CREATE TEMP TABLE was AS SELECT pg_temp.answers() AS answers;
DELETE FROM regress_live.tile;
SELECT pack_tiles('regress_live') > 10 AS t, pg_temp.answers() = (SELECT answers FROM was) AS t;
-- With no cache, and with little.
SET pg_occlusion.cache_size = 0;
SELECT pg_temp.answers() = (SELECT answers FROM was) AS t;
SET pg_occlusion.cache_size = '100kB';
SELECT pg_temp.answers() = (SELECT answers FROM was) AS t;
RESET pg_occlusion.cache_size;
-- Fields of view hold no more than all round does.
SELECT count(*) > 50 AS t, bool_and(v.feature_id IN (SELECT feature_id FROM visible_features('regress_live', eye, 250))) AS t
FROM eye, visible_features('regress_live', view_cone(eye, 30, 70, 250)) AS v;
SELECT drop_scene('regress_live');
RESET client_min_messages;
RESET search_path;
