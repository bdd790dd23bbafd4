-- More of points and boxes: parts and measures, boxes made of boxes, arrays, extents.

CREATE FUNCTION occlusion.center(box occlusion.box3d) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_center_wrapper';
COMMENT ON FUNCTION occlusion.center(occlusion.box3d) IS 'middle of a box';
CREATE FUNCTION occlusion.size(box occlusion.box3d) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_size_wrapper';
COMMENT ON FUNCTION occlusion.size(occlusion.box3d) IS 'edge lengths of a box along x, y and z, metres';
CREATE FUNCTION occlusion.corners(box occlusion.box3d) RETURNS occlusion.point3d[]
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_corners_wrapper';
COMMENT ON FUNCTION occlusion.corners(occlusion.box3d) IS 'the eight corners of a box; x turns fastest, then y';
CREATE FUNCTION occlusion.surface_area(box occlusion.box3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_surface_area_wrapper';
COMMENT ON FUNCTION occlusion.surface_area(occlusion.box3d) IS 'area of the six faces of a box, square metres';
CREATE FUNCTION occlusion.translate(box occlusion.box3d, dx float8, dy float8, dz float8) RETURNS occlusion.box3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_translate_wrapper';
COMMENT ON FUNCTION occlusion.translate(occlusion.box3d, float8, float8, float8) IS 'box moved, metres';
CREATE FUNCTION occlusion.translate(point occlusion.point3d, dx float8, dy float8, dz float8) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_translate_wrapper';
COMMENT ON FUNCTION occlusion.translate(occlusion.point3d, float8, float8, float8) IS 'point moved, metres';
CREATE FUNCTION occlusion.intersection(occlusion.box3d, occlusion.box3d) RETURNS occlusion.box3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_intersection_wrapper';
COMMENT ON FUNCTION occlusion.intersection(occlusion.box3d, occlusion.box3d) IS 'box that both share; NULL when they are apart';
CREATE FUNCTION occlusion.merge(occlusion.box3d, occlusion.box3d) RETURNS occlusion.box3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_merge_wrapper';
COMMENT ON FUNCTION occlusion.merge(occlusion.box3d, occlusion.box3d) IS 'smallest box that holds both';
CREATE FUNCTION occlusion.max_distance(occlusion.box3d, occlusion.box3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_max_distance_wrapper';
COMMENT ON FUNCTION occlusion.max_distance(occlusion.box3d, occlusion.box3d) IS 'greatest distance between a point of one box and one of the other, metres';
CREATE FUNCTION occlusion.max_distance(occlusion.box3d, occlusion.point3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_max_distance_point_wrapper';
COMMENT ON FUNCTION occlusion.max_distance(occlusion.box3d, occlusion.point3d) IS 'greatest distance between a point of the box and the point, metres';

CREATE FUNCTION occlusion.box3d(point occlusion.point3d) RETURNS occlusion.box3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_from_point_wrapper';
COMMENT ON FUNCTION occlusion.box3d(occlusion.point3d) IS 'box that is a single point';
CREATE FUNCTION occlusion.box3d(numbers float8[]) RETURNS occlusion.box3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_from_array_wrapper';
COMMENT ON FUNCTION occlusion.box3d(float8[]) IS 'box of six numbers: two opposite corners, in any order';
CREATE FUNCTION occlusion.point3d(numbers float8[]) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_from_array_wrapper';
COMMENT ON FUNCTION occlusion.point3d(float8[]) IS 'point of three numbers';
CREATE FUNCTION occlusion.numbers(box occlusion.box3d) RETURNS float8[]
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_to_array_wrapper';
COMMENT ON FUNCTION occlusion.numbers(occlusion.box3d) IS 'the six numbers of a box: least corner, greatest corner';
CREATE FUNCTION occlusion.numbers(point occlusion.point3d) RETURNS float8[]
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_to_array_wrapper';
COMMENT ON FUNCTION occlusion.numbers(occlusion.point3d) IS 'the three numbers of a point';
CREATE CAST (occlusion.point3d AS occlusion.box3d) WITH FUNCTION occlusion.box3d(occlusion.point3d) AS ASSIGNMENT;
COMMENT ON CAST (occlusion.point3d AS occlusion.box3d) IS 'a point as a box without extent';
CREATE CAST (occlusion.box3d AS float8[]) WITH FUNCTION occlusion.numbers(occlusion.box3d);
COMMENT ON CAST (occlusion.box3d AS float8[]) IS 'the six numbers';
CREATE CAST (occlusion.point3d AS float8[]) WITH FUNCTION occlusion.numbers(occlusion.point3d);
COMMENT ON CAST (occlusion.point3d AS float8[]) IS 'the three numbers';
CREATE CAST (float8[] AS occlusion.box3d) WITH FUNCTION occlusion.box3d(float8[]);
COMMENT ON CAST (float8[] AS occlusion.box3d) IS 'six numbers as a box';
CREATE CAST (float8[] AS occlusion.point3d) WITH FUNCTION occlusion.point3d(float8[]);
COMMENT ON CAST (float8[] AS occlusion.point3d) IS 'three numbers as a point';

CREATE FUNCTION occlusion.extend(occlusion.box3d, occlusion.point3d) RETURNS occlusion.box3d
    LANGUAGE c IMMUTABLE PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_extend_wrapper';
COMMENT ON FUNCTION occlusion.extend(occlusion.box3d, occlusion.point3d) IS 'step of extent(point3d)';
CREATE AGGREGATE occlusion.extent(occlusion.box3d) (
    SFUNC = occlusion.merge, STYPE = occlusion.box3d, COMBINEFUNC = occlusion.merge, PARALLEL = SAFE
);
COMMENT ON AGGREGATE occlusion.extent(occlusion.box3d) IS 'smallest box that holds all boxes; NULL when there are none';
CREATE AGGREGATE occlusion.extent(occlusion.point3d) (
    SFUNC = occlusion.extend, STYPE = occlusion.box3d, COMBINEFUNC = occlusion.merge, PARALLEL = SAFE
);
COMMENT ON AGGREGATE occlusion.extent(occlusion.point3d) IS 'smallest box that holds all points; NULL when there are none';

CREATE FUNCTION occlusion.heading(cone occlusion.view_cone) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_heading_wrapper';
COMMENT ON FUNCTION occlusion.heading(occlusion.view_cone) IS 'heading, degrees clockwise from +y';
CREATE FUNCTION occlusion.angle(cone occlusion.view_cone) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_angle_wrapper';
COMMENT ON FUNCTION occlusion.angle(occlusion.view_cone) IS 'full aperture, degrees';
CREATE FUNCTION occlusion.range(cone occlusion.view_cone) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_range_wrapper';
COMMENT ON FUNCTION occlusion.range(occlusion.view_cone) IS 'range, metres';
CREATE FUNCTION occlusion.pitch(cone occlusion.view_cone) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_pitch_wrapper';
COMMENT ON FUNCTION occlusion.pitch(occlusion.view_cone) IS 'pitch, degrees upward from the horizon';
CREATE FUNCTION occlusion.heading(sector occlusion.view_sector) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_heading_wrapper';
COMMENT ON FUNCTION occlusion.heading(occlusion.view_sector) IS 'heading, degrees clockwise from +y';
CREATE FUNCTION occlusion.angle(sector occlusion.view_sector) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_angle_wrapper';
COMMENT ON FUNCTION occlusion.angle(occlusion.view_sector) IS 'full aperture, degrees';
CREATE FUNCTION occlusion.range(sector occlusion.view_sector) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_range_wrapper';
COMMENT ON FUNCTION occlusion.range(occlusion.view_sector) IS 'range, metres';
