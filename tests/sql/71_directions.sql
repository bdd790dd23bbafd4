-- In which directions features are seen, what hides one, and the isovist.
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

-- Two houses with a gap of 10 m between them, a long low one behind, and one to the south.
SELECT create_scene('regress_directions');
INSERT INTO regress_directions.feature (id, class, envelope) VALUES
    (1, 'House', 'BOX3D(84980 447010 0, 84995 447020 10)'), (2, 'House', 'BOX3D(85005 447010 0, 85020 447020 10)'),
    (3, 'Shed', 'BOX3D(84985 447030 0, 85015 447035 3)'), (4, 'House', 'BOX3D(84995 446980 0, 85005 446990 10)'),
    (5, 'Shed', 'BOX3D(84984 447030 0, 84988 447034 3)');
INSERT INTO regress_directions.inner_envelope SELECT id, envelope, true FROM regress_directions.feature;
SELECT pack_tiles('regress_directions') AS tiles;
SELECT feature_id, class, round(azimuth_from::numeric, 4) AS azimuth_from, round(azimuth_to::numeric, 4) AS azimuth_to,
       npoints(facade), isopen(facade), round(length(facade)::numeric, 3) AS metres
FROM visible_extent('regress_directions', 'POINT(85000 447000 1.75)', 100) ORDER BY feature_id, azimuth_from;
SELECT facade FROM visible_extent('regress_directions', 'POINT(85000 447000 1.75)', 100) WHERE feature_id = 2;
-- The features are those of visible_features; an eye over a house sees it all round.
SELECT array_agg(DISTINCT v.feature_id) = (SELECT array_agg(feature_id ORDER BY feature_id) FROM visible_features('regress_directions', 'POINT(85000 447000 1.75)', 100)) AS t
FROM visible_extent('regress_directions', 'POINT(85000 447000 1.75)', 100) AS v;
SELECT feature_id, azimuth_from, azimuth_to, facade FROM visible_extent('regress_directions', 'POINT(85000 446985 12)', 5);
SELECT count(*) FROM visible_extent('regress_directions', 'POINT(0 0 0)', 100);

-- The second shed is behind the first house alone; the long one is seen through the gap, but not past the house in the south.
SELECT occluder, class, envelope, round(distance::numeric, 3) AS distance FROM hidden_by('regress_directions', 5, 'POINT(85000 447000 1.75)');
SELECT count(*) FROM hidden_by('regress_directions', 3, 'POINT(85000 447000 1.75)');
SELECT array_agg(occluder ORDER BY occluder) FROM hidden_by('regress_directions', 3, 'POINT(85000 446975 1.75)');
-- With nothing else they still hide it; without one of them it is seen.
BEGIN;
DELETE FROM regress_directions.inner_envelope WHERE feature NOT IN (SELECT occluder FROM hidden_by('regress_directions', 3, 'POINT(85000 446975 1.75)'));
SELECT count(*) = 0 AS t FROM visible_features('regress_directions', 'POINT(85000 446975 1.75)', 100) WHERE feature_id = 3;
DELETE FROM regress_directions.inner_envelope WHERE feature = (SELECT min(occluder) FROM hidden_by('regress_directions', 3, 'POINT(85000 446975 1.75)'));
SELECT count(*) = 1 AS t FROM visible_features('regress_directions', 'POINT(85000 446975 1.75)', 100) WHERE feature_id = 3;
ROLLBACK;
-- What only a volume hides is hidden by its occluder.
BEGIN;
INSERT INTO regress_directions.street (area, eye_low, eye_high) VALUES ('{"((84990,446995),(85010,446995),(85010,447005),(84990,447005))"}', 1, 2);
INSERT INTO regress_directions.occlusion_volume VALUES (2, 3, 'BOX3D(84990 446995 1, 85010 447005 2)');
SELECT array_agg(occluder) FROM hidden_by('regress_directions', 3, 'POINT(85000 447000 1.75)');
SELECT count(*) FROM visible_extent('regress_directions', 'POINT(85000 447000 1.75)', 100) WHERE feature_id = 3;
SELECT count(*) FROM visible_features('regress_directions', 'POINT(85000 447000 1.75)', 100) WHERE feature_id = 3;
SET LOCAL pg_occlusion.use_volumes = off;
SELECT count(*) FROM visible_features('regress_directions', 'POINT(85000 447000 1.75)', 100) WHERE feature_id = 3;
ROLLBACK;

-- The isovist is a polygon of its own kind: near walls bound it, and the range where there are none.
CREATE FUNCTION pg_temp.sees(x float8, y float8) RETURNS boolean LANGUAGE sql AS $$
    SELECT isovist('regress_directions', 'POINT(85000 447000 1.75)', 50) @> point(85000 + x, 447000 + y)
$$;
SELECT pg_temp.sees(0, 0) AS t, pg_temp.sees(0, 45) AS f, pg_temp.sees(0, 25) AS t, pg_temp.sees(49, 0) AS t, pg_temp.sees(51, 0) AS f,
       pg_temp.sees(-8, 15) AS f, pg_temp.sees(-10, 9.9) AS t, pg_temp.sees(-12, 24) AS f, pg_temp.sees(0, 29.9) AS t, pg_temp.sees(0, 30.1) AS f;
SELECT npoints(isovist('regress_directions', 'POINT(85000 447000 200)', 50)) AS over_all,
       isovist('regress_directions', 'POINT(85000 447000 1.75)', 0) AS nothing;

-- Edits count at once.
BEGIN;
DELETE FROM regress_directions.feature WHERE id = 1;
SELECT count(*) FROM hidden_by('regress_directions', 5, 'POINT(85000 447000 1.75)');
SELECT count(*) > 0 AS t FROM visible_extent('regress_directions', 'POINT(85000 447000 1.75)', 100) WHERE feature_id = 5;
SELECT pg_temp.sees(-8, 15) AS t;
ROLLBACK;

SELECT pg_temp.outcome(statement) FROM (VALUES
    ($$SELECT hidden_by('regress_directions', 99, 'POINT(0 0 0)')$$), ($$SELECT hidden_by('atlantis', 1, 'POINT(0 0 0)')$$),
    ($$SELECT visible_extent('regress_directions', 'POINT(0 0 0)', -1)$$), ($$SELECT visible_extent('atlantis', 'POINT(0 0 0)', 1)$$),
    ($$SELECT isovist('regress_directions', 'POINT(0 0 0)', 'Infinity')$$), ($$SELECT isovist('public', 'POINT(0 0 0)', 1)$$),
    ($$SELECT isovist('regress_directions', NULL, 1)$$)) AS v (statement);
SELECT drop_scene('regress_directions');
RESET client_min_messages;
RESET search_path;
