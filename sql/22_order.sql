-- Equality, order and hash of the types that are nothing but numbers, for GROUP BY, DISTINCT, ORDER BY,
-- keys and joins. The order is that of the numbers in turn: it has no meaning in space. That of = for boxes
-- is among the operators.

CREATE FUNCTION occlusion.differs(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_differs_wrapper';
COMMENT ON FUNCTION occlusion.differs(occlusion.box3d, occlusion.box3d) IS 'implementation of <>';
CREATE FUNCTION occlusion.less(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_less_wrapper';
COMMENT ON FUNCTION occlusion.less(occlusion.box3d, occlusion.box3d) IS 'implementation of <';
CREATE FUNCTION occlusion.less_or_equal(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_less_or_equal_wrapper';
COMMENT ON FUNCTION occlusion.less_or_equal(occlusion.box3d, occlusion.box3d) IS 'implementation of <=';
CREATE FUNCTION occlusion.greater_or_equal(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_greater_or_equal_wrapper';
COMMENT ON FUNCTION occlusion.greater_or_equal(occlusion.box3d, occlusion.box3d) IS 'implementation of >=';
CREATE FUNCTION occlusion.greater(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_greater_wrapper';
COMMENT ON FUNCTION occlusion.greater(occlusion.box3d, occlusion.box3d) IS 'implementation of >';
CREATE FUNCTION occlusion.compare(occlusion.box3d, occlusion.box3d) RETURNS integer
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_compare_wrapper';
COMMENT ON FUNCTION occlusion.compare(occlusion.box3d, occlusion.box3d) IS '-1, 0 or 1: order of the numbers in turn';
CREATE FUNCTION occlusion.hash(occlusion.box3d) RETURNS integer
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_hash_wrapper';
COMMENT ON FUNCTION occlusion.hash(occlusion.box3d) IS 'hash, for hash indexes and joins';
CREATE FUNCTION occlusion.hash_extended(occlusion.box3d, bigint) RETURNS bigint
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_hash_extended_wrapper';
COMMENT ON FUNCTION occlusion.hash_extended(occlusion.box3d, bigint) IS 'hash with a seed, for hash partitions';
CREATE OPERATOR occlusion.<> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.differs,
    COMMUTATOR = OPERATOR(occlusion.<>), NEGATOR = OPERATOR(occlusion.=),
    RESTRICT = neqsel, JOIN = neqjoinsel
);
COMMENT ON OPERATOR occlusion.<> (occlusion.box3d, occlusion.box3d) IS 'not the same numbers';
CREATE OPERATOR occlusion.< (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.less,
    COMMUTATOR = OPERATOR(occlusion.>), NEGATOR = OPERATOR(occlusion.>=),
    RESTRICT = scalarltsel, JOIN = scalarltjoinsel
);
COMMENT ON OPERATOR occlusion.< (occlusion.box3d, occlusion.box3d) IS 'earlier in the order of the numbers';
CREATE OPERATOR occlusion.<= (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.less_or_equal,
    COMMUTATOR = OPERATOR(occlusion.>=), NEGATOR = OPERATOR(occlusion.>),
    RESTRICT = scalarlesel, JOIN = scalarlejoinsel
);
COMMENT ON OPERATOR occlusion.<= (occlusion.box3d, occlusion.box3d) IS 'earlier in the order of the numbers, or equal';
CREATE OPERATOR occlusion.>= (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.greater_or_equal,
    COMMUTATOR = OPERATOR(occlusion.<=), NEGATOR = OPERATOR(occlusion.<),
    RESTRICT = scalargesel, JOIN = scalargejoinsel
);
COMMENT ON OPERATOR occlusion.>= (occlusion.box3d, occlusion.box3d) IS 'later in the order of the numbers, or equal';
CREATE OPERATOR occlusion.> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.greater,
    COMMUTATOR = OPERATOR(occlusion.<), NEGATOR = OPERATOR(occlusion.<=),
    RESTRICT = scalargtsel, JOIN = scalargtjoinsel
);
COMMENT ON OPERATOR occlusion.> (occlusion.box3d, occlusion.box3d) IS 'later in the order of the numbers';
CREATE OPERATOR CLASS occlusion.box3d_order_ops DEFAULT FOR TYPE occlusion.box3d USING btree AS
    OPERATOR 1 occlusion.<, OPERATOR 2 occlusion.<=, OPERATOR 3 occlusion.=, OPERATOR 4 occlusion.>=, OPERATOR 5 occlusion.>,
    FUNCTION 1 occlusion.compare(occlusion.box3d, occlusion.box3d);
COMMENT ON OPERATOR CLASS occlusion.box3d_order_ops USING btree IS 'order of the numbers in turn';
CREATE OPERATOR CLASS occlusion.box3d_hash_ops DEFAULT FOR TYPE occlusion.box3d USING hash AS
    OPERATOR 1 occlusion.=,
    FUNCTION 1 occlusion.hash(occlusion.box3d), FUNCTION 2 occlusion.hash_extended(occlusion.box3d, bigint);
COMMENT ON OPERATOR CLASS occlusion.box3d_hash_ops USING hash IS 'the same numbers';

CREATE FUNCTION occlusion.equals(occlusion.point3d, occlusion.point3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_equals_wrapper';
COMMENT ON FUNCTION occlusion.equals(occlusion.point3d, occlusion.point3d) IS 'implementation of =';
CREATE FUNCTION occlusion.differs(occlusion.point3d, occlusion.point3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_differs_wrapper';
COMMENT ON FUNCTION occlusion.differs(occlusion.point3d, occlusion.point3d) IS 'implementation of <>';
CREATE FUNCTION occlusion.less(occlusion.point3d, occlusion.point3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_less_wrapper';
COMMENT ON FUNCTION occlusion.less(occlusion.point3d, occlusion.point3d) IS 'implementation of <';
CREATE FUNCTION occlusion.less_or_equal(occlusion.point3d, occlusion.point3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_less_or_equal_wrapper';
COMMENT ON FUNCTION occlusion.less_or_equal(occlusion.point3d, occlusion.point3d) IS 'implementation of <=';
CREATE FUNCTION occlusion.greater_or_equal(occlusion.point3d, occlusion.point3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_greater_or_equal_wrapper';
COMMENT ON FUNCTION occlusion.greater_or_equal(occlusion.point3d, occlusion.point3d) IS 'implementation of >=';
CREATE FUNCTION occlusion.greater(occlusion.point3d, occlusion.point3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_greater_wrapper';
COMMENT ON FUNCTION occlusion.greater(occlusion.point3d, occlusion.point3d) IS 'implementation of >';
CREATE FUNCTION occlusion.compare(occlusion.point3d, occlusion.point3d) RETURNS integer
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_compare_wrapper';
COMMENT ON FUNCTION occlusion.compare(occlusion.point3d, occlusion.point3d) IS '-1, 0 or 1: order of the numbers in turn';
CREATE FUNCTION occlusion.hash(occlusion.point3d) RETURNS integer
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_hash_wrapper';
COMMENT ON FUNCTION occlusion.hash(occlusion.point3d) IS 'hash, for hash indexes and joins';
CREATE FUNCTION occlusion.hash_extended(occlusion.point3d, bigint) RETURNS bigint
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_hash_extended_wrapper';
COMMENT ON FUNCTION occlusion.hash_extended(occlusion.point3d, bigint) IS 'hash with a seed, for hash partitions';
CREATE OPERATOR occlusion.= (
    LEFTARG = occlusion.point3d, RIGHTARG = occlusion.point3d, FUNCTION = occlusion.equals,
    COMMUTATOR = OPERATOR(occlusion.=), NEGATOR = OPERATOR(occlusion.<>),
    RESTRICT = eqsel, JOIN = eqjoinsel, HASHES, MERGES
);
COMMENT ON OPERATOR occlusion.= (occlusion.point3d, occlusion.point3d) IS 'the same numbers';
CREATE OPERATOR occlusion.<> (
    LEFTARG = occlusion.point3d, RIGHTARG = occlusion.point3d, FUNCTION = occlusion.differs,
    COMMUTATOR = OPERATOR(occlusion.<>), NEGATOR = OPERATOR(occlusion.=),
    RESTRICT = neqsel, JOIN = neqjoinsel
);
COMMENT ON OPERATOR occlusion.<> (occlusion.point3d, occlusion.point3d) IS 'not the same numbers';
CREATE OPERATOR occlusion.< (
    LEFTARG = occlusion.point3d, RIGHTARG = occlusion.point3d, FUNCTION = occlusion.less,
    COMMUTATOR = OPERATOR(occlusion.>), NEGATOR = OPERATOR(occlusion.>=),
    RESTRICT = scalarltsel, JOIN = scalarltjoinsel
);
COMMENT ON OPERATOR occlusion.< (occlusion.point3d, occlusion.point3d) IS 'earlier in the order of the numbers';
CREATE OPERATOR occlusion.<= (
    LEFTARG = occlusion.point3d, RIGHTARG = occlusion.point3d, FUNCTION = occlusion.less_or_equal,
    COMMUTATOR = OPERATOR(occlusion.>=), NEGATOR = OPERATOR(occlusion.>),
    RESTRICT = scalarlesel, JOIN = scalarlejoinsel
);
COMMENT ON OPERATOR occlusion.<= (occlusion.point3d, occlusion.point3d) IS 'earlier in the order of the numbers, or equal';
CREATE OPERATOR occlusion.>= (
    LEFTARG = occlusion.point3d, RIGHTARG = occlusion.point3d, FUNCTION = occlusion.greater_or_equal,
    COMMUTATOR = OPERATOR(occlusion.<=), NEGATOR = OPERATOR(occlusion.<),
    RESTRICT = scalargesel, JOIN = scalargejoinsel
);
COMMENT ON OPERATOR occlusion.>= (occlusion.point3d, occlusion.point3d) IS 'later in the order of the numbers, or equal';
CREATE OPERATOR occlusion.> (
    LEFTARG = occlusion.point3d, RIGHTARG = occlusion.point3d, FUNCTION = occlusion.greater,
    COMMUTATOR = OPERATOR(occlusion.<), NEGATOR = OPERATOR(occlusion.<=),
    RESTRICT = scalargtsel, JOIN = scalargtjoinsel
);
COMMENT ON OPERATOR occlusion.> (occlusion.point3d, occlusion.point3d) IS 'later in the order of the numbers';
CREATE OPERATOR CLASS occlusion.point3d_order_ops DEFAULT FOR TYPE occlusion.point3d USING btree AS
    OPERATOR 1 occlusion.<, OPERATOR 2 occlusion.<=, OPERATOR 3 occlusion.=, OPERATOR 4 occlusion.>=, OPERATOR 5 occlusion.>,
    FUNCTION 1 occlusion.compare(occlusion.point3d, occlusion.point3d);
COMMENT ON OPERATOR CLASS occlusion.point3d_order_ops USING btree IS 'order of the numbers in turn';
CREATE OPERATOR CLASS occlusion.point3d_hash_ops DEFAULT FOR TYPE occlusion.point3d USING hash AS
    OPERATOR 1 occlusion.=,
    FUNCTION 1 occlusion.hash(occlusion.point3d), FUNCTION 2 occlusion.hash_extended(occlusion.point3d, bigint);
COMMENT ON OPERATOR CLASS occlusion.point3d_hash_ops USING hash IS 'the same numbers';

CREATE FUNCTION occlusion.equals(occlusion.view_cone, occlusion.view_cone) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_equals_wrapper';
COMMENT ON FUNCTION occlusion.equals(occlusion.view_cone, occlusion.view_cone) IS 'implementation of =';
CREATE FUNCTION occlusion.differs(occlusion.view_cone, occlusion.view_cone) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_differs_wrapper';
COMMENT ON FUNCTION occlusion.differs(occlusion.view_cone, occlusion.view_cone) IS 'implementation of <>';
CREATE FUNCTION occlusion.less(occlusion.view_cone, occlusion.view_cone) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_less_wrapper';
COMMENT ON FUNCTION occlusion.less(occlusion.view_cone, occlusion.view_cone) IS 'implementation of <';
CREATE FUNCTION occlusion.less_or_equal(occlusion.view_cone, occlusion.view_cone) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_less_or_equal_wrapper';
COMMENT ON FUNCTION occlusion.less_or_equal(occlusion.view_cone, occlusion.view_cone) IS 'implementation of <=';
CREATE FUNCTION occlusion.greater_or_equal(occlusion.view_cone, occlusion.view_cone) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_greater_or_equal_wrapper';
COMMENT ON FUNCTION occlusion.greater_or_equal(occlusion.view_cone, occlusion.view_cone) IS 'implementation of >=';
CREATE FUNCTION occlusion.greater(occlusion.view_cone, occlusion.view_cone) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_greater_wrapper';
COMMENT ON FUNCTION occlusion.greater(occlusion.view_cone, occlusion.view_cone) IS 'implementation of >';
CREATE FUNCTION occlusion.compare(occlusion.view_cone, occlusion.view_cone) RETURNS integer
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_compare_wrapper';
COMMENT ON FUNCTION occlusion.compare(occlusion.view_cone, occlusion.view_cone) IS '-1, 0 or 1: order of the numbers in turn';
CREATE FUNCTION occlusion.hash(occlusion.view_cone) RETURNS integer
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_hash_wrapper';
COMMENT ON FUNCTION occlusion.hash(occlusion.view_cone) IS 'hash, for hash indexes and joins';
CREATE FUNCTION occlusion.hash_extended(occlusion.view_cone, bigint) RETURNS bigint
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_cone_hash_extended_wrapper';
COMMENT ON FUNCTION occlusion.hash_extended(occlusion.view_cone, bigint) IS 'hash with a seed, for hash partitions';
CREATE OPERATOR occlusion.= (
    LEFTARG = occlusion.view_cone, RIGHTARG = occlusion.view_cone, FUNCTION = occlusion.equals,
    COMMUTATOR = OPERATOR(occlusion.=), NEGATOR = OPERATOR(occlusion.<>),
    RESTRICT = eqsel, JOIN = eqjoinsel, HASHES, MERGES
);
COMMENT ON OPERATOR occlusion.= (occlusion.view_cone, occlusion.view_cone) IS 'the same numbers';
CREATE OPERATOR occlusion.<> (
    LEFTARG = occlusion.view_cone, RIGHTARG = occlusion.view_cone, FUNCTION = occlusion.differs,
    COMMUTATOR = OPERATOR(occlusion.<>), NEGATOR = OPERATOR(occlusion.=),
    RESTRICT = neqsel, JOIN = neqjoinsel
);
COMMENT ON OPERATOR occlusion.<> (occlusion.view_cone, occlusion.view_cone) IS 'not the same numbers';
CREATE OPERATOR occlusion.< (
    LEFTARG = occlusion.view_cone, RIGHTARG = occlusion.view_cone, FUNCTION = occlusion.less,
    COMMUTATOR = OPERATOR(occlusion.>), NEGATOR = OPERATOR(occlusion.>=),
    RESTRICT = scalarltsel, JOIN = scalarltjoinsel
);
COMMENT ON OPERATOR occlusion.< (occlusion.view_cone, occlusion.view_cone) IS 'earlier in the order of the numbers';
CREATE OPERATOR occlusion.<= (
    LEFTARG = occlusion.view_cone, RIGHTARG = occlusion.view_cone, FUNCTION = occlusion.less_or_equal,
    COMMUTATOR = OPERATOR(occlusion.>=), NEGATOR = OPERATOR(occlusion.>),
    RESTRICT = scalarlesel, JOIN = scalarlejoinsel
);
COMMENT ON OPERATOR occlusion.<= (occlusion.view_cone, occlusion.view_cone) IS 'earlier in the order of the numbers, or equal';
CREATE OPERATOR occlusion.>= (
    LEFTARG = occlusion.view_cone, RIGHTARG = occlusion.view_cone, FUNCTION = occlusion.greater_or_equal,
    COMMUTATOR = OPERATOR(occlusion.<=), NEGATOR = OPERATOR(occlusion.<),
    RESTRICT = scalargesel, JOIN = scalargejoinsel
);
COMMENT ON OPERATOR occlusion.>= (occlusion.view_cone, occlusion.view_cone) IS 'later in the order of the numbers, or equal';
CREATE OPERATOR occlusion.> (
    LEFTARG = occlusion.view_cone, RIGHTARG = occlusion.view_cone, FUNCTION = occlusion.greater,
    COMMUTATOR = OPERATOR(occlusion.<), NEGATOR = OPERATOR(occlusion.<=),
    RESTRICT = scalargtsel, JOIN = scalargtjoinsel
);
COMMENT ON OPERATOR occlusion.> (occlusion.view_cone, occlusion.view_cone) IS 'later in the order of the numbers';
CREATE OPERATOR CLASS occlusion.view_cone_order_ops DEFAULT FOR TYPE occlusion.view_cone USING btree AS
    OPERATOR 1 occlusion.<, OPERATOR 2 occlusion.<=, OPERATOR 3 occlusion.=, OPERATOR 4 occlusion.>=, OPERATOR 5 occlusion.>,
    FUNCTION 1 occlusion.compare(occlusion.view_cone, occlusion.view_cone);
COMMENT ON OPERATOR CLASS occlusion.view_cone_order_ops USING btree IS 'order of the numbers in turn';
CREATE OPERATOR CLASS occlusion.view_cone_hash_ops DEFAULT FOR TYPE occlusion.view_cone USING hash AS
    OPERATOR 1 occlusion.=,
    FUNCTION 1 occlusion.hash(occlusion.view_cone), FUNCTION 2 occlusion.hash_extended(occlusion.view_cone, bigint);
COMMENT ON OPERATOR CLASS occlusion.view_cone_hash_ops USING hash IS 'the same numbers';

CREATE FUNCTION occlusion.equals(occlusion.view_sector, occlusion.view_sector) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_equals_wrapper';
COMMENT ON FUNCTION occlusion.equals(occlusion.view_sector, occlusion.view_sector) IS 'implementation of =';
CREATE FUNCTION occlusion.differs(occlusion.view_sector, occlusion.view_sector) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_differs_wrapper';
COMMENT ON FUNCTION occlusion.differs(occlusion.view_sector, occlusion.view_sector) IS 'implementation of <>';
CREATE FUNCTION occlusion.less(occlusion.view_sector, occlusion.view_sector) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_less_wrapper';
COMMENT ON FUNCTION occlusion.less(occlusion.view_sector, occlusion.view_sector) IS 'implementation of <';
CREATE FUNCTION occlusion.less_or_equal(occlusion.view_sector, occlusion.view_sector) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_less_or_equal_wrapper';
COMMENT ON FUNCTION occlusion.less_or_equal(occlusion.view_sector, occlusion.view_sector) IS 'implementation of <=';
CREATE FUNCTION occlusion.greater_or_equal(occlusion.view_sector, occlusion.view_sector) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_greater_or_equal_wrapper';
COMMENT ON FUNCTION occlusion.greater_or_equal(occlusion.view_sector, occlusion.view_sector) IS 'implementation of >=';
CREATE FUNCTION occlusion.greater(occlusion.view_sector, occlusion.view_sector) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_greater_wrapper';
COMMENT ON FUNCTION occlusion.greater(occlusion.view_sector, occlusion.view_sector) IS 'implementation of >';
CREATE FUNCTION occlusion.compare(occlusion.view_sector, occlusion.view_sector) RETURNS integer
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_compare_wrapper';
COMMENT ON FUNCTION occlusion.compare(occlusion.view_sector, occlusion.view_sector) IS '-1, 0 or 1: order of the numbers in turn';
CREATE FUNCTION occlusion.hash(occlusion.view_sector) RETURNS integer
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_hash_wrapper';
COMMENT ON FUNCTION occlusion.hash(occlusion.view_sector) IS 'hash, for hash indexes and joins';
CREATE FUNCTION occlusion.hash_extended(occlusion.view_sector, bigint) RETURNS bigint
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'view_sector_hash_extended_wrapper';
COMMENT ON FUNCTION occlusion.hash_extended(occlusion.view_sector, bigint) IS 'hash with a seed, for hash partitions';
CREATE OPERATOR occlusion.= (
    LEFTARG = occlusion.view_sector, RIGHTARG = occlusion.view_sector, FUNCTION = occlusion.equals,
    COMMUTATOR = OPERATOR(occlusion.=), NEGATOR = OPERATOR(occlusion.<>),
    RESTRICT = eqsel, JOIN = eqjoinsel, HASHES, MERGES
);
COMMENT ON OPERATOR occlusion.= (occlusion.view_sector, occlusion.view_sector) IS 'the same numbers';
CREATE OPERATOR occlusion.<> (
    LEFTARG = occlusion.view_sector, RIGHTARG = occlusion.view_sector, FUNCTION = occlusion.differs,
    COMMUTATOR = OPERATOR(occlusion.<>), NEGATOR = OPERATOR(occlusion.=),
    RESTRICT = neqsel, JOIN = neqjoinsel
);
COMMENT ON OPERATOR occlusion.<> (occlusion.view_sector, occlusion.view_sector) IS 'not the same numbers';
CREATE OPERATOR occlusion.< (
    LEFTARG = occlusion.view_sector, RIGHTARG = occlusion.view_sector, FUNCTION = occlusion.less,
    COMMUTATOR = OPERATOR(occlusion.>), NEGATOR = OPERATOR(occlusion.>=),
    RESTRICT = scalarltsel, JOIN = scalarltjoinsel
);
COMMENT ON OPERATOR occlusion.< (occlusion.view_sector, occlusion.view_sector) IS 'earlier in the order of the numbers';
CREATE OPERATOR occlusion.<= (
    LEFTARG = occlusion.view_sector, RIGHTARG = occlusion.view_sector, FUNCTION = occlusion.less_or_equal,
    COMMUTATOR = OPERATOR(occlusion.>=), NEGATOR = OPERATOR(occlusion.>),
    RESTRICT = scalarlesel, JOIN = scalarlejoinsel
);
COMMENT ON OPERATOR occlusion.<= (occlusion.view_sector, occlusion.view_sector) IS 'earlier in the order of the numbers, or equal';
CREATE OPERATOR occlusion.>= (
    LEFTARG = occlusion.view_sector, RIGHTARG = occlusion.view_sector, FUNCTION = occlusion.greater_or_equal,
    COMMUTATOR = OPERATOR(occlusion.<=), NEGATOR = OPERATOR(occlusion.<),
    RESTRICT = scalargesel, JOIN = scalargejoinsel
);
COMMENT ON OPERATOR occlusion.>= (occlusion.view_sector, occlusion.view_sector) IS 'later in the order of the numbers, or equal';
CREATE OPERATOR occlusion.> (
    LEFTARG = occlusion.view_sector, RIGHTARG = occlusion.view_sector, FUNCTION = occlusion.greater,
    COMMUTATOR = OPERATOR(occlusion.<), NEGATOR = OPERATOR(occlusion.<=),
    RESTRICT = scalargtsel, JOIN = scalargtjoinsel
);
COMMENT ON OPERATOR occlusion.> (occlusion.view_sector, occlusion.view_sector) IS 'later in the order of the numbers';
CREATE OPERATOR CLASS occlusion.view_sector_order_ops DEFAULT FOR TYPE occlusion.view_sector USING btree AS
    OPERATOR 1 occlusion.<, OPERATOR 2 occlusion.<=, OPERATOR 3 occlusion.=, OPERATOR 4 occlusion.>=, OPERATOR 5 occlusion.>,
    FUNCTION 1 occlusion.compare(occlusion.view_sector, occlusion.view_sector);
COMMENT ON OPERATOR CLASS occlusion.view_sector_order_ops USING btree IS 'order of the numbers in turn';
CREATE OPERATOR CLASS occlusion.view_sector_hash_ops DEFAULT FOR TYPE occlusion.view_sector USING hash AS
    OPERATOR 1 occlusion.=,
    FUNCTION 1 occlusion.hash(occlusion.view_sector), FUNCTION 2 occlusion.hash_extended(occlusion.view_sector, bigint);
COMMENT ON OPERATOR CLASS occlusion.view_sector_hash_ops USING hash IS 'the same numbers';
