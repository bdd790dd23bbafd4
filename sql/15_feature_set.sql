-- Sets of features, compressed.

CREATE TYPE occlusion.feature_set;
CREATE FUNCTION occlusion.feature_set_in(cstring) RETURNS occlusion.feature_set
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_in_wrapper';
CREATE FUNCTION occlusion.feature_set_out(occlusion.feature_set) RETURNS cstring
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_out_wrapper';
CREATE FUNCTION occlusion.feature_set_recv(internal) RETURNS occlusion.feature_set
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_recv_wrapper';
CREATE FUNCTION occlusion.feature_set_send(occlusion.feature_set) RETURNS bytea
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_send_wrapper';
-- External: what is compressed already is not compressed again, and the count is read without the rest.
CREATE TYPE occlusion.feature_set (
    INPUT = occlusion.feature_set_in,
    OUTPUT = occlusion.feature_set_out,
    RECEIVE = occlusion.feature_set_recv,
    SEND = occlusion.feature_set_send,
    INTERNALLENGTH = VARIABLE,
    ALIGNMENT = int4,
    STORAGE = external
);
COMMENT ON TYPE occlusion.feature_set IS 'set of numbers of features, {1,2,7}, compressed';

CREATE FUNCTION occlusion.feature_set(bigint[]) RETURNS occlusion.feature_set
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_from_array_wrapper';
COMMENT ON FUNCTION occlusion.feature_set(bigint[]) IS 'the set of the numbers of an array, in any order';
CREATE FUNCTION occlusion.to_array(occlusion.feature_set) RETURNS bigint[]
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_to_array_wrapper';
COMMENT ON FUNCTION occlusion.to_array(occlusion.feature_set) IS 'the numbers of a set, ascending';
CREATE CAST (bigint[] AS occlusion.feature_set) WITH FUNCTION occlusion.feature_set(bigint[]) AS ASSIGNMENT;
COMMENT ON CAST (bigint[] AS occlusion.feature_set) IS 'the set of the numbers of an array';
CREATE CAST (occlusion.feature_set AS bigint[]) WITH FUNCTION occlusion.to_array(occlusion.feature_set) AS ASSIGNMENT;
COMMENT ON CAST (occlusion.feature_set AS bigint[]) IS 'the numbers of a set, ascending';

CREATE FUNCTION occlusion.cardinality(occlusion.feature_set) RETURNS bigint
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_cardinality_wrapper';
COMMENT ON FUNCTION occlusion.cardinality(occlusion.feature_set) IS 'how many numbers a set has; only its beginning is read';
CREATE FUNCTION occlusion.least_number(occlusion.feature_set) RETURNS bigint
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_least_wrapper';
COMMENT ON FUNCTION occlusion.least_number(occlusion.feature_set) IS 'least number of a set; NULL if it is empty';
CREATE FUNCTION occlusion.greatest_number(occlusion.feature_set) RETURNS bigint
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_greatest_wrapper';
COMMENT ON FUNCTION occlusion.greatest_number(occlusion.feature_set) IS 'greatest number of a set; NULL if it is empty';
CREATE FUNCTION occlusion.unnest(occlusion.feature_set) RETURNS SETOF bigint
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE ROWS 500 SUPPORT occlusion.feature_set_unnest_support
    AS 'MODULE_PATHNAME', 'feature_set_unnest_wrapper';
COMMENT ON FUNCTION occlusion.unnest(occlusion.feature_set) IS 'the numbers of a set as rows, ascending';

-- A set has one form, so it is equal when its bytes are: core's functions for bytea compare and hash
-- them, and tell sets of different length apart without fetching them.
CREATE FUNCTION occlusion.equals(occlusion.feature_set, occlusion.feature_set) RETURNS boolean
    LANGUAGE internal IMMUTABLE STRICT PARALLEL SAFE LEAKPROOF AS 'byteaeq';
COMMENT ON FUNCTION occlusion.equals(occlusion.feature_set, occlusion.feature_set) IS 'implementation of =';
CREATE FUNCTION occlusion.differs(occlusion.feature_set, occlusion.feature_set) RETURNS boolean
    LANGUAGE internal IMMUTABLE STRICT PARALLEL SAFE LEAKPROOF AS 'byteane';
COMMENT ON FUNCTION occlusion.differs(occlusion.feature_set, occlusion.feature_set) IS 'implementation of <>';
CREATE FUNCTION occlusion.hash(occlusion.feature_set) RETURNS integer
    LANGUAGE internal IMMUTABLE STRICT PARALLEL SAFE AS 'hashvarlena';
COMMENT ON FUNCTION occlusion.hash(occlusion.feature_set) IS 'hash, for hash indexes and joins';
CREATE FUNCTION occlusion.hash_extended(occlusion.feature_set, bigint) RETURNS bigint
    LANGUAGE internal IMMUTABLE STRICT PARALLEL SAFE AS 'hashvarlenaextended';
COMMENT ON FUNCTION occlusion.hash_extended(occlusion.feature_set, bigint) IS 'hash with a seed, for hash partitions';
CREATE FUNCTION occlusion.compare(occlusion.feature_set, occlusion.feature_set) RETURNS integer
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_compare_wrapper';
COMMENT ON FUNCTION occlusion.compare(occlusion.feature_set, occlusion.feature_set) IS
    'less than, equal to or greater than 0, as the ascending numbers compare one by one';
CREATE FUNCTION occlusion.less(occlusion.feature_set, occlusion.feature_set) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_less_wrapper';
COMMENT ON FUNCTION occlusion.less(occlusion.feature_set, occlusion.feature_set) IS 'implementation of <';
CREATE FUNCTION occlusion.less_or_equal(occlusion.feature_set, occlusion.feature_set) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_less_or_equal_wrapper';
COMMENT ON FUNCTION occlusion.less_or_equal(occlusion.feature_set, occlusion.feature_set) IS 'implementation of <=';
CREATE FUNCTION occlusion.greater(occlusion.feature_set, occlusion.feature_set) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_greater_wrapper';
COMMENT ON FUNCTION occlusion.greater(occlusion.feature_set, occlusion.feature_set) IS 'implementation of >';
CREATE FUNCTION occlusion.greater_or_equal(occlusion.feature_set, occlusion.feature_set) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_greater_or_equal_wrapper';
COMMENT ON FUNCTION occlusion.greater_or_equal(occlusion.feature_set, occlusion.feature_set) IS 'implementation of >=';
CREATE FUNCTION occlusion.set_union(occlusion.feature_set, occlusion.feature_set) RETURNS occlusion.feature_set
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_union_wrapper';
COMMENT ON FUNCTION occlusion.set_union(occlusion.feature_set, occlusion.feature_set) IS 'implementation of |';
CREATE FUNCTION occlusion.set_intersection(occlusion.feature_set, occlusion.feature_set) RETURNS occlusion.feature_set
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_intersection_wrapper';
COMMENT ON FUNCTION occlusion.set_intersection(occlusion.feature_set, occlusion.feature_set) IS 'implementation of &';
CREATE FUNCTION occlusion.set_difference(occlusion.feature_set, occlusion.feature_set) RETURNS occlusion.feature_set
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_difference_wrapper';
COMMENT ON FUNCTION occlusion.set_difference(occlusion.feature_set, occlusion.feature_set) IS 'implementation of -';
CREATE FUNCTION occlusion.contains(occlusion.feature_set, occlusion.feature_set) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_contains_wrapper';
COMMENT ON FUNCTION occlusion.contains(occlusion.feature_set, occlusion.feature_set) IS 'implementation of @>';
CREATE FUNCTION occlusion.contained_by(occlusion.feature_set, occlusion.feature_set) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_contained_by_wrapper';
COMMENT ON FUNCTION occlusion.contained_by(occlusion.feature_set, occlusion.feature_set) IS 'implementation of <@';
CREATE FUNCTION occlusion.contains(occlusion.feature_set, bigint) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_contains_number_wrapper';
COMMENT ON FUNCTION occlusion.contains(occlusion.feature_set, bigint) IS 'implementation of @>';
CREATE FUNCTION occlusion.contained_by(bigint, occlusion.feature_set) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_number_contained_by_wrapper';
COMMENT ON FUNCTION occlusion.contained_by(bigint, occlusion.feature_set) IS 'implementation of <@';
CREATE FUNCTION occlusion.overlaps(occlusion.feature_set, occlusion.feature_set) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_overlaps_wrapper';
COMMENT ON FUNCTION occlusion.overlaps(occlusion.feature_set, occlusion.feature_set) IS 'implementation of &&';

CREATE OPERATOR occlusion.= (
    LEFTARG = occlusion.feature_set, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.equals,
    COMMUTATOR = OPERATOR(occlusion.=), NEGATOR = OPERATOR(occlusion.<>),
    RESTRICT = eqsel, JOIN = eqjoinsel, HASHES, MERGES
);
COMMENT ON OPERATOR occlusion.= (occlusion.feature_set, occlusion.feature_set) IS 'the same numbers';
CREATE OPERATOR occlusion.<> (
    LEFTARG = occlusion.feature_set, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.differs,
    COMMUTATOR = OPERATOR(occlusion.<>), NEGATOR = OPERATOR(occlusion.=),
    RESTRICT = neqsel, JOIN = neqjoinsel
);
COMMENT ON OPERATOR occlusion.<> (occlusion.feature_set, occlusion.feature_set) IS 'not the same numbers';
CREATE OPERATOR occlusion.< (
    LEFTARG = occlusion.feature_set, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.less,
    COMMUTATOR = OPERATOR(occlusion.>), NEGATOR = OPERATOR(occlusion.>=),
    RESTRICT = scalarltsel, JOIN = scalarltjoinsel
);
COMMENT ON OPERATOR occlusion.< (occlusion.feature_set, occlusion.feature_set) IS 'comes before';
CREATE OPERATOR occlusion.<= (
    LEFTARG = occlusion.feature_set, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.less_or_equal,
    COMMUTATOR = OPERATOR(occlusion.>=), NEGATOR = OPERATOR(occlusion.>),
    RESTRICT = scalarlesel, JOIN = scalarlejoinsel
);
COMMENT ON OPERATOR occlusion.<= (occlusion.feature_set, occlusion.feature_set) IS 'comes before or is equal';
CREATE OPERATOR occlusion.> (
    LEFTARG = occlusion.feature_set, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.greater,
    COMMUTATOR = OPERATOR(occlusion.<), NEGATOR = OPERATOR(occlusion.<=),
    RESTRICT = scalargtsel, JOIN = scalargtjoinsel
);
COMMENT ON OPERATOR occlusion.> (occlusion.feature_set, occlusion.feature_set) IS 'comes after';
CREATE OPERATOR occlusion.>= (
    LEFTARG = occlusion.feature_set, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.greater_or_equal,
    COMMUTATOR = OPERATOR(occlusion.<=), NEGATOR = OPERATOR(occlusion.<),
    RESTRICT = scalargesel, JOIN = scalargejoinsel
);
COMMENT ON OPERATOR occlusion.>= (occlusion.feature_set, occlusion.feature_set) IS 'comes after or is equal';
CREATE OPERATOR occlusion.| (
    LEFTARG = occlusion.feature_set, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.set_union,
    COMMUTATOR = OPERATOR(occlusion.|)
);
COMMENT ON OPERATOR occlusion.| (occlusion.feature_set, occlusion.feature_set) IS 'numbers of either';
CREATE OPERATOR occlusion.& (
    LEFTARG = occlusion.feature_set, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.set_intersection,
    COMMUTATOR = OPERATOR(occlusion.&)
);
COMMENT ON OPERATOR occlusion.& (occlusion.feature_set, occlusion.feature_set) IS 'numbers of both';
CREATE OPERATOR occlusion.- (
    LEFTARG = occlusion.feature_set, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.set_difference
);
COMMENT ON OPERATOR occlusion.- (occlusion.feature_set, occlusion.feature_set) IS 'numbers of the first that the second has not';
CREATE OPERATOR occlusion.@> (
    LEFTARG = occlusion.feature_set, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.contains,
    COMMUTATOR = OPERATOR(occlusion.<@),
    RESTRICT = contsel, JOIN = contjoinsel
);
COMMENT ON OPERATOR occlusion.@> (occlusion.feature_set, occlusion.feature_set) IS 'contains';
CREATE OPERATOR occlusion.<@ (
    LEFTARG = occlusion.feature_set, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.contained_by,
    COMMUTATOR = OPERATOR(occlusion.@>),
    RESTRICT = contsel, JOIN = contjoinsel
);
COMMENT ON OPERATOR occlusion.<@ (occlusion.feature_set, occlusion.feature_set) IS 'is contained by';
CREATE OPERATOR occlusion.@> (
    LEFTARG = occlusion.feature_set, RIGHTARG = bigint, FUNCTION = occlusion.contains,
    COMMUTATOR = OPERATOR(occlusion.<@),
    RESTRICT = contsel, JOIN = contjoinsel
);
COMMENT ON OPERATOR occlusion.@> (occlusion.feature_set, bigint) IS 'has the number';
CREATE OPERATOR occlusion.<@ (
    LEFTARG = bigint, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.contained_by,
    COMMUTATOR = OPERATOR(occlusion.@>),
    RESTRICT = contsel, JOIN = contjoinsel
);
COMMENT ON OPERATOR occlusion.<@ (bigint, occlusion.feature_set) IS 'is one of the numbers';
CREATE OPERATOR occlusion.&& (
    LEFTARG = occlusion.feature_set, RIGHTARG = occlusion.feature_set, FUNCTION = occlusion.overlaps,
    COMMUTATOR = OPERATOR(occlusion.&&),
    RESTRICT = contsel, JOIN = contjoinsel
);
COMMENT ON OPERATOR occlusion.&& (occlusion.feature_set, occlusion.feature_set) IS 'have a number in common';

CREATE OPERATOR CLASS occlusion.feature_set_ops DEFAULT FOR TYPE occlusion.feature_set USING btree AS
    OPERATOR 1 occlusion.<,
    OPERATOR 2 occlusion.<=,
    OPERATOR 3 occlusion.=,
    OPERATOR 4 occlusion.>=,
    OPERATOR 5 occlusion.>,
    FUNCTION 1 occlusion.compare(occlusion.feature_set, occlusion.feature_set),
    FUNCTION 4 btequalimage(oid);
COMMENT ON OPERATOR CLASS occlusion.feature_set_ops USING btree IS 'sets in the order of their numbers';
CREATE OPERATOR CLASS occlusion.feature_set_ops DEFAULT FOR TYPE occlusion.feature_set USING hash AS
    OPERATOR 1 occlusion.=,
    FUNCTION 1 occlusion.hash(occlusion.feature_set),
    FUNCTION 2 occlusion.hash_extended(occlusion.feature_set, bigint);
COMMENT ON OPERATOR CLASS occlusion.feature_set_ops USING hash IS 'equality of sets';

-- GIN, an entry for each number: which sets hold this feature?
CREATE FUNCTION occlusion.feature_set_gin_extract_value(occlusion.feature_set, internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_gin_extract_value_wrapper';
COMMENT ON FUNCTION occlusion.feature_set_gin_extract_value(occlusion.feature_set, internal) IS 'GIN support';
CREATE FUNCTION occlusion.feature_set_gin_extract_query(occlusion.feature_set, internal, smallint, internal, internal, internal, internal)
    RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_gin_extract_query_wrapper';
COMMENT ON FUNCTION occlusion.feature_set_gin_extract_query(occlusion.feature_set, internal, smallint, internal, internal, internal, internal) IS
    'GIN support';
CREATE FUNCTION occlusion.feature_set_gin_consistent(internal, smallint, occlusion.feature_set, integer, internal, internal, internal, internal)
    RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_gin_consistent_wrapper';
COMMENT ON FUNCTION occlusion.feature_set_gin_consistent(internal, smallint, occlusion.feature_set, integer, internal, internal, internal, internal) IS
    'GIN support';
CREATE FUNCTION occlusion.feature_set_gin_triconsistent(internal, smallint, occlusion.feature_set, integer, internal, internal, internal)
    RETURNS "char"
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_gin_triconsistent_wrapper';
COMMENT ON FUNCTION occlusion.feature_set_gin_triconsistent(internal, smallint, occlusion.feature_set, integer, internal, internal, internal) IS
    'GIN support';
CREATE OPERATOR CLASS occlusion.feature_set_ops DEFAULT FOR TYPE occlusion.feature_set USING gin AS
    OPERATOR 1 occlusion.&& (occlusion.feature_set, occlusion.feature_set),
    OPERATOR 2 occlusion.@> (occlusion.feature_set, occlusion.feature_set),
    OPERATOR 3 occlusion.<@ (occlusion.feature_set, occlusion.feature_set),
    OPERATOR 4 occlusion.= (occlusion.feature_set, occlusion.feature_set),
    OPERATOR 5 occlusion.@> (occlusion.feature_set, bigint),
    FUNCTION 1 btint8cmp(bigint, bigint),
    FUNCTION 2 occlusion.feature_set_gin_extract_value(occlusion.feature_set, internal),
    FUNCTION 3 occlusion.feature_set_gin_extract_query(occlusion.feature_set, internal, smallint, internal, internal, internal, internal),
    FUNCTION 4 occlusion.feature_set_gin_consistent(internal, smallint, occlusion.feature_set, integer, internal, internal, internal, internal),
    FUNCTION 6 occlusion.feature_set_gin_triconsistent(internal, smallint, occlusion.feature_set, integer, internal, internal, internal),
    STORAGE bigint;
COMMENT ON OPERATOR CLASS occlusion.feature_set_ops USING gin IS 'sets by their numbers';

-- Aggregates. Workers hand each other the set that they have so far.
CREATE FUNCTION occlusion.feature_set_collect(internal, bigint) RETURNS internal
    LANGUAGE c IMMUTABLE PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_collect_number_wrapper';
COMMENT ON FUNCTION occlusion.feature_set_collect(internal, bigint) IS 'part of feature_set_agg';
CREATE FUNCTION occlusion.feature_set_collect(internal, occlusion.feature_set) RETURNS internal
    LANGUAGE c IMMUTABLE PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_collect_set_wrapper';
COMMENT ON FUNCTION occlusion.feature_set_collect(internal, occlusion.feature_set) IS 'part of feature_set_union';
CREATE FUNCTION occlusion.feature_set_collected(internal) RETURNS occlusion.feature_set
    LANGUAGE c IMMUTABLE PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_collected_wrapper';
COMMENT ON FUNCTION occlusion.feature_set_collected(internal) IS 'part of feature_set_agg and feature_set_union';
CREATE FUNCTION occlusion.feature_set_collect_combine(internal, internal) RETURNS internal
    LANGUAGE c IMMUTABLE PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_collect_combine_wrapper';
COMMENT ON FUNCTION occlusion.feature_set_collect_combine(internal, internal) IS 'part of feature_set_agg and feature_set_union';
CREATE FUNCTION occlusion.feature_set_collect_save(internal) RETURNS bytea
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_collected_wrapper';
COMMENT ON FUNCTION occlusion.feature_set_collect_save(internal) IS 'part of feature_set_agg and feature_set_union';
CREATE FUNCTION occlusion.feature_set_collect_resume(bytea, internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'feature_set_collect_resume_wrapper';
COMMENT ON FUNCTION occlusion.feature_set_collect_resume(bytea, internal) IS 'part of feature_set_agg and feature_set_union';
CREATE AGGREGATE occlusion.feature_set_agg(bigint) (
    SFUNC = occlusion.feature_set_collect,
    STYPE = internal,
    FINALFUNC = occlusion.feature_set_collected,
    COMBINEFUNC = occlusion.feature_set_collect_combine,
    SERIALFUNC = occlusion.feature_set_collect_save,
    DESERIALFUNC = occlusion.feature_set_collect_resume,
    PARALLEL = SAFE
);
COMMENT ON AGGREGATE occlusion.feature_set_agg(bigint) IS 'the set of all numbers; NULL if there are none';
CREATE AGGREGATE occlusion.feature_set_union(occlusion.feature_set) (
    SFUNC = occlusion.feature_set_collect,
    STYPE = internal,
    FINALFUNC = occlusion.feature_set_collected,
    COMBINEFUNC = occlusion.feature_set_collect_combine,
    SERIALFUNC = occlusion.feature_set_collect_save,
    DESERIALFUNC = occlusion.feature_set_collect_resume,
    PARALLEL = SAFE
);
COMMENT ON AGGREGATE occlusion.feature_set_union(occlusion.feature_set) IS 'union of all sets; NULL if there are none';
