-- What a scene holds, and what of it is up to date.

CREATE FUNCTION occlusion.scene_status(scene text)
RETURNS TABLE (features bigint, solid_columns bigint, models bigint, streets bigint, occlusion_volumes bigint,
               tiles bigint, edits bigint, squares bigint, right_squares bigint, right_share float8,
               view_cells bigint, proven_share float8, changes bigint, computed timestamptz, bytes numeric)
LANGUAGE plpgsql STABLE STRICT ROWS 1 COST 100000
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    has_tiles boolean := to_regclass(format('%I.tile', scene)) IS NOT NULL;
    has_cells boolean := to_regclass(format('%I.view_cell', scene)) IS NOT NULL;
BEGIN
    PERFORM occlusion.require_scene(scene);
    EXECUTE format($q$
        SELECT (SELECT count(*) FROM %1$I.feature), (SELECT count(*) FROM %1$I.solid_column),
               (SELECT count(*) FROM %1$I.model), (SELECT count(*) FROM %1$I.street),
               (SELECT count(*) FROM %1$I.occlusion_volume),
               (SELECT sum(pg_total_relation_size(c.oid)) FROM pg_class AS c
                WHERE c.relnamespace = %2$L::regnamespace AND c.relkind = 'r')
    $q$, scene, quote_ident(scene))
    INTO features, solid_columns, models, streets, occlusion_volumes, bytes;
    IF has_tiles THEN
        EXECUTE format('SELECT (SELECT count(*) FROM %1$I.tile), (SELECT count(*) FROM %1$I.edit)', scene)
        INTO tiles, edits;
    END IF;
    IF has_cells AND occlusion.hidden_source(scene) IS NULL THEN
        EXECUTE format($q$
            SELECT count(*), count(*) FILTER (WHERE b.done AND b.cluster = $1 AND %2$s)
            FROM %1$I.view_cell_block AS b
        $q$, scene, occlusion.valid_cells_condition(scene))
        INTO squares, right_squares USING occlusion.cluster_identity();
        right_share := right_squares / nullif(squares, 0)::float8;
        SELECT count(*), (sum(c.proven) / nullif(sum(c.visible), 0))::float8
        INTO view_cells, proven_share FROM occlusion.view_cells(scene) AS c;
        EXECUTE format($q$
            SELECT (SELECT count(*) FROM %1$I.change),
                   (SELECT j.updated FROM %1$I.job AS j WHERE j.task = 'generate_view_cells' AND j.finished)
        $q$, scene)
        INTO changes, computed;
    END IF;
    RETURN NEXT;
END
$$;
COMMENT ON FUNCTION occlusion.scene_status(text) IS
    'what a scene holds, and what is up to date: edits since its tiles were packed, squares whose view cells are right and what share these are, changes that are logged, when view cells were computed last; NULL where a scene of an older version lacks a table, or where row security hides from the caller what cells rest on';
