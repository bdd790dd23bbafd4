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
