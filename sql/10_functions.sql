-- Constructors, accessors and measures.

CREATE FUNCTION occlusion.point3d(x float8, y float8, z float8) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_make_wrapper';
COMMENT ON FUNCTION occlusion.point3d(float8, float8, float8) IS 'point from its coordinates, metres';

CREATE FUNCTION occlusion.x(point occlusion.point3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_x_wrapper';
COMMENT ON FUNCTION occlusion.x(occlusion.point3d) IS 'x of a point, metres';
CREATE FUNCTION occlusion.y(point occlusion.point3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_y_wrapper';
COMMENT ON FUNCTION occlusion.y(occlusion.point3d) IS 'y of a point, metres';
CREATE FUNCTION occlusion.z(point occlusion.point3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_z_wrapper';
COMMENT ON FUNCTION occlusion.z(occlusion.point3d) IS 'z of a point, metres';

CREATE FUNCTION occlusion.box3d(corner occlusion.point3d, opposite occlusion.point3d) RETURNS occlusion.box3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_make_wrapper';
COMMENT ON FUNCTION occlusion.box3d(occlusion.point3d, occlusion.point3d) IS
    'box from two opposite corners, in any order';

CREATE FUNCTION occlusion.lower(box occlusion.box3d) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_lower_wrapper';
COMMENT ON FUNCTION occlusion.lower(occlusion.box3d) IS 'corner with the least coordinates';
CREATE FUNCTION occlusion.upper(box occlusion.box3d) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_upper_wrapper';
COMMENT ON FUNCTION occlusion.upper(occlusion.box3d) IS 'corner with the greatest coordinates';
CREATE FUNCTION occlusion.volume(box occlusion.box3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_volume_wrapper';
COMMENT ON FUNCTION occlusion.volume(occlusion.box3d) IS 'volume of a box, cubic metres';
CREATE FUNCTION occlusion.expand(box occlusion.box3d, margin float8) RETURNS occlusion.box3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_expand_wrapper';
COMMENT ON FUNCTION occlusion.expand(occlusion.box3d, float8) IS
    'box moved outward by a margin in metres on every side; NULL when a negative margin leaves nothing';

CREATE FUNCTION occlusion.view_cone(observer occlusion.point3d, heading float8, angle float8,
                                    range float8, pitch float8 DEFAULT 0) RETURNS occlusion.view_cone
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_make_wrapper';
COMMENT ON FUNCTION occlusion.view_cone(occlusion.point3d, float8, float8, float8, float8) IS
    'cone of view: heading (clockwise from +y), full aperture and pitch in degrees, range in metres';
CREATE FUNCTION occlusion.observer(cone occlusion.view_cone) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_observer_wrapper';
COMMENT ON FUNCTION occlusion.observer(occlusion.view_cone) IS 'eye of a cone of view';

CREATE FUNCTION occlusion.view_sector(observer occlusion.point3d, heading float8, angle float8,
                                      range float8) RETURNS occlusion.view_sector
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_make_wrapper';
COMMENT ON FUNCTION occlusion.view_sector(occlusion.point3d, float8, float8, float8) IS
    'horizontal sector of view of any pitch: heading (clockwise from +y) and full aperture in degrees, range in metres';
CREATE FUNCTION occlusion.observer(sector occlusion.view_sector) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_observer_wrapper';
COMMENT ON FUNCTION occlusion.observer(occlusion.view_sector) IS 'eye of a sector of view';
