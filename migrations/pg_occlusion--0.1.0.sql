-- Types: points, boxes and fields of view. Fixed length, with text and binary input and output.

COMMENT ON SCHEMA occlusion IS 'pg_occlusion: which features of a 3D city can be seen from here';

CREATE TYPE occlusion.point3d;
CREATE FUNCTION occlusion.point3d_in(cstring) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_in_wrapper';
CREATE FUNCTION occlusion.point3d_out(occlusion.point3d) RETURNS cstring
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_out_wrapper';
CREATE FUNCTION occlusion.point3d_recv(internal) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_recv_wrapper';
CREATE FUNCTION occlusion.point3d_send(occlusion.point3d) RETURNS bytea
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_send_wrapper';
CREATE TYPE occlusion.point3d (
    INPUT = occlusion.point3d_in,
    OUTPUT = occlusion.point3d_out,
    RECEIVE = occlusion.point3d_recv,
    SEND = occlusion.point3d_send,
    INTERNALLENGTH = 24,
    ALIGNMENT = double,
    STORAGE = plain
);
COMMENT ON TYPE occlusion.point3d IS 'point in space, POINT(x y z), metres';

CREATE TYPE occlusion.box3d;
CREATE FUNCTION occlusion.box3d_in(cstring) RETURNS occlusion.box3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_in_wrapper';
CREATE FUNCTION occlusion.box3d_out(occlusion.box3d) RETURNS cstring
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_out_wrapper';
CREATE FUNCTION occlusion.box3d_recv(internal) RETURNS occlusion.box3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_recv_wrapper';
CREATE FUNCTION occlusion.box3d_send(occlusion.box3d) RETURNS bytea
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_send_wrapper';
CREATE TYPE occlusion.box3d (
    INPUT = occlusion.box3d_in,
    OUTPUT = occlusion.box3d_out,
    RECEIVE = occlusion.box3d_recv,
    SEND = occlusion.box3d_send,
    INTERNALLENGTH = 48,
    ALIGNMENT = double,
    STORAGE = plain
);
COMMENT ON TYPE occlusion.box3d IS
    'axis-aligned closed box, BOX3D(xmin ymin zmin, xmax ymax zmax), metres; corners are sorted on input';

CREATE TYPE occlusion.view_cone;
CREATE FUNCTION occlusion.view_cone_in(cstring) RETURNS occlusion.view_cone
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_in_wrapper';
CREATE FUNCTION occlusion.view_cone_out(occlusion.view_cone) RETURNS cstring
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_out_wrapper';
CREATE FUNCTION occlusion.view_cone_recv(internal) RETURNS occlusion.view_cone
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_recv_wrapper';
CREATE FUNCTION occlusion.view_cone_send(occlusion.view_cone) RETURNS bytea
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_send_wrapper';
CREATE TYPE occlusion.view_cone (
    INPUT = occlusion.view_cone_in,
    OUTPUT = occlusion.view_cone_out,
    RECEIVE = occlusion.view_cone_recv,
    SEND = occlusion.view_cone_send,
    INTERNALLENGTH = 56,
    ALIGNMENT = double,
    STORAGE = plain
);
COMMENT ON TYPE occlusion.view_cone IS
    'circular cone of view, VIEW_CONE(x y z, heading, angle, range, pitch): degrees, heading clockwise from +y, angle the full aperture; metres';

CREATE TYPE occlusion.view_sector;
CREATE FUNCTION occlusion.view_sector_in(cstring) RETURNS occlusion.view_sector
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_in_wrapper';
CREATE FUNCTION occlusion.view_sector_out(occlusion.view_sector) RETURNS cstring
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_out_wrapper';
CREATE FUNCTION occlusion.view_sector_recv(internal) RETURNS occlusion.view_sector
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_recv_wrapper';
CREATE FUNCTION occlusion.view_sector_send(occlusion.view_sector) RETURNS bytea
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_send_wrapper';
CREATE TYPE occlusion.view_sector (
    INPUT = occlusion.view_sector_in,
    OUTPUT = occlusion.view_sector_out,
    RECEIVE = occlusion.view_sector_recv,
    SEND = occlusion.view_sector_send,
    INTERNALLENGTH = 48,
    ALIGNMENT = double,
    STORAGE = plain
);
COMMENT ON TYPE occlusion.view_sector IS
    'horizontal sector of view of any pitch, VIEW_SECTOR(x y z, heading, angle, range): degrees, heading clockwise from +y, angle the full aperture; metres';
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
-- Operators. All intervals are closed: boxes that touch overlap.

CREATE FUNCTION occlusion.equals(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_equals_wrapper';
COMMENT ON FUNCTION occlusion.equals(occlusion.box3d, occlusion.box3d) IS 'implementation of = and ~=';
CREATE FUNCTION occlusion.overlaps(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_overlaps_wrapper';
COMMENT ON FUNCTION occlusion.overlaps(occlusion.box3d, occlusion.box3d) IS 'implementation of &&';
CREATE FUNCTION occlusion.contains(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_contains_wrapper';
COMMENT ON FUNCTION occlusion.contains(occlusion.box3d, occlusion.box3d) IS 'implementation of @>';
CREATE FUNCTION occlusion.contained_by(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_contained_by_wrapper';
COMMENT ON FUNCTION occlusion.contained_by(occlusion.box3d, occlusion.box3d) IS 'implementation of <@';
CREATE FUNCTION occlusion.contains(occlusion.box3d, occlusion.point3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_contains_point_wrapper';
COMMENT ON FUNCTION occlusion.contains(occlusion.box3d, occlusion.point3d) IS 'implementation of @>';
CREATE FUNCTION occlusion.contained_by(occlusion.point3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_contained_by_wrapper';
COMMENT ON FUNCTION occlusion.contained_by(occlusion.point3d, occlusion.box3d) IS 'implementation of <@';
CREATE FUNCTION occlusion.meets(occlusion.box3d, occlusion.view_cone) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_meets_cone_wrapper';
COMMENT ON FUNCTION occlusion.meets(occlusion.box3d, occlusion.view_cone) IS 'implementation of &&';
CREATE FUNCTION occlusion.meets(occlusion.view_cone, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'cone_meets_box3d_wrapper';
COMMENT ON FUNCTION occlusion.meets(occlusion.view_cone, occlusion.box3d) IS 'implementation of &&';
CREATE FUNCTION occlusion.meets(occlusion.box3d, occlusion.view_sector) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_meets_sector_wrapper';
COMMENT ON FUNCTION occlusion.meets(occlusion.box3d, occlusion.view_sector) IS 'implementation of &&';
CREATE FUNCTION occlusion.meets(occlusion.view_sector, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'sector_meets_box3d_wrapper';
COMMENT ON FUNCTION occlusion.meets(occlusion.view_sector, occlusion.box3d) IS 'implementation of &&';
CREATE FUNCTION occlusion.distance(occlusion.box3d, occlusion.box3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_distance_wrapper';
COMMENT ON FUNCTION occlusion.distance(occlusion.box3d, occlusion.box3d) IS 'implementation of <->';
CREATE FUNCTION occlusion.distance(occlusion.box3d, occlusion.point3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_distance_point_wrapper';
COMMENT ON FUNCTION occlusion.distance(occlusion.box3d, occlusion.point3d) IS 'implementation of <->';
CREATE FUNCTION occlusion.distance(occlusion.point3d, occlusion.box3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_distance_box_wrapper';
COMMENT ON FUNCTION occlusion.distance(occlusion.point3d, occlusion.box3d) IS 'implementation of <->';

CREATE OPERATOR occlusion.= (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.equals,
    COMMUTATOR = OPERATOR(occlusion.=), RESTRICT = eqsel, JOIN = eqjoinsel
);
COMMENT ON OPERATOR occlusion.= (occlusion.box3d, occlusion.box3d) IS 'same corners';
CREATE OPERATOR occlusion.~= (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.equals,
    COMMUTATOR = OPERATOR(occlusion.~=), RESTRICT = eqsel, JOIN = eqjoinsel
);
COMMENT ON OPERATOR occlusion.~= (occlusion.box3d, occlusion.box3d) IS 'same corners, by index';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.overlaps,
    COMMUTATOR = OPERATOR(occlusion.&&), RESTRICT = areasel, JOIN = areajoinsel
);
COMMENT ON OPERATOR occlusion.&& (occlusion.box3d, occlusion.box3d) IS 'share a point';
CREATE OPERATOR occlusion.@> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.contains,
    COMMUTATOR = OPERATOR(occlusion.<@), RESTRICT = contsel, JOIN = contjoinsel
);
COMMENT ON OPERATOR occlusion.@> (occlusion.box3d, occlusion.box3d) IS 'contains';
CREATE OPERATOR occlusion.<@ (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.contained_by,
    COMMUTATOR = OPERATOR(occlusion.@>), RESTRICT = contsel, JOIN = contjoinsel
);
COMMENT ON OPERATOR occlusion.<@ (occlusion.box3d, occlusion.box3d) IS 'is contained by';
CREATE OPERATOR occlusion.@> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.point3d, FUNCTION = occlusion.contains,
    COMMUTATOR = OPERATOR(occlusion.<@), RESTRICT = contsel, JOIN = contjoinsel
);
COMMENT ON OPERATOR occlusion.@> (occlusion.box3d, occlusion.point3d) IS 'contains';
CREATE OPERATOR occlusion.<@ (
    LEFTARG = occlusion.point3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.contained_by,
    COMMUTATOR = OPERATOR(occlusion.@>), RESTRICT = contsel, JOIN = contjoinsel
);
COMMENT ON OPERATOR occlusion.<@ (occlusion.point3d, occlusion.box3d) IS 'is contained by';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.view_cone, FUNCTION = occlusion.meets,
    COMMUTATOR = OPERATOR(occlusion.&&), RESTRICT = areasel, JOIN = areajoinsel
);
COMMENT ON OPERATOR occlusion.&& (occlusion.box3d, occlusion.view_cone) IS 'meets the cone of view, exactly';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.view_cone, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.meets,
    COMMUTATOR = OPERATOR(occlusion.&&), RESTRICT = areasel, JOIN = areajoinsel
);
COMMENT ON OPERATOR occlusion.&& (occlusion.view_cone, occlusion.box3d) IS 'meets the box, exactly';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.view_sector, FUNCTION = occlusion.meets,
    COMMUTATOR = OPERATOR(occlusion.&&), RESTRICT = areasel, JOIN = areajoinsel
);
COMMENT ON OPERATOR occlusion.&& (occlusion.box3d, occlusion.view_sector) IS 'meets the sector of view, exactly';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.view_sector, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.meets,
    COMMUTATOR = OPERATOR(occlusion.&&), RESTRICT = areasel, JOIN = areajoinsel
);
COMMENT ON OPERATOR occlusion.&& (occlusion.view_sector, occlusion.box3d) IS 'meets the box, exactly';
CREATE OPERATOR occlusion.<-> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.distance,
    COMMUTATOR = OPERATOR(occlusion.<->)
);
COMMENT ON OPERATOR occlusion.<-> (occlusion.box3d, occlusion.box3d) IS 'Euclidean distance, metres';
CREATE OPERATOR occlusion.<-> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.point3d, FUNCTION = occlusion.distance,
    COMMUTATOR = OPERATOR(occlusion.<->)
);
COMMENT ON OPERATOR occlusion.<-> (occlusion.box3d, occlusion.point3d) IS 'Euclidean distance, metres';
CREATE OPERATOR occlusion.<-> (
    LEFTARG = occlusion.point3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.distance,
    COMMUTATOR = OPERATOR(occlusion.<->)
);
COMMENT ON OPERATOR occlusion.<-> (occlusion.point3d, occlusion.box3d) IS 'Euclidean distance, metres';
-- GiST for box3d. Keys are the boxes themselves, so scans need no recheck and may be index-only.

CREATE FUNCTION occlusion.box3d_gist_consistent(internal, occlusion.box3d, smallint, oid, internal) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_consistent_wrapper';
CREATE FUNCTION occlusion.box3d_gist_union(internal, internal) RETURNS occlusion.box3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_union_wrapper';
CREATE FUNCTION occlusion.box3d_gist_penalty(internal, internal, internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_penalty_wrapper';
CREATE FUNCTION occlusion.box3d_gist_picksplit(internal, internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_picksplit_wrapper';
CREATE FUNCTION occlusion.box3d_gist_same(occlusion.box3d, occlusion.box3d, internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_same_wrapper';
CREATE FUNCTION occlusion.box3d_gist_distance(internal, occlusion.box3d, smallint, oid, internal) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_distance_wrapper';
CREATE FUNCTION occlusion.box3d_gist_fetch(internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_fetch_wrapper';

CREATE OPERATOR CLASS occlusion.box3d_ops DEFAULT FOR TYPE occlusion.box3d USING gist AS
    OPERATOR 3 occlusion.&& (occlusion.box3d, occlusion.box3d),
    OPERATOR 6 occlusion.~= (occlusion.box3d, occlusion.box3d),
    OPERATOR 7 occlusion.@> (occlusion.box3d, occlusion.box3d),
    OPERATOR 8 occlusion.<@ (occlusion.box3d, occlusion.box3d),
    OPERATOR 15 occlusion.<-> (occlusion.box3d, occlusion.box3d) FOR ORDER BY pg_catalog.float_ops,
    OPERATOR 18 occlusion.= (occlusion.box3d, occlusion.box3d),
    OPERATOR 27 occlusion.@> (occlusion.box3d, occlusion.point3d),
    OPERATOR 33 occlusion.&& (occlusion.box3d, occlusion.view_cone),
    OPERATOR 43 occlusion.&& (occlusion.box3d, occlusion.view_sector),
    OPERATOR 25 occlusion.<-> (occlusion.box3d, occlusion.point3d) FOR ORDER BY pg_catalog.float_ops,
    FUNCTION 1 occlusion.box3d_gist_consistent(internal, occlusion.box3d, smallint, oid, internal),
    FUNCTION 2 occlusion.box3d_gist_union(internal, internal),
    FUNCTION 5 occlusion.box3d_gist_penalty(internal, internal, internal),
    FUNCTION 6 occlusion.box3d_gist_picksplit(internal, internal),
    FUNCTION 7 occlusion.box3d_gist_same(occlusion.box3d, occlusion.box3d, internal),
    FUNCTION 8 (occlusion.box3d, occlusion.box3d) occlusion.box3d_gist_distance(internal, occlusion.box3d, smallint, oid, internal),
    FUNCTION 9 (occlusion.box3d, occlusion.box3d) occlusion.box3d_gist_fetch(internal);
COMMENT ON OPERATOR CLASS occlusion.box3d_ops USING gist IS
    'boxes in space: overlap, containment, fields of view, nearest first';
-- Scenes: a schema of ordinary tables for each city.

-- What every scene holds: the tables and the columns that functions read, with their types.
CREATE FUNCTION occlusion.scene_columns()
RETURNS TABLE (table_name name, column_name name, type_name text)
LANGUAGE sql IMMUTABLE PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    VALUES
        ('scene_info', 'format_version', 'integer'),
        ('scene_info', 'srid', 'integer'),
        ('scene_info', 'attribution', 'text'),
        ('feature', 'id', 'bigint'),
        ('feature', 'class', 'text'),
        ('feature', 'envelope', 'occlusion.box3d'),
        ('feature', 'name', 'text'),
        ('feature', 'slot', 'integer'),
        ('feature', 'outline', 'polygon'),
        ('feature', 'attributes', 'jsonb'),
        ('mesh', 'feature', 'bigint'),
        ('mesh', 'level_of_detail', 'double precision'),
        ('mesh', 'vertices', 'double precision[]'),
        ('mesh', 'triangles', 'integer[]'),
        ('mesh', 'defect', 'text'),
        ('mesh', 'repair', 'text'),
        ('mesh', 'repair_triangles', 'integer'),
        ('shape', 'digest', 'bytea'),
        ('shape', 'content', 'bytea'),
        ('model', 'feature', 'bigint'),
        ('model', 'level_of_detail', 'double precision'),
        ('model', 'format', 'text'),
        ('model', 'content', 'bytea'),
        ('model', 'shape', 'bytea'),
        ('model', 'placement', 'double precision[]'),
        ('model', 'geometric_error', 'double precision'),
        ('inner_envelope', 'feature', 'bigint'),
        ('inner_envelope', 'box', 'occlusion.box3d'),
        ('inner_envelope', 'grounded', 'boolean'),
        ('solid_column', 'feature', 'bigint'),
        ('solid_column', 'footprint', 'polygon[]'),
        ('solid_column', 'bottom', 'double precision'),
        ('solid_column', 'top', 'double precision'),
        ('solid_column', 'grounded', 'boolean'),
        ('solid_column', 'envelope', 'occlusion.box3d'),
        ('street', 'area', 'polygon[]'),
        ('street', 'eye_low', 'double precision'),
        ('street', 'eye_high', 'double precision'),
        ('street', 'envelope', 'occlusion.box3d'),
        ('occlusion_volume', 'occluder', 'bigint'),
        ('occlusion_volume', 'occludee', 'bigint'),
        ('occlusion_volume', 'box', 'occlusion.box3d'),
        ('import_remark', 'remark', 'text'),
        ('job', 'task', 'text')
$$;
COMMENT ON FUNCTION occlusion.scene_columns() IS 'the tables of a scene and the columns that functions read';

-- Raises an error unless the schema is a scene made of real tables. Functions call it before they
-- read a scene, so that no view, foreign table or type of somebody else's making runs in its place.
CREATE FUNCTION occlusion.require_scene(scene text) RETURNS void
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    namespace oid;
    wrong record;
BEGIN
    IF octet_length(scene) > 63 THEN
        RAISE EXCEPTION 'scene name "%" is too long', scene
            USING ERRCODE = 'name_too_long',
                  DETAIL = format('The name has %s bytes; at most 63 are allowed.', octet_length(scene));
    END IF;
    SELECT n.oid INTO namespace FROM pg_catalog.pg_namespace AS n WHERE n.nspname = scene;
    IF namespace IS NULL THEN
        RAISE EXCEPTION 'scene "%" does not exist', scene
            USING ERRCODE = 'invalid_schema_name',
                  HINT = format('Make it with SELECT occlusion.create_scene(%L).', scene);
    END IF;
    IF NOT EXISTS (SELECT FROM pg_catalog.pg_class AS c
                   WHERE c.relnamespace = namespace AND c.relname = 'scene_info') THEN
        RAISE EXCEPTION 'schema "%" is not a scene', scene
            USING ERRCODE = 'wrong_object_type',
                  DETAIL = 'It has no table scene_info.',
                  HINT = 'A scene is made by occlusion.create_scene.';
    END IF;
    SELECT e.table_name, e.column_name, e.type_name, c.relkind,
           format_type(a.atttypid, a.atttypmod) AS found
      INTO wrong
      FROM occlusion.scene_columns() AS e
      LEFT JOIN pg_catalog.pg_class AS c ON c.relnamespace = namespace AND c.relname = e.table_name
      LEFT JOIN pg_catalog.pg_attribute AS a
             ON a.attrelid = c.oid AND a.attname = e.column_name AND NOT a.attisdropped
     WHERE c.relkind IS NULL OR c.relkind NOT IN ('r', 'p')
        OR format_type(a.atttypid, a.atttypmod) IS DISTINCT FROM e.type_name
     LIMIT 1;
    IF FOUND THEN
        RAISE EXCEPTION 'scene "%" is damaged', scene
            USING ERRCODE = 'wrong_object_type',
                  DETAIL = CASE
                      WHEN wrong.relkind IS NULL THEN
                          format('Table "%s" is missing.', wrong.table_name)
                      WHEN wrong.relkind NOT IN ('r', 'p') THEN
                          format('"%s" is not a table.', wrong.table_name)
                      ELSE format('Column "%s" of table "%s" must be of type %s, not %s.',
                                  wrong.column_name, wrong.table_name, wrong.type_name,
                                  coalesce(wrong.found, 'missing'))
                  END,
                  HINT = 'Only real tables of a scene are read, never views in their place.';
    END IF;
END
$$;
COMMENT ON FUNCTION occlusion.require_scene(text) IS 'raises an error unless a schema is a scene of real tables';

CREATE FUNCTION occlusion.create_scene(scene text, srid integer DEFAULT 0) RETURNS void
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    s text := quote_ident(scene);
BEGIN
    IF octet_length(scene) > 63 THEN
        RAISE EXCEPTION 'scene name "%" is too long', scene
            USING ERRCODE = 'name_too_long',
                  DETAIL = format('The name has %s bytes; at most 63 are allowed.', octet_length(scene));
    END IF;
    IF EXISTS (SELECT FROM pg_catalog.pg_namespace AS n WHERE n.nspname = scene) THEN
        RAISE EXCEPTION 'schema "%" already exists', scene
            USING ERRCODE = 'duplicate_schema',
                  HINT = format('If it is a scene, SELECT occlusion.drop_scene(%L) removes it.', scene);
    END IF;
    EXECUTE format('CREATE SCHEMA %s', s);
    EXECUTE format('COMMENT ON SCHEMA %s IS %L', s, 'a scene of pg_occlusion');

    EXECUTE format($ddl$
        CREATE TABLE %1$s.scene_info (
            singleton boolean PRIMARY KEY DEFAULT true CHECK (singleton),
            format_version integer NOT NULL,
            srid integer NOT NULL,
            ground float8,
            attribution text
        );
        COMMENT ON TABLE %1$s.scene_info IS 'one row; marks this schema as a scene';
        COMMENT ON COLUMN %1$s.scene_info.singleton IS 'keeps it one row';
        COMMENT ON COLUMN %1$s.scene_info.format_version IS 'version of the layout of these tables';
        COMMENT ON COLUMN %1$s.scene_info.srid IS 'EPSG code of the projected frame, 0 if unknown';
        COMMENT ON COLUMN %1$s.scene_info.ground IS 'height of level ground in metres; NULL: from the feet of near features';
        COMMENT ON COLUMN %1$s.scene_info.attribution IS 'whom to credit for the data';
        INSERT INTO %1$s.scene_info (format_version, srid) VALUES (1, %2$s);

        CREATE TABLE %1$s.feature (
            id bigint GENERATED BY DEFAULT AS IDENTITY PRIMARY KEY,
            name text UNIQUE,
            class text NOT NULL DEFAULT 'Generic',
            envelope occlusion.box3d NOT NULL,
            slot integer,
            outline polygon,
            attributes jsonb
        );
        CREATE INDEX feature_envelope ON %1$s.feature USING gist (envelope);
        COMMENT ON TABLE %1$s.feature IS 'one indivisible city object a row';
        COMMENT ON COLUMN %1$s.feature.id IS 'number of the feature';
        COMMENT ON COLUMN %1$s.feature.name IS 'identifier in the source';
        COMMENT ON COLUMN %1$s.feature.class IS 'kind of object, as the source names it';
        COMMENT ON COLUMN %1$s.feature.envelope IS 'outer envelope: smallest box that holds all of the feature, every level of detail';
        COMMENT ON COLUMN %1$s.feature.slot IS 'position along a space-filling order; internal';
        COMMENT ON COLUMN %1$s.feature.outline IS 'outer prism: convex hull of the footprint, over the heights of the envelope';
        COMMENT ON COLUMN %1$s.feature.attributes IS 'attributes of the source';

        CREATE TABLE %1$s.shape (
            digest bytea PRIMARY KEY,
            content bytea NOT NULL
        );
        COMMENT ON TABLE %1$s.shape IS 'shapes that several models are instances of, each once';
        COMMENT ON COLUMN %1$s.shape.digest IS 'digest of the content';
        COMMENT ON COLUMN %1$s.shape.content IS 'the shape in its own frame, packed';

        CREATE TABLE %1$s.model (
            feature bigint NOT NULL REFERENCES %1$s.feature ON DELETE CASCADE,
            level_of_detail float8 NOT NULL,
            format text NOT NULL,
            content bytea,
            shape bytea REFERENCES %1$s.shape,
            placement float8[] CHECK (cardinality(placement) = 12),
            geometric_error float8,
            PRIMARY KEY (feature, level_of_detail, format),
            CHECK ((content IS NULL) <> (shape IS NULL)),
            CHECK ((shape IS NULL) = (placement IS NULL))
        );
        COMMENT ON TABLE %1$s.model IS 'models of features, by level of detail';
        COMMENT ON COLUMN %1$s.model.feature IS 'feature that it shows';
        COMMENT ON COLUMN %1$s.model.level_of_detail IS 'level of detail; the greatest is the best';
        COMMENT ON COLUMN %1$s.model.format IS 'packed as imports write it, or a file format: glb, vrml97, cityjson, obj, ply';
        COMMENT ON COLUMN %1$s.model.content IS 'the model itself; NULL for an instance of a shape';
        COMMENT ON COLUMN %1$s.model.shape IS 'digest of the shape that this model is an instance of';
        COMMENT ON COLUMN %1$s.model.placement IS 'where the instance goes: three rows of a, b, c, d with x'' = a x + b y + c z + d';
        COMMENT ON COLUMN %1$s.model.geometric_error IS 'greatest distance to the best level of detail in metres, if known';

        CREATE TABLE %1$s.mesh (
            feature bigint PRIMARY KEY REFERENCES %1$s.feature ON DELETE CASCADE,
            level_of_detail float8,
            vertices float8[] NOT NULL,
            triangles integer[] NOT NULL,
            defect text,
            repair text,
            repair_triangles integer NOT NULL DEFAULT 0 CHECK (repair_triangles >= 0)
        );
        COMMENT ON TABLE %1$s.mesh IS 'truth: the triangles of the best level of detail of each feature';
        COMMENT ON COLUMN %1$s.mesh.feature IS 'feature whose surface it is';
        COMMENT ON COLUMN %1$s.mesh.level_of_detail IS 'level of detail that was triangulated';
        COMMENT ON COLUMN %1$s.mesh.vertices IS 'x, y, z of vertex 0, of vertex 1, and so on, metres';
        COMMENT ON COLUMN %1$s.mesh.triangles IS 'three vertices a triangle, counted from 0, anticlockwise seen from outside';
        COMMENT ON COLUMN %1$s.mesh.defect IS 'why the mesh encloses no solid and so hides nothing; NULL if it does';
        COMMENT ON COLUMN %1$s.mesh.repair IS 'what was added to the delivered surface to close it; NULL if nothing was';
        COMMENT ON COLUMN %1$s.mesh.repair_triangles IS 'how many of the last triangles were added';

        CREATE TABLE %1$s.inner_envelope (
            feature bigint PRIMARY KEY REFERENCES %1$s.feature ON DELETE CASCADE,
            box occlusion.box3d NOT NULL,
            grounded boolean NOT NULL DEFAULT false
        );
        CREATE INDEX inner_envelope_box ON %1$s.inner_envelope USING gist (box);
        COMMENT ON TABLE %1$s.inner_envelope IS 'what hides: the largest box found wholly inside each solid feature';
        COMMENT ON COLUMN %1$s.inner_envelope.feature IS 'feature that it is part of';
        COMMENT ON COLUMN %1$s.inner_envelope.box IS 'box inside the solid, metres';
        COMMENT ON COLUMN %1$s.inner_envelope.grounded IS 'whether the ground under the box is solid down to any depth';

        CREATE TABLE %1$s.solid_column (
            feature bigint NOT NULL REFERENCES %1$s.feature ON DELETE CASCADE,
            footprint polygon[] NOT NULL CHECK (cardinality(footprint) > 0),
            bottom float8 NOT NULL,
            top float8 NOT NULL CHECK (bottom < top),
            grounded boolean NOT NULL DEFAULT false,
            envelope occlusion.box3d NOT NULL GENERATED ALWAYS AS (occlusion.box3d(
                occlusion.point3d(((box(footprint[1]))[1])[0], ((box(footprint[1]))[1])[1], bottom),
                occlusion.point3d(((box(footprint[1]))[0])[0], ((box(footprint[1]))[0])[1], top)
            )) STORED
        );
        CREATE INDEX solid_column_feature ON %1$s.solid_column (feature);
        CREATE INDEX solid_column_envelope ON %1$s.solid_column USING gist (envelope);
        COMMENT ON TABLE %1$s.solid_column IS 'what hides: prisms wholly inside each solid feature';
        COMMENT ON COLUMN %1$s.solid_column.feature IS 'feature that it is part of';
        COMMENT ON COLUMN %1$s.solid_column.footprint IS 'outer ring anticlockwise, then holes, metres';
        COMMENT ON COLUMN %1$s.solid_column.bottom IS 'lowest height, metres';
        COMMENT ON COLUMN %1$s.solid_column.top IS 'greatest height, metres';
        COMMENT ON COLUMN %1$s.solid_column.grounded IS 'whether the ground under the column is solid down to any depth';
        COMMENT ON COLUMN %1$s.solid_column.envelope IS 'box around it; derived';

        CREATE TABLE %1$s.street (
            id bigint GENERATED BY DEFAULT AS IDENTITY PRIMARY KEY,
            name text,
            area polygon[] NOT NULL CHECK (cardinality(area) > 0),
            eye_low float8 NOT NULL,
            eye_high float8 NOT NULL CHECK (eye_low <= eye_high),
            envelope occlusion.box3d NOT NULL GENERATED ALWAYS AS (occlusion.box3d(
                occlusion.point3d(((box(area[1]))[1])[0], ((box(area[1]))[1])[1], eye_low),
                occlusion.point3d(((box(area[1]))[0])[0], ((box(area[1]))[0])[1], eye_high)
            )) STORED
        );
        CREATE INDEX street_envelope ON %1$s.street USING gist (envelope);
        COMMENT ON TABLE %1$s.street IS 'view region: where observers can be';
        COMMENT ON COLUMN %1$s.street.id IS 'number of the street';
        COMMENT ON COLUMN %1$s.street.name IS 'identifier in the source';
        COMMENT ON COLUMN %1$s.street.area IS 'outer ring, then holes';
        COMMENT ON COLUMN %1$s.street.eye_low IS 'lowest eye, absolute height in metres';
        COMMENT ON COLUMN %1$s.street.eye_high IS 'highest eye, absolute height in metres';
        COMMENT ON COLUMN %1$s.street.envelope IS 'box around all its eyes; derived';

        CREATE TABLE %1$s.occlusion_volume (
            occluder bigint NOT NULL REFERENCES %1$s.feature ON DELETE CASCADE,
            occludee bigint NOT NULL REFERENCES %1$s.feature ON DELETE CASCADE,
            box occlusion.box3d NOT NULL,
            CHECK (occluder <> occludee)
        );
        CREATE INDEX occlusion_volume_box ON %1$s.occlusion_volume USING gist (box);
        CREATE INDEX occlusion_volume_occluder ON %1$s.occlusion_volume (occluder);
        CREATE INDEX occlusion_volume_occludee ON %1$s.occlusion_volume (occludee);
        COMMENT ON TABLE %1$s.occlusion_volume IS 'from everywhere in the box, occluder alone hides all of occludee';
        COMMENT ON COLUMN %1$s.occlusion_volume.occluder IS 'feature that hides';
        COMMENT ON COLUMN %1$s.occlusion_volume.occludee IS 'feature that is hidden';
        COMMENT ON COLUMN %1$s.occlusion_volume.box IS 'eyes from which it is hidden, metres';

        CREATE TABLE %1$s.import_remark (
            source text NOT NULL,
            name text NOT NULL,
            class text NOT NULL,
            skipped boolean NOT NULL,
            remark text NOT NULL
        );
        COMMENT ON TABLE %1$s.import_remark IS 'objects of imported files that were left out or changed';
        COMMENT ON COLUMN %1$s.import_remark.source IS 'file or table that it came from';
        COMMENT ON COLUMN %1$s.import_remark.name IS 'identifier in the source';
        COMMENT ON COLUMN %1$s.import_remark.class IS 'kind of object, as the source names it';
        COMMENT ON COLUMN %1$s.import_remark.skipped IS 'whether it is not in the scene';
        COMMENT ON COLUMN %1$s.import_remark.remark IS 'why it was left out, or what is different';

        CREATE TABLE %1$s.job (
            task text PRIMARY KEY,
            backend integer NOT NULL,
            started timestamptz NOT NULL,
            updated timestamptz NOT NULL,
            done bigint NOT NULL,
            total bigint NOT NULL,
            made bigint NOT NULL,
            finished boolean NOT NULL
        );
        COMMENT ON TABLE %1$s.job IS 'long work on this scene and how far it is';
        COMMENT ON COLUMN %1$s.job.task IS 'procedure';
        COMMENT ON COLUMN %1$s.job.backend IS 'process that runs or ran it';
        COMMENT ON COLUMN %1$s.job.started IS 'when it began';
        COMMENT ON COLUMN %1$s.job.updated IS 'when it last committed a batch';
        COMMENT ON COLUMN %1$s.job.done IS 'features finished';
        COMMENT ON COLUMN %1$s.job.total IS 'features in all';
        COMMENT ON COLUMN %1$s.job.made IS 'rows written';
        COMMENT ON COLUMN %1$s.job.finished IS 'whether it came to its end';

        CREATE TRIGGER forget_volumes AFTER UPDATE OR DELETE ON %1$s.feature
            FOR EACH ROW EXECUTE FUNCTION occlusion.forget_feature_volumes();
        CREATE TRIGGER forget_all_volumes AFTER TRUNCATE ON %1$s.feature
            FOR EACH STATEMENT EXECUTE FUNCTION occlusion.forget_all_volumes();
        CREATE TRIGGER forget_volumes AFTER UPDATE OR DELETE ON %1$s.inner_envelope
            FOR EACH ROW EXECUTE FUNCTION occlusion.forget_occluder_volumes();
        CREATE TRIGGER forget_all_volumes AFTER TRUNCATE ON %1$s.inner_envelope
            FOR EACH STATEMENT EXECUTE FUNCTION occlusion.forget_all_volumes();
        CREATE TRIGGER forget_volumes AFTER UPDATE OR DELETE ON %1$s.solid_column
            FOR EACH ROW EXECUTE FUNCTION occlusion.forget_occluder_volumes();
        CREATE TRIGGER forget_all_volumes AFTER TRUNCATE ON %1$s.solid_column
            FOR EACH STATEMENT EXECUTE FUNCTION occlusion.forget_all_volumes();
        ALTER TABLE %1$s.feature ENABLE ALWAYS TRIGGER forget_volumes;
        ALTER TABLE %1$s.feature ENABLE ALWAYS TRIGGER forget_all_volumes;
        ALTER TABLE %1$s.inner_envelope ENABLE ALWAYS TRIGGER forget_volumes;
        ALTER TABLE %1$s.inner_envelope ENABLE ALWAYS TRIGGER forget_all_volumes;
        ALTER TABLE %1$s.solid_column ENABLE ALWAYS TRIGGER forget_volumes;
        ALTER TABLE %1$s.solid_column ENABLE ALWAYS TRIGGER forget_all_volumes;
    $ddl$, s, srid);
END
$$;
COMMENT ON FUNCTION occlusion.create_scene(text, integer) IS
    'makes a scene: a schema of that name with the tables of one city';

-- Raises an error where an edit could not drop all its volumes, because row security or an old
-- snapshot keeps some out of sight: they would go on hiding what was edited.
CREATE FUNCTION occlusion.require_all_volumes(scene name) RETURNS void
LANGUAGE plpgsql VOLATILE STRICT SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    IF row_security_active(format('%I.occlusion_volume', scene)) THEN
        RAISE EXCEPTION 'row security hides occlusion volumes of scene "%"', scene
            USING ERRCODE = 'insufficient_privilege',
                  DETAIL = 'An edit must drop every volume that it invalidates.',
                  HINT = 'Edit as the owner of the scene, or as a role with BYPASSRLS.';
    END IF;
    -- An old snapshot does not show volumes computed since, but locking this row, which every batch
    -- of them updates, fails then (40001).
    IF current_setting('transaction_isolation') <> 'read committed' THEN
        EXECUTE format('SELECT FROM %I.scene_info FOR SHARE', scene);
    END IF;
END
$$;
COMMENT ON FUNCTION occlusion.require_all_volumes(name) IS
    'raises an error where row security or an old snapshot would keep an edit from dropping volumes';

-- Volumes cast by or on a feature whose envelope changed say nothing any more. Foreign keys drop
-- those of deleted features as well, but not where rows arrive by replication.
CREATE FUNCTION occlusion.forget_feature_volumes() RETURNS trigger
LANGUAGE plpgsql SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    IF TG_OP = 'UPDATE' THEN
        IF OLD.envelope OPERATOR(occlusion.=) NEW.envelope THEN
            RETURN NULL;
        END IF;
    END IF;
    PERFORM occlusion.require_all_volumes(TG_TABLE_SCHEMA);
    EXECUTE format('DELETE FROM %I.occlusion_volume WHERE occluder = $1 OR occludee = $1', TG_TABLE_SCHEMA)
        USING OLD.id;
    RETURN NULL;
END
$$;
COMMENT ON FUNCTION occlusion.forget_feature_volumes() IS 'trigger: drops the volumes of a feature that moved';

CREATE FUNCTION occlusion.forget_occluder_volumes() RETURNS trigger
LANGUAGE plpgsql SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_all_volumes(TG_TABLE_SCHEMA);
    EXECUTE format('DELETE FROM %I.occlusion_volume WHERE occluder = $1', TG_TABLE_SCHEMA)
        USING OLD.feature;
    RETURN NULL;
END
$$;
COMMENT ON FUNCTION occlusion.forget_occluder_volumes() IS 'trigger: drops the volumes cast by a solid that changed';

CREATE FUNCTION occlusion.forget_all_volumes() RETURNS trigger
LANGUAGE plpgsql SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_all_volumes(TG_TABLE_SCHEMA);
    EXECUTE format('DELETE FROM %I.occlusion_volume', TG_TABLE_SCHEMA);
    RETURN NULL;
END
$$;
COMMENT ON FUNCTION occlusion.forget_all_volumes() IS 'trigger: drops all volumes of a scene';

CREATE FUNCTION occlusion.drop_scene(scene text, force boolean DEFAULT false) RETURNS void
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    tables text;
    reason text;
BEGIN
    IF NOT force THEN
        PERFORM occlusion.require_scene(scene);
        SELECT string_agg(DISTINCT format('%I.%I', scene, table_name), ', ') INTO tables
          FROM occlusion.scene_columns();
        -- RESTRICT stops at every object of another's making, in the schema or outside it.
        BEGIN
            EXECUTE format('DROP TABLE %s RESTRICT', tables);
            EXECUTE format('DROP SCHEMA %I RESTRICT', scene);
        EXCEPTION WHEN dependent_objects_still_exist THEN
            GET STACKED DIAGNOSTICS reason = PG_EXCEPTION_DETAIL;
            RAISE EXCEPTION 'scene "%" holds objects that are not part of it', scene
                USING ERRCODE = 'dependent_objects_still_exist',
                      DETAIL = reason,
                      HINT = 'Move them, or drop everything with force => true.';
        END;
        RETURN;
    END IF;
    IF NOT EXISTS (SELECT FROM pg_catalog.pg_class AS c
                   JOIN pg_catalog.pg_namespace AS n ON n.oid = c.relnamespace
                   WHERE n.nspname = scene AND c.relname = 'scene_info' AND c.relkind IN ('r', 'p')) THEN
        PERFORM occlusion.require_scene(scene);
    END IF;
    EXECUTE format('DROP SCHEMA %I CASCADE', scene);
END
$$;
COMMENT ON FUNCTION occlusion.drop_scene(text, boolean) IS
    'drops a scene; refuses a schema that is none, and one with foreign objects unless forced';
-- Making scenes without files, and their view region.

CREATE FUNCTION occlusion.make_city(layout text, features integer, seed bigint,
                                    first_part integer DEFAULT 0, parts integer DEFAULT 2147483647)
RETURNS TABLE (number integer, kind text, class text, envelope occlusion.box3d, inner_envelope occlusion.box3d,
               vertices float8[], triangles integer[], footprint text[], top float8)
LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'make_city_wrapper';
COMMENT ON FUNCTION occlusion.make_city(text, integer, bigint, integer, integer) IS
    'the features of some parts of a generated city, each a small piece of it: their boxes, closed meshes and solid columns';

CREATE FUNCTION occlusion.make_city_streets(layout text, features integer, seed bigint)
RETURNS TABLE (area text[], eye_low float8, eye_high float8)
LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'make_city_streets_wrapper';
COMMENT ON FUNCTION occlusion.make_city_streets(text, integer, bigint) IS
    'the streets of a generated city, rings as text';

CREATE FUNCTION occlusion.generate_city(scene text, layout text DEFAULT 'scattered',
                                        features integer DEFAULT 326, seed integer DEFAULT 1)
RETURNS bigint
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    -- Some 2,000 features in memory at once.
    batch CONSTANT integer := 64;
    -- Smaller cities are done before anybody wonders.
    told_from CONSTANT integer := 100000;
    occupied boolean;
    batches integer := 0;
    added bigint;
    made bigint := 0;
BEGIN
    IF NOT EXISTS (SELECT FROM pg_catalog.pg_namespace AS n WHERE n.nspname = scene) THEN
        PERFORM occlusion.create_scene(scene);
    END IF;
    PERFORM occlusion.require_scene(scene);
    EXECUTE format('SELECT EXISTS (SELECT FROM %1$I.feature) OR EXISTS (SELECT FROM %1$I.street)', scene)
        INTO occupied;
    IF occupied THEN
        RAISE EXCEPTION 'scene "%" is not empty', scene
            USING ERRCODE = 'object_not_in_prerequisite_state',
                  HINT = 'Generate into a new scene.';
    END IF;
    EXECUTE format($q$
        INSERT INTO %1$I.street (name, area, eye_low, eye_high)
        SELECT 'street', s.area::polygon[], s.eye_low, s.eye_high
        FROM occlusion.make_city_streets($1, $2, $3) AS s
    $q$, scene) USING layout, features, seed::bigint;
    WHILE made < features LOOP
        -- The features of a city of blocks or streets come along a space-filling curve.
        EXECUTE format($q$
            WITH city AS MATERIALIZED (
                SELECT $6 + m.number AS id, m.*
                FROM occlusion.make_city($1, $2, $3, $4, $5) AS m
            ),
            feature AS (
                INSERT INTO %1$I.feature (id, name, class, envelope, slot)
                SELECT c.id, c.kind || ' ' || c.id, c.class, c.envelope,
                       CASE WHEN $1 <> 'scattered' THEN c.id - 1 END
                FROM city AS c
                RETURNING id
            ),
            mesh AS (
                INSERT INTO %1$I.mesh (feature, level_of_detail, vertices, triangles)
                SELECT c.id, 1, c.vertices, c.triangles FROM city AS c
            ),
            inner_envelope AS (
                INSERT INTO %1$I.inner_envelope (feature, box, grounded)
                SELECT c.id, c.inner_envelope, true FROM city AS c
            ),
            solid_column AS (
                INSERT INTO %1$I.solid_column (feature, footprint, bottom, top, grounded)
                SELECT c.id, c.footprint::polygon[], 0, c.top, true FROM city AS c
            )
            SELECT count(*) FROM feature
        $q$, scene)
            INTO added
            USING layout, (features - made)::integer, seed::bigint, batch * batches, batch, made;
        batches := batches + 1;
        IF features >= told_from AND (made + added) * 10 / features > made * 10 / features THEN
            RAISE NOTICE 'generate_city: % of % features', made + added, features;
        END IF;
        made := made + added;
    END LOOP;
    EXECUTE format('SELECT pg_catalog.setval(pg_catalog.pg_get_serial_sequence(%L, %L), greatest($1, 1))',
                   format('%I.feature', scene), 'id') USING made;
    RETURN made;
END
$$;
COMMENT ON FUNCTION occlusion.generate_city(text, text, integer, integer) IS
    'fills a new scene with a generated city: scattered (that of the 2004 report), blocks or streets; returns the number of features';

CREATE FUNCTION occlusion.generate_view_region(scene text, eye_low float8 DEFAULT 1.5,
                                               eye_high float8 DEFAULT 2.0, tile float8 DEFAULT 50)
RETURNS bigint
LANGUAGE c VOLATILE STRICT SET search_path = pg_catalog, pg_temp
AS 'MODULE_PATHNAME', 'generate_view_region_wrapper';
COMMENT ON FUNCTION occlusion.generate_view_region(text, float8, float8, float8) IS
    'replaces the streets of a scene by the open space between its features: inside their hull, outside every footprint; eye heights in metres above the feet of near features; returns the number of streets';
-- Features from rows.

CREATE FUNCTION occlusion.settle_ground(scene text, features bigint[],
                                        OUT aloft bigint, OUT opened bigint)
RETURNS SETOF record
LANGUAGE c VOLATILE STRICT SET search_path = pg_catalog, pg_temp ROWS 1
AS 'MODULE_PATHNAME', 'settle_ground_wrapper';
COMMENT ON FUNCTION occlusion.settle_ground(text, bigint[]) IS
    'of some features, makes the solids of those that do not stand on the ground ungrounded, and removes them where a bottom was added; returns how many there are of each';

CREATE FUNCTION occlusion.import_rows(scene text, source text, query text) RETURNS bigint
LANGUAGE c VOLATILE STRICT SET search_path = pg_catalog, pg_temp
AS 'MODULE_PATHNAME', 'import_rows_wrapper';
COMMENT ON FUNCTION occlusion.import_rows(text, text, text) IS
    'imports the rows of a query as features; its columns: name text, class text, attributes jsonb, footprint text[] (rings of a polygon), bottom and top float8, surfaces bytea (well-known binary); rows that cannot be used become remarks; returns the number of features';

-- Columns of a relation by name, with their types.
CREATE FUNCTION occlusion.column_type(source regclass, name text) RETURNS text
LANGUAGE sql STABLE PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT format_type(a.atttypid, NULL) FROM pg_attribute AS a
    WHERE a.attrelid = source AND a.attname = name AND a.attnum > 0 AND NOT a.attisdropped
$$;
COMMENT ON FUNCTION occlusion.column_type(regclass, text) IS 'type of a column, null if there is none';

-- SQL for a column of a row "t" as some type, null where there is no such column.
CREATE FUNCTION occlusion.column_value(source regclass, name text, type_name text) RETURNS text
LANGUAGE sql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT CASE WHEN occlusion.column_type(source, name) IS NULL THEN format('NULL::%s', type_name)
                ELSE format('t.%I::%s', name, type_name) END
$$;
COMMENT ON FUNCTION occlusion.column_value(regclass, text, text) IS
    'SQL for a column of a relation as some type; null where there is no such column';

-- SQL for the columns of a row "t" but some, as jsonb. Those of PostGIS's types are left out: not
-- all of their values have a form in JSON.
CREATE FUNCTION occlusion.other_columns(source regclass, used text[]) RETURNS text
LANGUAGE sql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT format('(SELECT to_jsonb(r) FROM (SELECT %s) AS r)',
                  string_agg(format('t.%I', a.attname), ', ' ORDER BY a.attnum))
    FROM pg_attribute AS a
    JOIN pg_type AS y ON y.oid = a.atttypid
    WHERE a.attrelid = source AND a.attnum > 0 AND NOT a.attisdropped AND a.attname <> ALL (used)
      AND y.typname NOT IN ('geometry', 'geography', 'raster')
$$;
COMMENT ON FUNCTION occlusion.other_columns(regclass, text[]) IS
    'SQL for the columns of a relation that are not used otherwise, as jsonb';

CREATE FUNCTION occlusion.import_features(scene text, source regclass,
                                          footprint text DEFAULT 'footprint',
                                          bottom text DEFAULT 'bottom', top text DEFAULT 'top',
                                          height text DEFAULT 'height',
                                          name text DEFAULT 'name', class text DEFAULT 'class')
RETURNS bigint
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    kind text := occlusion.column_type(source, footprint);
    rings text;
    low text := format('coalesce(%s, 0)', occlusion.column_value(source, bottom, 'float8'));
    high text;
BEGIN
    PERFORM occlusion.require_scene(scene);
    rings := CASE kind
        WHEN 'polygon' THEN format('CASE WHEN t.%1$I IS NOT NULL THEN ARRAY[t.%1$I]::text[] END', footprint)
        WHEN 'polygon[]' THEN format('t.%I::text[]', footprint)
    END;
    IF rings IS NULL THEN
        RAISE EXCEPTION 'column "%" of % is no footprint', footprint, source
            USING ERRCODE = 'datatype_mismatch',
                  DETAIL = CASE WHEN kind IS NULL THEN 'There is no such column.'
                                ELSE format('Its type is %s, not polygon or polygon[].', kind) END,
                  HINT = 'Geometries of PostGIS are imported by import_geometries of the extension pg_occlusion_postgis.';
    END IF;
    high := CASE
        WHEN occlusion.column_type(source, top) IS NOT NULL THEN format('t.%I::float8', top)
        WHEN occlusion.column_type(source, height) IS NOT NULL THEN format('%s + t.%I::float8', low, height)
    END;
    IF high IS NULL THEN
        RAISE EXCEPTION 'neither column "%" nor column "%" is in %', top, height, source
            USING ERRCODE = 'undefined_column',
                  DETAIL = 'A footprint needs its highest point, or its height above its lowest.';
    END IF;
    RETURN occlusion.import_rows(scene, source::text, format(
        'SELECT %s, %s, %s, %s, %s, %s, NULL::bytea FROM %s AS t',
        occlusion.column_value(source, name, 'text'), occlusion.column_value(source, class, 'text'),
        occlusion.other_columns(source, ARRAY[footprint, bottom, top, height, name, class]),
        rings, low, high, source));
END
$$;
COMMENT ON FUNCTION occlusion.import_features(text, regclass, text, text, text, text, text, text) IS
    'imports the rows of a table as features: a footprint (polygon, or polygon[] with holes) from its bottom, or 0, up to its top, or by its height, metres; the other columns become attributes; returns the number of features';

CREATE FUNCTION occlusion.import_report(scene text)
RETURNS TABLE (outcome text, reason text, objects bigint, names text[])
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE format($q$
        WITH known AS (
            SELECT CASE
                       WHEN m.feature IS NULL THEN 'no mesh'
                       WHEN m.defect IS NOT NULL THEN 'hides nothing'
                       WHEN m.repair IS NOT NULL THEN 'repaired'
                       ELSE 'solid'
                   END AS outcome,
                   CASE
                       WHEN m.defect IS NOT NULL THEN split_part(m.defect, ':', 1)
                       WHEN m.repair IS NOT NULL THEN split_part(m.repair, ',', 1)
                   END AS reason,
                   coalesce(f.name, f.id::text) AS name
            FROM %1$I.feature AS f LEFT JOIN %1$I.mesh AS m ON m.feature = f.id
            UNION ALL
            SELECT CASE WHEN r.skipped THEN 'skipped' ELSE 'changed' END,
                   r.class || ': ' || r.remark, r.name
            FROM %1$I.import_remark AS r
        )
        SELECT k.outcome, k.reason, count(*),
               CASE WHEN k.outcome <> 'solid' THEN array_agg(k.name ORDER BY k.name) END
        FROM known AS k
        GROUP BY k.outcome, k.reason
        ORDER BY k.outcome = 'solid' DESC, k.outcome, count(*) DESC, k.reason
    $q$, scene);
END
$$;
COMMENT ON FUNCTION occlusion.import_report(text) IS
    'what became of imported objects: how many features are solid, and which hide nothing, were repaired, skipped or changed, and why';
-- Occlusion volumes.

CREATE PROCEDURE occlusion.generate_occlusion_volumes(scene text, smallest float8 DEFAULT 1,
                                                      range float8 DEFAULT NULL,
                                                      worth float8 DEFAULT NULL)
LANGUAGE c AS 'MODULE_PATHNAME', 'generate_occlusion_volumes_wrapper';
COMMENT ON PROCEDURE occlusion.generate_occlusion_volumes(text, float8, float8, float8) IS
    'computes from where single features hide others, along all streets; replaces what is there, commits batch by batch. smallest: least width of a lane in metres; range: farthest look in metres, NULL for any; worth: square metres of street that each volume must add, NULL for the larger of 4 times smallest squared and a 20,000th of the street area';

CREATE FUNCTION occlusion.progress(scene text)
RETURNS TABLE (task text, done bigint, total bigint, made bigint, per_second float8,
               time_left interval, state text)
LANGUAGE plpgsql STABLE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE format($q$
        SELECT j.task, j.done, j.total, j.made, r.rate,
               CASE WHEN NOT j.finished AND r.rate > 0
                    THEN make_interval(secs => (j.total - j.done) / r.rate) END,
               CASE WHEN j.finished THEN 'finished'
                    WHEN EXISTS (SELECT FROM pg_catalog.pg_stat_activity AS a WHERE a.pid = j.backend)
                    THEN 'running' ELSE 'interrupted' END
        FROM %I.job AS j
        CROSS JOIN LATERAL (
            SELECT j.done / nullif(extract(epoch FROM j.updated - j.started), 0)::float8 AS rate
        ) AS r
        ORDER BY j.started
    $q$, scene);
END
$$;
COMMENT ON FUNCTION occlusion.progress(text) IS 'how far the long work on a scene is';
-- Visibility queries.

-- Whether a point lies in a footprint, within a margin of it included: that of a hole, too.
CREATE FUNCTION occlusion.covers(footprint polygon[], x float8, y float8, margin float8) RETURNS boolean
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
    SELECT footprint[1] OPERATOR(pg_catalog.<->) pg_catalog.point(x, y) <= margin
       AND NOT EXISTS (
           SELECT FROM pg_catalog.unnest(footprint[2:]) AS hole
           WHERE hole OPERATOR(pg_catalog.@>) pg_catalog.point(x, y)
             AND pg_catalog.path(hole) OPERATOR(pg_catalog.<->) pg_catalog.point(x, y) > margin);
END;
COMMENT ON FUNCTION occlusion.covers(polygon[], float8, float8, float8) IS
    'whether a point lies in a footprint (outer ring, then holes) or within a margin of it, metres';

-- The statement behind visible_features. Parameters: $1 the eye; $2 the field of view, or the
-- range when all round. Margins: an eye within a millimetre of a solid counts as inside it, and the
-- box that preselects all round is a millimetre larger, so that its rounding loses nothing in range.
CREATE FUNCTION occlusion.visible_features_statement(scene text, all_round boolean) RETURNS text
LANGUAGE sql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT format($q$
        WITH eye AS MATERIALIZED (
            SELECT EXISTS (
                SELECT FROM %1$I.street AS s
                WHERE s.envelope OPERATOR(occlusion.@>) $1
                  AND s.area[1] @> point(occlusion.x($1), occlusion.y($1))
                  AND NOT EXISTS (
                      SELECT FROM unnest(s.area[2:]) AS hole
                      WHERE hole @> point(occlusion.x($1), occlusion.y($1)))
            ) AND NOT EXISTS (
                SELECT FROM %1$I.inner_envelope AS i
                WHERE i.box OPERATOR(occlusion.&&)
                          occlusion.expand(occlusion.box3d($1, $1), 0.001)
            ) AND NOT EXISTS (
                SELECT FROM %1$I.solid_column AS c
                WHERE c.envelope OPERATOR(occlusion.&&)
                          occlusion.expand(occlusion.box3d($1, $1), 0.001)
                  AND occlusion.covers(c.footprint, occlusion.x($1), occlusion.y($1), 0.001)
            ) AS in_view_region
        )
        SELECT f.id, f.class, f.envelope, f.envelope OPERATOR(occlusion.<->) $1
        FROM %1$I.feature AS f
        WHERE %2$s
          AND f.id NOT IN (
              SELECT v.occludee
              FROM %1$I.occlusion_volume AS v
              WHERE v.box OPERATOR(occlusion.@>) $1
                AND (SELECT eye.in_view_region FROM eye))
    $q$, scene, CASE WHEN all_round
        THEN 'f.envelope OPERATOR(occlusion.&&) occlusion.expand(occlusion.box3d($1, $1), $2 + 0.001)'
             ' AND f.envelope OPERATOR(occlusion.<->) $1 <= $2 * (1 + 1e-12)'
        ELSE 'f.envelope OPERATOR(occlusion.&&) $2' END)
$$;
COMMENT ON FUNCTION occlusion.visible_features_statement(text, boolean) IS
    'the statement that visible_features runs';

CREATE FUNCTION occlusion.visible_features(scene text, cone occlusion.view_cone)
RETURNS TABLE (feature_id bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE occlusion.visible_features_statement(scene, false)
        USING occlusion.observer(cone), cone;
END
$$;
COMMENT ON FUNCTION occlusion.visible_features(text, occlusion.view_cone) IS
    'features that meet the cone of view and are not hidden from its eye; holds every visible one';

CREATE FUNCTION occlusion.visible_features(scene text, sector occlusion.view_sector)
RETURNS TABLE (feature_id bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE occlusion.visible_features_statement(scene, false)
        USING occlusion.observer(sector), sector;
END
$$;
COMMENT ON FUNCTION occlusion.visible_features(text, occlusion.view_sector) IS
    'features that meet the sector of view and are not hidden from its eye; holds every visible one';

CREATE FUNCTION occlusion.visible_features(scene text, observer occlusion.point3d, range float8)
RETURNS TABLE (feature_id bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    PERFORM occlusion.require_range(range);
    RETURN QUERY EXECUTE occlusion.visible_features_statement(scene, true) USING observer, range;
END
$$;
COMMENT ON FUNCTION occlusion.visible_features(text, occlusion.point3d, float8) IS
    'features within range of the observer, all round, that are not hidden from there; holds every visible one';

CREATE FUNCTION occlusion.require_range(range float8) RETURNS void
LANGUAGE plpgsql IMMUTABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    IF NOT (range >= 0 AND range < 'infinity') THEN
        RAISE EXCEPTION 'range % is out of bounds', range
            USING ERRCODE = 'invalid_parameter_value',
                  DETAIL = 'A range is a finite number of metres, 0 or more.';
    END IF;
END
$$;
COMMENT ON FUNCTION occlusion.require_range(float8) IS 'raises an error unless a range is finite and not negative';

CREATE FUNCTION occlusion.explain_visible_features(scene text, cone occlusion.view_cone) RETURNS SETOF text
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE 'EXPLAIN (ANALYZE, BUFFERS, COSTS OFF, SUMMARY OFF, TIMING OFF) '
        || occlusion.visible_features_statement(scene, false) USING occlusion.observer(cone), cone;
END
$$;
COMMENT ON FUNCTION occlusion.explain_visible_features(text, occlusion.view_cone) IS
    'how visible_features answers: its plan, run, with the buffers that it read';

CREATE FUNCTION occlusion.explain_visible_features(scene text, sector occlusion.view_sector) RETURNS SETOF text
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE 'EXPLAIN (ANALYZE, BUFFERS, COSTS OFF, SUMMARY OFF, TIMING OFF) '
        || occlusion.visible_features_statement(scene, false) USING occlusion.observer(sector), sector;
END
$$;
COMMENT ON FUNCTION occlusion.explain_visible_features(text, occlusion.view_sector) IS
    'how visible_features answers: its plan, run, with the buffers that it read';

CREATE FUNCTION occlusion.explain_visible_features(scene text, observer occlusion.point3d, range float8)
RETURNS SETOF text
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    PERFORM occlusion.require_range(range);
    RETURN QUERY EXECUTE 'EXPLAIN (ANALYZE, BUFFERS, COSTS OFF, SUMMARY OFF, TIMING OFF) '
        || occlusion.visible_features_statement(scene, true) USING observer, range;
END
$$;
COMMENT ON FUNCTION occlusion.explain_visible_features(text, occlusion.point3d, float8) IS
    'how visible_features answers: its plan, run, with the buffers that it read';
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
