-- Operators. All intervals are closed: boxes that touch overlap.
-- Costs are times of a call, as multiples of a comparison of two numbers, 9 ns: a box 20 ns, a field of
-- view 25 to 50 ns.

CREATE FUNCTION occlusion.equals(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_equals_wrapper';
COMMENT ON FUNCTION occlusion.equals(occlusion.box3d, occlusion.box3d) IS 'implementation of = and ~=';
CREATE FUNCTION occlusion.overlaps(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_overlaps_wrapper';
COMMENT ON FUNCTION occlusion.overlaps(occlusion.box3d, occlusion.box3d) IS 'implementation of &&';
CREATE FUNCTION occlusion.contains(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_contains_wrapper';
COMMENT ON FUNCTION occlusion.contains(occlusion.box3d, occlusion.box3d) IS 'implementation of @>';
CREATE FUNCTION occlusion.contained_by(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_contained_by_wrapper';
COMMENT ON FUNCTION occlusion.contained_by(occlusion.box3d, occlusion.box3d) IS 'implementation of <@';
CREATE FUNCTION occlusion.contains(occlusion.box3d, occlusion.point3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_contains_point_wrapper';
COMMENT ON FUNCTION occlusion.contains(occlusion.box3d, occlusion.point3d) IS 'implementation of @>';
CREATE FUNCTION occlusion.contained_by(occlusion.point3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'point3d_contained_by_wrapper';
COMMENT ON FUNCTION occlusion.contained_by(occlusion.point3d, occlusion.box3d) IS 'implementation of <@';
CREATE FUNCTION occlusion.meets(occlusion.box3d, occlusion.view_cone) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 5 AS 'MODULE_PATHNAME', 'box3d_meets_cone_wrapper';
COMMENT ON FUNCTION occlusion.meets(occlusion.box3d, occlusion.view_cone) IS 'implementation of &&';
CREATE FUNCTION occlusion.meets(occlusion.view_cone, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 5 AS 'MODULE_PATHNAME', 'cone_meets_box3d_wrapper';
COMMENT ON FUNCTION occlusion.meets(occlusion.view_cone, occlusion.box3d) IS 'implementation of &&';
CREATE FUNCTION occlusion.meets(occlusion.box3d, occlusion.view_sector) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 5 AS 'MODULE_PATHNAME', 'box3d_meets_sector_wrapper';
COMMENT ON FUNCTION occlusion.meets(occlusion.box3d, occlusion.view_sector) IS 'implementation of &&';
CREATE FUNCTION occlusion.meets(occlusion.view_sector, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 5 AS 'MODULE_PATHNAME', 'sector_meets_box3d_wrapper';
COMMENT ON FUNCTION occlusion.meets(occlusion.view_sector, occlusion.box3d) IS 'implementation of &&';
CREATE FUNCTION occlusion.distance(occlusion.box3d, occlusion.box3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_distance_wrapper';
COMMENT ON FUNCTION occlusion.distance(occlusion.box3d, occlusion.box3d) IS 'implementation of <->';
CREATE FUNCTION occlusion.distance(occlusion.box3d, occlusion.point3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_distance_point_wrapper';
COMMENT ON FUNCTION occlusion.distance(occlusion.box3d, occlusion.point3d) IS 'implementation of <->';
CREATE FUNCTION occlusion.distance(occlusion.point3d, occlusion.box3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'point3d_distance_box_wrapper';
COMMENT ON FUNCTION occlusion.distance(occlusion.point3d, occlusion.box3d) IS 'implementation of <->';

CREATE OPERATOR occlusion.= (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.equals,
    COMMUTATOR = OPERATOR(occlusion.=), NEGATOR = OPERATOR(occlusion.<>),
    RESTRICT = eqsel, JOIN = eqjoinsel, HASHES, MERGES
);
COMMENT ON OPERATOR occlusion.= (occlusion.box3d, occlusion.box3d) IS 'same corners';
CREATE OPERATOR occlusion.~= (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.equals,
    COMMUTATOR = OPERATOR(occlusion.~=), RESTRICT = eqsel, JOIN = eqjoinsel
);
COMMENT ON OPERATOR occlusion.~= (occlusion.box3d, occlusion.box3d) IS 'same corners, by index';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.overlaps,
    COMMUTATOR = OPERATOR(occlusion.&&),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.&& (occlusion.box3d, occlusion.box3d) IS 'share a point';
CREATE OPERATOR occlusion.@> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.contains,
    COMMUTATOR = OPERATOR(occlusion.<@),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.@> (occlusion.box3d, occlusion.box3d) IS 'contains';
CREATE OPERATOR occlusion.<@ (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.contained_by,
    COMMUTATOR = OPERATOR(occlusion.@>),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.<@ (occlusion.box3d, occlusion.box3d) IS 'is contained by';
CREATE OPERATOR occlusion.@> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.point3d, FUNCTION = occlusion.contains,
    COMMUTATOR = OPERATOR(occlusion.<@),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.@> (occlusion.box3d, occlusion.point3d) IS 'contains';
CREATE OPERATOR occlusion.<@ (
    LEFTARG = occlusion.point3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.contained_by,
    COMMUTATOR = OPERATOR(occlusion.@>),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.<@ (occlusion.point3d, occlusion.box3d) IS 'is contained by';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.view_cone, FUNCTION = occlusion.meets,
    COMMUTATOR = OPERATOR(occlusion.&&),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.&& (occlusion.box3d, occlusion.view_cone) IS 'meets the cone of view, exactly';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.view_cone, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.meets,
    COMMUTATOR = OPERATOR(occlusion.&&),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.&& (occlusion.view_cone, occlusion.box3d) IS 'meets the box, exactly';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.view_sector, FUNCTION = occlusion.meets,
    COMMUTATOR = OPERATOR(occlusion.&&),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.&& (occlusion.box3d, occlusion.view_sector) IS 'meets the sector of view, exactly';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.view_sector, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.meets,
    COMMUTATOR = OPERATOR(occlusion.&&),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
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
