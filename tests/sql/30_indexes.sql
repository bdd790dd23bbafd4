-- GiST, SP-GiST and BRIN: every answer by index is the one without it.
SET search_path = occlusion, public;

-- Rows of every kind: scattered, a grid that touches, flat ones, the same box over and over, single
-- points, huge coordinates. Spread by the golden ratio, so that they are the same everywhere.
CREATE TEMPORARY TABLE indexed (id int, box box3d);
INSERT INTO indexed
SELECT i, box3d(point3d(x, y, z), point3d(x + 10 * z / 50, y + 5, z + 5 * x / 1000))
FROM generate_series(1, 4000) AS i
CROSS JOIN LATERAL (SELECT 1000 * (i * 0.6180339887498949 - floor(i * 0.6180339887498949)) AS x,
                           1000 * (i * 0.7548776662466927 - floor(i * 0.7548776662466927)) AS y,
                           50 * (i * 0.5698402909980532 - floor(i * 0.5698402909980532)) AS z) AS p;
INSERT INTO indexed
SELECT 10000 + i, box3d(point3d(x, y, 0), point3d(x + 10, y + 10, 10))
FROM generate_series(0, 1599) AS i
CROSS JOIN LATERAL (SELECT 10.0 * (i / 40) AS x, 10.0 * (i % 40) AS y) AS p;
INSERT INTO indexed SELECT 20000 + i, box3d(point3d(i, 0, 0), point3d(i, 1000, 50)) FROM generate_series(1, 500) AS i;
INSERT INTO indexed SELECT 30000 + i, 'BOX3D(100 100 0, 110 110 10)' FROM generate_series(1, 1000) AS i;
INSERT INTO indexed SELECT 40000 + i, box3d(point3d(i, i, i), point3d(i, i, i)) FROM generate_series(1, 500) AS i;
INSERT INTO indexed
SELECT 50000 + i, box3d(point3d(x, y, 0), point3d(x + 20, y + 7.25, 30))
FROM generate_series(1, 1500) AS i
CROSS JOIN LATERAL (SELECT 85000 + i % 50 * 20 AS x, 447000 + i / 50 * 20 AS y) AS p;
INSERT INTO indexed
SELECT 60000 + i, box3d(point3d(-1e15 * i, 1e15 * i, -i), point3d(1e300, 1e15 * i + i, 1e-300)) FROM generate_series(1, 200) AS i;
INSERT INTO indexed VALUES (-1, NULL), (-2, NULL);
CREATE INDEX indexed_box ON indexed USING gist (box);
ANALYZE indexed;

-- Each operator, with the queries to put to it.
CREATE TEMPORARY TABLE query (number serial, condition text);
INSERT INTO query (condition)
SELECT format('box OPERATOR(occlusion.%s) %L::occlusion.box3d', operator, box)
FROM (VALUES ('&&'), ('@>'), ('<@'), ('~='), ('='), ('<<'), ('&<'), ('&>'), ('>>'), ('<<|'), ('&<|'), ('|&>'), ('|>>'),
             ('<</'), ('&</'), ('/&>'), ('/>>')) AS o (operator),
     (VALUES ('BOX3D(100 100 0, 110 110 10)'), ('BOX3D(105 105 5, 105 105 5)'), ('BOX3D(90 90 0, 130 130 20)'),
             ('BOX3D(7 7 7, 7 7 7)'), ('BOX3D(250 0 0, 250 1000 50)'), ('BOX3D(400 100 0, 500 200 10)'),
             ('BOX3D(-50 -50 -50, -1 -1 -1)'), ('BOX3D(85000 447000 0, 85020 447007.25 30)'),
             ('BOX3D(-1e15 1e15 -1, 1e300 1000000000000001 1e-300)'), ('BOX3D(-1e308 -1e308 -1e308, 1e308 1e308 1e308)')
     ) AS b (box);
INSERT INTO query (condition)
SELECT format('box OPERATOR(occlusion.@>) %L::occlusion.point3d', point)
FROM (VALUES ('POINT(110 110 10)'), ('POINT(105 105 5)'), ('POINT(7 7 7)'), ('POINT(250.5 3 1)'),
             ('POINT(85007 447003 12)'), ('POINT(0 1e15 0)'), ('POINT(-1 0 0)')) AS p (point);
INSERT INTO query (condition)
SELECT format('box OPERATOR(occlusion.&&) %L::occlusion.view_cone', cone)
FROM (VALUES ('VIEW_CONE(500 500 1.75, 45, 60, 200, 0)'), ('VIEW_CONE(110 110 10, 225, 1, 5, -30)'),
             ('VIEW_CONE(85500 447300 1.75, 300, 90, 100, 10)'), ('VIEW_CONE(0 0 -5, 0, 60, 4, 0)'),
             ('VIEW_CONE(500 500 1.75, 45, 350, 1e6, 0)')) AS c (cone);
INSERT INTO query (condition)
SELECT format('box OPERATOR(occlusion.&&) %L::occlusion.view_sector', sector)
FROM (VALUES ('VIEW_SECTOR(500 500 1.75, 45, 60, 200)'), ('VIEW_SECTOR(110 110 10, 225, 1, 5)'),
             ('VIEW_SECTOR(85500 447300 1.75, 300, 90, 100)'), ('VIEW_SECTOR(0 0 -5, 0, 60, 4)'),
             ('VIEW_SECTOR(500 500 1.75, 45, 200, 1e6)')) AS s (sector);

-- The rows of a statement, as one array, and the scan nodes of its plan.
CREATE FUNCTION pg_temp.rows_of(statement text, by_index boolean) RETURNS int[] LANGUAGE plpgsql AS $$
DECLARE
    rows int[];
BEGIN
    PERFORM set_config('enable_seqscan', CASE WHEN by_index THEN 'off' ELSE 'on' END, true);
    PERFORM set_config('enable_indexscan', CASE WHEN by_index THEN 'on' ELSE 'off' END, true);
    PERFORM set_config('enable_indexonlyscan', CASE WHEN by_index THEN 'on' ELSE 'off' END, true);
    -- BRIN knows no other scan.
    PERFORM set_config('enable_bitmapscan', CASE WHEN by_index THEN 'on' ELSE 'off' END, true);
    EXECUTE format('SELECT array_agg(q.id) FROM (%s) AS q', statement) INTO rows;
    RETURN rows;
END
$$;
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

-- Whether the index, and nothing else, is what answers when it may.
CREATE FUNCTION pg_temp.uses_index(statement text) RETURNS boolean LANGUAGE plpgsql AS $$
BEGIN
    PERFORM pg_temp.rows_of(statement, true); -- leaves the settings of a scan by index
    RETURN (SELECT bool_or(scan ~ 'Scan (using|on) indexed_box') AND NOT bool_or(scan ~ 'Seq Scan')
            FROM pg_temp.scans(statement) AS scan);
END
$$;
-- For each operator: whether every answer is right, whether all were by index, and whether some found anything.
CREATE FUNCTION pg_temp.answers() RETURNS TABLE (operator text, queries bigint, t boolean, by_index boolean, found boolean)
LANGUAGE sql AS $$
    SELECT substring(condition FROM 'OPERATOR\(occlusion\.(.+?)\)') || ' ' || substring(condition FROM '[a-z0-9_]+$'),
           count(*),
           bool_and(pg_temp.rows_of(statement, true) IS NOT DISTINCT FROM pg_temp.rows_of(statement, false)),
           bool_and(pg_temp.uses_index(statement)),
           count(pg_temp.rows_of(statement, true)) > 0
    FROM query
    CROSS JOIN LATERAL (SELECT format('SELECT id FROM indexed WHERE %s ORDER BY id', condition)) AS s (statement)
    GROUP BY 1 ORDER BY 1
$$;
CREATE FUNCTION pg_temp.build(method text) RETURNS void LANGUAGE plpgsql AS $$
BEGIN
    DROP INDEX IF EXISTS indexed_box;
    -- Small ranges of blocks, so that BRIN has something to leave out.
    EXECUTE format('CREATE INDEX indexed_box ON indexed USING %s (box) %s', method,
                   CASE method WHEN 'brin' THEN 'WITH (pages_per_range = 1)' ELSE '' END);
END
$$;
SELECT * FROM pg_temp.answers();
SELECT pg_temp.build('spgist');
SELECT * FROM pg_temp.answers();
SELECT pg_temp.build('brin');
SELECT * FROM pg_temp.answers();
SELECT pg_temp.build('gist');

-- The index is what answers, unprompted where it is worth it.
SET enable_bitmapscan = off;
SELECT pg_temp.scans(format('SELECT * FROM indexed WHERE box %s', condition))
FROM (VALUES ($$&& 'BOX3D(1 1 1, 2 2 2)'::box3d$$), ($$@> 'BOX3D(1 1 1, 2 2 2)'::box3d$$),
             ($$<@ 'BOX3D(1 1 1, 2 2 2)'::box3d$$), ($$~= 'BOX3D(1 1 1, 2 2 2)'::box3d$$),
             ($$= 'BOX3D(1 1 1, 2 2 2)'::box3d$$), ($$@> 'POINT(1 1 1)'::point3d$$),
             ($$&& 'VIEW_CONE(0 0 0, 0, 60, 5, 0)'::view_cone$$), ($$&& 'VIEW_SECTOR(0 0 0, 0, 60, 5)'::view_sector$$)
     ) AS c (condition);
-- Commuted too.
SELECT pg_temp.scans(format('SELECT * FROM indexed WHERE %s box', condition))
FROM (VALUES ($$'POINT(1 1 1)'::point3d <@$$), ($$'VIEW_CONE(0 0 0, 0, 60, 5, 0)'::view_cone &&$$),
             ($$'VIEW_SECTOR(0 0 0, 0, 60, 5)'::view_sector &&$$), ($$'BOX3D(1 1 1, 2 2 2)'::box3d <@$$)) AS c (condition);
RESET enable_bitmapscan;
SET enable_indexscan = off;
SET enable_indexonlyscan = off;
SELECT pg_temp.scans($$SELECT * FROM indexed WHERE box && 'BOX3D(1 1 1, 2 2 2)'::box3d$$);
RESET ALL;
SET search_path = occlusion, public;

-- NULLs are in the index.
SELECT pg_temp.rows_of('SELECT id FROM indexed WHERE box IS NULL ORDER BY id', true) = '{-2,-1}' AS t;

-- Nearest first.
CREATE FUNCTION pg_temp.nearest(target text, most int) RETURNS TABLE (t boolean, complete boolean) LANGUAGE plpgsql AS $$
DECLARE
    statement text := format('SELECT id, box OPERATOR(occlusion.<->) %s AS far FROM indexed '
                             'WHERE box IS NOT NULL ORDER BY 2 LIMIT %s', target, most);
    by_index float8[];
    by_sort float8[];
BEGIN
    SET LOCAL enable_seqscan = off;
    SET LOCAL enable_sort = off;
    EXECUTE format('SELECT array_agg(far) FROM (%s) AS q', statement) INTO by_index;
    SET LOCAL enable_seqscan = on;
    SET LOCAL enable_sort = on;
    SET LOCAL enable_indexscan = off;
    SET LOCAL enable_indexonlyscan = off;
    EXECUTE format('SELECT array_agg(far) FROM (%s) AS q', statement) INTO by_sort;
    RETURN QUERY SELECT by_index = by_sort, cardinality(by_index) = least(most, 9300);
END
$$;
SELECT target, n.*
FROM (VALUES ($$'POINT(105 105 5)'::occlusion.point3d$$), ($$'POINT(-50 1200 3)'::occlusion.point3d$$),
             ($$'POINT(85500 447300 1.75)'::occlusion.point3d$$), ($$'POINT(1e15 1e15 0)'::occlusion.point3d$$),
             ($$'BOX3D(105 105 5, 300 300 10)'::occlusion.box3d$$), ($$'BOX3D(-9 -9 -9, -8 -8 -8)'::occlusion.box3d$$)
     ) AS q (target), LATERAL pg_temp.nearest(target, 10000) AS n;
SELECT pg_temp.build('spgist');
SELECT bool_and(n.t AND n.complete) AS t
FROM (VALUES ($$'POINT(105 105 5)'::occlusion.point3d$$), ($$'POINT(-50 1200 3)'::occlusion.point3d$$),
             ($$'POINT(85500 447300 1.75)'::occlusion.point3d$$), ($$'POINT(1e15 1e15 0)'::occlusion.point3d$$),
             ($$'BOX3D(105 105 5, 300 300 10)'::occlusion.box3d$$), ($$'BOX3D(-9 -9 -9, -8 -8 -8)'::occlusion.box3d$$)
     ) AS q (target), LATERAL pg_temp.nearest(target, 10000) AS n;
SELECT pg_temp.build('gist');
BEGIN;
SET LOCAL enable_seqscan = off;
SELECT pg_temp.scans($$SELECT id FROM indexed ORDER BY box <-> 'POINT(105 105 5)'::point3d LIMIT 5$$);
SELECT pg_temp.scans($$SELECT id FROM indexed ORDER BY 'POINT(105 105 5)'::point3d <-> box LIMIT 5$$);
SELECT pg_temp.scans($$SELECT id FROM indexed ORDER BY box <-> 'BOX3D(1 1 1, 2 2 2)'::box3d LIMIT 5$$);
-- With a condition on the same index.
SELECT pg_temp.scans($$SELECT id FROM indexed WHERE box && 'BOX3D(0 0 0, 90 90 90)'::box3d
                       ORDER BY box <-> 'POINT(105 105 5)'::point3d LIMIT 5$$);
COMMIT;

-- The index alone returns the boxes as they are.
VACUUM (ANALYZE) indexed;
BEGIN;
SET LOCAL enable_seqscan = off;
SET LOCAL enable_bitmapscan = off;
SELECT pg_temp.scans($$SELECT box FROM indexed WHERE box && 'BOX3D(0 0 0, 120 120 90)'::box3d$$);
CREATE TEMPORARY TABLE from_index AS SELECT box::text FROM indexed WHERE box && 'BOX3D(0 0 0, 120 120 90)'::box3d;
SET LOCAL enable_indexonlyscan = off;
SET LOCAL enable_indexscan = off;
SET LOCAL enable_seqscan = on;
SELECT count(*) = 0 AS t FROM (
    (TABLE from_index EXCEPT ALL SELECT box::text FROM indexed WHERE box && 'BOX3D(0 0 0, 120 120 90)'::box3d)
    UNION ALL
    (SELECT box::text FROM indexed WHERE box && 'BOX3D(0 0 0, 120 120 90)'::box3d EXCEPT ALL TABLE from_index)
) AS different;
SELECT count(*) > 1000 AS t FROM from_index;
COMMIT;

-- Joins by index.
BEGIN;
SET LOCAL enable_hashjoin = off;
SET LOCAL enable_mergejoin = off;
CREATE TEMPORARY TABLE by_loop AS
SELECT a.id AS a, b.id AS b FROM indexed AS a, indexed AS b WHERE a.id BETWEEN 50000 AND 59999 AND a.box && b.box;
SELECT count(*) FILTER (WHERE scan ~ 'Index') > 0 AS t
FROM pg_temp.scans('SELECT * FROM indexed AS a, indexed AS b WHERE a.id BETWEEN 50000 AND 59999 AND a.box && b.box') AS scan;
SET LOCAL enable_indexscan = off;
SET LOCAL enable_indexonlyscan = off;
SET LOCAL enable_bitmapscan = off;
SELECT count(*) = (SELECT count(*) FROM by_loop) AND count(l.a) = count(*) AND count(*) > 1500 AS t
FROM (SELECT a.id AS a, b.id AS b FROM indexed AS a, indexed AS b
      WHERE a.id BETWEEN 50000 AND 59999 AND a.box && b.box) AS plain
LEFT JOIN by_loop AS l ON l.a = plain.a AND l.b = plain.b;
COMMIT;

-- Another field of view for each row of a join: what was prepared for one does not serve the next.
CREATE TEMPORARY TABLE eye AS
SELECT i AS number, view_cone(eye, i * 37, 20 + i, 150, i % 3 * 10 - 10) AS cone, view_sector(eye, i * 37, 20 + i, 150) AS sector,
       frustum(eye, i * 37, 0, 0, 20 + i, 1, 0, 150) AS frustum
FROM generate_series(1, 40) AS i, LATERAL (SELECT point3d(25 * i, 1000 - 25 * i, 5 + i % 4) AS eye) AS e;
CREATE FUNCTION pg_temp.seen(by_index boolean) RETURNS bigint[] LANGUAGE plpgsql AS $$
DECLARE
    statement text := 'SELECT number * 1000000::bigint + id AS pair FROM eye, indexed WHERE box && cone '
        'UNION ALL SELECT number * 1000000::bigint + id FROM eye, indexed WHERE box && sector '
        'UNION ALL SELECT number * 1000000::bigint + id FROM eye, indexed WHERE box && frustum';
    pairs bigint[];
BEGIN
    PERFORM set_config('enable_indexscan', by_index::text, true), set_config('enable_bitmapscan', by_index::text, true),
            set_config('enable_material', 'off', true), set_config('random_page_cost', '0.01', true);
    ASSERT by_index = EXISTS (SELECT FROM pg_temp.scans(statement) AS scan WHERE scan ~ 'indexed_box');
    EXECUTE format('SELECT array_agg(pair ORDER BY pair) FROM (%s) AS q', statement) INTO pairs;
    RETURN pairs;
END
$$;
SELECT pg_temp.build('spgist');
SELECT pg_temp.seen(true) = pg_temp.seen(false) AS t;
SELECT pg_temp.build('brin');
SELECT pg_temp.seen(true) = pg_temp.seen(false) AS t;
SELECT pg_temp.build('gist');
SELECT pg_temp.seen(true) = pg_temp.seen(false) AS t, cardinality(pg_temp.seen(true)) > 1000 AS t;

-- After rows came, went and moved, and vacuum; an index that starts empty, and one over nothing but duplicates.
CREATE TABLE pg_temp.original AS TABLE indexed;
CREATE FUNCTION pg_temp.right() RETURNS boolean LANGUAGE sql AS $$
    SELECT bool_and(t AND by_index) FROM pg_temp.answers()
$$;
CREATE FUNCTION pg_temp.right_and_empty() RETURNS boolean LANGUAGE sql AS $$
    SELECT bool_and(t) AND NOT bool_or(found) FROM pg_temp.answers()
$$;
-- gist
SELECT pg_temp.build('gist');
INSERT INTO indexed
SELECT 70000 + i, box3d(point3d(x, y, 0), point3d(x + 3, y + 3, 3))
FROM generate_series(1, 3000) AS i
CROSS JOIN LATERAL (SELECT i % 60 * 3 + 100 AS x, i / 60 * 3 + 100 AS y) AS p;
UPDATE indexed SET box = expand(box, 1) WHERE id % 5 = 0 AND id BETWEEN 1 AND 59999;
DELETE FROM indexed WHERE id % 3 = 0;
SELECT pg_temp.right() AS t;
VACUUM indexed;
SELECT pg_temp.right() AS t;
INSERT INTO indexed SELECT id + 100000, box FROM indexed WHERE id > 0;
SELECT pg_temp.right() AS t;
REINDEX INDEX indexed_box;
SELECT pg_temp.right() AS t;
TRUNCATE indexed;
SELECT pg_temp.right_and_empty() AS t;
INSERT INTO indexed SELECT i, 'BOX3D(100 100 0, 110 110 10)' FROM generate_series(1, 3000) AS i;
SELECT pg_temp.right() AS t;
DELETE FROM indexed;
VACUUM indexed;
SELECT pg_temp.right_and_empty() AS t;
INSERT INTO indexed TABLE pg_temp.original;
-- spgist
SELECT pg_temp.build('spgist');
INSERT INTO indexed
SELECT 70000 + i, box3d(point3d(x, y, 0), point3d(x + 3, y + 3, 3))
FROM generate_series(1, 3000) AS i
CROSS JOIN LATERAL (SELECT i % 60 * 3 + 100 AS x, i / 60 * 3 + 100 AS y) AS p;
UPDATE indexed SET box = expand(box, 1) WHERE id % 5 = 0 AND id BETWEEN 1 AND 59999;
DELETE FROM indexed WHERE id % 3 = 0;
SELECT pg_temp.right() AS t;
VACUUM indexed;
SELECT pg_temp.right() AS t;
INSERT INTO indexed SELECT id + 100000, box FROM indexed WHERE id > 0;
SELECT pg_temp.right() AS t;
REINDEX INDEX indexed_box;
SELECT pg_temp.right() AS t;
TRUNCATE indexed;
SELECT pg_temp.right_and_empty() AS t;
INSERT INTO indexed SELECT i, 'BOX3D(100 100 0, 110 110 10)' FROM generate_series(1, 3000) AS i;
SELECT pg_temp.right() AS t;
DELETE FROM indexed;
VACUUM indexed;
SELECT pg_temp.right_and_empty() AS t;
INSERT INTO indexed TABLE pg_temp.original;
-- brin
SELECT pg_temp.build('brin');
INSERT INTO indexed
SELECT 70000 + i, box3d(point3d(x, y, 0), point3d(x + 3, y + 3, 3))
FROM generate_series(1, 3000) AS i
CROSS JOIN LATERAL (SELECT i % 60 * 3 + 100 AS x, i / 60 * 3 + 100 AS y) AS p;
UPDATE indexed SET box = expand(box, 1) WHERE id % 5 = 0 AND id BETWEEN 1 AND 59999;
DELETE FROM indexed WHERE id % 3 = 0;
SELECT pg_temp.right() AS t;
VACUUM indexed;
SELECT pg_temp.right() AS t;
INSERT INTO indexed SELECT id + 100000, box FROM indexed WHERE id > 0;
SELECT pg_temp.right() AS t;
REINDEX INDEX indexed_box;
SELECT pg_temp.right() AS t;
TRUNCATE indexed;
SELECT pg_temp.right_and_empty() AS t;
INSERT INTO indexed SELECT i, 'BOX3D(100 100 0, 110 110 10)' FROM generate_series(1, 3000) AS i;
SELECT pg_temp.right() AS t;
DELETE FROM indexed;
VACUUM indexed;
SELECT pg_temp.right_and_empty() AS t;
INSERT INTO indexed TABLE pg_temp.original;

-- The catalog agrees that the operator class is sound, and that it is the default.
SELECT a.amname, c.opcname, amvalidate(c.oid) AS t, c.opcdefault AS t
FROM pg_opclass AS c JOIN pg_am AS a ON a.oid = c.opcmethod
WHERE c.opcnamespace = 'occlusion'::regnamespace ORDER BY 1, 2;
SELECT pg_temp.build('gist');
SELECT bool_and(pg_index_column_has_property('indexed_box', 1, property)) AS t
FROM (VALUES ('distance_orderable'), ('returnable'), ('search_nulls')) AS p (property);
SELECT pg_temp.build('spgist');
SELECT bool_and(pg_index_column_has_property('indexed_box', 1, property)) AS t
FROM (VALUES ('distance_orderable'), ('returnable'), ('search_nulls')) AS p (property);
