-- Operators that compare positions along one axis, and the distance between points.

CREATE FUNCTION occlusion.left_of(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_left_of_wrapper';
COMMENT ON FUNCTION occlusion.left_of(occlusion.box3d, occlusion.box3d) IS 'implementation of <<';
CREATE OPERATOR occlusion.<< (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.left_of,
    COMMUTATOR = OPERATOR(occlusion.>>),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.<< (occlusion.box3d, occlusion.box3d) IS 'ends before the other begins, along x';
CREATE FUNCTION occlusion.not_right_of(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_not_right_of_wrapper';
COMMENT ON FUNCTION occlusion.not_right_of(occlusion.box3d, occlusion.box3d) IS 'implementation of &<';
CREATE OPERATOR occlusion.&< (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.not_right_of,
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.&< (occlusion.box3d, occlusion.box3d) IS 'ends no later than the other, along x';
CREATE FUNCTION occlusion.not_left_of(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_not_left_of_wrapper';
COMMENT ON FUNCTION occlusion.not_left_of(occlusion.box3d, occlusion.box3d) IS 'implementation of &>';
CREATE OPERATOR occlusion.&> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.not_left_of,
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.&> (occlusion.box3d, occlusion.box3d) IS 'begins no earlier than the other, along x';
CREATE FUNCTION occlusion.right_of(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_right_of_wrapper';
COMMENT ON FUNCTION occlusion.right_of(occlusion.box3d, occlusion.box3d) IS 'implementation of >>';
CREATE OPERATOR occlusion.>> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.right_of,
    COMMUTATOR = OPERATOR(occlusion.<<),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.>> (occlusion.box3d, occlusion.box3d) IS 'begins after the other ends, along x';
CREATE FUNCTION occlusion.below(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_below_wrapper';
COMMENT ON FUNCTION occlusion.below(occlusion.box3d, occlusion.box3d) IS 'implementation of <<|';
CREATE OPERATOR occlusion.<<| (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.below,
    COMMUTATOR = OPERATOR(occlusion.|>>),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.<<| (occlusion.box3d, occlusion.box3d) IS 'ends before the other begins, along y';
CREATE FUNCTION occlusion.not_above(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_not_above_wrapper';
COMMENT ON FUNCTION occlusion.not_above(occlusion.box3d, occlusion.box3d) IS 'implementation of &<|';
CREATE OPERATOR occlusion.&<| (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.not_above,
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.&<| (occlusion.box3d, occlusion.box3d) IS 'ends no later than the other, along y';
CREATE FUNCTION occlusion.not_below(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_not_below_wrapper';
COMMENT ON FUNCTION occlusion.not_below(occlusion.box3d, occlusion.box3d) IS 'implementation of |&>';
CREATE OPERATOR occlusion.|&> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.not_below,
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.|&> (occlusion.box3d, occlusion.box3d) IS 'begins no earlier than the other, along y';
CREATE FUNCTION occlusion.above(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_above_wrapper';
COMMENT ON FUNCTION occlusion.above(occlusion.box3d, occlusion.box3d) IS 'implementation of |>>';
CREATE OPERATOR occlusion.|>> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.above,
    COMMUTATOR = OPERATOR(occlusion.<<|),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.|>> (occlusion.box3d, occlusion.box3d) IS 'begins after the other ends, along y';
CREATE FUNCTION occlusion.in_front_of(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_in_front_of_wrapper';
COMMENT ON FUNCTION occlusion.in_front_of(occlusion.box3d, occlusion.box3d) IS 'implementation of <</';
CREATE OPERATOR occlusion.<</ (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.in_front_of,
    COMMUTATOR = OPERATOR(occlusion./>>),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.<</ (occlusion.box3d, occlusion.box3d) IS 'ends before the other begins, along z';
CREATE FUNCTION occlusion.not_behind(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_not_behind_wrapper';
COMMENT ON FUNCTION occlusion.not_behind(occlusion.box3d, occlusion.box3d) IS 'implementation of &</';
CREATE OPERATOR occlusion.&</ (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.not_behind,
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion.&</ (occlusion.box3d, occlusion.box3d) IS 'ends no later than the other, along z';
CREATE FUNCTION occlusion.not_in_front_of(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_not_in_front_of_wrapper';
COMMENT ON FUNCTION occlusion.not_in_front_of(occlusion.box3d, occlusion.box3d) IS 'implementation of /&>';
CREATE OPERATOR occlusion./&> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.not_in_front_of,
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion./&> (occlusion.box3d, occlusion.box3d) IS 'begins no earlier than the other, along z';
CREATE FUNCTION occlusion.behind(occlusion.box3d, occlusion.box3d) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE COST 2 AS 'MODULE_PATHNAME', 'box3d_behind_wrapper';
COMMENT ON FUNCTION occlusion.behind(occlusion.box3d, occlusion.box3d) IS 'implementation of />>';
CREATE OPERATOR occlusion./>> (
    LEFTARG = occlusion.box3d, RIGHTARG = occlusion.box3d, FUNCTION = occlusion.behind,
    COMMUTATOR = OPERATOR(occlusion.<</),
    RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity
);
COMMENT ON OPERATOR occlusion./>> (occlusion.box3d, occlusion.box3d) IS 'begins after the other ends, along z';

CREATE FUNCTION occlusion.distance(occlusion.point3d, occlusion.point3d) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'point3d_distance_wrapper';
COMMENT ON FUNCTION occlusion.distance(occlusion.point3d, occlusion.point3d) IS 'implementation of <->';
CREATE OPERATOR occlusion.<-> (
    LEFTARG = occlusion.point3d, RIGHTARG = occlusion.point3d, FUNCTION = occlusion.distance,
    COMMUTATOR = OPERATOR(occlusion.<->)
);
COMMENT ON OPERATOR occlusion.<-> (occlusion.point3d, occlusion.point3d) IS 'Euclidean distance, metres';
