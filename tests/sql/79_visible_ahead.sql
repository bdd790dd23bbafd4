-- What a moving observer may see: a superset of what is seen from anywhere on its way.
\pset format unaligned
SET search_path = public, occlusion;
SET client_min_messages = warning;
SELECT occlusion.create_scene('regress_ahead');
SELECT occlusion.generate_city('regress_ahead', 'streets', 60, 2) > 0 AS t;

-- Where nothing was computed ahead, all that is in range of the way.
CREATE FUNCTION pg_temp.in_range(a occlusion.point3d, range float8) RETURNS bigint LANGUAGE sql AS $$
    SELECT count(*) FROM regress_ahead.feature AS f WHERE f.envelope <-> a <= range
$$;
SELECT count(*) > 0 AS t, bool_and(v.distance <= 60.01) AS t
FROM occlusion.visible_ahead('regress_ahead', 'POINT(0 0 1.75)', 'POINT(3 1 0)', 10, 60) AS v;

CALL occlusion.generate_view_cells('regress_ahead', range => 150, finest => 0.5);

-- Ways from eye to eye, in the streets or not. Whatever is seen on one is in the answer.
CREATE TEMP TABLE way AS
SELECT i AS number, point3d(x, y, 1.75) AS observer, point3d(dx, dy, 0) AS velocity, 5.0::float8 AS seconds
FROM (
    SELECT i, x(c) + (i * 37 % 41) - 20 AS x, y(c) + (i * 53 % 43) - 21 AS y,
           ((i * 29) % 9 - 4)::float8 AS dx, ((i * 31) % 7 - 3)::float8 AS dy
    FROM generate_series(1, 40) AS i,
         LATERAL (SELECT center(envelope) FROM regress_ahead.street ORDER BY id OFFSET i % (SELECT count(*) FROM regress_ahead.street) LIMIT 1) AS s (c)
) AS w;
CREATE TEMP TABLE answer AS
SELECT w.number, v.feature_id FROM way AS w
CROSS JOIN LATERAL occlusion.visible_ahead('regress_ahead', w.observer, w.velocity, w.seconds, 150) AS v;
CREATE TEMP TABLE seen AS
SELECT DISTINCT w.number, t, v.feature_id, point3d(x(w.observer) + t * x(w.velocity), y(w.observer) + t * y(w.velocity), 1.75) AS eye
FROM way AS w CROSS JOIN generate_series(0, 5, 0.5) AS t
CROSS JOIN LATERAL occlusion.visible_features('regress_ahead',
    point3d(x(w.observer) + t * x(w.velocity), y(w.observer) + t * y(w.velocity), 1.75), 150) AS v;
SELECT count(DISTINCT number) = 40 AS t, count(*) > 5000 AS t FROM seen;
-- What a live answer has besides is seen by no line to the corners and the middle of its envelope.
SELECT count(*) = 0 AS t
FROM seen AS s JOIN regress_ahead.feature AS f ON f.id = s.feature_id
CROSS JOIN LATERAL unnest(corners(f.envelope) || center(f.envelope)) AS corner
CROSS JOIN LATERAL occlusion.line_of_sight('regress_ahead', s.eye, corner) AS line
WHERE (s.number, s.feature_id) NOT IN (SELECT number, feature_id FROM answer)
  AND (line.visible OR line.obstacle = f.id);
SELECT count(*) < 100 AS t FROM seen AS s WHERE (s.number, s.feature_id) NOT IN (SELECT number, feature_id FROM answer);

-- In a street it is what the cells on the way hold: less than all in range.
CREATE TEMP TABLE walk AS
SELECT e.eye, 'POINT(0.2 0.1 0)'::point3d AS velocity, s.visible
FROM (SELECT point3d(x(center(box)), y(center(box)), 1.75) FROM regress_ahead.view_cell) AS e (eye)
CROSS JOIN LATERAL occlusion.visible_set('regress_ahead', e.eye) AS s;
SELECT count(*) > 20 AS t, sum(n) <= sum(cardinality(visible)) AS t, sum(n) < 0.8 * sum(pg_temp.in_range(eye, 150)) AS t, min(n) > 0 AS t
FROM walk CROSS JOIN LATERAL (SELECT count(*) AS n FROM occlusion.visible_ahead('regress_ahead', eye, velocity, 1, 150)) AS n;
-- Beyond the range of the cells, and after an edit nearby, all in range.
SELECT sum(n) >= sum(pg_temp.in_range(eye, 151)) AS t
FROM walk CROSS JOIN LATERAL (SELECT count(*) AS n FROM occlusion.visible_ahead('regress_ahead', eye, velocity, 1, 151)) AS n;
BEGIN;
DELETE FROM regress_ahead.feature WHERE id = 30;
SELECT bool_and(NOT v.feature_id = 30) AS t, count(*) >= sum(DISTINCT pg_temp.in_range('POINT(0 0 1.75)', 150)) AS t
FROM occlusion.visible_ahead('regress_ahead', 'POINT(0 0 1.75)', 'POINT(0.2 0.1 0)', 1, 150) AS v;
ROLLBACK;

SELECT occlusion.visible_ahead('regress_ahead', 'POINT(0 0 1)', 'POINT(1 0 0)', -1);
\echo :SQLSTATE
SELECT occlusion.visible_ahead('regress_ahead', 'POINT(0 0 1)', 'POINT(1 0 0)', 'Infinity');
SELECT occlusion.visible_ahead('regress_ahead', 'POINT(0 0 1)', 'POINT(1 0 0)', 'NaN');
SELECT occlusion.visible_ahead('regress_ahead', 'POINT(0 0 1)', 'POINT(1e300 0 0)', 1e30);
\echo :SQLSTATE
SELECT occlusion.visible_ahead('regress_ahead', 'POINT(0 0 1)', 'POINT(1 0 0)', 1, -5);
\echo :SQLSTATE
SELECT occlusion.visible_ahead('regress_nowhere', 'POINT(0 0 1)', 'POINT(1 0 0)', 1);
\echo :SQLSTATE
SELECT occlusion.drop_scene('regress_ahead');
