-- What a moving observer may see.

CREATE FUNCTION occlusion.visible_ahead(scene text, observer occlusion.point3d, velocity occlusion.point3d,
                                        seconds float8, range float8 DEFAULT 500)
RETURNS TABLE (feature_id bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE c STABLE STRICT PARALLEL SAFE ROWS 300 COST 100000
AS 'MODULE_PATHNAME', 'visible_ahead_wrapper';
COMMENT ON FUNCTION occlusion.visible_ahead(text, occlusion.point3d, occlusion.point3d, float8, float8) IS
    'features that may be seen within range from somewhere on the way of an observer with that velocity, metres a second, in so many seconds; holds every visible one';
