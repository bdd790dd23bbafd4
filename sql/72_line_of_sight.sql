-- Whether one point can be seen from another.

CREATE FUNCTION occlusion.line_of_sight(scene text, a occlusion.point3d, b occlusion.point3d)
RETURNS TABLE (visible boolean, obstacle bigint, distance float8, point occlusion.point3d)
    LANGUAGE c STABLE STRICT PARALLEL SAFE ROWS 1 COST 10000 AS 'MODULE_PATHNAME', 'line_of_sight_wrapper';
COMMENT ON FUNCTION occlusion.line_of_sight(text, occlusion.point3d, occlusion.point3d) IS
    'whether b can be seen from a past the meshes of the scene, exactly; if not, the first feature in the way, its distance from a in metres, and where the line meets it';
