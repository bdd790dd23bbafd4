-- Visibility queries for a frustum.

CREATE FUNCTION occlusion.visible_features(scene text, view occlusion.frustum)
RETURNS TABLE (feature_id bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE c STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
SUPPORT occlusion.visible_features_support
AS 'MODULE_PATHNAME', 'visible_features_frustum_wrapper';
COMMENT ON FUNCTION occlusion.visible_features(text, occlusion.frustum) IS
    'features that meet the frustum and are not hidden from its eye; holds every visible one';

CREATE FUNCTION occlusion.explain_sight(scene text, view occlusion.frustum) RETURNS SETOF text
LANGUAGE c STABLE STRICT PARALLEL SAFE
AS 'MODULE_PATHNAME', 'explain_sight_frustum_wrapper';
COMMENT ON FUNCTION occlusion.explain_sight(text, occlusion.frustum) IS
    'how many tiles and features visible_features looked at to answer';

CREATE FUNCTION occlusion.explain_visible_features(scene text, view occlusion.frustum) RETURNS SETOF text
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    RETURN QUERY SELECT * FROM occlusion.explain_sight(scene, view);
    RETURN QUERY EXECUTE 'EXPLAIN (ANALYZE, BUFFERS, COSTS OFF, SUMMARY OFF, TIMING OFF) '
        || occlusion.hidden_features_statement(scene) USING occlusion.observer(view);
END
$$;
COMMENT ON FUNCTION occlusion.explain_visible_features(text, occlusion.frustum) IS
    'how visible_features answers: what it looked at, and the plan, run, of its question for occlusion volumes';
