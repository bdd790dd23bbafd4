-- The planner: estimates against counts, and the plans that follow from them.
SET search_path = occlusion, public;
SET jit = off;

-- The rows that the planner expects, and the topmost scan.
CREATE FUNCTION pg_temp.expected(statement text) RETURNS float8 LANGUAGE plpgsql AS $$
DECLARE
    plan json;
BEGIN
    EXECUTE 'EXPLAIN (FORMAT json) ' || statement INTO plan;
    RETURN plan -> 0 -> 'Plan' ->> 'Plan Rows';
END
$$;
CREATE FUNCTION pg_temp.scan(statement text) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    line text;
BEGIN
    FOR line IN EXECUTE 'EXPLAIN (COSTS OFF) ' || statement LOOP
        IF line ~ 'Scan' THEN
            RETURN regexp_replace(line, '^[ >-]*(Parallel )?(\w+ )?(\w+ Only |\w+ )?Scan.*$', '\2\3Scan');
        END IF;
    END LOOP;
END
$$;

-- 100,000 boxes of each kind: uniform, clustered, along streets, and far from the origin and flat.
SELECT setseed(0.5) IS NOT NULL AS t;
CREATE FUNCTION pg_temp.normal() RETURNS float8 LANGUAGE sql VOLATILE AS
    'SELECT sqrt(-2 * ln(1 - random())) * cos(2 * pi() * random())';
CREATE TABLE uniform AS
SELECT box3d(point3d(x, y, z), point3d(x + 20 * random(), y + 20 * random(), z + 20 * random())) AS box
FROM (SELECT 10000 * random() AS x, 10000 * random() AS y, 50 * random() AS z
      FROM generate_series(1, 100000)) AS p;
CREATE TABLE clustered AS
SELECT box3d(point3d(x, y, 0), point3d(x + 15 * random(), y + 15 * random(), 3 + 10 * random())) AS box
FROM (SELECT 500 * (c * 7 % 20) + 150 * pg_temp.normal() AS x,
             500 * (c * 3 % 20) + 150 * pg_temp.normal() AS y
      FROM (SELECT floor(30 * random() * random())::int AS c FROM generate_series(1, 100000)) AS n) AS p;
CREATE TABLE streets AS
SELECT box3d(point3d(x, y, 0), point3d(x + 8 + 4 * random(), y + 8 + 4 * random(), 3 + 9 * random() ^ 3)) AS box
FROM (SELECT CASE WHEN across THEN along ELSE street END AS x, CASE WHEN across THEN street ELSE along END AS y
      FROM (SELECT random() < 0.5 AS across, 10000 * random() AS along,
                   200 * floor(50 * random()) + CASE WHEN random() < 0.5 THEN -15 ELSE 15 END AS street
            FROM generate_series(1, 100000)) AS s) AS p;
CREATE TABLE far_away AS
SELECT box3d(point3d(x, y, 0), point3d(x + 10, y, 0)) AS box
FROM (SELECT 85000 + 10000 * random() AS x, 447000 + 10000 * random() AS y
      FROM generate_series(1, 100000)) AS p;
CREATE INDEX ON uniform USING gist (box);
CREATE INDEX ON clustered USING gist (box);
CREATE INDEX ON streets USING gist (box);
CREATE INDEX ON far_away USING gist (box);
ANALYZE uniform, clustered, streets, far_away;

-- Random queries: half of them around a box, half anywhere; sizes over four powers of ten.
CREATE FUNCTION pg_temp.queries(source regclass, kind text, number int) RETURNS SETOF text
LANGUAGE plpgsql AS $$
DECLARE
    origin text := CASE source WHEN 'far_away'::regclass THEN '85000, 447000' ELSE '0, 0' END;
    form text := CASE kind
        WHEN 'column' THEN '&& ''BOX3D(%1$s %2$s -1000, %3$s %4$s 1000)''::box3d'
        WHEN 'box' THEN '&& ''BOX3D(%1$s %2$s %5$s, %3$s %4$s %6$s)''::box3d'
        WHEN 'inside' THEN '<@ ''BOX3D(%1$s %2$s -1000, %3$s %4$s 1000)''::box3d'
        WHEN 'cone' THEN '&& ''VIEW_CONE(%1$s %2$s 1.75, %7$s, %8$s, %9$s, 0)''::view_cone'
        WHEN 'sector' THEN '&& ''VIEW_SECTOR(%1$s %2$s 1.75, %7$s, %8$s, %9$s)''::view_sector' END;
BEGIN
    RETURN QUERY EXECUTE format($q$
        SELECT format(%L, x, y, x + size * aspect, y + size / aspect, z, z + 60 * random(),
                      360 * random(), 20 + 100 * random(), size)
        FROM (SELECT CASE WHEN i %% 2 = 0 THEN x(lower(box)) ELSE x(o) + 10000 * random() END AS x,
                     CASE WHEN i %% 2 = 0 THEN y(lower(box)) ELSE y(o) + 10000 * random() END AS y,
                     60 * random() - 30 AS z, 10 ^ (1.5 + 2.2 * random()) AS size, 2 ^ (random() - 0.5) AS aspect
              FROM (SELECT box, row_number() OVER () AS i FROM %s TABLESAMPLE bernoulli (3) REPEATABLE (1)) AS b,
                   (SELECT point3d(%s, 0)) AS p (o)
              LIMIT %s) AS q
    $q$, form, source, origin, number);
END
$$;
CREATE TABLE estimate (source text, kind text, expected float8, counted float8);
CREATE FUNCTION pg_temp.measure(source regclass, kind text, number int) RETURNS void LANGUAGE plpgsql AS $$
DECLARE
    condition text;
    counted bigint;
BEGIN
    FOR condition IN SELECT pg_temp.queries(source, kind, number) LOOP
        EXECUTE format('SELECT count(*) FROM %s WHERE box %s', source, condition) INTO counted;
        INSERT INTO estimate
        SELECT source, kind, pg_temp.expected(format('SELECT FROM %s WHERE box %s', source, condition)), counted;
    END LOOP;
END
$$;
SELECT count(pg_temp.measure(source, kind, CASE WHEN kind IN ('box', 'column') THEN 1000 ELSE 400 END)) AS measured
FROM unnest('{uniform,clustered,streets,far_away}'::regclass[]) AS source,
     unnest('{box,column,inside,cone,sector}'::text[]) AS kind;

-- Of the queries that hold 0.1 to 10 % of the rows, the share that is estimated within a factor of 2;
-- of the smaller ones, within a factor of 5 or 50 rows, whichever is wider. Both must be 95 %.
CREATE VIEW accuracy AS
SELECT source, kind,
       count(*) FILTER (WHERE counted BETWEEN 100 AND 10000) AS medium,
       avg((expected BETWEEN counted / 2 AND counted * 2)::int)
           FILTER (WHERE counted BETWEEN 100 AND 10000) AS medium_share,
       count(*) FILTER (WHERE counted < 100) AS small,
       avg((expected BETWEEN counted / 5 AND counted * 5 OR abs(expected - counted) <= 50)::int)
           FILTER (WHERE counted < 100) AS small_share
FROM estimate GROUP BY source, kind;
SELECT source, kind, medium > 80 AND small > 80 AS enough,
       medium_share >= 0.95 AS within_2, small_share >= 0.95 AS within_5_or_50
FROM accuracy ORDER BY 1, 2;

-- A box that holds a point or a small box; the same, written the other way round.
SELECT abs(pg_temp.expected($$SELECT FROM uniform WHERE box @> 'POINT(5000 5000 30)'::point3d$$) - 1) < 50 AS t,
       abs(pg_temp.expected($$SELECT FROM uniform WHERE 'POINT(5000 5000 30)'::point3d <@ box$$) - 1) < 50 AS t,
       pg_temp.expected($$SELECT FROM uniform WHERE 'BOX3D(0 0 0, 5000 5000 99)'::box3d @> box$$)
           BETWEEN 20000 AND 30000 AS t,
       pg_temp.expected($$SELECT FROM uniform WHERE 'VIEW_SECTOR(5000 5000 0, 0, 90, 2000)'::view_sector && box$$)
           BETWEEN 2000 AND 5000 AS t;
-- One side only, each way along each axis: half of the rows, and next to none.
SELECT operator,
       pg_temp.expected(format($$SELECT FROM uniform WHERE box OPERATOR(occlusion.%s) 'BOX3D(5000 5000 30, 5000 5000 30)'::box3d$$,
                               operator)) BETWEEN 35000 AND 65000 AS half,
       least(pg_temp.expected(format($$SELECT FROM uniform WHERE box OPERATOR(occlusion.%s) 'BOX3D(-9 -9 -9, -9 -9 -9)'::box3d$$, operator)),
             pg_temp.expected(format($$SELECT FROM uniform WHERE box OPERATOR(occlusion.%s) 'BOX3D(20000 20000 99, 20000 20000 99)'::box3d$$, operator))) AS none
FROM unnest(string_to_array('<< &< &> >> <<| &<| |&> |>> <</ &</ /&> />>', ' ')) AS operator;
SELECT pg_temp.expected($$SELECT FROM uniform WHERE 'BOX3D(9000 0 0, 9000 0 0)'::box3d << box$$) BETWEEN 9000 AND 11000 AS t;

-- The frustum, like the other fields of view.
SELECT f.expected / f.counted BETWEEN 0.5 AND 2 AS t
FROM (SELECT frustum(point3d(5000, 5000, 1.75), 60, 0, 0, 60, 1.5, 1, 2000) AS v) AS v,
     LATERAL (SELECT pg_temp.expected(format('SELECT FROM uniform WHERE box && %L::frustum', v)),
                     (SELECT count(*) FROM uniform WHERE box && v)) AS f (expected, counted);

-- NULL keeps no row; nor does a stable expression whose value is not known fail.
SELECT pg_temp.expected('SELECT FROM uniform WHERE box && NULL::box3d') AS no_row,
       pg_temp.expected($$SELECT FROM uniform WHERE box && (SELECT 'BOX3D(0 0 0, 1 1 1)'::box3d)$$) AS default_of_overlaps,
       pg_temp.expected($$SELECT FROM uniform WHERE box @> (SELECT 'POINT(0 0 0)'::point3d)$$) AS default_of_contains;

-- A prepared statement with a known value, and with any.
PREPARE near(box3d) AS SELECT FROM uniform WHERE box && $1;
SET plan_cache_mode = force_custom_plan;
SELECT pg_temp.expected($$EXECUTE near('BOX3D(0 0 0, 5000 5000 99)')$$) BETWEEN 20000 AND 30000 AS t;
SET plan_cache_mode = force_generic_plan;
SELECT pg_temp.expected($$EXECUTE near('BOX3D(0 0 0, 5000 5000 99)')$$) AS default_of_overlaps;
RESET plan_cache_mode;

-- Joins: no nonsense, and near the truth for two independent tables.
CREATE TABLE quarter AS SELECT expand(box, 30) AS box FROM streets TABLESAMPLE bernoulli (1) REPEATABLE (2);
ANALYZE quarter;
SELECT expected / counted BETWEEN 0.5 AND 2 AS t
FROM (SELECT pg_temp.expected('SELECT FROM quarter AS q, clustered AS c WHERE q.box && c.box'),
             (SELECT count(*) FROM quarter AS q, clustered AS c WHERE q.box && c.box)) AS e (expected, counted);
SELECT pg_temp.expected('SELECT FROM quarter AS q, uniform AS u WHERE q.box @> u.box') <= count(*) * 1e5 AS t,
       pg_temp.expected('SELECT FROM quarter AS q WHERE EXISTS (SELECT FROM clustered AS c WHERE q.box && c.box)')
           <= count(*) AS t,
       pg_temp.expected('SELECT FROM quarter AS q WHERE NOT EXISTS (SELECT FROM clustered AS c WHERE q.box && c.box)')
           <= count(*) AS t
FROM quarter;
-- The index serves the inner side.
SELECT pg_temp.scan('SELECT FROM uniform AS u, (SELECT box FROM quarter LIMIT 3) AS q WHERE u.box && q.box') IS NOT NULL AS t;

-- Columns of every kind: empty, all null, half null, one box only, huge coordinates, mixed with outliers.
CREATE TABLE odd (empty box3d, half box3d, same box3d, huge box3d);
ANALYZE odd;
SELECT pg_temp.expected($$SELECT FROM odd WHERE same && 'BOX3D(0 0 0, 1 1 1)'::box3d$$) >= 1 AS t;
INSERT INTO odd
SELECT NULL, CASE WHEN i % 2 = 0 THEN box3d(point3d(i, 0, 0), point3d(i, 1, 1)) END, 'BOX3D(1 1 1, 2 2 2)',
       box3d(point3d(-1e300 * (i % 3), i, 0), point3d(1e15 * i, i, 1e300))
FROM generate_series(1, 10000) AS i;
ANALYZE odd;
SELECT pg_temp.expected($$SELECT FROM odd WHERE empty && 'BOX3D(0 0 0, 1 1 1)'::box3d$$) <= 50 AS t,
       pg_temp.expected($$SELECT FROM odd WHERE half && 'BOX3D(0 0 0, 99999 1 1)'::box3d$$) BETWEEN 4900 AND 5100 AS t,
       pg_temp.expected($$SELECT FROM odd WHERE same && 'BOX3D(0 0 0, 1 1 1)'::box3d$$) = 10000 AS t,
       pg_temp.expected($$SELECT FROM odd WHERE same && 'BOX3D(3 3 3, 4 4 4)'::box3d$$) = 1 AS t,
       pg_temp.expected($$SELECT FROM odd WHERE same = 'BOX3D(1 1 1, 2 2 2)'::box3d$$) >= 9999 AS t,
       pg_temp.expected($$SELECT FROM odd WHERE huge && 'BOX3D(-1e308 -1e308 -1e308, 1e308 1e308 1e308)'::box3d$$)
           = 10000 AS t;
SELECT attname, null_frac, avg_width, n_distinct FROM pg_stats WHERE tablename = 'odd' ORDER BY 1;

-- Statistics that are none of ours are ignored.
BEGIN;
SET LOCAL allow_system_table_mods = on;
CREATE FUNCTION pg_temp.spoil(numbers float4[]) RETURNS bigint LANGUAGE sql AS $$
    WITH spoilt AS (
        UPDATE pg_statistic
        SET stanumbers1 = CASE WHEN stakind1 = 27183 THEN numbers ELSE stanumbers1 END,
            stanumbers2 = CASE WHEN stakind2 = 27183 THEN numbers ELSE stanumbers2 END,
            stanumbers3 = CASE WHEN stakind3 = 27183 THEN numbers ELSE stanumbers3 END,
            stanumbers4 = CASE WHEN stakind4 = 27183 THEN numbers ELSE stanumbers4 END
        WHERE starelid = 'uniform'::regclass AND 27183 IN (stakind1, stakind2, stakind3, stakind4) RETURNING 1)
    SELECT count(*) FROM spoilt
$$;
SELECT pg_temp.spoil('{9,1,2,3}') AS spoilt;
SELECT pg_temp.expected($$SELECT FROM uniform WHERE box && 'BOX3D(0 0 0, 5000 5000 99)'::box3d$$) AS default_of_overlaps;
SELECT pg_temp.spoil('{1,1,0,NaN,0,1,0,1,0,1,0,1,0,1}') AS spoilt;
SELECT pg_temp.expected($$SELECT FROM uniform WHERE box && 'BOX3D(0 0 0, 5000 5000 99)'::box3d$$) AS default_of_overlaps;
ROLLBACK;

-- Statistics of an expression, of partitions and of a table with children.
CREATE INDEX ON far_away USING gist (expand(box, 5));
ANALYZE far_away;
SELECT pg_temp.expected($$SELECT FROM far_away WHERE expand(box, 5) && 'BOX3D(85000 447000 0, 90000 452000 9)'::box3d$$)
           BETWEEN 20000 AND 30000 AS t;
CREATE TABLE parted (id int, box box3d) PARTITION BY HASH (id);
CREATE TABLE parted_0 PARTITION OF parted FOR VALUES WITH (MODULUS 2, REMAINDER 0);
CREATE TABLE parted_1 PARTITION OF parted FOR VALUES WITH (MODULUS 2, REMAINDER 1);
INSERT INTO parted SELECT row_number() OVER (), box FROM uniform;
ANALYZE parted;
SELECT pg_temp.expected($$SELECT FROM parted WHERE box && 'BOX3D(0 0 0, 5000 5000 99)'::box3d$$)
           BETWEEN 20000 AND 30000 AS t;
-- The statistics target sets their size.
ALTER TABLE far_away ALTER box SET STATISTICS 10;
ANALYZE far_away;
SELECT greatest(cardinality(stanumbers1), cardinality(stanumbers2), cardinality(stanumbers3), cardinality(stanumbers4))
           BETWEEN 1000 AND 160 * 13 + 1 AS t
FROM pg_statistic WHERE starelid = 'far_away'::regclass AND staattnum = 1;

-- Who may not read all rows learns nothing: the estimate is the one without statistics.
CREATE ROLE planner_guest;
GRANT USAGE ON SCHEMA public, occlusion TO planner_guest;
CREATE TABLE secret AS SELECT box, true AS mine FROM uniform;
ANALYZE secret;
ALTER TABLE secret ENABLE ROW LEVEL SECURITY;
CREATE POLICY own ON secret USING (mine);
GRANT SELECT ON secret TO planner_guest;
CREATE FUNCTION public.planner_expected(statement text) RETURNS float8 LANGUAGE plpgsql AS $$
DECLARE
    plan json;
BEGIN
    EXECUTE 'EXPLAIN (FORMAT json) ' || statement INTO plan;
    RETURN plan -> 0 -> 'Plan' ->> 'Plan Rows';
END
$$;
SELECT planner_expected($$SELECT FROM secret WHERE box && 'BOX3D(0 0 0, 5000 5000 99)'::box3d$$) > 20000 AS t;
SET ROLE planner_guest;
SELECT planner_expected($$SELECT FROM secret WHERE box && 'BOX3D(0 0 0, 5000 5000 99)'::box3d$$)
           = planner_expected($$SELECT FROM secret WHERE box && 'BOX3D(0 0 0, 1 1 1)'::box3d$$) AS t;
RESET ROLE;

-- visible_features and its kin.
SELECT create_scene('planned');
SELECT generate_city('planned', 'streets', 3000, 1) IS NOT NULL AS t;
SELECT pg_temp.expected($$SELECT FROM visible_features('planned', point3d(0, 0, 1.7), 200)$$) AS before_analyze;
ANALYZE planned.feature;
-- What is seen grows as the logarithm of what is there.
CREATE FUNCTION pg_temp.counted(statement text) RETURNS float8 LANGUAGE plpgsql AS $$
DECLARE
    counted float8;
BEGIN
    EXECUTE format('SELECT count(*) FROM (%s) AS q', statement) INTO counted;
    RETURN counted;
END
$$;
SELECT kind, pg_temp.counted(statement) > 10 AS some,
       pg_temp.expected(statement) / pg_temp.counted(statement) BETWEEN 0.5 AND 2 AS t
FROM (SELECT format('point3d(%s, %s, 1.7)', avg(x(lower(envelope))), avg(y(lower(envelope)))) AS eye
      FROM planned.feature) AS e,
     (VALUES ('cone', 'view_cone(%s, 30, 90, 300)'), ('sector', 'view_sector(%s, 30, 90, 300)'),
             ('all round', '%s, 300')) AS v (kind, form),
     LATERAL (SELECT format('SELECT FROM visible_features(''planned'', %s)', format(form, eye))) AS s (statement);
SELECT pg_temp.expected($$SELECT FROM visible_models('planned', point3d(0, 0, 1.7), 100000)$$) AS seen,
       pg_temp.expected($$SELECT FROM feature_models('planned', '{1,2,3}')$$) AS three,
       pg_temp.expected($$SELECT FROM unnest('{1,2,3}'::feature_set)$$) AS three,
       pg_temp.expected($$SELECT FROM unnest((SELECT '{1,2,3}'::feature_set))$$) AS unknown,
       pg_temp.expected($$SELECT FROM feature_models('planned', (SELECT '{1,2,3}'::bigint[]))$$) AS unknown;
-- What cannot be told is left to the declared number: unknown values, no scene, no rights.
SELECT pg_temp.expected($$SELECT FROM visible_features('atlantis', point3d(0, 0, 1.7), 100000)$$) AS no_scene,
       pg_temp.expected($$SELECT FROM visible_features(repeat('x', 100), point3d(0, 0, 1.7), 100000)$$) AS no_name,
       pg_temp.expected($$SELECT FROM visible_features('public', point3d(0, 0, 1.7), 100000)$$) AS no_tables,
       pg_temp.expected($$SELECT FROM visible_features((SELECT 'planned'), point3d(0, 0, 1.7), 100000)$$) AS unknown;
SET ROLE planner_guest;
SELECT planner_expected($$SELECT FROM visible_features('planned', point3d(0, 0, 1.7), 100000)$$) AS no_rights;
RESET ROLE;
GRANT USAGE ON SCHEMA planned TO planner_guest;
SET ROLE planner_guest;
SELECT planner_expected($$SELECT FROM visible_features('planned', point3d(0, 0, 1.7), 100000)$$) AS no_rights;
RESET ROLE;
GRANT SELECT ON planned.feature TO planner_guest;
SET ROLE planner_guest;
SELECT planner_expected($$SELECT FROM visible_features('planned', point3d(0, 0, 1.7), 100000)$$) AS seen;
RESET ROLE;

-- Few rows come by index, many by reading all: no hints.
SELECT condition, CASE pg_temp.scan('SELECT * FROM uniform WHERE ' || condition) WHEN 'Seq Scan' THEN 'all' ELSE 'index' END AS scan
FROM (VALUES ($$box && 'BOX3D(1000 1000 0, 1100 1100 60)'::box3d$$), ($$box <@ 'BOX3D(1000 1000 0, 1100 1100 60)'::box3d$$),
             ($$box @> 'POINT(1000 1000 5)'::point3d$$), ($$'POINT(1000 1000 5)'::point3d <@ box$$),
             ($$box @> 'BOX3D(1000 1000 5, 1001 1001 6)'::box3d$$), ($$box = 'BOX3D(1000 1000 5, 1001 1001 6)'::box3d$$),
             ($$box && view_cone(point3d(5000, 5000, 1.75), 90, 60, 500)$$),
             ($$box && view_sector(point3d(5000, 5000, 1.75), 90, 60, 500)$$),
             ($$box && 'BOX3D(-1 -1 -1, 10001 10001 100)'::box3d$$), ($$box <@ 'BOX3D(-1 -1 -1, 10100 10100 100)'::box3d$$),
             ($$box && view_sector(point3d(5000, 5000, 1.75), 90, 350, 50000)$$)) AS c (condition);
SELECT pg_temp.scan($$SELECT * FROM uniform ORDER BY box <-> point3d(5, 500, 1.75) LIMIT 5$$) ~ 'Index' AS nearest;

DROP FUNCTION planner_expected(text);
DROP VIEW accuracy;
DROP TABLE uniform, clustered, streets, far_away, estimate, quarter, odd, parted, secret;
SELECT drop_scene('planned');
REVOKE ALL ON SCHEMA public, occlusion FROM planner_guest;
DROP ROLE planner_guest;
