-- Sets of a scene's features by their slots: numbers along a space-filling order, which compress best.

CREATE FUNCTION occlusion.curve_position(occlusion.box3d) RETURNS bytea
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_curve_position_wrapper';
COMMENT ON FUNCTION occlusion.curve_position(occlusion.box3d) IS
    'position of the box''s centre on Hilbert''s curve through space';

-- Slots that were given stay. Writers wait until the end of the transaction, so that no slot is
-- given twice; the index watches over it afterwards. Of several features with one slot the first keeps it.
CREATE FUNCTION occlusion.assign_slots(scene text) RETURNS bigint
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    assigned bigint;
    partitioned boolean;
BEGIN
    PERFORM occlusion.require_scene(scene);
    EXECUTE format('LOCK TABLE %I.feature IN SHARE ROW EXCLUSIVE MODE', scene);
    EXECUTE format($q$
        WITH claim AS (
            SELECT f.id, f.envelope, f.slot, row_number() OVER (PARTITION BY f.slot ORDER BY f.id) AS place
            FROM %1$I.feature AS f
        ), given AS (
            SELECT c.id, (SELECT coalesce(max(f.slot)::bigint, -1) FROM %1$I.feature AS f)
                         + row_number() OVER (ORDER BY occlusion.curve_position(c.envelope), c.id) AS slot
            FROM claim AS c
            WHERE c.slot IS NULL OR c.place > 1
        )
        UPDATE %1$I.feature AS f SET slot = g.slot::integer FROM given AS g WHERE f.id = g.id
    $q$, scene);
    GET DIAGNOSTICS assigned = ROW_COUNT;
    IF to_regclass(format('%I.feature_slot', scene)) IS NULL THEN
        -- A partitioned table has no unique index without its partition key.
        SELECT c.relkind = 'p' INTO partitioned
        FROM pg_catalog.pg_class AS c WHERE c.oid = format('%I.feature', scene)::regclass;
        EXECUTE format('CREATE %s INDEX feature_slot ON %I.feature (slot)',
                       CASE WHEN partitioned THEN '' ELSE 'UNIQUE' END, scene);
    END IF;
    RETURN assigned;
END
$$;
COMMENT ON FUNCTION occlusion.assign_slots(text) IS
    'gives a slot to each feature that has none of its own, along Hilbert''s curve after those that are given; returns how many';

CREATE FUNCTION occlusion.feature_set(scene text, ids bigint[]) RETURNS occlusion.feature_set
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE COST 10000
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    found record;
BEGIN
    PERFORM occlusion.require_scene(scene);
    EXECUTE format($q$
        SELECT occlusion.feature_set_agg(f.slot::bigint) AS slots,
               bool_or(w.id IS NULL) AS holds_null,
               min(w.id) FILTER (WHERE f.id IS NULL) AS unknown,
               min(f.id) FILTER (WHERE f.slot IS NULL) AS without_slot
        FROM unnest($1) AS w (id) LEFT JOIN %I.feature AS f ON f.id = w.id
    $q$, scene) INTO found USING ids;
    IF found.holds_null THEN
        RAISE EXCEPTION 'feature_set must not contain nulls'
            USING ERRCODE = 'null_value_not_allowed',
                  HINT = 'array_remove(ids, NULL) leaves them out.';
    END IF;
    IF found.unknown IS NOT NULL THEN
        RAISE EXCEPTION 'scene "%" has no feature %', scene, found.unknown
            USING ERRCODE = 'no_data_found';
    END IF;
    IF found.without_slot IS NOT NULL THEN
        RAISE EXCEPTION 'feature % of scene "%" has no slot', found.without_slot, scene
            USING ERRCODE = 'object_not_in_prerequisite_state',
                  HINT = format('SELECT occlusion.assign_slots(%L) gives slots.', scene);
    END IF;
    RETURN coalesce(found.slots, '{}'::occlusion.feature_set);
END
$$;
COMMENT ON FUNCTION occlusion.feature_set(text, bigint[]) IS 'the set of the slots of features that are given by id';

CREATE FUNCTION occlusion.feature_ids(scene text, slots occlusion.feature_set) RETURNS bigint[]
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE COST 10000
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    found record;
BEGIN
    PERFORM occlusion.require_scene(scene);
    EXECUTE format($q$
        SELECT array_agg(f.id ORDER BY f.id) AS ids,
               min(w.slot) FILTER (WHERE f.id IS NULL) AS vacant,
               count(*) AS matches
        FROM occlusion.unnest($1) AS w (slot) LEFT JOIN %I.feature AS f ON f.slot = w.slot
    $q$, scene) INTO found USING slots;
    IF found.vacant IS NOT NULL THEN
        RAISE EXCEPTION 'scene "%" has no feature with slot %', scene, found.vacant
            USING ERRCODE = 'no_data_found',
                  DETAIL = 'The set is of another scene, or the feature has been deleted.';
    END IF;
    IF found.matches <> occlusion.cardinality(slots) THEN
        RAISE EXCEPTION 'features of scene "%" share a slot', scene
            USING ERRCODE = 'object_not_in_prerequisite_state',
                  HINT = format('SELECT occlusion.assign_slots(%L) gives each one of its own.', scene);
    END IF;
    RETURN coalesce(found.ids, '{}');
END
$$;
COMMENT ON FUNCTION occlusion.feature_ids(text, occlusion.feature_set) IS 'ids, ascending, of the features with the slots of a set';
