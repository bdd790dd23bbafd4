-- Models of features, as files.

CREATE FUNCTION occlusion.feature_models(scene text, features bigint[], format text DEFAULT 'glb',
                                         level_of_detail float8 DEFAULT NULL,
                                         most_error float8[] DEFAULT NULL)
RETURNS TABLE (feature_id bigint, level_of_detail float8, content bytea)
LANGUAGE c STABLE PARALLEL SAFE ROWS 100 COST 10000
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

CREATE FUNCTION occlusion.visible_models(scene text, cone occlusion.view_cone, format text DEFAULT 'glb',
                                         level_of_detail float8 DEFAULT NULL,
                                         error_angle float8 DEFAULT NULL)
RETURNS TABLE (feature_id bigint, class text, distance float8, level_of_detail float8, content bytea)
LANGUAGE sql STABLE PARALLEL SAFE ROWS 100 COST 100000
SET search_path = pg_catalog, pg_temp AS $$
    WITH visible AS MATERIALIZED (
        SELECT array_agg(v.feature_id ORDER BY v.distance, v.feature_id) AS ids,
               array_agg(v.class ORDER BY v.distance, v.feature_id) AS classes,
               array_agg(v.distance ORDER BY v.distance, v.feature_id) AS distances
        FROM occlusion.visible_features($1, $2) AS v
    )
    SELECT m.feature_id, visible.classes[m.place], visible.distances[m.place],
           m.level_of_detail, m.content
    FROM visible,
         occlusion.feature_models($1, visible.ids, $3, $4,
                                  occlusion.unnoticed_errors(visible.distances, $5))
             WITH ORDINALITY AS m (feature_id, level_of_detail, content, place)
    WHERE visible.ids IS NOT NULL
$$;
COMMENT ON FUNCTION occlusion.visible_models(text, occlusion.view_cone, text, float8, float8) IS
    'the model of each visible feature, the nearest first: format glb, vrml97, cityjson or cityjsonseq; the best level of detail not above the one given, or the coarsest whose error takes at most error_angle degrees';

CREATE FUNCTION occlusion.visible_models(scene text, sector occlusion.view_sector, format text DEFAULT 'glb',
                                         level_of_detail float8 DEFAULT NULL,
                                         error_angle float8 DEFAULT NULL)
RETURNS TABLE (feature_id bigint, class text, distance float8, level_of_detail float8, content bytea)
LANGUAGE sql STABLE PARALLEL SAFE ROWS 100 COST 100000
SET search_path = pg_catalog, pg_temp AS $$
    WITH visible AS MATERIALIZED (
        SELECT array_agg(v.feature_id ORDER BY v.distance, v.feature_id) AS ids,
               array_agg(v.class ORDER BY v.distance, v.feature_id) AS classes,
               array_agg(v.distance ORDER BY v.distance, v.feature_id) AS distances
        FROM occlusion.visible_features($1, $2) AS v
    )
    SELECT m.feature_id, visible.classes[m.place], visible.distances[m.place],
           m.level_of_detail, m.content
    FROM visible,
         occlusion.feature_models($1, visible.ids, $3, $4,
                                  occlusion.unnoticed_errors(visible.distances, $5))
             WITH ORDINALITY AS m (feature_id, level_of_detail, content, place)
    WHERE visible.ids IS NOT NULL
$$;
COMMENT ON FUNCTION occlusion.visible_models(text, occlusion.view_sector, text, float8, float8) IS
    'the model of each visible feature, the nearest first: format glb, vrml97, cityjson or cityjsonseq; the best level of detail not above the one given, or the coarsest whose error takes at most error_angle degrees';

CREATE FUNCTION occlusion.visible_models(scene text, observer occlusion.point3d, range float8, format text DEFAULT 'glb',
                                         level_of_detail float8 DEFAULT NULL,
                                         error_angle float8 DEFAULT NULL)
RETURNS TABLE (feature_id bigint, class text, distance float8, level_of_detail float8, content bytea)
LANGUAGE sql STABLE PARALLEL SAFE ROWS 100 COST 100000
SET search_path = pg_catalog, pg_temp AS $$
    WITH visible AS MATERIALIZED (
        SELECT array_agg(v.feature_id ORDER BY v.distance, v.feature_id) AS ids,
               array_agg(v.class ORDER BY v.distance, v.feature_id) AS classes,
               array_agg(v.distance ORDER BY v.distance, v.feature_id) AS distances
        FROM occlusion.visible_features($1, $2, $3) AS v
    )
    SELECT m.feature_id, visible.classes[m.place], visible.distances[m.place],
           m.level_of_detail, m.content
    FROM visible,
         occlusion.feature_models($1, visible.ids, $4, $5,
                                  occlusion.unnoticed_errors(visible.distances, $6))
             WITH ORDINALITY AS m (feature_id, level_of_detail, content, place)
    WHERE visible.ids IS NOT NULL
$$;
COMMENT ON FUNCTION occlusion.visible_models(text, occlusion.point3d, float8, text, float8, float8) IS
    'the model of each visible feature, the nearest first: format glb, vrml97, cityjson or cityjsonseq; the best level of detail not above the one given, or the coarsest whose error takes at most error_angle degrees';

CREATE FUNCTION occlusion.visible_glb(scene text, cone occlusion.view_cone, level_of_detail float8 DEFAULT NULL,
                                      error_angle float8 DEFAULT NULL)
RETURNS bytea
LANGUAGE sql STABLE PARALLEL SAFE COST 100000
SET search_path = pg_catalog, pg_temp AS $$
    SELECT occlusion.merged_models(
        $1, coalesce(array_agg(v.feature_id ORDER BY v.feature_id), '{}'), 'glb', $3,
        occlusion.unnoticed_errors(array_agg(v.distance ORDER BY v.feature_id), $4))
    FROM occlusion.visible_features($1, $2) AS v
$$;
COMMENT ON FUNCTION occlusion.visible_glb(text, occlusion.view_cone, float8, float8) IS
    'the models of all visible features as one GLB; level_of_detail and error_angle as those of visible_models';

CREATE FUNCTION occlusion.visible_glb(scene text, sector occlusion.view_sector, level_of_detail float8 DEFAULT NULL,
                                      error_angle float8 DEFAULT NULL)
RETURNS bytea
LANGUAGE sql STABLE PARALLEL SAFE COST 100000
SET search_path = pg_catalog, pg_temp AS $$
    SELECT occlusion.merged_models(
        $1, coalesce(array_agg(v.feature_id ORDER BY v.feature_id), '{}'), 'glb', $3,
        occlusion.unnoticed_errors(array_agg(v.distance ORDER BY v.feature_id), $4))
    FROM occlusion.visible_features($1, $2) AS v
$$;
COMMENT ON FUNCTION occlusion.visible_glb(text, occlusion.view_sector, float8, float8) IS
    'the models of all visible features as one GLB; level_of_detail and error_angle as those of visible_models';

CREATE FUNCTION occlusion.visible_glb(scene text, observer occlusion.point3d, range float8, level_of_detail float8 DEFAULT NULL,
                                      error_angle float8 DEFAULT NULL)
RETURNS bytea
LANGUAGE sql STABLE PARALLEL SAFE COST 100000
SET search_path = pg_catalog, pg_temp AS $$
    SELECT occlusion.merged_models(
        $1, coalesce(array_agg(v.feature_id ORDER BY v.feature_id), '{}'), 'glb', $4,
        occlusion.unnoticed_errors(array_agg(v.distance ORDER BY v.feature_id), $5))
    FROM occlusion.visible_features($1, $2, $3) AS v
$$;
COMMENT ON FUNCTION occlusion.visible_glb(text, occlusion.point3d, float8, float8, float8) IS
    'the models of all visible features as one GLB; level_of_detail and error_angle as those of visible_models';
