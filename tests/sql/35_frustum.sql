-- The frustum: type, operators, indexes, queries.
SET search_path = occlusion, public;

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

-- Text comes back in its one shortest form, from any spelling, and so do all finite numbers.
SELECT given::frustum::text = shown AS t
FROM (VALUES
    ('FRUSTUM(5 500 1.75, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500)', 'FRUSTUM(5 500 1.75, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500)'),
    (E' frustum Z\n( 5 5e2 1.750,0 1 0 ,0 0 1,60.0,15e-1,.1,+500 ) ', 'FRUSTUM(5 500 1.75, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500)'),
    ('FRUSTUM(5 500 1.75, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500, 0 0)', 'FRUSTUM(5 500 1.75, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500)'),
    ('FRUSTUM(5 500 1.75, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500, 0.25 -1)', 'FRUSTUM(5 500 1.75, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500, 0.25 -1)'),
    ('FRUSTUM(-0 0 0, -0 1 0, 0 0 1, 60, 1.5, 0, 500, -0 0)', 'FRUSTUM(-0 0 0, -0 1 0, 0 0 1, 60, 1.5, 0, 500, -0 0)'),
    ('FRUSTUM(85000.125 447000.875 -3.5, 1e-300 2e-300 5e-324, 0 1e300 1e300, 179.99999999999997, 1e-9, 5e-324, 0.30000000000000004)',
     'FRUSTUM(85000.125 447000.875 -3.5, 1e-300 2e-300 5e-324, 0 1e300 1e300, 179.99999999999997, 1e-9, 5e-324, 0.30000000000000004)'),
    ('FRUSTUM(1e15 1e300 -1e300, 1 1 1, 1.0000001 1 1, 1e-300, 1e300, 1e15, 1e16, -1e-300 3)',
     'FRUSTUM(1000000000000000 1e300 -1e300, 1 1 1, 1.0000001 1 1, 1e-300, 1e300, 1000000000000000, 1e16, -1e-300 3)')
) AS spelling (given, shown);

-- Constructors and accessors.
SELECT frustum('POINT(1 2 3)', 'POINT(0 1 0)', 'POINT(0 0 1)', 60, 1.5, 0.1, 500)::text
           = 'FRUSTUM(1 2 3, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500)' AS t,
       frustum(observer => 'POINT(1 2 3)', direction => 'POINT(0 1 0)', up => 'POINT(0 0 1)',
               fov => 60, aspect => 1.5, near => 0.1, far => 500)::text
           = 'FRUSTUM(1 2 3, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500)' AS t,
       frustum('POINT(1 2 3)', 'POINT(0 1 0)', 'POINT(0 0 1)', 60, 1.5, 0.1, 500, 0.5, -1)::text
           = 'FRUSTUM(1 2 3, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500, 0.5 -1)' AS t,
       frustum('POINT(1 2 3)', 90, 0, 0, 60, 1.5, 0.1, 500)::text
           = 'FRUSTUM(1 2 3, 1 0 0, 0 0 1, 60, 1.5, 0.1, 500)' AS t,
       frustum(observer => 'POINT(1 2 3)', heading => -90, pitch => -90, roll => 180,
               fov => 60, aspect => 1.5, near => 0.1, far => 500)::text
           = 'FRUSTUM(1 2 3, 0 0 -1, 1 0 0, 60, 1.5, 0.1, 500)' AS t,
       frustum('POINT(1 2 3)', 0, 0, 90, 60, 1.5, 0.1, 500)::text
           = 'FRUSTUM(1 2 3, 0 1 0, 1 0 0, 60, 1.5, 0.1, 500)' AS t,
       frustum('POINT(1 2 3)', 0, NULL, 90, 60, 1.5, 0.1, 500) IS NULL AS t;
SELECT observer(f)::text = 'POINT(1 2 3)' AS t, direction(f)::text = 'POINT(0 4 0)' AS t, up(f)::text = 'POINT(0 1 2)' AS t,
       fov(f) = 60 AS t, aspect(f) = 1.5 AS t, near(f) = 0.1 AS t, far(f) = 500 AS t, shift_right(f) = 0.5 AS t, shift_up(f) = -1 AS t
FROM (VALUES ('FRUSTUM(1 2 3, 0 4 0, 0 1 2, 60, 1.5, 0.1, 500, 0.5 -1)'::frustum)) AS v (f);
-- Near ones first, from the lower left anticlockwise.
SELECT bool_and(box3d(corner, corner) <-> expected < 1e-12) AND count(*) = 8 AS t
FROM unnest(corners(frustum('POINT(5 0 0)', 90, 0, 0, 90, 2, 1, 10)),
            ARRAY['POINT(6 2 -1)', 'POINT(6 -2 -1)', 'POINT(6 -2 1)', 'POINT(6 2 1)',
                  'POINT(15 20 -10)', 'POINT(15 -20 -10)', 'POINT(15 -20 10)', 'POINT(15 20 10)']::point3d[]) AS c (corner, expected);
SELECT bool_and(box3d(corner, corner) <-> expected < 1e-12) AS t
FROM unnest((corners(frustum('POINT(0 0 0)', 'POINT(0 1 0)', 'POINT(0 0 1)', 90, 2, 1, 10, 1, -0.5)))[1:4],
            ARRAY['POINT(0 1 -1.5)', 'POINT(4 1 -1.5)', 'POINT(4 1 0.5)', 'POINT(0 1 0.5)']::point3d[]) AS c (corner, expected);

-- Matrices, by rows: at the origin to +y, 90 degrees high and wide, from 1 to 100 m.
CREATE FUNCTION pg_temp.matrix(shift float8, y_sign float8, z_slope float8, z_start float8) RETURNS float8[] LANGUAGE sql AS $$
    SELECT ARRAY[1, -shift, 0, 0,  0, 0, y_sign, 0,  0, z_slope, 0, z_start,  0, 1, 0, 0]
$$;
SELECT name, observer(f)::text = 'POINT(0 0 0)' AND direction(f)::text = 'POINT(0 1 0)' AND up(f)::text = 'POINT(0 0 1)'
       AND fov(f) = 90 AND aspect(f) = 1 AND abs(near(f) - 1) < 1e-12 AND abs(far(f) - 100) < 1e-9
       AND shift_right(f) = shift AND shift_up(f) = 0 AND f::text::frustum::text = f::text AS t
FROM (VALUES
    ('OpenGL', 0, frustum(pg_temp.matrix(0, 1, 101.0 / 99, -200.0 / 99))),
    ('OpenGL, off centre', 0.25, frustum(pg_temp.matrix(0.25, 1, 101.0 / 99, -200.0 / 99))),
    ('OpenGL, reversed', 0, frustum(pg_temp.matrix(0, 1, -101.0 / 99, 200.0 / 99))),
    ('Direct3D', 0, frustum(pg_temp.matrix(0, 1, 100.0 / 99, -100.0 / 99), depth_from_zero => true)),
    ('Vulkan', -0.5, frustum(pg_temp.matrix(-0.5, -1, 100.0 / 99, -100.0 / 99), depth_from_zero => true)),
    ('Vulkan, reversed', 0, frustum(pg_temp.matrix(0, -1, -1.0 / 99, 100.0 / 99), depth_from_zero => true)),
    ('any scale', 0, frustum((SELECT array_agg(1e-200 * n) FROM unnest(pg_temp.matrix(0, 1, 101.0 / 99, -200.0 / 99)) AS n))),
    ('nested', 0, frustum(matrix => ARRAY[[1, 0, 0, 0], [0, 0, 1, 0], [0, 101.0 / 99, 0, -200.0 / 99], [0, 1, 0, 0]]))
) AS m (name, shift, f);

-- Literals of another form, and numbers out of bounds.
\pset format unaligned
SELECT pg_temp.outcome(format('SELECT %L::occlusion.frustum', literal))
FROM (VALUES
    (''),
    ('FRUSTUM'),
    ('FRUSTUM()'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1.5, 0.1)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500, 0)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500, 0, 0)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500,)'),
    ('FRUSTUM(0 0 0, 0 1, 0 0 0 1, 60, 1.5, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, sixty, 1.5, 0.1, 500)'),
    ('VIEW_CONE(0 0 0, 90, 60, 500, 0)'),
    ('FRUSTUM(0 0 NaN, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 inf 0, 0 0 1, 60, 1.5, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1e309, 60, 1.5, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1.5, 0.1, Infinity)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500, 0 NaN)'),
    ('FRUSTUM(0 0 0, 0 0 -0, 0 0 1, 60, 1.5, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 0, 60, 1.5, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 2 2, 0 -3 -3, 60, 1.5, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 2 2, 1e-12 1 1, 60, 1.5, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 0, 1.5, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 180, 1.5, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, -60, 1.5, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 0, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, -1.5, 0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1.5, -0.1, 500)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1.5, 500, 500)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1.5, 0, 0)'),
    ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 179, 1.5, 0.1, 1.7e308)')
) AS malformed (literal);
SELECT pg_temp.outcome('SELECT occlusion.frustum(' || arguments || ')')
FROM (VALUES
    ($$'POINT(0 0 0)', 'POINT(0 0 0)', 'POINT(0 0 1)', 60, 1.5, 0.1, 500$$),
    ($$'POINT(0 0 0)', 'POINT(0 1 0)', 'POINT(0 0 1)', 60, 1.5, 0.1, 500, 0, 'NaN'$$),
    ($$'POINT(0 0 0)', 'NaN', 0, 0, 60, 1.5, 0.1, 500$$),
    ($$'POINT(0 0 0)', 0, 90.5, 0, 60, 1.5, 0.1, 500$$),
    ($$'POINT(0 0 0)', 0, 0, 'Infinity', 60, 1.5, 0.1, 500$$),
    ($$'POINT(0 0 0)', 0, 0, 0, 200, 1.5, 0.1, 500$$),
    ($$matrix => '{}'$$),
    ($$matrix => '{1,2,3}'$$),
    ($$matrix => '{1,0,0,0, 0,NULL,1,0, 0,1.02,0,-2.02, 0,1,0,0}'$$),
    ($$matrix => '{1,0,0,0, 0,0,1,0, 0,1.02,0,NaN, 0,1,0,0}'$$),
    ($$matrix => '{0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,0}'$$),
    ($$matrix => '{1,0,0,0, 2,0,0,0, 0,1.02,0,-2.02, 0,1,0,0}'$$),
    ($$matrix => '{1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1}'$$),
    ($$matrix => '{1,0,0.1,0, 0,0,1,0, 0,1.02,0,-2.02, 0,1,0,0}'$$),
    ($$matrix => '{1,0,0,0, 0,0,1,0, 0.1,1.02,0,-2.02, 0,1,0,0}'$$),
    ($$matrix => '{-1,0,0,0, 0,0,-1,0, 0,-1.02,0,2.02, 0,-1,0,0}'$$),
    ($$matrix => '{1,0,0,0, 0,0,1,0, 0,1,0,-2, 0,1,0,0}'$$),
    ($$matrix => '{1,0,0,0, 0,0,1,0, 0,0,0,1, 0,1,0,0}', depth_from_zero => true$$)
) AS refused (arguments);
\pset format aligned

-- Binary: the numbers, most significant byte first; what comes back by COPY is the same.
SELECT octet_length(frustum_send(f)) = 120 AS t,
       frustum_send(f) = (SELECT string_agg(float8send(n), '' ORDER BY i)
                          FROM unnest('{1,2,3,0,1,0,0,0,1,60,1.5,0.1,500,0.25,-0}'::float8[]) WITH ORDINALITY AS u (n, i)) AS t
FROM (VALUES ('FRUSTUM(1 2 3, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500, 0.25 -0)'::frustum)) AS v (f);
-- What receive makes of a message, as text, by the file format of COPY.
CREATE FUNCTION pg_temp.received(message bytea) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    file bytea := '\x5047434f50590aff0d0a0000000000000000000001'::bytea
        || int4send(octet_length(message)) || message || '\xffff'::bytea;
    printed text;
    result text;
BEGIN
    SELECT string_agg(E'\\0' || lpad(
               (get_byte(file, i) / 64)::text || (get_byte(file, i) / 8 % 8) || (get_byte(file, i) % 8), 3, '0'),
               '' ORDER BY i)
      INTO printed FROM generate_series(0, octet_length(file) - 1) AS i;
    CREATE TEMPORARY TABLE message (value occlusion.frustum);
    EXECUTE format('COPY message FROM PROGRAM %L (FORMAT binary)', format('printf %%b ''%s''', printed));
    SELECT value::text FROM message INTO result;
    DROP TABLE message;
    RETURN result;
END
$$;
SELECT pg_temp.received(frustum_send(f::frustum)) = f AS t
FROM (VALUES ('FRUSTUM(1 2 3, 0 1 0, 0 0 1, 60, 1.5, 0.1, 500)'),
             ('FRUSTUM(85000.125 447000.875 -3.5, 1e-300 2e-300 5e-324, 0 1e300 1e300, 179.99999999999997, 1e-9, 5e-324, 0.30000000000000004, -1e-300 -0)')
     ) AS v (f);
\pset format unaligned
SELECT pg_temp.outcome(format('SELECT pg_temp.received(%L)', message))
FROM (SELECT (SELECT string_agg(float8send(n), '' ORDER BY i) FROM unnest(numbers::float8[]) WITH ORDINALITY AS u (n, i))
      FROM (VALUES ('{1,2,3}'),
                   ('{1,2,NaN,0,1,0,0,0,1,60,1.5,0.1,500,0,0}'),
                   ('{1,2,3,0,0,0,0,0,1,60,1.5,0.1,500,0,0}'),
                   ('{1,2,3,0,1,0,0,1,0,60,1.5,0.1,500,0,0}'),
                   ('{1,2,3,0,1,0,0,0,1,180,1.5,0.1,500,0,0}'),
                   ('{1,2,3,0,1,0,0,0,1,60,0,0.1,500,0,0}'),
                   ('{1,2,3,0,1,0,0,0,1,60,1.5,-1,500,0,0}'),
                   ('{1,2,3,0,1,0,0,0,1,60,1.5,1,1,0,0}'),
                   ('{1,2,3,0,1,0,0,0,1,60,1.5,1,500,0,Infinity}'),
                   ('{1,2,3,0,1,0,0,0,1,60,1.5,1,500,0,0,0}')) AS m (numbers)) AS malformed (message);
\pset format aligned

-- Touching counts: near plane, far plane, sides, a corner, and the eye of one that starts there.
SELECT bool_and((box::box3d && f::frustum) = meets AND (f::frustum && box::box3d) = meets) AS t
FROM (VALUES
    ('BOX3D(-9 -9 -9, 9 1 9)', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', true),
    ('BOX3D(-9 -9 -9, 9 0.999999 9)', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', false),
    ('BOX3D(0 10 0, 0 10 0)', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', true),
    ('BOX3D(0 10.000001 0, 0 11 0)', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', false),
    ('BOX3D(4 0 -9, 5 2 9)', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', true),
    ('BOX3D(4.000001 0 -9, 5 2 9)', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', false),
    ('BOX3D(20 10 10, 21 11 11)', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', true),
    ('BOX3D(20 10 10.000001, 21 11 11)', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', false),
    ('BOX3D(-1 -1 -1, 0 0 0)', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 90, 2, 0, 10)', true),
    ('BOX3D(-1 -1 -1, 0 0 0)', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', false),
    -- off centre: all of the image is right of the direction
    ('BOX3D(-1 5 0, 0 6 0)', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 90, 1, 1, 10, 1 0)', true),
    ('BOX3D(-1 5 0, -0.000001 6 0)', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 90, 1, 1, 10, 1 0)', false),
    -- turned by 45 degrees: only a pair of edges tells them apart
    ('BOX3D(-1 4 7.0710678, 1 5 8)', 'FRUSTUM(0 0 0, 0 1 0, 1 0 1, 90, 1, 1, 10)', true),
    ('BOX3D(-1 4 7.0710679, 1 5 8)', 'FRUSTUM(0 0 0, 0 1 0, 1 0 1, 90, 1, 1, 10)', false),
    -- far away
    ('BOX3D(85004 447000 -9, 85005 447002 9)', 'FRUSTUM(85000 447000 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', true),
    ('BOX3D(85004.000001 447000 -9, 85005 447002 9)', 'FRUSTUM(85000 447000 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', false),
    ('BOX3D(1000000000000004 1e15 -9, 1000000000000005 1000000000000002 9)', 'FRUSTUM(1e15 1e15 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', true),
    ('BOX3D(1000000000000004.125 1e15 -9, 1000000000000005 1000000000000002 9)', 'FRUSTUM(1e15 1e15 0, 0 1 0, 0 0 1, 90, 2, 1, 10)', false)
) AS pair (box, f, meets);

-- Just what passes in clip space is met. The matrix is written out: eye (85000, 447000, 10), turned
-- and tilted, shifted, from 0.5 to 40 m. Points by the golden ratio.
WITH axes AS (
    SELECT 85000::float8 AS ex, 447000::float8 AS ey, 10::float8 AS ez,
           0.8::float8 AS rx, -0.6::float8 AS ry, 0::float8 AS rz,          -- right
           0.6 * 0.96 AS fx, 0.8 * 0.96 AS fy, -0.28::float8 AS fz,         -- forward
           0.6 * 0.28 AS ux, 0.8 * 0.28 AS uy, 0.96::float8 AS uz           -- up
), rows AS (
    SELECT ARRAY[1.5 * rx - 0.3 * fx, 1.5 * ry - 0.3 * fy, 1.5 * rz - 0.3 * fz] AS x,
           ARRAY[2 * ux + 0.1 * fx, 2 * uy + 0.1 * fy, 2 * uz + 0.1 * fz] AS y,
           ARRAY[fx, fy, fz] AS w, ARRAY[ex, ey, ez] AS e
    FROM axes
), clip AS (
    SELECT x, y, w, -(x[1] * e[1] + x[2] * e[2] + x[3] * e[3]) AS x4, -(y[1] * e[1] + y[2] * e[2] + y[3] * e[3]) AS y4,
           -(w[1] * e[1] + w[2] * e[2] + w[3] * e[3]) AS w4, 40.5 / 39.5 AS a, -40 / 39.5 AS b
    FROM rows
), view AS (
    SELECT clip.*, frustum(ARRAY[x[1], x[2], x[3], x4,  y[1], y[2], y[3], y4,
                                 a * w[1], a * w[2], a * w[3], a * w4 + b,  w[1], w[2], w[3], w4]) AS f
    FROM clip
), point AS (
    SELECT 85000 + 100 * (i * 0.6180339887498949 - floor(i * 0.6180339887498949)) - 50 AS px,
           447000 + 100 * (i * 0.7548776662466927 - floor(i * 0.7548776662466927)) - 50 AS py,
           100 * (i * 0.5698402909980532 - floor(i * 0.5698402909980532)) - 50 AS pz, i
    FROM generate_series(1, 40000) AS i
), clipped AS (
    SELECT point.*, f, w[1] * px + w[2] * py + w[3] * pz + w4 AS cw,
           abs(x[1] * px + x[2] * py + x[3] * pz + x4) AS cx, abs(y[1] * px + y[2] * py + y[3] * pz + y4) AS cy,
           abs(a * (w[1] * px + w[2] * py + w[3] * pz + w4) + b) AS cz
    FROM point, view
), answered AS (
    SELECT cw - greatest(cx, cy, cz) > 1e-6 AS inside, cw - greatest(cx, cy, cz) < -1e-6 AS outside, f,
           box3d(point3d(px, py, pz), point3d(px, py, pz)) AS just,
           box3d(point3d(px, py, pz), point3d(px + mod(i, 7) - 3, py + mod(i, 5) - 2, pz + mod(i, 3) - 1)) AS around
    FROM clipped
)
SELECT bool_and(just && f) FILTER (WHERE inside) AS t,
       bool_and(around && f) FILTER (WHERE inside) AS t,
       bool_and(NOT just && f) FILTER (WHERE outside) AS t,
       count(*) FILTER (WHERE inside) > 400 AS t,
       bool_and(inside <> outside) AS t
FROM answered;

-- So is a box of any size around one, and however far the frustum goes.
SELECT bool_and(box && frustum('POINT(110 110 10)', 225, -30, 12, 1, 1.5, 0.1, far)) AS t
FROM (VALUES ('BOX3D(100 100 0, 120 120 20)'::box3d), ('BOX3D(-1e6 -1e6 -1e6, 1e6 1e6 1e6)'),
             ('BOX3D(-1e15 -3 -1e15, 1e15 1e15 1e9)'), ('BOX3D(-1e15 0 -1, 1e300 1000000000000001 50)'),
             ('BOX3D(-1e308 -1e308 -1e308, 1e308 1e308 1e308)')) AS around (box),
     (VALUES (5::float8), (1e6), (1e15), (1e300)) AS depth (far);

-- Every answer by an index of each kind is the one without it. Rows of every kind: scattered, a grid that
-- touches, flat ones, the same box over and over, single points, huge coordinates.
CREATE TEMPORARY TABLE indexed (id int, box box3d);
INSERT INTO indexed
SELECT i, box3d(point3d(x, y, z), point3d(x + 10 * z / 50, y + 5, z + 5 * x / 1000))
FROM generate_series(1, 4000) AS i
CROSS JOIN LATERAL (SELECT 1000 * (i * 0.6180339887498949 - floor(i * 0.6180339887498949)) AS x,
                           1000 * (i * 0.7548776662466927 - floor(i * 0.7548776662466927)) AS y,
                           50 * (i * 0.5698402909980532 - floor(i * 0.5698402909980532)) AS z) AS p;
INSERT INTO indexed
SELECT 10000 + i, box3d(point3d(x, y, 0), point3d(x + 10, y + 10, 10))
FROM generate_series(0, 1599) AS i CROSS JOIN LATERAL (SELECT 10.0 * (i / 40) AS x, 10.0 * (i % 40) AS y) AS p;
INSERT INTO indexed SELECT 20000 + i, box3d(point3d(i, 0, 0), point3d(i, 1000, 50)) FROM generate_series(1, 500) AS i;
INSERT INTO indexed SELECT 30000 + i, 'BOX3D(100 100 0, 110 110 10)' FROM generate_series(1, 1000) AS i;
INSERT INTO indexed SELECT 40000 + i, box3d(point3d(i, i, i), point3d(i, i, i)) FROM generate_series(1, 500) AS i;
INSERT INTO indexed
SELECT 50000 + i, box3d(point3d(x, y, 0), point3d(x + 20, y + 7.25, 30))
FROM generate_series(1, 1500) AS i
CROSS JOIN LATERAL (SELECT 85000 + i % 50 * 20 AS x, 447000 + i / 50 * 20 AS y) AS p;
INSERT INTO indexed
SELECT 60000 + i, box3d(point3d(-1e15 * i, 1e15 * i, -i), point3d(1e300, 1e15 * i + i, 1e-300)) FROM generate_series(1, 200) AS i;
INSERT INTO indexed
SELECT 70000 + i, box3d(point3d(1e15 + i, 1e15 + 2 * i, 0), point3d(1e15 + i + 2, 1e15 + 2 * i + 3, 5)) FROM generate_series(1, 500) AS i;
INSERT INTO indexed VALUES (-1, NULL);
CREATE TEMPORARY TABLE indexed_spgist AS TABLE indexed;
CREATE TEMPORARY TABLE indexed_brin AS TABLE indexed;
CREATE INDEX ON indexed USING gist (box);
CREATE INDEX ON indexed_spgist USING spgist (box);
CREATE INDEX ON indexed_brin USING brin (box) WITH (pages_per_range = 1);
ANALYZE indexed;
ANALYZE indexed_spgist;
ANALYZE indexed_brin;
CREATE TEMPORARY TABLE view (number serial, f frustum);
INSERT INTO view (f)
SELECT frustum(eye::point3d, heading, pitch, roll, fov, aspect, near, far)
FROM (VALUES ('POINT(500 500 1.75)'), ('POINT(110 110 10)'), ('POINT(85500 447300 1.75)'), ('POINT(1000000000000250 1000000000000500 2)')) AS e (eye),
     (VALUES (0, 0, 0), (45, -10, 0), (200, 30, 33), (315, -90, 0)) AS d (heading, pitch, roll),
     (VALUES (60::float8, 1.5::float8, 0.1::float8, 200::float8), (1, 1, 5, 40), (150, 0.5, 0, 2000), (40, 3, 50, 1e9)) AS i (fov, aspect, near, far);
INSERT INTO view (f) VALUES ('FRUSTUM(500 500 20, 0 1 0, 0 0 1, 60, 1.5, 1, 300, 1 -2)'), ('FRUSTUM(0 0 -5, 0 1 0, 0 0 1, 60, 1, 0, 4)');
CREATE FUNCTION pg_temp.rows_of(f frustum, relation text, by_index boolean) RETURNS int[] LANGUAGE plpgsql AS $$
DECLARE
    rows int[];
BEGIN
    PERFORM set_config('enable_seqscan', CASE WHEN by_index THEN 'off' ELSE 'on' END, true);
    PERFORM set_config('enable_indexscan', CASE WHEN by_index THEN 'on' ELSE 'off' END, true);
    PERFORM set_config('enable_indexonlyscan', CASE WHEN by_index THEN 'on' ELSE 'off' END, true);
    PERFORM set_config('enable_bitmapscan', CASE WHEN by_index THEN 'on' ELSE 'off' END, true);
    EXECUTE format('SELECT array_agg(id ORDER BY id) FROM %I WHERE box && %L::occlusion.frustum', relation, f) INTO rows;
    RETURN rows;
END
$$;
SELECT relation, bool_and(pg_temp.rows_of(f, relation, true) IS NOT DISTINCT FROM pg_temp.rows_of(f, 'indexed', false)) AS t,
       count(*) = 66 AS t, count(pg_temp.rows_of(f, relation, true)) > 50 AS t
FROM view, (VALUES ('indexed'), ('indexed_spgist'), ('indexed_brin')) AS r (relation)
GROUP BY relation ORDER BY relation;

-- The index is what answers, unprompted, and commuted too.
CREATE FUNCTION pg_temp.scans(statement text) RETURNS SETOF text LANGUAGE plpgsql AS $$
DECLARE
    line text;
BEGIN
    FOR line IN EXECUTE 'EXPLAIN (COSTS OFF) ' || statement LOOP
        IF line ~ '(Scan|Sort)' THEN
            RETURN NEXT regexp_replace(line, '^[ >-]*', '');
        END IF;
    END LOOP;
END
$$;
SET enable_bitmapscan = off;
SELECT pg_temp.scans($$SELECT * FROM indexed WHERE box && 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1, 0, 4)'::frustum$$);
SELECT pg_temp.scans($$SELECT * FROM indexed WHERE 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1, 0, 4)'::frustum && box$$);
SELECT pg_temp.scans($$SELECT * FROM indexed_spgist WHERE box && 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1, 0, 4)'::frustum$$);
RESET enable_bitmapscan;
SELECT pg_temp.scans($$SELECT * FROM indexed_brin WHERE box && 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1, 0, 4)'::frustum$$);
-- By columns of another table as well.
SET enable_seqscan = off;
SELECT pg_temp.scans('SELECT * FROM view JOIN indexed ON box && f') ~ 'Index' AS t OFFSET 1;
RESET enable_seqscan;
SELECT opcname, amvalidate(oid) AS t FROM pg_opclass WHERE opcnamespace = 'occlusion'::regnamespace AND opcname ~ 'box3d|frustum' ORDER BY opcname;

-- Equality, order and hash: of the numbers.
SELECT a = b AS t, NOT a <> b AS t, hash(a) = hash(b) AS t, hash_extended(a, 7) = hash_extended(b, 7) AS t, compare(a, b) = 0 AS t,
       a < c AS t, c > a AS t, NOT a = c AS t, a <= b AND a >= b AND a <> c AS t
FROM (VALUES ('FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1, 0, 4)'::frustum, 'FRUSTUM(-0 0 0, -0 1 0, 0 0 1, 60, 1, -0, 4, 0 -0)'::frustum,
              'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1, 0, 4, 0 1)'::frustum)) AS v (a, b, c);
SELECT count(DISTINCT f) = 66 AND count(*) = 132 AS t FROM (TABLE view UNION ALL TABLE view) AS twice;

-- Visibility: the answer for a frustum is the filter of the answer all round.
SELECT generate_city('regress_frustum', 'scattered', 120, 7);
SET client_min_messages = warning;
CALL generate_occlusion_volumes('regress_frustum');
RESET client_min_messages;
CREATE TEMPORARY TABLE look AS
SELECT x, heading, frustum(point3d(x, 500, 1.75), heading, pitch, 0, fov, 1.5, 0.5, 600) AS f
FROM generate_series(5, 995, 110) AS x, generate_series(0, 330, 30) AS heading, (VALUES (0, 60), (10, 25)) AS v (pitch, fov);
SELECT bool_and(by_frustum IS NULL OR by_frustum <@ by_filter) AS t, count(*) = 240 AS t,
       sum(cardinality(by_frustum)) > 500 AS t, sum(hidden) > 100 AS t
FROM look,
     LATERAL (SELECT array_agg((v.feature_id, v.class, v.envelope::text, v.distance) ORDER BY v.feature_id)
              FROM visible_features('regress_frustum', f) AS v) AS a (by_frustum),
     LATERAL (SELECT array_agg((v.feature_id, v.class, v.envelope::text, v.distance) ORDER BY v.feature_id)
              FROM visible_features('regress_frustum', observer(f), 5000) AS v WHERE v.envelope && f) AS b (by_filter),
     LATERAL (SELECT count(*) FROM regress_frustum.feature AS g WHERE g.envelope && f
                 AND g.id NOT IN (SELECT feature_id FROM visible_features('regress_frustum', f))) AS c (hidden);
SELECT count(*) > 0 AS t FROM explain_visible_features('regress_frustum', (SELECT f FROM look LIMIT 1)) AS line
WHERE line ~ '^Tiles in Range: [1-9]';

-- Models: those of the features, the nearest first.
SELECT bool_and(models IS NOT DISTINCT FROM features) AS t, sum(cardinality(models)) > 10 AS t, bool_and(glb) AS t
FROM (SELECT * FROM look WHERE heading = 90) AS l,
     LATERAL (SELECT array_agg((m.feature_id, m.class, m.distance)), bool_and(substr(m.content, 1, 4) = 'glTF')
              FROM visible_models('regress_frustum', f) AS m) AS a (models, glb),
     LATERAL (SELECT array_agg((v.feature_id, v.class, v.distance) ORDER BY v.distance, v.feature_id)
              FROM visible_features('regress_frustum', f) AS v) AS b (features);
SELECT visible_glb('regress_frustum', f) = merged_models('regress_frustum', (SELECT array_agg(feature_id ORDER BY feature_id) FROM visible_features('regress_frustum', f))) AS t
FROM look WHERE x = 5 AND heading = 90 LIMIT 1;
SELECT visible_glb('regress_frustum', frustum('POINT(0 0 900)', 0, 0, 0, 1, 1, 0, 1)) = merged_models('regress_frustum', '{}') AS t,
       (SELECT count(*) FROM visible_models('regress_frustum', frustum('POINT(0 0 900)', 0, 0, 0, 1, 1, 0, 1))) = 0 AS t;
SELECT drop_scene('regress_frustum');

-- No such scene.
SET search_path = pg_catalog;
SELECT pg_temp.outcome($$SELECT occlusion.visible_features('regress_nowhere', 'FRUSTUM(0 0 0, 0 1 0, 0 0 1, 60, 1, 0, 4)'::occlusion.frustum)$$) LIKE '3F000%' AS t;
