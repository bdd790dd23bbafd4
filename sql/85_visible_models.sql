-- Models of what an observer sees. CREATE OR REPLACE, since upgrades run this file too.

-- What all forms of visible_models share: the features of an answer, the nearest first, each with its
-- model. The arrays are parallel; null ones are an empty answer.
CREATE FUNCTION occlusion.nearest_models(scene text, features bigint[], classes text[], distances float8[],
                                         format text, level_of_detail float8, error_angle float8)
RETURNS TABLE (feature_id bigint, class text, distance float8, level_of_detail float8, content bytea)
LANGUAGE sql STABLE PARALLEL SAFE ROWS 100 COST 100000
SET search_path = pg_catalog, pg_temp AS $$
    WITH visible AS MATERIALIZED (
        SELECT array_agg(v.id ORDER BY v.distance, v.id) AS ids,
               array_agg(v.class ORDER BY v.distance, v.id) AS classes,
               array_agg(v.distance ORDER BY v.distance, v.id) AS distances
        FROM unnest($2, $3, $4) AS v (id, class, distance)
    )
    SELECT m.feature_id, visible.classes[m.place], visible.distances[m.place],
           m.level_of_detail, m.content
    FROM visible,
         occlusion.feature_models($1, visible.ids, $5, $6,
                                  occlusion.unnoticed_errors(visible.distances, $7))
             WITH ORDINALITY AS m (feature_id, level_of_detail, content, place)
    WHERE visible.ids IS NOT NULL
$$;
COMMENT ON FUNCTION occlusion.nearest_models(text, bigint[], text[], float8[], text, float8, float8) IS
    'the models of the features of an answer, the nearest first: what visible_models does once it has the answer';

CREATE OR REPLACE FUNCTION occlusion.visible_models(scene text, cone occlusion.view_cone, format text DEFAULT 'glb',
                                                    level_of_detail float8 DEFAULT NULL,
                                                    error_angle float8 DEFAULT NULL)
RETURNS TABLE (feature_id bigint, class text, distance float8, level_of_detail float8, content bytea)
LANGUAGE sql STABLE PARALLEL SAFE ROWS 100 COST 100000
SUPPORT occlusion.visible_features_support
SET search_path = pg_catalog, pg_temp AS $$
    SELECT m.*
    FROM (SELECT array_agg(v.feature_id), array_agg(v.class), array_agg(v.distance)
          FROM occlusion.visible_features($1, $2) AS v) AS a (ids, classes, distances),
         occlusion.nearest_models($1, a.ids, a.classes, a.distances, $3, $4, $5) AS m
$$;
COMMENT ON FUNCTION occlusion.visible_models(text, occlusion.view_cone, text, float8, float8) IS
    'the model of each visible feature, the nearest first: format glb, vrml97, cityjson or cityjsonseq; the best level of detail not above the one given, or the coarsest whose error takes at most error_angle degrees';

CREATE OR REPLACE FUNCTION occlusion.visible_models(scene text, sector occlusion.view_sector, format text DEFAULT 'glb',
                                                    level_of_detail float8 DEFAULT NULL,
                                                    error_angle float8 DEFAULT NULL)
RETURNS TABLE (feature_id bigint, class text, distance float8, level_of_detail float8, content bytea)
LANGUAGE sql STABLE PARALLEL SAFE ROWS 100 COST 100000
SUPPORT occlusion.visible_features_support
SET search_path = pg_catalog, pg_temp AS $$
    SELECT m.*
    FROM (SELECT array_agg(v.feature_id), array_agg(v.class), array_agg(v.distance)
          FROM occlusion.visible_features($1, $2) AS v) AS a (ids, classes, distances),
         occlusion.nearest_models($1, a.ids, a.classes, a.distances, $3, $4, $5) AS m
$$;
COMMENT ON FUNCTION occlusion.visible_models(text, occlusion.view_sector, text, float8, float8) IS
    'the model of each visible feature, the nearest first: format glb, vrml97, cityjson or cityjsonseq; the best level of detail not above the one given, or the coarsest whose error takes at most error_angle degrees';

CREATE OR REPLACE FUNCTION occlusion.visible_models(scene text, view occlusion.frustum, format text DEFAULT 'glb',
                                                    level_of_detail float8 DEFAULT NULL,
                                                    error_angle float8 DEFAULT NULL)
RETURNS TABLE (feature_id bigint, class text, distance float8, level_of_detail float8, content bytea)
LANGUAGE sql STABLE PARALLEL SAFE ROWS 100 COST 100000
SUPPORT occlusion.visible_features_support
SET search_path = pg_catalog, pg_temp AS $$
    SELECT m.*
    FROM (SELECT array_agg(v.feature_id), array_agg(v.class), array_agg(v.distance)
          FROM occlusion.visible_features($1, $2) AS v) AS a (ids, classes, distances),
         occlusion.nearest_models($1, a.ids, a.classes, a.distances, $3, $4, $5) AS m
$$;
COMMENT ON FUNCTION occlusion.visible_models(text, occlusion.frustum, text, float8, float8) IS
    'the model of each visible feature, the nearest first: format glb, vrml97, cityjson or cityjsonseq; the best level of detail not above the one given, or the coarsest whose error takes at most error_angle degrees';

CREATE OR REPLACE FUNCTION occlusion.visible_models(scene text, observer occlusion.point3d, range float8, format text DEFAULT 'glb',
                                                    level_of_detail float8 DEFAULT NULL,
                                                    error_angle float8 DEFAULT NULL)
RETURNS TABLE (feature_id bigint, class text, distance float8, level_of_detail float8, content bytea)
LANGUAGE sql STABLE PARALLEL SAFE ROWS 100 COST 100000
SUPPORT occlusion.visible_features_support
SET search_path = pg_catalog, pg_temp AS $$
    SELECT m.*
    FROM (SELECT array_agg(v.feature_id), array_agg(v.class), array_agg(v.distance)
          FROM occlusion.visible_features($1, $2, $3) AS v) AS a (ids, classes, distances),
         occlusion.nearest_models($1, a.ids, a.classes, a.distances, $4, $5, $6) AS m
$$;
COMMENT ON FUNCTION occlusion.visible_models(text, occlusion.point3d, float8, text, float8, float8) IS
    'the model of each visible feature, the nearest first: format glb, vrml97, cityjson or cityjsonseq; the best level of detail not above the one given, or the coarsest whose error takes at most error_angle degrees';

CREATE OR REPLACE FUNCTION occlusion.visible_glb(scene text, cone occlusion.view_cone, level_of_detail float8 DEFAULT NULL,
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

CREATE OR REPLACE FUNCTION occlusion.visible_glb(scene text, sector occlusion.view_sector, level_of_detail float8 DEFAULT NULL,
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

CREATE OR REPLACE FUNCTION occlusion.visible_glb(scene text, view occlusion.frustum, level_of_detail float8 DEFAULT NULL,
                                                 error_angle float8 DEFAULT NULL)
RETURNS bytea
LANGUAGE sql STABLE PARALLEL SAFE COST 100000
SET search_path = pg_catalog, pg_temp AS $$
    SELECT occlusion.merged_models(
        $1, coalesce(array_agg(v.feature_id ORDER BY v.feature_id), '{}'), 'glb', $3,
        occlusion.unnoticed_errors(array_agg(v.distance ORDER BY v.feature_id), $4))
    FROM occlusion.visible_features($1, $2) AS v
$$;
COMMENT ON FUNCTION occlusion.visible_glb(text, occlusion.frustum, float8, float8) IS
    'the models of all visible features as one GLB; level_of_detail and error_angle as those of visible_models';

CREATE OR REPLACE FUNCTION occlusion.visible_glb(scene text, observer occlusion.point3d, range float8, level_of_detail float8 DEFAULT NULL,
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
