-- Planner support of set-returning functions: how many rows they return.

CREATE FUNCTION occlusion.visible_features_support(internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'visible_features_support_wrapper';
COMMENT ON FUNCTION occlusion.visible_features_support(internal) IS
    'planner support: rows of visible_features and visible_models, from the statistics of the scene';
ALTER FUNCTION occlusion.visible_features(text, occlusion.view_cone)
    SUPPORT occlusion.visible_features_support;
ALTER FUNCTION occlusion.visible_features(text, occlusion.view_sector)
    SUPPORT occlusion.visible_features_support;
ALTER FUNCTION occlusion.visible_features(text, occlusion.frustum)
    SUPPORT occlusion.visible_features_support;
ALTER FUNCTION occlusion.visible_features(text, occlusion.point3d, float8)
    SUPPORT occlusion.visible_features_support;
ALTER FUNCTION occlusion.visible_models(text, occlusion.view_cone, text, float8, float8)
    SUPPORT occlusion.visible_features_support;
ALTER FUNCTION occlusion.visible_models(text, occlusion.view_sector, text, float8, float8)
    SUPPORT occlusion.visible_features_support;
ALTER FUNCTION occlusion.visible_models(text, occlusion.frustum, text, float8, float8)
    SUPPORT occlusion.visible_features_support;
ALTER FUNCTION occlusion.visible_models(text, occlusion.point3d, float8, text, float8, float8)
    SUPPORT occlusion.visible_features_support;

CREATE FUNCTION occlusion.feature_models_support(internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_models_support_wrapper';
COMMENT ON FUNCTION occlusion.feature_models_support(internal) IS
    'planner support: rows of feature_models, one for each feature asked for';
ALTER FUNCTION occlusion.feature_models(text, bigint[], text, float8, float8[])
    SUPPORT occlusion.feature_models_support;

CREATE FUNCTION occlusion.feature_set_unnest_support(internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_unnest_support_wrapper';
COMMENT ON FUNCTION occlusion.feature_set_unnest_support(internal) IS
    'planner support: rows of unnest, the numbers in the set';
ALTER FUNCTION occlusion.unnest(occlusion.feature_set) SUPPORT occlusion.feature_set_unnest_support;
