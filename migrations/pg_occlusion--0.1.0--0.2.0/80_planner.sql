-- What the planner asks, for what 0.1.0 has.

ALTER OPERATOR occlusion.&& (occlusion.box3d, occlusion.box3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.@> (occlusion.box3d, occlusion.box3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.<@ (occlusion.box3d, occlusion.box3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.@> (occlusion.box3d, occlusion.point3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.<@ (occlusion.point3d, occlusion.box3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.&& (occlusion.box3d, occlusion.view_cone)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.&& (occlusion.view_cone, occlusion.box3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.&& (occlusion.box3d, occlusion.view_sector)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.&& (occlusion.view_sector, occlusion.box3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);

ALTER FUNCTION occlusion.equals(occlusion.box3d, occlusion.box3d) COST 2;
ALTER FUNCTION occlusion.overlaps(occlusion.box3d, occlusion.box3d) COST 2;
ALTER FUNCTION occlusion.contains(occlusion.box3d, occlusion.box3d) COST 2;
ALTER FUNCTION occlusion.contained_by(occlusion.box3d, occlusion.box3d) COST 2;
ALTER FUNCTION occlusion.contains(occlusion.box3d, occlusion.point3d) COST 2;
ALTER FUNCTION occlusion.contained_by(occlusion.point3d, occlusion.box3d) COST 2;
ALTER FUNCTION occlusion.distance(occlusion.box3d, occlusion.box3d) COST 2;
ALTER FUNCTION occlusion.distance(occlusion.box3d, occlusion.point3d) COST 2;
ALTER FUNCTION occlusion.distance(occlusion.point3d, occlusion.box3d) COST 2;
ALTER FUNCTION occlusion.meets(occlusion.box3d, occlusion.view_cone) COST 5;
ALTER FUNCTION occlusion.meets(occlusion.view_cone, occlusion.box3d) COST 5;
ALTER FUNCTION occlusion.meets(occlusion.box3d, occlusion.view_sector) COST 5;
ALTER FUNCTION occlusion.meets(occlusion.view_sector, occlusion.box3d) COST 5;

ALTER FUNCTION occlusion.visible_features(text, occlusion.view_cone) SUPPORT occlusion.visible_features_support;
ALTER FUNCTION occlusion.visible_features(text, occlusion.view_sector) SUPPORT occlusion.visible_features_support;
ALTER FUNCTION occlusion.visible_features(text, occlusion.point3d, float8) SUPPORT occlusion.visible_features_support;
ALTER FUNCTION occlusion.feature_models(text, bigint[], text, float8, float8[]) SUPPORT occlusion.feature_models_support;
