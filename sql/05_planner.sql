-- What the planner asks: statistics of columns of boxes, the selectivity of operators, rows of functions.

CREATE FUNCTION occlusion.box3d_typanalyze(internal) RETURNS boolean
    LANGUAGE c STABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_typanalyze_wrapper';
COMMENT ON FUNCTION occlusion.box3d_typanalyze(internal) IS 'ANALYZE of columns of type box3d';
ALTER TYPE occlusion.box3d SET (ANALYZE = occlusion.box3d_typanalyze);

CREATE FUNCTION occlusion.box3d_selectivity(internal, oid, internal, integer) RETURNS float8
    LANGUAGE c STABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_selectivity_wrapper';
COMMENT ON FUNCTION occlusion.box3d_selectivity(internal, oid, internal, integer) IS
    'share of rows that an operator of boxes keeps';
CREATE FUNCTION occlusion.box3d_join_selectivity(internal, oid, internal, smallint, internal) RETURNS float8
    LANGUAGE c STABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_join_selectivity_wrapper';
COMMENT ON FUNCTION occlusion.box3d_join_selectivity(internal, oid, internal, smallint, internal) IS
    'share of pairs that a join by an operator of boxes keeps';

CREATE FUNCTION occlusion.visible_features_support(internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'visible_features_support_wrapper';
COMMENT ON FUNCTION occlusion.visible_features_support(internal) IS
    'planner support: rows of visible_features and visible_models, from the statistics of the scene';
CREATE FUNCTION occlusion.feature_models_support(internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_models_support_wrapper';
COMMENT ON FUNCTION occlusion.feature_models_support(internal) IS
    'planner support: rows of feature_models, one for each feature asked for';
CREATE FUNCTION occlusion.feature_set_unnest_support(internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_unnest_support_wrapper';
COMMENT ON FUNCTION occlusion.feature_set_unnest_support(internal) IS
    'planner support: rows of unnest, the numbers in the set';
