-- The functions, operators and operator classes of points and boxes that 0.1.0 lacked.

-- include sql/12_points_and_boxes.sql
-- include sql/21_positions.sql

-- ALTER OPERATOR learns to set these only in PostgreSQL 17.
UPDATE pg_catalog.pg_operator SET oprcanhash = true, oprcanmerge = true
WHERE oid = 'occlusion.=(occlusion.box3d, occlusion.box3d)'::pg_catalog.regoperator;

-- include sql/22_order.sql

CREATE FUNCTION occlusion.box3d_gist_sortsupport(internal) RETURNS void
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_sortsupport_wrapper';
COMMENT ON FUNCTION occlusion.box3d_gist_sortsupport(internal) IS 'GiST support: order of a sorted build';
ALTER OPERATOR FAMILY occlusion.box3d_ops USING gist ADD
    OPERATOR 1 occlusion.<< (occlusion.box3d, occlusion.box3d),
    OPERATOR 2 occlusion.&< (occlusion.box3d, occlusion.box3d),
    OPERATOR 4 occlusion.&> (occlusion.box3d, occlusion.box3d),
    OPERATOR 5 occlusion.>> (occlusion.box3d, occlusion.box3d),
    OPERATOR 9 occlusion.&<| (occlusion.box3d, occlusion.box3d),
    OPERATOR 10 occlusion.<<| (occlusion.box3d, occlusion.box3d),
    OPERATOR 11 occlusion.|>> (occlusion.box3d, occlusion.box3d),
    OPERATOR 12 occlusion.|&> (occlusion.box3d, occlusion.box3d),
    OPERATOR 29 occlusion.&</ (occlusion.box3d, occlusion.box3d),
    OPERATOR 30 occlusion.<</ (occlusion.box3d, occlusion.box3d),
    OPERATOR 31 occlusion./>> (occlusion.box3d, occlusion.box3d),
    OPERATOR 32 occlusion./&> (occlusion.box3d, occlusion.box3d),
    FUNCTION 11 (occlusion.box3d, occlusion.box3d) occlusion.box3d_gist_sortsupport(internal);
COMMENT ON OPERATOR CLASS occlusion.box3d_ops USING gist IS
    'boxes in space: overlap, containment, positions, fields of view, nearest first';

-- include sql/31_spgist.sql
-- include sql/32_brin.sql
