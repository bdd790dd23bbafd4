-- The frustum of a camera: type, constructors, accessors, operators, indexes, order.

CREATE TYPE occlusion.frustum;
CREATE FUNCTION occlusion.frustum_in(cstring) RETURNS occlusion.frustum
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_in_wrapper';
CREATE FUNCTION occlusion.frustum_out(occlusion.frustum) RETURNS cstring
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_out_wrapper';
CREATE FUNCTION occlusion.frustum_recv(internal) RETURNS occlusion.frustum
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_recv_wrapper';
CREATE FUNCTION occlusion.frustum_send(occlusion.frustum) RETURNS bytea
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_send_wrapper';
CREATE TYPE occlusion.frustum (
    INPUT = occlusion.frustum_in,
    OUTPUT = occlusion.frustum_out,
    RECEIVE = occlusion.frustum_recv,
    SEND = occlusion.frustum_send,
    INTERNALLENGTH = 120,
    ALIGNMENT = double,
    STORAGE = plain
);
COMMENT ON TYPE occlusion.frustum IS
    'what a camera sees, FRUSTUM(x y z, dx dy dz, ux uy uz, fov, aspect, near, far[, right up]): eye, direction, up vector, vertical field of view in degrees, width by height, distances of near and far plane in metres, shift of the image in halves of its width and height';

CREATE FUNCTION occlusion.frustum(observer occlusion.point3d, direction occlusion.point3d, up occlusion.point3d,
                                  fov float8, aspect float8, near float8, far float8) RETURNS occlusion.frustum
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_make_wrapper';
COMMENT ON FUNCTION occlusion.frustum(occlusion.point3d, occlusion.point3d, occlusion.point3d, float8, float8, float8, float8) IS
    'frustum of a camera: direction and up as vectors of any length, vertical field of view in degrees, width by height, distances of near and far plane in metres';
CREATE FUNCTION occlusion.frustum(observer occlusion.point3d, direction occlusion.point3d, up occlusion.point3d,
                                  fov float8, aspect float8, near float8, far float8,
                                  shift_right float8, shift_up float8) RETURNS occlusion.frustum
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_make_shifted_wrapper';
COMMENT ON FUNCTION occlusion.frustum(occlusion.point3d, occlusion.point3d, occlusion.point3d, float8, float8, float8, float8, float8, float8) IS
    'frustum of a camera whose image is off centre: shifted by halves of its width and height';
CREATE FUNCTION occlusion.frustum(observer occlusion.point3d, heading float8, pitch float8, roll float8,
                                  fov float8, aspect float8, near float8, far float8) RETURNS occlusion.frustum
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_make_turned_wrapper';
COMMENT ON FUNCTION occlusion.frustum(occlusion.point3d, float8, float8, float8, float8, float8, float8, float8) IS
    'frustum of a camera: heading clockwise from +y, pitch upward from the horizon, roll clockwise and vertical field of view in degrees, width by height, distances of near and far plane in metres';
CREATE FUNCTION occlusion.frustum(matrix float8[], depth_from_zero boolean DEFAULT false) RETURNS occlusion.frustum
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_from_matrix_wrapper';
COMMENT ON FUNCTION occlusion.frustum(float8[], boolean) IS
    'frustum of a view-projection matrix, by rows, for column vectors; clip space has z from -w to w, or with depth_from_zero from 0 to w; depths may be reversed';

CREATE FUNCTION occlusion.observer(view occlusion.frustum) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_observer_wrapper';
COMMENT ON FUNCTION occlusion.observer(occlusion.frustum) IS 'eye of a frustum: the centre of projection';
CREATE FUNCTION occlusion.direction(view occlusion.frustum) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_direction_wrapper';
COMMENT ON FUNCTION occlusion.direction(occlusion.frustum) IS 'direction of a frustum, a vector as it was given';
CREATE FUNCTION occlusion.up(view occlusion.frustum) RETURNS occlusion.point3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_up_wrapper';
COMMENT ON FUNCTION occlusion.up(occlusion.frustum) IS 'up vector of a frustum, as it was given';
CREATE FUNCTION occlusion.fov(view occlusion.frustum) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_fov_wrapper';
COMMENT ON FUNCTION occlusion.fov(occlusion.frustum) IS 'vertical field of view of a frustum, were its image centred, degrees';
CREATE FUNCTION occlusion.aspect(view occlusion.frustum) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_aspect_wrapper';
COMMENT ON FUNCTION occlusion.aspect(occlusion.frustum) IS 'width of the image of a frustum by its height';
CREATE FUNCTION occlusion.near(view occlusion.frustum) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_near_wrapper';
COMMENT ON FUNCTION occlusion.near(occlusion.frustum) IS 'distance of the near plane of a frustum, metres';
CREATE FUNCTION occlusion.far(view occlusion.frustum) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_far_wrapper';
COMMENT ON FUNCTION occlusion.far(occlusion.frustum) IS 'distance of the far plane of a frustum, metres';
CREATE FUNCTION occlusion.shift_right(view occlusion.frustum) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_shift_right_wrapper';
COMMENT ON FUNCTION occlusion.shift_right(occlusion.frustum) IS
    'how far the middle of the image of a frustum is right of its direction, in halves of its width';
CREATE FUNCTION occlusion.shift_up(view occlusion.frustum) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_shift_up_wrapper';
COMMENT ON FUNCTION occlusion.shift_up(occlusion.frustum) IS
    'how far the middle of the image of a frustum is above its direction, in halves of its height';
CREATE FUNCTION occlusion.corners(view occlusion.frustum) RETURNS occlusion.point3d[]
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_corners_wrapper';
COMMENT ON FUNCTION occlusion.corners(occlusion.frustum) IS
    'the eight corners of a frustum: four on the near plane, four on the far plane, each from the lower left anticlockwise, as the observer sees them';

CREATE FUNCTION occlusion.meets(occlusion.box3d, occlusion.frustum) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 5 AS 'MODULE_PATHNAME', 'box3d_meets_frustum_wrapper';
COMMENT ON FUNCTION occlusion.meets(occlusion.box3d, occlusion.frustum) IS 'implementation of &&';
CREATE FUNCTION occlusion.meets(occlusion.frustum, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 5 AS 'MODULE_PATHNAME', 'frustum_meets_box3d_wrapper';
COMMENT ON FUNCTION occlusion.meets(occlusion.frustum, occlusion.box3d) IS 'implementation of &&';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.frustum, FUNCTION = occlusion.meets,
    COMMUTATOR = OPERATOR(occlusion.&&),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.&& (occlusion.box3d, occlusion.frustum) IS 'meets the frustum, exactly';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.frustum, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.meets,
    COMMUTATOR = OPERATOR(occlusion.&&),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.&& (occlusion.frustum, occlusion.box3d) IS 'meets the box, exactly';

ALTER OPERATOR FAMILY occlusion.box3d_ops USING gist ADD
    OPERATOR 53 occlusion.&& (occlusion.box3d, occlusion.frustum);
ALTER OPERATOR FAMILY occlusion.box3d_spgist_ops USING spgist ADD
    OPERATOR 53 occlusion.&& (occlusion.box3d, occlusion.frustum);
ALTER OPERATOR FAMILY occlusion.box3d_brin_ops USING brin ADD
    OPERATOR 3 occlusion.&& (occlusion.box3d, occlusion.frustum);

-- Equality, order and hash, as those of the other types.

CREATE FUNCTION occlusion.equals(occlusion.frustum, occlusion.frustum) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_equals_wrapper';
COMMENT ON FUNCTION occlusion.equals(occlusion.frustum, occlusion.frustum) IS 'implementation of =';
CREATE FUNCTION occlusion.differs(occlusion.frustum, occlusion.frustum) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_differs_wrapper';
COMMENT ON FUNCTION occlusion.differs(occlusion.frustum, occlusion.frustum) IS 'implementation of <>';
CREATE FUNCTION occlusion.less(occlusion.frustum, occlusion.frustum) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_less_wrapper';
COMMENT ON FUNCTION occlusion.less(occlusion.frustum, occlusion.frustum) IS 'implementation of <';
CREATE FUNCTION occlusion.less_or_equal(occlusion.frustum, occlusion.frustum) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_less_or_equal_wrapper';
COMMENT ON FUNCTION occlusion.less_or_equal(occlusion.frustum, occlusion.frustum) IS 'implementation of <=';
CREATE FUNCTION occlusion.greater_or_equal(occlusion.frustum, occlusion.frustum) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_greater_or_equal_wrapper';
COMMENT ON FUNCTION occlusion.greater_or_equal(occlusion.frustum, occlusion.frustum) IS 'implementation of >=';
CREATE FUNCTION occlusion.greater(occlusion.frustum, occlusion.frustum) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_greater_wrapper';
COMMENT ON FUNCTION occlusion.greater(occlusion.frustum, occlusion.frustum) IS 'implementation of >';
CREATE FUNCTION occlusion.compare(occlusion.frustum, occlusion.frustum) RETURNS integer
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_compare_wrapper';
COMMENT ON FUNCTION occlusion.compare(occlusion.frustum, occlusion.frustum) IS '-1, 0 or 1: order of the numbers in turn';
CREATE FUNCTION occlusion.hash(occlusion.frustum) RETURNS integer
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_hash_wrapper';
COMMENT ON FUNCTION occlusion.hash(occlusion.frustum) IS 'hash, for hash indexes and joins';
CREATE FUNCTION occlusion.hash_extended(occlusion.frustum, bigint) RETURNS bigint
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'frustum_hash_extended_wrapper';
COMMENT ON FUNCTION occlusion.hash_extended(occlusion.frustum, bigint) IS 'hash with a seed, for hash partitions';
CREATE OPERATOR occlusion.= (
    LEFTARG = occlusion.frustum, RIGHTARG = occlusion.frustum, FUNCTION = occlusion.equals,
    COMMUTATOR = OPERATOR(occlusion.=), NEGATOR = OPERATOR(occlusion.<>),
    RESTRICT = eqsel, JOIN = eqjoinsel, HASHES, MERGES
);
COMMENT ON OPERATOR occlusion.= (occlusion.frustum, occlusion.frustum) IS 'the same numbers';
CREATE OPERATOR occlusion.<> (
    LEFTARG = occlusion.frustum, RIGHTARG = occlusion.frustum, FUNCTION = occlusion.differs,
    COMMUTATOR = OPERATOR(occlusion.<>), NEGATOR = OPERATOR(occlusion.=),
    RESTRICT = neqsel, JOIN = neqjoinsel
);
COMMENT ON OPERATOR occlusion.<> (occlusion.frustum, occlusion.frustum) IS 'not the same numbers';
CREATE OPERATOR occlusion.< (
    LEFTARG = occlusion.frustum, RIGHTARG = occlusion.frustum, FUNCTION = occlusion.less,
    COMMUTATOR = OPERATOR(occlusion.>), NEGATOR = OPERATOR(occlusion.>=),
    RESTRICT = scalarltsel, JOIN = scalarltjoinsel
);
COMMENT ON OPERATOR occlusion.< (occlusion.frustum, occlusion.frustum) IS 'earlier in the order of the numbers';
CREATE OPERATOR occlusion.<= (
    LEFTARG = occlusion.frustum, RIGHTARG = occlusion.frustum, FUNCTION = occlusion.less_or_equal,
    COMMUTATOR = OPERATOR(occlusion.>=), NEGATOR = OPERATOR(occlusion.>),
    RESTRICT = scalarlesel, JOIN = scalarlejoinsel
);
COMMENT ON OPERATOR occlusion.<= (occlusion.frustum, occlusion.frustum) IS 'earlier in the order of the numbers, or equal';
CREATE OPERATOR occlusion.>= (
    LEFTARG = occlusion.frustum, RIGHTARG = occlusion.frustum, FUNCTION = occlusion.greater_or_equal,
    COMMUTATOR = OPERATOR(occlusion.<=), NEGATOR = OPERATOR(occlusion.<),
    RESTRICT = scalargesel, JOIN = scalargejoinsel
);
COMMENT ON OPERATOR occlusion.>= (occlusion.frustum, occlusion.frustum) IS 'later in the order of the numbers, or equal';
CREATE OPERATOR occlusion.> (
    LEFTARG = occlusion.frustum, RIGHTARG = occlusion.frustum, FUNCTION = occlusion.greater,
    COMMUTATOR = OPERATOR(occlusion.<), NEGATOR = OPERATOR(occlusion.<=),
    RESTRICT = scalargtsel, JOIN = scalargtjoinsel
);
COMMENT ON OPERATOR occlusion.> (occlusion.frustum, occlusion.frustum) IS 'later in the order of the numbers';
CREATE OPERATOR CLASS occlusion.frustum_order_ops DEFAULT FOR TYPE occlusion.frustum USING btree AS
    OPERATOR 1 occlusion.<, OPERATOR 2 occlusion.<=, OPERATOR 3 occlusion.=, OPERATOR 4 occlusion.>=, OPERATOR 5 occlusion.>,
    FUNCTION 1 occlusion.compare(occlusion.frustum, occlusion.frustum);
COMMENT ON OPERATOR CLASS occlusion.frustum_order_ops USING btree IS 'order of the numbers in turn';
CREATE OPERATOR CLASS occlusion.frustum_hash_ops DEFAULT FOR TYPE occlusion.frustum USING hash AS
    OPERATOR 1 occlusion.=,
    FUNCTION 1 occlusion.hash(occlusion.frustum), FUNCTION 2 occlusion.hash_extended(occlusion.frustum, bigint);
COMMENT ON OPERATOR CLASS occlusion.frustum_hash_ops USING hash IS 'the same numbers';
