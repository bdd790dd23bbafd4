-- Planner support: statistics of columns of boxes, and the selectivity of operators.

CREATE FUNCTION occlusion.box3d_typanalyze(internal) RETURNS boolean
    LANGUAGE c STABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_typanalyze_wrapper';
COMMENT ON FUNCTION occlusion.box3d_typanalyze(internal) IS 'ANALYZE of columns of type box3d';
ALTER TYPE occlusion.box3d SET (ANALYZE = occlusion.box3d_typanalyze);

CREATE FUNCTION occlusion.box3d_selectivity(internal, oid, internal, integer) RETURNS float8
    LANGUAGE c STABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_selectivity_wrapper';
COMMENT ON FUNCTION occlusion.box3d_selectivity(internal, oid, internal, integer) IS
    'share of rows that &&, @> or <@ keeps';
CREATE FUNCTION occlusion.box3d_join_selectivity(internal, oid, internal, smallint, internal) RETURNS float8
    LANGUAGE c STABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_join_selectivity_wrapper';
COMMENT ON FUNCTION occlusion.box3d_join_selectivity(internal, oid, internal, smallint, internal) IS
    'share of pairs that a join by &&, @> or <@ keeps';

ALTER OPERATOR occlusion.&& (occlusion.box3d, occlusion.box3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.@> (occlusion.box3d, occlusion.box3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.<@ (occlusion.box3d, occlusion.box3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.@> (occlusion.box3d, occlusion.point3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.<@ (occlusion.point3d, occlusion.box3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.&& (occlusion.box3d, occlusion.view_cone)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.&& (occlusion.view_cone, occlusion.box3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.&& (occlusion.box3d, occlusion.view_sector)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
ALTER OPERATOR occlusion.&& (occlusion.view_sector, occlusion.box3d)
    SET (RESTRICT = occlusion.box3d_selectivity, JOIN = occlusion.box3d_join_selectivity);
