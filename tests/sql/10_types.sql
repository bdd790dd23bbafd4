-- Types: what is read, what is written, what is refused.

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

-- Text comes back in its one shortest form, from any spelling.
SELECT given, given::occlusion.point3d::text = shown AS t
FROM (VALUES
    ('POINT(5 500 1.75)', 'POINT(5 500 1.75)'),
    ('POINT Z (5 500 1.75)', 'POINT(5 500 1.75)'),
    ('point z(5 500 1.75)', 'POINT(5 500 1.75)'),
    (E'  Point\t(\n5   500\t1.75 )  ', 'POINT(5 500 1.75)'),
    ('POINT(05.0 5e2 +1.750)', 'POINT(5 500 1.75)'),
    ('POINT(.5 5. -1E+2)', 'POINT(0.5 5 -100)'),
    ('POINT(0.1 0.30000000000000004 0.2)', 'POINT(0.1 0.30000000000000004 0.2)'),
    ('POINT(0.1000000000000000055511151231257827 0 0)', 'POINT(0.1 0 0)'),
    ('POINT(1e300 -1e300 1e-300)', 'POINT(1e300 -1e300 1e-300)'),
    ('POINT(1.7976931348623157e308 5e-324 2.2250738585072014e-308)',
     'POINT(1.7976931348623157e308 5e-324 2.2250738585072014e-308)'),
    ('POINT(1e15 9999999999999998 1e16)', 'POINT(1000000000000000 9999999999999998 1e16)'),
    ('POINT(0.00001 0.000009 123456.789)', 'POINT(0.00001 9e-6 123456.789)'),
    ('POINT(85000.125 447000.875 -3.5)', 'POINT(85000.125 447000.875 -3.5)')
) AS spelling (given, shown);

SELECT 'BOX3D(0 0 0, 1 1 1)'::occlusion.box3d::text = 'BOX3D(0 0 0, 1 1 1)' AS t,
       E' box3d\n( 0 0 0 ,1 1 1 ) '::occlusion.box3d::text = 'BOX3D(0 0 0, 1 1 1)' AS t,
       'BOX3D Z (0 0 0, 1 1 1)'::occlusion.box3d::text = 'BOX3D(0 0 0, 1 1 1)' AS t,
       'VIEW_CONE(5 500 1.75, 90, 60, 500, -10)'::occlusion.view_cone::text
           = 'VIEW_CONE(5 500 1.75, 90, 60, 500, -10)' AS t,
       'view_cone ( 5 500 1.75,90,60.0,5e2,-1e1 )'::occlusion.view_cone::text
           = 'VIEW_CONE(5 500 1.75, 90, 60, 500, -10)' AS t,
       'VIEW_SECTOR(5 500 1.75, 90, 60, 500)'::occlusion.view_sector::text
           = 'VIEW_SECTOR(5 500 1.75, 90, 60, 500)' AS t,
       'View_Sector( 5 500 1.75 , 90 , 60 , 500 )'::occlusion.view_sector::text
           = 'VIEW_SECTOR(5 500 1.75, 90, 60, 500)' AS t;

-- Minus zero equals zero.
SELECT occlusion.x('POINT(-0 0 0)') = 0 AS t,
       'BOX3D(-0 -0 -0, 0 0 0)'::occlusion.box3d OPERATOR(occlusion.=) 'BOX3D(0 0 0, -0 -0 -0)' AS t,
       'BOX3D(-0 0 0, 1 1 1)'::occlusion.box3d OPERATOR(occlusion.~=) 'BOX3D(0 0 0, 1 1 1)' AS t,
       'BOX3D(0 0 0, 1 1 1)'::occlusion.box3d OPERATOR(occlusion.@>) 'POINT(-0 -0 -0)'::occlusion.point3d AS t;

-- Corners come in any order.
SELECT bool_and(occlusion.box3d(occlusion.point3d(x, y, z), occlusion.point3d(5 - x, 7 - y, 9 - z))::text
                = 'BOX3D(1 2 3, 4 5 6)') AND count(*) = 8 AS t,
       bool_and(format('BOX3D(%s %s %s, %s %s %s)', x, y, z, 5 - x, 7 - y, 9 - z)::occlusion.box3d::text
                = 'BOX3D(1 2 3, 4 5 6)') AS t
FROM (VALUES (1), (4)) AS xs (x), (VALUES (2), (5)) AS ys (y), (VALUES (3), (6)) AS zs (z);

-- Constructors and accessors agree with text.
SELECT occlusion.point3d(0.1 + 0.2::float8, 1e300, -2)::text = 'POINT(0.30000000000000004 1e300 -2)' AS t,
       occlusion.x('POINT(1 2 3)') = 1 AS t, occlusion.y('POINT(1 2 3)') = 2 AS t, occlusion.z('POINT(1 2 3)') = 3 AS t,
       occlusion.lower('BOX3D(4 5 6, 1 2 3)')::text = 'POINT(1 2 3)' AS t,
       occlusion.upper('BOX3D(4 5 6, 1 2 3)')::text = 'POINT(4 5 6)' AS t,
       occlusion.view_cone('POINT(1 2 3)', 4, 5, 6)::text = 'VIEW_CONE(1 2 3, 4, 5, 6, 0)' AS t,
       occlusion.view_cone('POINT(1 2 3)', 4, 5, 6, 7)::text = 'VIEW_CONE(1 2 3, 4, 5, 6, 7)' AS t,
       occlusion.view_sector('POINT(1 2 3)', 4, 5, 6)::text = 'VIEW_SECTOR(1 2 3, 4, 5, 6)' AS t,
       occlusion.observer('VIEW_CONE(1 2 3, 4, 5, 6, 7)'::occlusion.view_cone)::text = 'POINT(1 2 3)' AS t,
       occlusion.observer('VIEW_SECTOR(1 2 3, 4, 5, 6)'::occlusion.view_sector)::text = 'POINT(1 2 3)' AS t;
SELECT occlusion.volume('BOX3D(0 0 0, 2 3 4)') = 24 AS t,
       occlusion.volume('BOX3D(0 0 0, 2 3 0)') = 0 AS t,
       occlusion.expand('BOX3D(0 0 0, 2 3 4)', 1)::text = 'BOX3D(-1 -1 -1, 3 4 5)' AS t,
       occlusion.expand('BOX3D(0 0 0, 2 3 4)', -1)::text = 'BOX3D(1 1 1, 1 2 3)' AS t,
       occlusion.expand('BOX3D(0 0 0, 2 3 4)', 0)::text = 'BOX3D(0 0 0, 2 3 4)' AS t,
       occlusion.expand('BOX3D(0 0 0, 2 3 4)', -1.5) IS NULL AS t;

-- NULL in, NULL out.
SELECT occlusion.point3d(1, NULL, 3) IS NULL AS t,
       occlusion.box3d('POINT(1 2 3)', NULL) IS NULL AS t,
       occlusion.view_cone('POINT(1 2 3)', 0, 60, NULL) IS NULL AS t,
       (NULL::occlusion.box3d OPERATOR(occlusion.&&) 'BOX3D(0 0 0, 1 1 1)') IS NULL AS t;

-- The bounds of angle, range and pitch that are just allowed.
SELECT pg_temp.outcome(format('SELECT %L::occlusion.%s', literal, type)) = 'done' AS t
FROM (VALUES
    ('view_cone', 'VIEW_CONE(0 0 0, -1000, 1e-9, 0, 90)'),
    ('view_cone', 'VIEW_CONE(0 0 0, 1000, 359.99999, 1e300, -90)'),
    ('view_sector', 'VIEW_SECTOR(0 0 0, -1000, 1e-9, 0)'),
    ('view_sector', 'VIEW_SECTOR(0 0 0, 1000, 359.99999, 1e300)')
) AS bound (type, literal);

-- Literals of another form.
\pset format unaligned
SELECT type, pg_temp.outcome(format('SELECT %L::occlusion.%s', literal, type))
FROM (VALUES
    ('point3d', ''),
    ('point3d', 'POINT'),
    ('point3d', 'POINT()'),
    ('point3d', 'POINT(1 2)'),
    ('point3d', 'POINT(1 2 3 4)'),
    ('point3d', 'POINT(1, 2, 3)'),
    ('point3d', 'POINT(1 2 3'),
    ('point3d', 'POINT 1 2 3)'),
    ('point3d', '(1 2 3)'),
    ('point3d', 'POINT(1 2 3) x'),
    ('point3d', 'POINT(1 2 3))'),
    ('point3d', 'POINT((1 2 3))'),
    ('point3d', 'POINTZ(1 2 3)'),
    ('point3d', 'POINT M (1 2 3)'),
    ('point3d', 'POINT Z Z (1 2 3)'),
    ('point3d', 'POINT EMPTY'),
    ('point3d', 'POINT(1 2 drei)'),
    ('point3d', 'POINT(1 2 0x3)'),
    ('point3d', 'POINT(1 2 3e)'),
    ('point3d', 'POINT(1 2 --3)'),
    ('point3d', 'POINT(1 2 ३)'),
    ('point3d', 'BOX3D(0 0 0, 1 1 1)'),
    ('box3d', 'BOX3D(0 0 0 1 1 1)'),
    ('box3d', 'BOX3D(0 0 0, 1 1)'),
    ('box3d', 'BOX3D(0 0, 0 1 1 1)'),
    ('box3d', 'BOX3D(0 0 0, 1 1 1,)'),
    ('box3d', 'BOX3D(0 0 0, 1 1 1, 2 2 2)'),
    ('box3d', 'BOX(0 0 0, 1 1 1)'),
    ('box3d', 'POINT(0 0 0)'),
    ('view_cone', 'VIEW_CONE(0 0 0, 90, 60, 500)'),
    ('view_cone', 'VIEW_CONE(0 0, 90, 60, 500, 0)'),
    ('view_cone', 'VIEW_CONE(0 0 0, 90 60, 500, 0)'),
    ('view_cone', 'VIEW_SECTOR(0 0 0, 90, 60, 500)'),
    ('view_sector', 'VIEW_SECTOR(0 0 0, 90, 60)'),
    ('view_sector', 'VIEW_SECTOR(0 0 0, 90, 60, 500, 0)'),
    ('view_sector', 'VIEW_CONE(0 0 0, 90, 60, 500, 0)')
) AS malformed (type, literal);

-- A long one is quoted in short.
SELECT pg_temp.outcome(format('SELECT %L::occlusion.box3d', 'BOX3D(' || repeat('é', 1000000)));

-- Numbers that are none, or too large to be one.
SELECT type, pg_temp.outcome(format('SELECT %L::occlusion.%s', literal, type))
FROM (VALUES
    ('point3d', 'POINT(NaN 2 3)'),
    ('point3d', 'POINT(1 nan 3)'),
    ('point3d', 'POINT(1 2 Infinity)'),
    ('point3d', 'POINT(1 2 -inf)'),
    ('point3d', 'POINT(1 2 1e309)'),
    ('point3d', 'POINT(1 2 -1e309)'),
    ('box3d', 'BOX3D(NaN 0 0, 1 1 1)'),
    ('box3d', 'BOX3D(0 0 0, 1 -Infinity 1)'),
    ('box3d', 'BOX3D(0 0 0, 1 1 1e999)'),
    ('view_cone', 'VIEW_CONE(0 NaN 0, 90, 60, 500, 0)'),
    ('view_cone', 'VIEW_CONE(0 0 0, NaN, 60, 500, 0)'),
    ('view_cone', 'VIEW_CONE(0 0 0, 90, inf, 500, 0)'),
    ('view_cone', 'VIEW_CONE(0 0 0, 90, 0, 500, 0)'),
    ('view_cone', 'VIEW_CONE(0 0 0, 90, -60, 500, 0)'),
    ('view_cone', 'VIEW_CONE(0 0 0, 90, 360, 500, 0)'),
    ('view_cone', 'VIEW_CONE(0 0 0, 90, 60, Infinity, 0)'),
    ('view_cone', 'VIEW_CONE(0 0 0, 90, 60, -1e-300, 0)'),
    ('view_cone', 'VIEW_CONE(0 0 0, 90, 60, 500, NaN)'),
    ('view_cone', 'VIEW_CONE(0 0 0, 90, 60, 500, 90.5)'),
    ('view_cone', 'VIEW_CONE(0 0 0, 90, 60, 500, -91)'),
    ('view_sector', 'VIEW_SECTOR(0 0 -Infinity, 90, 60, 500)'),
    ('view_sector', 'VIEW_SECTOR(0 0 0, Infinity, 60, 500)'),
    ('view_sector', 'VIEW_SECTOR(0 0 0, 90, 360.5, 500)'),
    ('view_sector', 'VIEW_SECTOR(0 0 0, 90, 0, 500)'),
    ('view_sector', 'VIEW_SECTOR(0 0 0, 90, 60, NaN)'),
    ('view_sector', 'VIEW_SECTOR(0 0 0, 90, 60, -5)')
) AS malformed (type, literal);

-- The same from constructors.
SELECT pg_temp.outcome('SELECT ' || expression)
FROM (VALUES
    ($$occlusion.point3d('NaN', 2, 3)$$),
    ($$occlusion.point3d(1, 'Infinity', 3)$$),
    ($$occlusion.point3d(1, 2, '-Infinity')$$),
    ($$occlusion.view_cone('POINT(0 0 0)', 'NaN', 60, 500)$$),
    ($$occlusion.view_cone('POINT(0 0 0)', 0, 0, 500)$$),
    ($$occlusion.view_cone('POINT(0 0 0)', 0, 60, -1)$$),
    ($$occlusion.view_cone('POINT(0 0 0)', 0, 60, 500, 91)$$),
    ($$occlusion.view_sector('POINT(0 0 0)', 0, 360, 500)$$),
    ($$occlusion.view_sector('POINT(0 0 0)', 0, 60, 'Infinity')$$),
    ($$occlusion.expand('BOX3D(0 0 0, 1 1 1)', 'NaN')$$),
    ($$occlusion.expand('BOX3D(0 0 0, 1 1 1)', 'Infinity')$$),
    ($$occlusion.expand('BOX3D(-1.7e308 0 0, 1 1 1)', 1e308)$$)
) AS refused (expression);

-- Binary: what is sent is the numbers, most significant byte first, and comes back the same.
SELECT occlusion.point3d_send('POINT(1 -2 0.5)')
           = '\x3ff0000000000000c0000000000000003fe0000000000000' AS t,
       octet_length(occlusion.box3d_send('BOX3D(0 0 0, 1 1 1)')) = 48 AS t,
       octet_length(occlusion.view_cone_send('VIEW_CONE(0 0 0, 0, 60, 500, 0)')) = 56 AS t,
       octet_length(occlusion.view_sector_send('VIEW_SECTOR(0 0 0, 0, 60, 500)')) = 48 AS t;

-- What a type's receive function makes of a message, as text. The message goes through COPY, in the
-- file format that its documentation gives: signature, flags, no header extension, one row.
CREATE FUNCTION pg_temp.received(type text, message bytea) RETURNS text LANGUAGE plpgsql AS $$
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
    EXECUTE format('CREATE TEMPORARY TABLE message (value occlusion.%I)', type);
    EXECUTE format('COPY message FROM PROGRAM %L (FORMAT binary)', format('printf %%b ''%s''', printed));
    EXECUTE 'SELECT value::text FROM message' INTO result;
    DROP TABLE message;
    RETURN result;
END
$$;

SELECT pg_temp.received('point3d', occlusion.point3d_send(p::occlusion.point3d)) = p AS t
FROM (VALUES ('POINT(0.30000000000000004 1e300 1e-300)'), ('POINT(85000.125 447000.875 -3.5)'),
             ('POINT(5e-324 -1.7976931348623157e308 0)')) AS point (p);
SELECT pg_temp.received('box3d', occlusion.box3d_send('BOX3D(1 2 3, 4 5 6.25)')) = 'BOX3D(1 2 3, 4 5 6.25)' AS t,
       pg_temp.received('view_cone', occlusion.view_cone_send('VIEW_CONE(1 2 3, 4, 5, 6, 7.5)'))
           = 'VIEW_CONE(1 2 3, 4, 5, 6, 7.5)' AS t,
       pg_temp.received('view_sector', occlusion.view_sector_send('VIEW_SECTOR(1 2 3, 4, 5, 6.5)'))
           = 'VIEW_SECTOR(1 2 3, 4, 5, 6.5)' AS t;
-- Corners are sorted here too.
SELECT pg_temp.received('box3d', occlusion.point3d_send('POINT(4 2 6)') || occlusion.point3d_send('POINT(1 5 3)'))
           = 'BOX3D(1 2 3, 4 5 6)' AS t;

SELECT pg_temp.outcome(format('SELECT pg_temp.received(%L, %L)', type, message))
FROM (VALUES
    ('point3d', ''::bytea),
    ('point3d', '\x3ff0000000000000c0000000000000003fe00000000000'),
    ('point3d', '\x3ff0000000000000c0000000000000003fe000000000000000'),
    ('point3d', '\x7ff8000000000000c0000000000000003fe0000000000000'),
    ('point3d', '\x3ff00000000000007ff00000000000003fe0000000000000'),
    ('box3d', '\x3ff0000000000000c0000000000000003fe0000000000000'),
    ('box3d', occlusion.point3d_send('POINT(0 0 0)') || '\x00000000000000000000000000000000fff8000000000000'),
    ('view_cone', occlusion.view_sector_send('VIEW_SECTOR(0 0 0, 0, 60, 500)')),
    ('view_cone', occlusion.view_sector_send('VIEW_SECTOR(0 0 0, 0, 60, 500)') || float8send(91)),
    ('view_sector', occlusion.point3d_send('POINT(0 0 0)') || occlusion.point3d_send('POINT(0 400 500)')),
    ('view_sector', occlusion.point3d_send('POINT(0 0 0)') || occlusion.point3d_send('POINT(0 60 -1)'))
) AS malformed (type, message);
