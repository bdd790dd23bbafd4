-- GiST for box3d. Keys are the boxes themselves, so scans need no recheck and may be index-only.

CREATE FUNCTION occlusion.box3d_gist_consistent(internal, occlusion.box3d, smallint, oid, internal) RETURNS boolean
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_consistent_wrapper';
CREATE FUNCTION occlusion.box3d_gist_union(internal, internal) RETURNS occlusion.box3d
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_union_wrapper';
CREATE FUNCTION occlusion.box3d_gist_penalty(internal, internal, internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_penalty_wrapper';
CREATE FUNCTION occlusion.box3d_gist_picksplit(internal, internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_picksplit_wrapper';
CREATE FUNCTION occlusion.box3d_gist_same(occlusion.box3d, occlusion.box3d, internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_same_wrapper';
CREATE FUNCTION occlusion.box3d_gist_distance(internal, occlusion.box3d, smallint, oid, internal) RETURNS float8
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_distance_wrapper';
CREATE FUNCTION occlusion.box3d_gist_fetch(internal) RETURNS internal
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_fetch_wrapper';
CREATE FUNCTION occlusion.box3d_gist_sortsupport(internal) RETURNS void
    LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'box3d_gist_sortsupport_wrapper';
COMMENT ON FUNCTION occlusion.box3d_gist_sortsupport(internal) IS 'GiST support: order of a sorted build';

CREATE OPERATOR CLASS occlusion.box3d_ops DEFAULT FOR TYPE occlusion.box3d USING gist AS
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
    FUNCTION 1 occlusion.box3d_gist_consistent(internal, occlusion.box3d, smallint, oid, internal),
    FUNCTION 2 occlusion.box3d_gist_union(internal, internal),
    FUNCTION 5 occlusion.box3d_gist_penalty(internal, internal, internal),
    FUNCTION 6 occlusion.box3d_gist_picksplit(internal, internal),
    FUNCTION 7 occlusion.box3d_gist_same(occlusion.box3d, occlusion.box3d, internal),
    FUNCTION 8 (occlusion.box3d, occlusion.box3d) occlusion.box3d_gist_distance(internal, occlusion.box3d, smallint, oid, internal),
    FUNCTION 9 (occlusion.box3d, occlusion.box3d) occlusion.box3d_gist_fetch(internal),
    FUNCTION 11 (occlusion.box3d, occlusion.box3d) occlusion.box3d_gist_sortsupport(internal);
COMMENT ON OPERATOR CLASS occlusion.box3d_ops USING gist IS
    'boxes in space: overlap, containment, positions, fields of view, nearest first';
