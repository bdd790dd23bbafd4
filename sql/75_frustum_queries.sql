-- Visibility queries for a frustum.

CREATE FUNCTION occlusion.visible_features(scene text, view occlusion.frustum)
RETURNS TABLE (feature_id bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
SUPPORT occlusion.visible_features_support
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE occlusion.visible_features_statement(scene, false)
        USING occlusion.observer(view), view;
END
$$;
COMMENT ON FUNCTION occlusion.visible_features(text, occlusion.frustum) IS
    'features that meet the frustum and are not hidden from its eye; holds every visible one';

CREATE FUNCTION occlusion.explain_visible_features(scene text, view occlusion.frustum) RETURNS SETOF text
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE 'EXPLAIN (ANALYZE, BUFFERS, COSTS OFF, SUMMARY OFF, TIMING OFF) '
        || occlusion.visible_features_statement(scene, false) USING occlusion.observer(view), view;
END
$$;
COMMENT ON FUNCTION occlusion.explain_visible_features(text, occlusion.frustum) IS
    'how visible_features answers: its plan, run, with the buffers that it read';
