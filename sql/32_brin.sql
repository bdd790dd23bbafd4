-- BRIN for box3d: a box around each range of blocks. Core's functions keep it; ours knows what it can hold.
-- BRIN wants the same strategy numbers for every type on the right side.

CREATE FUNCTION occlusion.box3d_brin_consistent(internal, internal, internal) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_brin_consistent_wrapper';
COMMENT ON FUNCTION occlusion.box3d_brin_consistent(internal, internal, internal) IS 'BRIN support: whether a range of blocks can hold what is looked for';

CREATE OPERATOR CLASS occlusion.box3d_brin_ops DEFAULT FOR TYPE occlusion.box3d USING brin AS
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
    OPERATOR 7 occlusion.@> (occlusion.box3d, occlusion.point3d),
    OPERATOR 29 occlusion.&</ (occlusion.box3d, occlusion.box3d),
    OPERATOR 30 occlusion.<</ (occlusion.box3d, occlusion.box3d),
    OPERATOR 31 occlusion./>> (occlusion.box3d, occlusion.box3d),
    OPERATOR 32 occlusion./&> (occlusion.box3d, occlusion.box3d),
    OPERATOR 3 occlusion.&& (occlusion.box3d, occlusion.view_cone),
    OPERATOR 3 occlusion.&& (occlusion.box3d, occlusion.view_sector),
    FUNCTION 1 pg_catalog.brin_inclusion_opcinfo(internal),
    FUNCTION 2 pg_catalog.brin_inclusion_add_value(internal, internal, internal, internal),
    FUNCTION 3 occlusion.box3d_brin_consistent(internal, internal, internal),
    FUNCTION 4 pg_catalog.brin_inclusion_union(internal, internal, internal),
    FUNCTION 11 occlusion.merge(occlusion.box3d, occlusion.box3d),
    FUNCTION 13 occlusion.contains(occlusion.box3d, occlusion.box3d);
COMMENT ON OPERATOR CLASS occlusion.box3d_brin_ops USING brin IS
    'boxes in space: overlap, containment, positions, fields of view';
