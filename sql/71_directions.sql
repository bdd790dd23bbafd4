-- Where each feature is seen, what hides one, and the ground that is seen.

CREATE FUNCTION occlusion.visible_extent(scene text, observer occlusion.point3d, range float8)
RETURNS TABLE (feature_id bigint, class text, azimuth_from float8, azimuth_to float8, facade path)
LANGUAGE c STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
AS 'MODULE_PATHNAME', 'visible_extent_wrapper';
COMMENT ON FUNCTION occlusion.visible_extent(text, occlusion.point3d, float8) IS
    'in which directions each feature within range may be seen, degrees clockwise from +y, and what of its outline faces the observer there; holds every direction in which it is seen';

CREATE FUNCTION occlusion.hidden_by(scene text, feature_id bigint, observer occlusion.point3d)
RETURNS TABLE (occluder bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE c STABLE STRICT PARALLEL SAFE ROWS 2 COST 10000
AS 'MODULE_PATHNAME', 'hidden_by_wrapper';
COMMENT ON FUNCTION occlusion.hidden_by(text, bigint, occlusion.point3d) IS
    'features that, with nothing else, hide a feature from the observer, none of which can be left out; no rows where it may be seen';

CREATE FUNCTION occlusion.isovist(scene text, observer occlusion.point3d, range float8) RETURNS polygon
LANGUAGE c STABLE STRICT PARALLEL SAFE COST 10000
AS 'MODULE_PATHNAME', 'isovist_wrapper';
COMMENT ON FUNCTION occlusion.isovist(text, occlusion.point3d, float8) IS
    'polygon of all that can be seen in the horizontal plane through the observer''s eye, within range; holds all of it, and little more';
