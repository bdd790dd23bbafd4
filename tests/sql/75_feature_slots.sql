-- Slots of a scene's features, and sets of them.

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

SELECT occlusion.create_scene('slot city');
INSERT INTO "slot city".feature (id, envelope)
SELECT 1000 + (i * 37) % 100, occlusion.box3d(occlusion.point3d(85000 + i % 10 * 20, 447000 + i / 10 * 20, 0),
                                              occlusion.point3d(85010 + i % 10 * 20, 447010 + i / 10 * 20, 9))
FROM generate_series(0, 99) AS i;

\pset format unaligned
SELECT pg_temp.outcome(statement)
FROM (VALUES
    ($$SELECT occlusion.feature_set('slot city', '{1000,1001}')$$),
    ($$SELECT occlusion.feature_set('slot city', '{1000,5}')$$),
    ($$SELECT occlusion.feature_set('slot city', '{1000,NULL}')$$),
    ($$SELECT occlusion.feature_ids('slot city', '{0}')$$),
    ($$SELECT occlusion.feature_ids('slot city', '{-9223372036854775808}')$$),
    ($$SELECT occlusion.feature_set('nowhere', '{1}')$$),
    ($$SELECT occlusion.feature_ids('public', '{1}')$$),
    ($$SELECT occlusion.assign_slots('pg_catalog')$$)
) AS refused (statement);
\pset format aligned

-- Every feature gets one, neighbours near each other; those that have one keep it.
UPDATE "slot city".feature SET slot = 7 WHERE id = 1050;
SELECT occlusion.assign_slots('slot city') = 99 AS t;
SELECT count(DISTINCT slot) = 100 AND min(slot) = 7 AND max(slot) = 106 AS t, bool_and(slot = 7) FILTER (WHERE id = 1050) AS t
FROM "slot city".feature;
SELECT avg(a.envelope OPERATOR(occlusion.<->) b.envelope) < 15 AS t
FROM "slot city".feature AS a JOIN "slot city".feature AS b ON b.slot = a.slot + 1;
SELECT occlusion.assign_slots('slot city') = 0 AS t;

-- Ids to slots and back.
SELECT occlusion.feature_ids('slot city', occlusion.feature_set('slot city', ids)) = ids AS t,
       occlusion.cardinality(occlusion.feature_set('slot city', ids)) = 3 AS t,
       occlusion.feature_set('slot city', ids || ids) OPERATOR(occlusion.=) occlusion.feature_set('slot city', ids) AS t
FROM (VALUES ('{1001,1050,1099}'::bigint[])) AS v (ids);
SELECT occlusion.feature_set('slot city', '{}')::text = '{}' AS t, occlusion.feature_ids('slot city', '{}') = '{}' AS t,
       occlusion.feature_set('slot city', NULL) IS NULL AS t, occlusion.feature_ids('slot city', NULL) IS NULL AS t;
SELECT occlusion.feature_ids('slot city', occlusion.feature_set_agg(slot::bigint)) = array_agg(id ORDER BY id) AS t
FROM "slot city".feature;

-- No slot is given twice.
\pset format unaligned
SELECT pg_temp.outcome($$UPDATE "slot city".feature SET slot = 7 WHERE id = 1051$$);
\pset format aligned
-- Where there is no index yet they may be; then the first feature keeps the slot.
DROP INDEX "slot city".feature_slot;
UPDATE "slot city".feature SET slot = 7 WHERE id IN (1049, 1051);
\pset format unaligned
SELECT pg_temp.outcome($$SELECT occlusion.feature_ids('slot city', '{7}')$$);
\pset format aligned
SELECT occlusion.assign_slots('slot city') = 2 AS t;
SELECT occlusion.feature_ids('slot city', '{7}') = '{1049}' AS t, occlusion.feature_ids('slot city', '{107,108}') = '{1050,1051}' AS t;

-- A deleted feature.
DELETE FROM "slot city".feature WHERE id = 1049;
\pset format unaligned
SELECT pg_temp.outcome($$SELECT occlusion.feature_ids('slot city', '{7,107}')$$);
\pset format aligned

-- The volumes of a feature are not touched by a new slot.
INSERT INTO "slot city".occlusion_volume VALUES (1001, 1002, 'BOX3D(0 0 0, 1 1 1)');
UPDATE "slot city".feature SET slot = NULL;
SELECT occlusion.assign_slots('slot city') = 99 AS t;
SELECT count(*) = 1 AS t FROM "slot city".occlusion_volume;

-- With the rights of the caller.
CREATE ROLE regress_slots;
GRANT USAGE ON SCHEMA occlusion TO regress_slots;
SET ROLE regress_slots;
\pset format unaligned
SELECT pg_temp.outcome(statement)
FROM (VALUES
    ($$SELECT occlusion.feature_set('slot city', '{1000}')$$),
    ($$SELECT occlusion.feature_ids('slot city', '{0}')$$),
    ($$SELECT occlusion.assign_slots('slot city')$$)
) AS refused (statement);
\pset format aligned
RESET ROLE;
REVOKE USAGE ON SCHEMA occlusion FROM regress_slots;
DROP ROLE regress_slots;

SELECT occlusion.drop_scene('slot city');
