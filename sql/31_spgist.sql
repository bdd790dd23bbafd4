-- SP-GiST for box3d: a box as a point of six dimensions, split at medians.

CREATE FUNCTION occlusion.box3d_spgist_config(internal, internal) RETURNS void
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_spgist_config_wrapper';
COMMENT ON FUNCTION occlusion.box3d_spgist_config(internal, internal) IS 'SP-GiST support: what nodes hold';
CREATE FUNCTION occlusion.box3d_spgist_choose(internal, internal) RETURNS void
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_spgist_choose_wrapper';
COMMENT ON FUNCTION occlusion.box3d_spgist_choose(internal, internal) IS 'SP-GiST support: the child for a new box';
CREATE FUNCTION occlusion.box3d_spgist_picksplit(internal, internal) RETURNS void
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_spgist_picksplit_wrapper';
COMMENT ON FUNCTION occlusion.box3d_spgist_picksplit(internal, internal) IS 'SP-GiST support: splits a full page';
CREATE FUNCTION occlusion.box3d_spgist_inner_consistent(internal, internal) RETURNS void
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_spgist_inner_consistent_wrapper';
COMMENT ON FUNCTION occlusion.box3d_spgist_inner_consistent(internal, internal) IS 'SP-GiST support: the children that can hold what is looked for';
CREATE FUNCTION occlusion.box3d_spgist_leaf_consistent(internal, internal) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_spgist_leaf_consistent_wrapper';
COMMENT ON FUNCTION occlusion.box3d_spgist_leaf_consistent(internal, internal) IS 'SP-GiST support: whether a box is what is looked for';

CREATE OPERATOR CLASS occlusion.box3d_spgist_ops DEFAULT FOR TYPE occlusion.box3d USING spgist AS
    OPERATOR 1 occlusion.<< (occlusion.box3d, occlusion.box3d),
    OPERATOR 2 occlusion.&< (occlusion.box3d, occlusion.box3d),
    OPERATOR 3 occlusion.&& (occlusion.box3d, occlusion.box3d),
    OPERATOR 4 occlusion.&> (occlusion.box3d, occlusion.box3d),
    OPERATOR 5 occlusion.>> (occlusion.box3d, occlusion.box3d),
    OPERATOR 6 occlusion.~= (occlusion.box3d, occlusion.box3d),
    OPERATOR 7 occlusion.@> (occlusion.box3d, occlusion.box3d),
    OPERATOR 8 occlusion.<@ (occlusion.box3d, occlusion.box3d),
    OPERATOR 9 occlusion.&<| (occlusion.box3d, occlusion.box3d),
    OPERATOR 10 occlusion.<<| (occlusion.box3d, occlusion.box3d),
    OPERATOR 11 occlusion.|>> (occlusion.box3d, occlusion.box3d),
    OPERATOR 12 occlusion.|&> (occlusion.box3d, occlusion.box3d),
    OPERATOR 18 occlusion.= (occlusion.box3d, occlusion.box3d),
    OPERATOR 27 occlusion.@> (occlusion.box3d, occlusion.point3d),
    OPERATOR 29 occlusion.&</ (occlusion.box3d, occlusion.box3d),
    OPERATOR 30 occlusion.<</ (occlusion.box3d, occlusion.box3d),
    OPERATOR 31 occlusion./>> (occlusion.box3d, occlusion.box3d),
    OPERATOR 32 occlusion./&> (occlusion.box3d, occlusion.box3d),
    OPERATOR 33 occlusion.&& (occlusion.box3d, occlusion.view_cone),
    OPERATOR 43 occlusion.&& (occlusion.box3d, occlusion.view_sector),
    OPERATOR 15 occlusion.<-> (occlusion.box3d, occlusion.box3d) FOR ORDER BY pg_catalog.float_ops,
    OPERATOR 25 occlusion.<-> (occlusion.box3d, occlusion.point3d) FOR ORDER BY pg_catalog.float_ops,
    FUNCTION 1 occlusion.box3d_spgist_config(internal, internal),
    FUNCTION 2 occlusion.box3d_spgist_choose(internal, internal),
    FUNCTION 3 occlusion.box3d_spgist_picksplit(internal, internal),
    FUNCTION 4 occlusion.box3d_spgist_inner_consistent(internal, internal),
    FUNCTION 5 occlusion.box3d_spgist_leaf_consistent(internal, internal);
COMMENT ON OPERATOR CLASS occlusion.box3d_spgist_ops USING spgist IS
    'boxes in space: overlap, containment, positions, fields of view, nearest first';
