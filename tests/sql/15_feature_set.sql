-- Sets of features: form, algebra against arrays, order, index, aggregates.

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
SET search_path = public, occlusion;

-- Text: any order and spacing in, ascending and once out.
SELECT given, given::feature_set::text = shown AS t
FROM (VALUES
    ('{}', '{}'),
    (E' { \t\n } ', '{}'),
    ('{1,2,7}', '{1,2,7}'),
    ('{7,2,1,2}', '{1,2,7}'),
    (E'\t{ 3 ,\n-5, +4, 007 } ', '{-5,3,4,7}'),
    ('{-0}', '{0}'),
    ('{63,64,-1,-64,-65}', '{-65,-64,-1,63,64}'),
    ('{9223372036854775807,-9223372036854775808}', '{-9223372036854775808,9223372036854775807}')
) AS spelling (given, shown);
\pset format unaligned
SELECT pg_temp.outcome(format('SELECT %L::feature_set', literal))
FROM (VALUES
    (''), ('1,2'), ('{1,2'), ('1}'), ('{1,,2}'), ('{,}'), ('{1,}'), ('{1 2}'), ('{{1}}'), ('{1}{2}'), ('{1} x'),
    ('{NULL}'), ('{x}'), ('{-}'), ('{--1}'), ('{1.0}'), ('{1e3}'), ('{0x1}'), ('{१}'), ('[1,2]'),
    ('{9223372036854775808}'), ('{-9223372036854775809}'), ('{99999999999999999999999999}')
) AS malformed (literal);
SELECT pg_temp.outcome(format('SELECT %L::feature_set', '{' || repeat('é', 1000000)));
\pset format aligned

-- Casts keep the numbers.
SELECT '{3,1,2,3}'::bigint[]::feature_set::text = '{1,2,3}' AS t,
       '{}'::bigint[]::feature_set::text = '{}' AS t,
       '{{1,2},{3,4}}'::bigint[]::feature_set::text = '{1,2,3,4}' AS t,
       '{5,-5}'::feature_set::bigint[] = '{-5,5}'::bigint[] AS t,
       '{}'::feature_set::bigint[] = '{}'::bigint[] AS t,
       pg_temp.outcome($$SELECT '{1,NULL}'::bigint[]::feature_set$$) AS refused;

-- NULL in, NULL out.
SELECT (NULL::feature_set | '{1}') IS NULL AS t, ('{1}'::feature_set & NULL) IS NULL AS t,
       (NULL::feature_set @> 1::bigint) IS NULL AS t, (NULL::feature_set = '{1}') IS NULL AS t,
       NULL::bigint[]::feature_set IS NULL AS t, cardinality(NULL::feature_set) IS NULL AS t,
       (SELECT count(*) FROM unnest(NULL::feature_set)) = 0 AS t;

SELECT cardinality('{}'::feature_set) = 0 AS t, cardinality('{7,8,-9}'::feature_set) = 3 AS t,
       least_number('{7,8,-9}') = -9 AS t, greatest_number('{7,8,-9}') = 8 AS t,
       least_number('{}') IS NULL AS t, greatest_number('{}') IS NULL AS t,
       (SELECT array_agg(n ORDER BY o) FROM unnest('{7,8,-9}'::feature_set) WITH ORDINALITY AS u (n, o)) = '{-9,7,8}' AS t;

-- Sets of every kind: runs, thick and thin ones, ends of the range. Beside each, the same as an array.
CREATE TABLE sample AS
SELECT row_number() OVER () AS id, numbers, numbers::feature_set AS value
FROM (
    SELECT ARRAY(SELECT DISTINCT n FROM (
        SELECT start + i AS n
        FROM generate_series(0, length - 1) AS i
        WHERE i % thin = 0 OR hashint8(i + start) % 7 = 0) AS chosen ORDER BY n) AS numbers
    FROM (VALUES (0::bigint), (37), (-70), (9223372036854774000), (-9223372036854775808), (100000000000)) AS s (start),
         (VALUES (0), (1), (64), (200), (1500)) AS l (length),
         (VALUES (1), (2), (50)) AS d (thin)
) AS made;
SELECT count(*) = 90 AND bool_and(value::bigint[] = numbers AND cardinality(value) = cardinality(numbers)) AS t,
       bool_and(value::text = numbers::text AND value::text::feature_set = value) AS t,
       bool_and(ARRAY(SELECT unnest(value)) = numbers) AS t
FROM sample;
SELECT bool_and((a.value | b.value)::bigint[] = ARRAY(SELECT unnest(a.numbers) UNION SELECT unnest(b.numbers) ORDER BY 1)) AS t,
       bool_and((a.value & b.value)::bigint[] = ARRAY(SELECT unnest(a.numbers) INTERSECT SELECT unnest(b.numbers) ORDER BY 1)) AS t,
       bool_and((a.value - b.value)::bigint[] = ARRAY(SELECT unnest(a.numbers) EXCEPT SELECT unnest(b.numbers) ORDER BY 1)) AS t
FROM sample AS a, sample AS b WHERE (a.id * 31 + b.id) % 11 = 0 OR a.id = b.id;
SELECT bool_and((a.value @> b.value) = (a.numbers @> b.numbers)) AS t,
       bool_and((a.value <@ b.value) = (a.numbers <@ b.numbers)) AS t,
       bool_and((a.value && b.value) = (a.numbers && b.numbers)) AS t,
       bool_and((a.value = b.value) = (a.numbers = b.numbers)) AS t,
       bool_and((a.value <> b.value) = (a.numbers <> b.numbers)) AS t,
       bool_and(compare(a.value, b.value) = btarraycmp(a.numbers, b.numbers)) AS t,
       bool_and((a.value < b.value) = (a.numbers < b.numbers) AND (a.value <= b.value) = (a.numbers <= b.numbers)
            AND (a.value > b.value) = (a.numbers > b.numbers) AND (a.value >= b.value) = (a.numbers >= b.numbers)) AS t
FROM sample AS a, sample AS b;
SELECT bool_and((value @> n) = (n = ANY (numbers)) AND (n <@ value) = (n = ANY (numbers))) AS t
FROM sample, (VALUES (0::bigint), (1), (37), (63), (64), (-70), (-1), (9223372036854775807), (-9223372036854775808), (100000000050)) AS probe (n);

-- Equal sets have one form, however they were made.
SELECT bool_and(feature_set_send(value) = feature_set_send(made) AND hash(value) = hash(made)
            AND hash_extended(value, 5) = hash_extended(made, 5)) AS t
FROM sample, LATERAL (SELECT coalesce(feature_set_agg(n), '{}') AS made FROM (SELECT n FROM unnest(numbers) AS n ORDER BY hashint8(n)) AS u) AS u;

-- GROUP BY, DISTINCT, ORDER BY; hash and merge joins.
SELECT (SELECT count(DISTINCT value) FROM sample) = (SELECT count(DISTINCT numbers) FROM sample) AS t,
       (SELECT count(*) FROM (SELECT FROM sample GROUP BY value) AS g) = (SELECT count(DISTINCT numbers) FROM sample) AS t,
       (SELECT array_agg(numbers::text ORDER BY value, id) FROM sample) = (SELECT array_agg(numbers::text ORDER BY numbers, id) FROM sample) AS t;
CREATE FUNCTION pg_temp.plan(query text) RETURNS SETOF text LANGUAGE plpgsql AS $$
BEGIN
    RETURN QUERY EXECUTE 'EXPLAIN (COSTS OFF) ' || query;
END
$$;
SET enable_nestloop = off;
SET enable_mergejoin = off;
SELECT bool_or(plan LIKE '%Hash Join%') AS t FROM pg_temp.plan('SELECT FROM sample AS a JOIN sample AS b USING (value)') AS plan;
SELECT (SELECT count(*) FROM sample AS a JOIN sample AS b USING (value))
       = (SELECT count(*) FROM sample AS a JOIN sample AS b USING (numbers)) AS t;
SET enable_mergejoin = on;
SET enable_hashjoin = off;
SELECT bool_or(plan LIKE '%Merge Join%') AS t FROM pg_temp.plan('SELECT FROM sample AS a JOIN sample AS b USING (value)') AS plan;
SELECT (SELECT count(*) FROM sample AS a JOIN sample AS b USING (value))
       = (SELECT count(*) FROM sample AS a JOIN sample AS b USING (numbers)) AS t;
RESET enable_nestloop;
RESET enable_mergejoin;
RESET enable_hashjoin;
CREATE UNIQUE INDEX ON sample (value, id);
CREATE INDEX ON sample USING hash (value);
DROP INDEX sample_value_id_idx;
SELECT bool_and(amvalidate(oid)) AS t, count(*) = 3 AS t FROM pg_opclass WHERE opcname = 'feature_set_ops';

-- GIN answers as a sequential scan does.
CREATE INDEX sample_numbers ON sample USING gin (value);
CREATE FUNCTION pg_temp.same(condition text) RETURNS boolean LANGUAGE plpgsql AS $$
DECLARE
    query text := 'SELECT array_agg(id ORDER BY id) FROM sample WHERE ' || condition;
    by_index bigint[];
    by_scan bigint[];
    indexed boolean;
BEGIN
    SET LOCAL enable_seqscan = off;
    SELECT bool_or(plan LIKE '%Bitmap Index Scan on sample_numbers%') INTO indexed FROM pg_temp.plan(query) AS plan;
    EXECUTE query INTO by_index;
    SET LOCAL enable_seqscan = on;
    SET LOCAL enable_bitmapscan = off;
    SET LOCAL enable_indexscan = off;
    EXECUTE query INTO by_scan;
    SET LOCAL enable_bitmapscan = on;
    SET LOCAL enable_indexscan = on;
    RETURN indexed AND by_index IS NOT DISTINCT FROM by_scan;
END
$$;
DROP INDEX sample_value_idx;
SELECT condition, pg_temp.same(condition) AS t
FROM (VALUES
    ('value @> 0::bigint'), ('value @> 37::bigint'), ('value @> -9223372036854775808'), ('value @> 12345::bigint'),
    ($$value @> '{}'$$), ($$value @> '{37,38}'$$), ($$value @> '{0,2,4,6,8,10,12}'$$), ($$value @> '{37,12345}'$$),
    ($$value && '{}'$$), ($$value && '{37,12345}'$$), ($$value && '{12345}'$$),
    ($$value <@ '{}'$$), ($$value <@ '{0,37}'$$), ($$value <@ (SELECT feature_set_agg(n) FROM generate_series(-70, 300) AS n)$$),
    ($$value = '{}'$$), ($$value = '{0}'$$), ($$value = '{0,37}'$$),
    ($$value = (SELECT value FROM sample WHERE id = 9)$$)
) AS asked (condition);

-- Aggregates.
SELECT feature_set_agg(n)::text = '{-3,1,5}' AS t FROM (VALUES (5::bigint), (1), (NULL), (-3), (1)) AS v (n);
SELECT feature_set_agg(n) IS NULL AS t FROM (VALUES (NULL::bigint)) AS v (n);
SELECT feature_set_agg(n) IS NULL AS t FROM generate_series(1, 0) AS n;
SELECT feature_set_union(s)::text = '{1,2,3}' AS t FROM (VALUES ('{1,2}'::feature_set), (NULL), ('{3}'), ('{}')) AS v (s);
SELECT feature_set_union(s) IS NULL AS t FROM (VALUES (NULL::feature_set)) AS v (s);
SELECT feature_set_union(value) = (SELECT feature_set_agg(n) FROM sample, unnest(numbers) AS n) AS t FROM sample;
SELECT array_agg(u ORDER BY id) = ARRAY['{1}', '{1,2}', '{1,2,9}']::text[] AS t
FROM (SELECT id, (feature_set_union(s) OVER (ORDER BY id))::text AS u
      FROM (VALUES (1, '{1}'::feature_set), (2, '{2}'), (3, '{1,9}')) AS v (id, s)) AS w;

-- In parallel.
CREATE TABLE many AS
SELECT i AS id, (i * 7919 % 200000)::bigint AS n,
       ARRAY(SELECT (i * 131 % 5000) * 20 + hashint8(k + i) % 300 FROM generate_series(1, 20) AS k)::bigint[]::feature_set AS s
FROM generate_series(1, 20000) AS i;
ANALYZE many;
CREATE TABLE serial AS SELECT feature_set_agg(n) AS n, feature_set_union(s) AS s FROM many;
SET parallel_setup_cost = 0;
SET parallel_tuple_cost = 0;
SET min_parallel_table_scan_size = 0;
SET max_parallel_workers_per_gather = 2;
SELECT bool_or(plan LIKE '%Partial Aggregate%') AS t
FROM pg_temp.plan('SELECT feature_set_agg(n), feature_set_union(s) FROM many') AS plan;
SELECT feature_set_agg(m.n) = (SELECT n FROM serial) AS t, feature_set_union(m.s) = (SELECT s FROM serial) AS t,
       cardinality(feature_set_agg(m.n)) = count(DISTINCT m.n) AS t
FROM many AS m;
RESET parallel_setup_cost;
RESET parallel_tuple_cost;
RESET min_parallel_table_scan_size;
RESET max_parallel_workers_per_gather;
SELECT (SELECT s::bigint[] FROM serial) = (SELECT array_agg(DISTINCT u ORDER BY u) FROM many, unnest(s) AS u) AS t;

-- Large ones are stored outside the row, and the count is read without fetching them.
CREATE TABLE large (id integer, value feature_set);
INSERT INTO large SELECT 1, feature_set_agg(n) FROM generate_series(1::bigint, 3000000) AS n WHERE hashint8(n) % 3 <> 0;
INSERT INTO large SELECT 2, value | '{-1}' FROM large;
SELECT cardinality(value) = (SELECT count(*) FROM unnest(value)) AS t, cardinality(value) > 1900000 AS t,
       value @> 3000000::bigint = (hashint8(3000000) % 3 <> 0) AS t, pg_column_size(value) < 500000 AS t
FROM large WHERE id = 1;
SELECT (b.value - a.value)::text = '{-1}' AS t, b.value < a.value AS t, b.value @> a.value AS t, a.value <> b.value AS t,
       (a.value & b.value) = a.value AS t
FROM large AS a, large AS b WHERE a.id = 1 AND b.id = 2;
SELECT count(*) = 2 AS t FROM (SELECT value FROM large GROUP BY value) AS g;

-- A set has a most. One of just that many numbers, in its bytes:
CREATE CAST (bytea AS feature_set) WITHOUT FUNCTION;
CREATE TABLE most AS SELECT '\x8080802002ffff3f'::bytea::feature_set AS value;
DROP CAST (bytea AS feature_set);
SELECT cardinality(value) = 67108864 AS t, greatest_number(value) = 67108863 AS t, (value - '{5}' | '{-1}') @> 7::bigint AS t
FROM most;
\pset format unaligned
SELECT pg_temp.outcome($$SELECT value | '{-1}' FROM most$$),
       pg_temp.outcome($$SELECT feature_set_union(v) FROM (SELECT value FROM most UNION ALL SELECT '{-1}') AS u (v)$$);
\pset format aligned

-- Binary: the bytes as they are kept.
SELECT feature_set_send('{}') = '\x00' AS t, feature_set_send('{3,4,5,9}') = '\x0400834509' AS t;
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
    CREATE TEMPORARY TABLE message (value feature_set);
    EXECUTE format('COPY message FROM PROGRAM %L (FORMAT binary)', format('printf %%b ''%s''', printed));
    SELECT value::text FROM message INTO result;
    DROP TABLE message;
    RETURN result;
END
$$;
SELECT bool_and(pg_temp.received(feature_set_send(value)) = numbers::text) AS t FROM sample WHERE id % 5 = 0;
\pset format unaligned
SELECT message, pg_temp.outcome(format('SELECT pg_temp.received(%L)', message))
FROM (VALUES
    (''::bytea), ('\x80'), ('\x0000'), ('\x01'), ('\x0100'), ('\x81000000'), ('\x020000'), ('\x01000000'),
    ('\x01008000'), ('\x02008100'), ('\x02004001'), ('\x01010101'), ('\x000100'), ('\x80010200'),
    -- 2^63 numbers in a few bytes.
    ('\x8080808080808080800102ffffffffffffffff01'), ('\xffffffffffffffffff')
) AS malformed (message);
\pset format aligned

DROP TABLE sample, many, serial, large, most;
RESET search_path;
