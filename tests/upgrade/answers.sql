-- What the queries of 0.1.0 answer about those scenes, by the index and without it: the same for ever.
-- What can be seen is in views.sql.
\pset format unaligned
\pset tuples_only on

SELECT 'merged', md5(occlusion.merged_models('hamlet', array_agg(id ORDER BY id))) FROM hamlet.feature;
SELECT 'feature', m.feature_id, m.level_of_detail, md5(m.content)
  FROM occlusion.feature_models('hamlet', (SELECT array_agg(id ORDER BY id) FROM hamlet.feature), 'glb', 1) AS m;
SELECT 'report', * FROM occlusion.import_report('hamlet');
SELECT 'progress', task, state, done, total, made FROM occlusion.progress('town');

-- The tables themselves.
SELECT 'town', v.* FROM town.occlusion_volume AS v ORDER BY v::text COLLATE "C";
SELECT 'hamlet', f.id, f.name, f.envelope, f.outline, f.attributes, c.footprint, c.bottom, c.top, i.box
  FROM hamlet.feature AS f LEFT JOIN hamlet.solid_column AS c ON c.feature = f.id LEFT JOIN hamlet.inner_envelope AS i ON i.feature = f.id
 ORDER BY f.id, c::text COLLATE "C";
SELECT * FROM place ORDER BY id;

-- Every operator, through the index that was built before.
CREATE FUNCTION pg_temp.plan(statement text) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    line text;
    plan text := '';
BEGIN
    FOR line IN EXECUTE 'EXPLAIN (COSTS off) ' || statement LOOP
        plan := plan || line;
    END LOOP;
    RETURN CASE WHEN plan ~ 'boxes_box' THEN 'index' ELSE 'table' END;
END
$$;
CREATE FUNCTION pg_temp.found(operator text, argument text) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    statement text := format('SELECT b.id FROM boxes AS b WHERE b.box OPERATOR(occlusion.%s) %s', operator, argument);
    ids text;
BEGIN
    EXECUTE format('SELECT string_agg(id::text, '' '' ORDER BY id) FROM (%s) AS found', statement) INTO ids;
    RETURN concat_ws(' ', pg_temp.plan(statement), 'finds', ids);
END
$$;
CREATE TEMP TABLE question (operator text, argument text);
INSERT INTO question
SELECT o.operator, quote_literal(o.box) || '::occlusion.box3d' FROM (VALUES
    ('&&', 'BOX3D(10 10 0, 60 60 9)'), ('<@', 'BOX3D(0 0 -1, 90 90 20)'), ('@>', 'BOX3D(20 20 1, 20 20 1)')) AS o (operator, box)
UNION ALL
SELECT operator, quote_literal(box::text) || '::occlusion.box3d'
  FROM unnest('{=,~=}'::text[]) AS operator, (SELECT box FROM boxes ORDER BY id LIMIT 2) AS b
UNION ALL
SELECT '@>', quote_literal(occlusion.lower(box)::text) || '::occlusion.point3d' FROM (SELECT box FROM boxes ORDER BY id LIMIT 2) AS b
UNION ALL
SELECT '&&', quote_literal(look::text) || '::occlusion.view_cone' FROM place
UNION ALL
SELECT '&&', quote_literal(area::text) || '::occlusion.view_sector' FROM place;
SET enable_seqscan = off;
SET enable_bitmapscan = off;
SELECT operator, argument, pg_temp.found(operator, argument) FROM question ORDER BY operator, argument COLLATE "C";
SELECT pg_temp.plan($$SELECT FROM boxes AS b ORDER BY b.box OPERATOR(occlusion.<->) 'POINT(30 40 1)'::occlusion.point3d LIMIT 9$$);
SELECT b.id, b.box OPERATOR(occlusion.<->) 'POINT(30 40 1)'::occlusion.point3d AS distance
  FROM boxes AS b ORDER BY distance, b.id LIMIT 9;
SET enable_indexscan = off;
SET enable_indexonlyscan = off;
SET enable_seqscan = on;
SELECT operator, argument, pg_temp.found(operator, argument) FROM question ORDER BY operator, argument COLLATE "C";

-- Enough was asked for a difference to show.
DO $$
BEGIN
    IF (SELECT count(*) FROM town.occlusion_volume) < 100
       OR (SELECT count(*) FROM hamlet.occlusion_volume) < 10 OR (SELECT count(*) FROM seen) < 10 THEN
        RAISE EXCEPTION 'too little was asked';
    END IF;
END
$$;
