-- More of points and boxes: positions, order, hash, measures, arrays, extents.
SET search_path = occlusion, public;
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

-- Boxes on a small lattice, so that touching, flat, nested and equal ones are common, here and far away.
CREATE TEMPORARY TABLE sample AS
SELECT row_number() OVER () AS id, n AS numbers, n::box3d AS box
FROM (SELECT ARRAY[x0 + s.x, y0 + s.y, z0 + s.z, x0 + dx + s.x, y0 + dy + s.y, z0 + dz + s.z] AS n
      FROM generate_series(0, 2) AS x0, generate_series(0, 1) AS y0, generate_series(0, 1) AS z0,
           generate_series(0, 2) AS dx, generate_series(0, 1) AS dy, generate_series(0, 1) AS dz,
           (VALUES (0::float8, 0::float8, 0::float8), (85000, 447000, -3), (1e15, -1e15, 1e15)) AS s (x, y, z)) AS q;

-- Positions, against the numbers; and their commutators.
WITH pair AS (SELECT a.box AS a, b.box AS b, a.numbers AS m, b.numbers AS n FROM sample AS a, sample AS b)
SELECT bool_and((a << b) = (m[4] < n[1])) AS t, bool_and((a <<| b) = (m[5] < n[2])) AS t, bool_and((a <</ b) = (m[6] < n[3])) AS t,
       bool_and((a >> b) = (m[1] > n[4])) AS t, bool_and((a |>> b) = (m[2] > n[5])) AS t, bool_and((a />> b) = (m[3] > n[6])) AS t,
       bool_and((a &< b) = (m[4] <= n[4])) AS t, bool_and((a &<| b) = (m[5] <= n[5])) AS t, bool_and((a &</ b) = (m[6] <= n[6])) AS t,
       bool_and((a &> b) = (m[1] >= n[1])) AS t, bool_and((a |&> b) = (m[2] >= n[2])) AS t, bool_and((a /&> b) = (m[3] >= n[3])) AS t,
       bool_and((a << b) = (b >> a) AND (a <<| b) = (b |>> a) AND (a <</ b) = (b />> a)) AS t
FROM pair;

-- Order: total, that of the numbers, with = and <> its own; hashes agree with it.
WITH pair AS (SELECT a.box AS a, b.box AS b, a.numbers AS m, b.numbers AS n FROM sample AS a, sample AS b)
SELECT bool_and((a < b) = (m < n)) AS t, bool_and((a <= b) = (m <= n)) AS t, bool_and((a > b) = (m > n)) AS t,
       bool_and((a >= b) = (m >= n)) AS t, bool_and((a = b) = (m = n)) AS t, bool_and((a <> b) = (m <> n)) AS t,
       bool_and(compare(a, b) = CASE WHEN m < n THEN -1 WHEN m = n THEN 0 ELSE 1 END) AS t,
       bool_and(a <> b OR hash(a) = hash(b) AND hash_extended(a, 7) = hash_extended(b, 7)) AS t,
       count(DISTINCT hash(a)) > 0.99 * count(DISTINCT m) AS t
FROM pair;
SELECT hash('BOX3D(-0 0 0, 1 1 -0)'::box3d) = hash('BOX3D(0 -0 -0, 1 1 0)'::box3d) AS t,
       hash('POINT(-0 0 0)'::point3d) = hash('POINT(0 -0 -0)'::point3d) AND 'POINT(-0 0 0)'::point3d = 'POINT(0 0 0)' AS t,
       compare('POINT(1 2 3)'::point3d, 'POINT(1 2 4)') = -1 AS t;

-- Sorting, grouping, keys, joins and hash partitions.
SELECT count(*) = count(DISTINCT numbers) AS t FROM (SELECT DISTINCT box, numbers FROM sample) AS d;
SELECT bool_and(ordered.numbers = plain.numbers) AS t
FROM (SELECT numbers, row_number() OVER (ORDER BY box, id) AS place FROM sample) AS ordered
JOIN (SELECT numbers, row_number() OVER (ORDER BY numbers, id) AS place FROM sample) AS plain USING (place);
CREATE FUNCTION pg_temp.plan(statement text) RETURNS SETOF text LANGUAGE plpgsql AS $$
DECLARE
    line text;
BEGIN
    FOR line IN EXECUTE 'EXPLAIN (COSTS OFF) ' || statement LOOP
        RETURN NEXT line;
    END LOOP;
END
$$;
BEGIN;
SET LOCAL enable_mergejoin = off;
SET LOCAL enable_nestloop = off;
SELECT count(*) = (SELECT count(*) FROM sample AS a JOIN sample AS b USING (numbers)) AS t FROM sample AS a JOIN sample AS b USING (box);
SELECT bool_or(line ~ 'Hash Join') AS t FROM pg_temp.plan('SELECT FROM sample AS a JOIN sample AS b USING (box)') AS line;
COMMIT;
BEGIN;
SET LOCAL enable_hashjoin = off;
SET LOCAL enable_nestloop = off;
SELECT count(*) = (SELECT count(*) FROM sample AS a JOIN sample AS b USING (numbers)) AS t FROM sample AS a JOIN sample AS b USING (box);
SELECT bool_or(line ~ 'Merge Join') AS t FROM pg_temp.plan('SELECT FROM sample AS a JOIN sample AS b USING (box)') AS line;
COMMIT;
CREATE TEMPORARY TABLE keyed (box box3d PRIMARY KEY, eye point3d UNIQUE, cone view_cone UNIQUE, sector view_sector UNIQUE);
INSERT INTO keyed VALUES ('BOX3D(0 0 0, 1 1 1)', 'POINT(1 2 3)', 'VIEW_CONE(1 2 3, 0, 60, 5, 0)', 'VIEW_SECTOR(1 2 3, 0, 60, 5)');
INSERT INTO keyed VALUES ('BOX3D(1 1 1, -0 -0 -0)', 'POINT(1 2 4)') ON CONFLICT (box) DO NOTHING;
INSERT INTO keyed VALUES ('BOX3D(1 1 1, 2 2 2)', 'POINT(1 2 3)') ON CONFLICT (eye) DO NOTHING;
INSERT INTO keyed VALUES ('BOX3D(1 1 1, 2 2 2)', NULL, 'VIEW_CONE(1 2 3, -0, 60, 5, 0)') ON CONFLICT (cone) DO NOTHING;
INSERT INTO keyed VALUES ('BOX3D(1 1 1, 2 2 2)', NULL, NULL, 'VIEW_SECTOR(1 2 3, 0, 60, 5)') ON CONFLICT (sector) DO NOTHING;
SELECT count(*) = 1 AS t FROM keyed;
CREATE TEMPORARY TABLE parted (box box3d) PARTITION BY HASH (box);
CREATE TEMPORARY TABLE parted_0 PARTITION OF parted FOR VALUES WITH (MODULUS 3, REMAINDER 0);
CREATE TEMPORARY TABLE parted_1 PARTITION OF parted FOR VALUES WITH (MODULUS 3, REMAINDER 1);
CREATE TEMPORARY TABLE parted_2 PARTITION OF parted FOR VALUES WITH (MODULUS 3, REMAINDER 2);
INSERT INTO parted SELECT box FROM sample;
SELECT bool_and(n > 20) AND sum(n) = (SELECT count(*) FROM sample) AS t
FROM (SELECT count(*) AS n FROM parted GROUP BY tableoid) AS q;
-- Equal boxes in a hash and a B-tree index.
CREATE INDEX sample_hash ON sample USING hash (box);
CREATE INDEX sample_order ON sample (box);
BEGIN;
SET LOCAL enable_seqscan = off;
SELECT bool_and(n = (SELECT count(*) FROM sample AS s WHERE s.numbers = ARRAY[85001, 447000, -3, 85002, 447001, -3]::float8[])) AND count(*) = 1 AS t
FROM (SELECT count(*) AS n FROM sample WHERE box = 'BOX3D(85001 447000 -3, 85002 447001 -3)') AS q;
SELECT bool_or(line ~ 'sample_(hash|order)') AS t FROM pg_temp.plan($$SELECT FROM sample WHERE box = 'BOX3D(1 0 0, 2 1 0)'$$) AS line;
COMMIT;

-- Measures and made boxes.
SELECT center('BOX3D(0 0 0, 2 4 6)'::box3d) = 'POINT(1 2 3)' AS t, size('BOX3D(1 1 1, 3 5 7)'::box3d) = 'POINT(2 4 6)' AS t,
       surface_area('BOX3D(0 0 0, 2 3 4)'::box3d) = 52 AS t, surface_area('BOX3D(0 0 0, 2 3 0)'::box3d) = 12 AS t,
       center('BOX3D(1.7e308 0 0, 1.7e308 0 0)'::box3d) = 'POINT(1.7e308 0 0)' AS t,
       corners('BOX3D(0 0 0, 1 2 3)'::box3d) = ARRAY['POINT(0 0 0)', 'POINT(1 0 0)', 'POINT(0 2 0)', 'POINT(1 2 0)',
                                             'POINT(0 0 3)', 'POINT(1 0 3)', 'POINT(0 2 3)', 'POINT(1 2 3)']::point3d[] AS t,
       translate('BOX3D(0 0 0, 1 1 1)'::box3d, 1, -2, 0.5) = 'BOX3D(1 -2 0.5, 2 -1 1.5)' AS t,
       translate('POINT(0 0 0)'::point3d, dx => 1, dy => -2, dz => 0.5) = 'POINT(1 -2 0.5)' AS t;
WITH pair AS (SELECT a.box AS a, b.box AS b FROM sample AS a, sample AS b)
SELECT bool_and((intersection(a, b) IS NOT NULL) = (a && b)) AS t,
       bool_and(intersection(a, b) <@ a AND intersection(a, b) <@ b) AS t,
       bool_and(intersection(a, b) IS NOT DISTINCT FROM intersection(b, a)) AS t,
       bool_and(a <@ merge(a, b) AND b <@ merge(a, b) AND merge(a, b) = merge(b, a)) AS t,
       bool_and(max_distance(a, b) >= (a <-> b) AND max_distance(a, b) = max_distance(b, a)) AS t,
       bool_and(max_distance(a, b) = (SELECT max(p <-> q) FROM unnest(corners(a)) AS p, unnest(corners(b)) AS q)) AS t
FROM pair WHERE hash(a) % 7 = 0 AND hash(b) % 7 = 0;
SELECT max_distance('BOX3D(0 0 0, 1 1 1)'::box3d, 'POINT(0 0 0)'::point3d) = sqrt(3) AS t,
       'POINT(0 0 0)'::point3d <-> 'POINT(3 4 12)'::point3d = 13 AS t,
       abs(('POINT(3e200 0 0)'::point3d <-> 'POINT(0 4e200 0)'::point3d) / 5e200 - 1) < 1e-15 AS t,
       'BOX3D(0 0 0, 1 1 1)'::box3d <-> 'BOX3D(1e300 1e300 0, 1e301 1e301 1)'::box3d < 'Infinity' AS t;

-- Arrays and casts.
SELECT bool_and(box::float8[] = numbers AND numbers::box3d = box AND numbers(box) = numbers) AS t FROM sample;
SELECT 'POINT(1 2 3)'::point3d::float8[] = '{1,2,3}' AS t, '{1,2,3}'::float8[]::point3d = 'POINT(1 2 3)' AS t,
       '{3,2,1,0,5,0}'::float8[]::box3d = 'BOX3D(0 2 0, 3 5 1)' AS t,
       'POINT(1 2 3)'::point3d::box3d = 'BOX3D(1 2 3, 1 2 3)' AS t,
       box3d(point => 'POINT(1 2 3)') = 'BOX3D(1 2 3, 1 2 3)' AS t;
SELECT pg_temp.outcome(statement)
FROM (VALUES ($$SELECT '{1,2,3,4,5}'::float8[]::occlusion.box3d$$), ($$SELECT '{}'::float8[]::occlusion.point3d$$),
             ($$SELECT '{1,NULL,3}'::float8[]::occlusion.point3d$$), ($$SELECT '{1,NaN,3}'::float8[]::occlusion.point3d$$),
             ($$SELECT '{1,2,3,4,Infinity,6}'::float8[]::occlusion.box3d$$), ($$SELECT '{{1,2},{3,4}}'::float8[]::occlusion.point3d$$),
             ($$SELECT occlusion.translate('BOX3D(0 0 0, 1 1 1)'::occlusion.box3d, 'NaN', 0, 0)$$),
             ($$SELECT occlusion.translate('BOX3D(0 0 0, 1e308 1 1)'::occlusion.box3d, 1e308, 0, 0)$$),
             ($$SELECT occlusion.translate('POINT(0 0 1e308)'::occlusion.point3d, 0, 0, 1e308)$$),
             ($$SELECT occlusion.size('BOX3D(-1e308 0 0, 1e308 1 1)'::occlusion.box3d)$$)) AS q (statement);

-- Extents, in parallel too.
SELECT extent(box) = 'BOX3D(0 -1e15 -3, 1000000000000004 447002 1000000000000002)' AS t,
       extent(lower(box)) = box3d(point3d(0, -1e15, -3), point3d(1e15 + 2, 447001, 1e15 + 1)) AS t,
       extent(box) FILTER (WHERE id < 0) IS NULL AND extent(lower(box)) FILTER (WHERE id < 0) IS NULL AS t FROM sample;
SELECT extent(box) = 'BOX3D(1 1 1, 2 2 2)' AS t, extent(lower(box)) = 'BOX3D(1 1 1, 1 1 1)' AS t
FROM (VALUES (NULL::box3d), ('BOX3D(1 1 1, 2 2 2)'), (NULL)) AS v (box);
CREATE TABLE regress_many AS
SELECT box3d(point3d(i, -i, i % 10), point3d(i + 1, 2 - i, 11)) AS box FROM generate_series(1, 50000) AS i;
BEGIN;
SET LOCAL parallel_setup_cost = 0;
SET LOCAL parallel_tuple_cost = 0;
SET LOCAL min_parallel_table_scan_size = 0;
SELECT bool_or(line ~ 'Partial Aggregate') AS t FROM pg_temp.plan('SELECT extent(box), extent(center(box)) FROM regress_many') AS line;
SELECT extent(box) = 'BOX3D(1 -50000 0, 50001 1 11)' AS t, extent(lower(box)) = 'BOX3D(1 -50000 0, 50000 -1 9)' AS t FROM regress_many;
SELECT bool_or(line ~ 'Parallel Seq Scan') AS t FROM pg_temp.plan($$SELECT count(*) FROM regress_many WHERE box && 'BOX3D(1000 -3000 0, 2999 -1001 11)'$$) AS line;
SELECT count(*) = 1999 AS t FROM regress_many WHERE box && 'BOX3D(1000 -3000 0, 2999 -1001 11)' AND box << 'BOX3D(3001 0 0, 3001 0 0)';
ROLLBACK;
DROP TABLE regress_many;

-- Fields of view: accessors and equality.
SELECT heading(c) = 90 AND angle(c) = 60 AND range(c) = 500 AND pitch(c) = -10 AND observer(c) = 'POINT(5 500 1.75)' AS t,
       heading(s) = 90 AND angle(s) = 60 AND range(s) = 500 AND observer(s) = 'POINT(5 500 1.75)' AS t,
       c = c AND s = s AND c <> view_cone(observer(c), 91, 60, 500, -10) AND s < view_sector(observer(s), 90, 60, 501) AS t
FROM (VALUES ('VIEW_CONE(5 500 1.75, 90, 60, 500, -10)'::view_cone, 'VIEW_SECTOR(5 500 1.75, 90, 60, 500)'::view_sector)) AS v (c, s);

-- Binary copies come back bit for bit.
\set file `mktemp -u /tmp/pg_occlusion.XXXXXX`
CREATE TEMPORARY TABLE copied (LIKE keyed);
COPY keyed TO :'file' WITH (FORMAT binary);
COPY copied FROM :'file' WITH (FORMAT binary);
SELECT count(*) = 1 AS t FROM (TABLE keyed INTERSECT TABLE copied) AS same;
\setenv file :file
\! rm -f "$file"
