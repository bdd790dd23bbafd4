-- Models of features, as files.

CREATE FUNCTION occlusion.feature_models(scene text, features bigint[], format text DEFAULT 'glb',
                                         level_of_detail float8 DEFAULT NULL,
                                         most_error float8[] DEFAULT NULL)
RETURNS TABLE (feature_id bigint, level_of_detail float8, content bytea)
LANGUAGE c STABLE PARALLEL SAFE ROWS 100 COST 10000 SUPPORT occlusion.feature_models_support
SET search_path = pg_catalog, pg_temp
AS 'MODULE_PATHNAME', 'feature_models_wrapper';
COMMENT ON FUNCTION occlusion.feature_models(text, bigint[], text, float8, float8[]) IS
    'the model of each feature as a file: format glb, vrml97, cityjson or cityjsonseq; the best level of detail not above the one given; with most_error, metres for each feature, the coarsest level within it; content is null where a feature has no model';

CREATE FUNCTION occlusion.merged_models(scene text, features bigint[], format text DEFAULT 'glb',
                                        level_of_detail float8 DEFAULT NULL,
                                        most_error float8[] DEFAULT NULL)
RETURNS bytea
LANGUAGE c STABLE PARALLEL SAFE COST 10000
SET search_path = pg_catalog, pg_temp
AS 'MODULE_PATHNAME', 'merged_models_wrapper';
COMMENT ON FUNCTION occlusion.merged_models(text, bigint[], text, float8, float8[]) IS
    'the models of features as one file; parameters as those of feature_models';

-- The greatest geometric error that an observer does not notice, metres: seen from the distance of
-- each feature it takes error_angle degrees. Null without an angle.
CREATE FUNCTION occlusion.unnoticed_errors(distances float8[], error_angle float8) RETURNS float8[]
LANGUAGE sql IMMUTABLE PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT CASE WHEN error_angle IS NOT NULL THEN
        (SELECT array_agg(tand(error_angle) * d.distance ORDER BY d.place)
         FROM unnest(distances) WITH ORDINALITY AS d (distance, place)) END
$$;
COMMENT ON FUNCTION occlusion.unnoticed_errors(float8[], float8) IS
    'geometric errors, metres, that take the given angle, degrees, at the given distances';
