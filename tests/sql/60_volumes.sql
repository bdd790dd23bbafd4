-- Occlusion volumes: computed, used, and gone at once where they say nothing any more.
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

-- Houses of 10 m in a row along y = 0 to 10, sheds behind them, and streets on both sides.
SELECT occlusion.create_scene('regress_volumes');
INSERT INTO regress_volumes.feature (id, class, envelope)
SELECT i, 'Building', occlusion.box3d(occlusion.point3d(10 * i, 0, 0), occlusion.point3d(10 * i + 10, 10, 9))
FROM generate_series(1, 20) AS i
UNION ALL
SELECT 100 + i, 'Shed', occlusion.box3d(occlusion.point3d(10 * i + 4, 14, 0), occlusion.point3d(10 * i + 6, 16, 2))
FROM generate_series(1, 20) AS i;
INSERT INTO regress_volumes.inner_envelope SELECT id, envelope, true FROM regress_volumes.feature WHERE class = 'Building';

-- Refused. A CALL within a function may not commit, so errors are read from psql.
CALL occlusion.generate_occlusion_volumes('regress_volumes');
\echo :SQLSTATE
INSERT INTO regress_volumes.street (name, area, eye_low, eye_high) VALUES
    ('south', ARRAY['((0,-20),(230,-20),(230,-8),(0,-8))'::polygon], 1.5, 2),
    ('north', ARRAY['((0,20),(230,20),(230,32),(0,32))'::polygon], 1.5, 2);
CALL occlusion.generate_occlusion_volumes(NULL);
\echo :SQLSTATE
CALL occlusion.generate_occlusion_volumes('regress_volumes', NULL);
\echo :SQLSTATE
CALL occlusion.generate_occlusion_volumes('regress_volumes', 0);
\echo :SQLSTATE
CALL occlusion.generate_occlusion_volumes('regress_volumes', -1);
CALL occlusion.generate_occlusion_volumes('regress_volumes', 'NaN');
CALL occlusion.generate_occlusion_volumes('regress_volumes', range => -5);
CALL occlusion.generate_occlusion_volumes('regress_volumes', range => 'Infinity');
CALL occlusion.generate_occlusion_volumes('regress_volumes', worth => 0);
\echo :SQLSTATE
CALL occlusion.generate_occlusion_volumes('regress_nowhere');
\echo :SQLSTATE
CALL occlusion.generate_occlusion_volumes('public');
\echo :SQLSTATE
-- Not where it cannot commit.
BEGIN;
CALL occlusion.generate_occlusion_volumes('regress_volumes');
\echo :SQLSTATE
ROLLBACK;
SELECT pg_temp.outcome($$CALL occlusion.generate_occlusion_volumes('regress_volumes')$$);
SELECT count(*) = 0 AS t FROM regress_volumes.occlusion_volume;
SELECT count(*) = 0 AS t FROM occlusion.progress('regress_volumes');

SET client_min_messages = warning;
CALL occlusion.generate_occlusion_volumes('regress_volumes');
SELECT task, done, total, made = (SELECT count(*) FROM regress_volumes.occlusion_volume) AS t, time_left IS NULL AS t, state
FROM occlusion.progress('regress_volumes');
SELECT count(*) > 100 AS t,
       bool_and(v.occluder <> v.occludee) AS t,
       bool_and(o.feature IS NOT NULL) AS t,
       -- of use: eyes of a street are in it
       bool_and(EXISTS (SELECT FROM regress_volumes.street AS s WHERE s.envelope OPERATOR(occlusion.&&) v.box)) AS t,
       count(DISTINCT v.occludee) FILTER (WHERE v.occludee > 100) = 20 AS t
FROM regress_volumes.occlusion_volume AS v LEFT JOIN regress_volumes.inner_envelope AS o ON o.feature = v.occluder;
-- Sheds hide nothing: they have no inner envelope. From the north they hide behind nothing.
SELECT count(*) = 0 AS t FROM regress_volumes.occlusion_volume
WHERE occludee > 100 AND box OPERATOR(occlusion.&&) 'BOX3D(0 20 1.5, 230 32 2)'::occlusion.box3d
  AND occluder BETWEEN occludee - 101 AND occludee - 99;

-- A rerun replaces: the same rows, once.
CREATE TEMPORARY TABLE first AS SELECT occluder, occludee, box::text FROM regress_volumes.occlusion_volume;
CREATE FUNCTION pg_temp.same() RETURNS boolean LANGUAGE sql AS $$
    SELECT NOT EXISTS (TABLE pg_temp.first EXCEPT ALL SELECT occluder, occludee, box::text FROM regress_volumes.occlusion_volume)
       AND NOT EXISTS (SELECT occluder, occludee, box::text FROM regress_volumes.occlusion_volume EXCEPT ALL TABLE pg_temp.first)
$$;
CALL occlusion.generate_occlusion_volumes('regress_volumes');
SELECT pg_temp.same() AS t;
-- Rows of nobody's making go, lost ones come back, one thread or many.
INSERT INTO regress_volumes.occlusion_volume VALUES (1, 20, 'BOX3D(0 -20 1.5, 230 -8 2)');
DELETE FROM regress_volumes.occlusion_volume WHERE occludee BETWEEN 101 AND 105;
SET pg_occlusion.max_threads = 1;
CALL occlusion.generate_occlusion_volumes('regress_volumes');
RESET pg_occlusion.max_threads;
SELECT pg_temp.same() AS t;
-- A range of nobody's reach changes nothing, a worth of nobody's keeps nothing.
CALL occlusion.generate_occlusion_volumes('regress_volumes', range => 1000);
SELECT pg_temp.same() AS t;
CALL occlusion.generate_occlusion_volumes('regress_volumes', worth => 1e9);
SELECT count(*) = 0 AS t FROM regress_volumes.occlusion_volume;
CALL occlusion.generate_occlusion_volumes('regress_volumes', 1, NULL, NULL);
SELECT pg_temp.same() AS t;

-- Across the street from house 8: all houses are in view, the sheds behind it and its neighbours are not.
-- What is within range and not hidden by volumes. visible_features returns no more, and less where features
-- hide together.
CREATE FUNCTION pg_temp.seen(observer occlusion.point3d) RETURNS bigint[] LANGUAGE plpgsql AS $$
DECLARE
    hidden bigint[];
    seen bigint[];
BEGIN
    EXECUTE format('SELECT coalesce(array_agg(occludee), ''{}'') FROM (%s) AS h', occlusion.hidden_features_statement('regress_volumes'))
        INTO hidden USING observer;
    SELECT array_agg(id ORDER BY id) INTO seen FROM regress_volumes.feature
    WHERE envelope OPERATOR(occlusion.<->) observer <= 500 AND id <> ALL (hidden);
    IF EXISTS (SELECT FROM occlusion.visible_features('regress_volumes', observer, 500) AS v WHERE v.feature_id <> ALL (seen)) THEN
        RAISE EXCEPTION 'a feature that volumes hide from % was returned', observer;
    END IF;
    RETURN seen;
END
$$;
CREATE FUNCTION pg_temp.everything() RETURNS bigint[] LANGUAGE sql AS $$
    SELECT array_agg(id ORDER BY id) FROM regress_volumes.feature
$$;
SELECT pg_temp.seen('POINT(85 -12 1.75)') @> '{1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20}' AS t,
       NOT pg_temp.seen('POINT(85 -12 1.75)') && '{107,108,109}' AS t;
-- From where nothing is known, all is in view: off the street, above the eyes, inside a house, within
-- a millimetre of one. A volume there, of nobody's making, makes no difference.
INSERT INTO regress_volumes.occlusion_volume SELECT 1, id, 'BOX3D(-50 -50 -50, 500 500 500)' FROM regress_volumes.feature WHERE id <> 1;
SELECT pg_temp.seen('POINT(85 -7.9 1.75)') = pg_temp.everything() AS t,
       pg_temp.seen('POINT(85 -12 2.01)') = pg_temp.everything() AS t,
       pg_temp.seen('POINT(85 -12 1.49)') = pg_temp.everything() AS t,
       pg_temp.seen('POINT(85 5 1.75)') = pg_temp.everything() AS t,
       pg_temp.seen('POINT(85 -12 1.75)') = '{1}' AS t,
       pg_temp.seen('POINT(85 -8 2)') = '{1}' AS t;
-- An annexe in the street: who stands in it, or within a millimetre of it, sees all.
INSERT INTO regress_volumes.inner_envelope VALUES (101, 'BOX3D(80 -12 0, 90 -10 3)');
SELECT pg_temp.seen('POINT(85 -11 1.75)') = pg_temp.everything() AS t,
       pg_temp.seen('POINT(85 -12 1.75)') = pg_temp.everything() AS t,
       pg_temp.seen('POINT(85 -12.0009 1.75)') = pg_temp.everything() AS t,
       pg_temp.seen('POINT(85 -12.0011 1.75)') = '{1}' AS t;
-- A courtyard in the street is off it.
UPDATE regress_volumes.street SET area = area || '((100,-16),(110,-16),(110,-12),(100,-12))'::polygon WHERE name = 'south';
SELECT pg_temp.seen('POINT(105 -14 1.75)') = pg_temp.everything() AS t,
       pg_temp.seen('POINT(95 -14 1.75)') = '{1}' AS t;
UPDATE regress_volumes.street SET area = area[1:1] WHERE name = 'south';
DELETE FROM regress_volumes.inner_envelope WHERE feature = 101;
DELETE FROM regress_volumes.occlusion_volume WHERE box OPERATOR(occlusion.=) 'BOX3D(-50 -50 -50, 500 500 500)';
SELECT pg_temp.same() AS t;

-- A change takes with it what it made wrong, within its own transaction, and a rollback brings it back.
CREATE FUNCTION pg_temp.volumes_of(feature bigint) RETURNS text LANGUAGE sql AS $$
    SELECT format('hides %s, hidden %s', bool_or(occluder = $1), bool_or(occludee = $1))
    FROM regress_volumes.occlusion_volume
$$;
SELECT pg_temp.volumes_of(8), pg_temp.volumes_of(108);
BEGIN;
UPDATE regress_volumes.feature SET envelope = 'BOX3D(80 0 0, 90 10 30)' WHERE id = 8;
SELECT pg_temp.volumes_of(8) = 'hides f, hidden f' AS t, pg_temp.seen('POINT(85 -12 1.75)') @> '{8,108}' AS t;
ROLLBACK;
SELECT pg_temp.same() AS t;
BEGIN;
DELETE FROM regress_volumes.feature WHERE id = 8;
SELECT pg_temp.volumes_of(8) = 'hides f, hidden f' AS t, pg_temp.seen('POINT(85 -12 1.75)') @> '{108}' AS t;
ROLLBACK;
SELECT pg_temp.same() AS t;
BEGIN;
UPDATE regress_volumes.feature SET envelope = 'BOX3D(84 14 0, 86 16 20)' WHERE id = 108;
SELECT pg_temp.volumes_of(108) = 'hides f, hidden f' AS t, pg_temp.seen('POINT(85 -12 1.75)') @> '{108}' AS t,
       pg_temp.volumes_of(8) = 'hides t, hidden f' AS t;
ROLLBACK;
SELECT pg_temp.same() AS t;
BEGIN;
UPDATE regress_volumes.inner_envelope SET box = 'BOX3D(84 4 0, 86 6 1)' WHERE feature = 8;
SELECT pg_temp.volumes_of(8) = 'hides f, hidden f' AS t, pg_temp.seen('POINT(85 -12 1.75)') @> '{108}' AS t;
ROLLBACK;
BEGIN;
UPDATE regress_volumes.inner_envelope SET grounded = false WHERE feature = 8;
SELECT pg_temp.volumes_of(8) = 'hides f, hidden f' AS t;
ROLLBACK;
BEGIN;
DELETE FROM regress_volumes.inner_envelope WHERE feature = 8;
SELECT pg_temp.volumes_of(8) = 'hides f, hidden f' AS t, pg_temp.seen('POINT(85 -12 1.75)') @> '{108}' AS t;
SAVEPOINT more;
DELETE FROM regress_volumes.inner_envelope;
SELECT count(*) = 0 AS t FROM regress_volumes.occlusion_volume;
SELECT pg_temp.seen('POINT(85 -12 1.75)') = pg_temp.everything() AS t;
ROLLBACK TO more;
SELECT pg_temp.volumes_of(8) = 'hides f, hidden f' AS t, pg_temp.volumes_of(9) = 'hides t, hidden f' AS t;
ROLLBACK;
-- A feature keeps its number as long as volumes name it.
SELECT left(pg_temp.outcome($$UPDATE regress_volumes.feature SET id = 1008 WHERE id = 108$$), 5);
BEGIN;
UPDATE regress_volumes.inner_envelope SET feature = 101 WHERE feature = 8;
SELECT pg_temp.volumes_of(8) = 'hides f, hidden f' AS t;
ROLLBACK;
BEGIN;
TRUNCATE regress_volumes.inner_envelope;
SELECT count(*) = 0 AS t FROM regress_volumes.occlusion_volume;
SELECT pg_temp.seen('POINT(85 -12 1.75)') = pg_temp.everything() AS t;
ROLLBACK;
BEGIN;
TRUNCATE regress_volumes.feature CASCADE;
SELECT count(*) = 0 AS t FROM regress_volumes.occlusion_volume;
SELECT count(*) = 0 AS t FROM occlusion.visible_features('regress_volumes', 'POINT(85 -12 1.75)', 500);
ROLLBACK;
SELECT pg_temp.same() AS t;
-- Where rows come by replication, too.
BEGIN;
SET LOCAL session_replication_role = replica;
UPDATE regress_volumes.feature SET envelope = 'BOX3D(80 0 0, 90 10 30)' WHERE id = 8;
DELETE FROM regress_volumes.feature WHERE id = 108;
DELETE FROM regress_volumes.inner_envelope WHERE feature = 9;
SELECT pg_temp.volumes_of(8) = 'hides f, hidden f' AS t, pg_temp.volumes_of(108) = 'hides f, hidden f' AS t,
       pg_temp.volumes_of(9) = 'hides f, hidden f' AS t;
ROLLBACK;
-- What changes nothing in space leaves them.
UPDATE regress_volumes.feature SET class = class || ', listed', attributes = '{"a": 1}', envelope = envelope WHERE id IN (8, 108);
SELECT pg_temp.same() AS t;
-- A new feature is seen at once.
BEGIN;
INSERT INTO regress_volumes.feature (id, envelope) VALUES (500, 'BOX3D(84 14 0, 86 16 2)');
SELECT pg_temp.seen('POINT(85 -12 1.75)') @> '{500}' AND NOT pg_temp.seen('POINT(85 -12 1.75)') @> '{108}' AS t;
ROLLBACK;
-- A feature that hides itself, or is none, is refused.
SELECT left(pg_temp.outcome($$INSERT INTO regress_volumes.occlusion_volume VALUES (8, 8, 'BOX3D(0 0 0, 1 1 1)')$$), 5);
SELECT left(pg_temp.outcome($$INSERT INTO regress_volumes.occlusion_volume VALUES (8, 999, 'BOX3D(0 0 0, 1 1 1)')$$), 5);

-- The same rows are found by index: in a large scene it is used unprompted.
INSERT INTO regress_volumes.feature (id, envelope)
SELECT 1000 + i, occlusion.box3d(occlusion.point3d(x, y, 0), occlusion.point3d(x + 5, y + 5, 5))
FROM generate_series(1, 5000) AS i, LATERAL (SELECT i % 70 * 20 AS x, 100 + i / 70 * 20 AS y) AS p;
INSERT INTO regress_volumes.occlusion_volume
SELECT 1, 1000 + i, occlusion.box3d(occlusion.point3d(x, -20, 1.5), occlusion.point3d(x + 1, -19, 2))
FROM generate_series(1, 5000) AS i, LATERAL (SELECT i % 200 AS x) AS p;
VACUUM ANALYZE regress_volumes.feature, regress_volumes.occlusion_volume, regress_volumes.street, regress_volumes.inner_envelope;
SELECT how, bool_or(line ~ '^Features Returned: [1-9]') AS t, bool_or(line ~ 'occlusion_volume_box') AS t,
       NOT bool_or(line ~ 'Seq Scan on occlusion_volume') AS t
FROM (
    SELECT 'all round' AS how, line FROM occlusion.explain_visible_features('regress_volumes', 'POINT(85 -12 1.75)', 50) AS line
    UNION ALL SELECT 'cone', line FROM occlusion.explain_visible_features('regress_volumes', 'VIEW_CONE(85 -12 1.75, 0, 60, 50, 0)'::occlusion.view_cone) AS line
    UNION ALL SELECT 'sector', line FROM occlusion.explain_visible_features('regress_volumes', 'VIEW_SECTOR(85 -12 1.75, 0, 60, 50)'::occlusion.view_sector) AS line
) AS explained
GROUP BY how ORDER BY how;
SELECT occlusion.drop_scene('regress_volumes');

-- A scene without features is done at once, streets or not.
SELECT occlusion.create_scene('regress_volumes');
CALL occlusion.generate_occlusion_volumes('regress_volumes');
SELECT done, total, made, state FROM occlusion.progress('regress_volumes');
SELECT occlusion.drop_scene('regress_volumes');
