-- View cells: boxes of the view region with what can be seen from anywhere in them, and from where a
-- feature can be seen.

-- Adds the tables of view cells to a scene, and the trigger that logs changes of its streets; those on
-- features and what hides in them are there (add_tiles).
CREATE FUNCTION occlusion.add_view_cells(scene text) RETURNS void
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    EXECUTE format($ddl$
        CREATE TABLE %1$I.view_cell (
            id bigint PRIMARY KEY,
            box occlusion.box3d NOT NULL,
            visible occlusion.feature_set NOT NULL,
            unproven occlusion.feature_set NOT NULL
        );
        COMMENT ON TABLE %1$I.view_cell IS 'what can be seen from anywhere in a box of the view region; derived';
        COMMENT ON COLUMN %1$I.view_cell.id IS 'number of the cell: that of its square, times 4194304, and a number in there';
        COMMENT ON COLUMN %1$I.view_cell.box IS 'where eyes are, metres';
        COMMENT ON COLUMN %1$I.view_cell.visible IS 'slots of the features that may be seen from somewhere in the box';
        COMMENT ON COLUMN %1$I.view_cell.unproven IS 'those of them for which no witness was found';

        CREATE TABLE %1$I.view_cell_block (
            id bigint PRIMARY KEY,
            area occlusion.box3d NOT NULL,
            range float8 NOT NULL CHECK (range > 0),
            smallest float8 NOT NULL,
            largest float8 NOT NULL,
            finest float8 NOT NULL,
            done boolean NOT NULL DEFAULT false,
            box occlusion.box3d,
            visible occlusion.feature_set NOT NULL DEFAULT '{}',
            snapshot pg_snapshot,
            cluster bigint,
            seal bytea
        );
        CREATE INDEX view_cell_block_open ON %1$I.view_cell_block (id) WHERE NOT done;
        CREATE INDEX view_cell_block_box ON %1$I.view_cell_block USING gist (box);
        CREATE INDEX view_cell_block_cluster ON %1$I.view_cell_block (cluster);
        CREATE INDEX view_cell_block_visible ON %1$I.view_cell_block USING gin (visible) WITH (fastupdate = off);
        COMMENT ON TABLE %1$I.view_cell_block IS 'squares of the view region, each covered with view cells in one transaction; derived';
        COMMENT ON COLUMN %1$I.view_cell_block.id IS 'number, by its place: along a curve through the plan';
        COMMENT ON COLUMN %1$I.view_cell_block.area IS 'the square, at all heights';
        COMMENT ON COLUMN %1$I.view_cell_block.range IS 'how far eyes see, metres';
        COMMENT ON COLUMN %1$I.view_cell_block.smallest IS 'edge below which no cell is divided, metres';
        COMMENT ON COLUMN %1$I.view_cell_block.largest IS 'longest edge of a cell, metres';
        COMMENT ON COLUMN %1$I.view_cell_block.finest IS 'half edge of the smallest parts of a cell that are told apart, metres';
        COMMENT ON COLUMN %1$I.view_cell_block.done IS 'whether its cells are there';
        COMMENT ON COLUMN %1$I.view_cell_block.box IS 'box around its cells; NULL: it has none yet';
        COMMENT ON COLUMN %1$I.view_cell_block.visible IS 'slots of the features that may be seen from one of its cells';
        COMMENT ON COLUMN %1$I.view_cell_block.snapshot IS 'edits that this snapshot does not show are not in its cells'' sets';
        COMMENT ON COLUMN %1$I.view_cell_block.cluster IS 'system identifier of the cluster whose transactions the snapshot is about';
        COMMENT ON COLUMN %1$I.view_cell_block.seal IS 'digest of what the table seal says and of its cells, which are right for that; NULL: not sealed';

        CREATE TABLE %1$I.seal (
            x bigint,
            y bigint,
            box occlusion.box3d NOT NULL,
            content bytea NOT NULL,
            PRIMARY KEY (x, y)
        );
        COMMENT ON TABLE %1$I.seal IS 'what the scene held when its view cells were sealed, in regions of 128 m; derived';
        COMMENT ON COLUMN %1$I.seal.x IS 'number of the region along x';
        COMMENT ON COLUMN %1$I.seal.y IS 'number of the region along y';
        COMMENT ON COLUMN %1$I.seal.box IS 'box around all features and streets of the region';
        COMMENT ON COLUMN %1$I.seal.content IS 'digest of them';

        CREATE TABLE %1$I.change (
            feature bigint,
            place occlusion.box3d,
            slot integer,
            transaction xid8 NOT NULL DEFAULT pg_current_xact_id()
        );
        ALTER TABLE %1$I.change REPLICA IDENTITY FULL;
        CREATE INDEX change_transaction ON %1$I.change (transaction);
        CREATE INDEX change_place ON %1$I.change USING gist (place);
        CREATE INDEX change_anywhere ON %1$I.change (feature) WHERE place IS NULL;
        COMMENT ON TABLE %1$I.change IS 'log: what was edited since view cells are computed; derived';
        COMMENT ON COLUMN %1$I.change.feature IS 'feature that was edited; NULL: a street';
        COMMENT ON COLUMN %1$I.change.place IS 'box around it before or after; NULL: wherever the feature is';
        COMMENT ON COLUMN %1$I.change.slot IS 'slot of a feature that was deleted: nothing is concerned but cells that see it; NULL: all within range';
        COMMENT ON COLUMN %1$I.change.transaction IS 'which transaction did it';

        CREATE TRIGGER log_edit_after AFTER INSERT OR UPDATE OR DELETE ON %1$I.street
            FOR EACH ROW EXECUTE FUNCTION occlusion.log_edit();
        CREATE TRIGGER log_truncate AFTER TRUNCATE ON %1$I.street
            FOR EACH STATEMENT EXECUTE FUNCTION occlusion.log_edit();
        ALTER TABLE %1$I.street ENABLE ALWAYS TRIGGER log_edit_after;
        ALTER TABLE %1$I.street ENABLE ALWAYS TRIGGER log_truncate;
    $ddl$, scene);
END
$$;
COMMENT ON FUNCTION occlusion.add_view_cells(text) IS
    'adds the tables of view cells to a scene, and the trigger that logs changes of streets';

CREATE PROCEDURE occlusion.generate_view_cells(scene text, range float8 DEFAULT 500,
                                               smallest float8 DEFAULT 4, largest float8 DEFAULT 16,
                                               finest float8 DEFAULT 0.25)
LANGUAGE c AS 'MODULE_PATHNAME', 'generate_view_cells_wrapper';
COMMENT ON PROCEDURE occlusion.generate_view_cells(text, float8, float8, float8, float8) IS
    'computes what can be seen from every part of the streets; goes on where it was interrupted, and shares the work with other sessions that call it; range: how far eyes see, smallest and largest: edges of cells, finest: half edge of the smallest parts of a cell that are told apart, all in metres';

CREATE PROCEDURE occlusion.refresh(scene text)
LANGUAGE c AS 'MODULE_PATHNAME', 'refresh_wrapper';
COMMENT ON PROCEDURE occlusion.refresh(text) IS
    'brings tiles and view cells up to date with the edits since they were computed: computes only what these concern';

-- Whether a square b is right under the snapshot of the query: no edit that the query sees and its cells do not
-- is in it, where eyes may be now that could not be, or near it. What is not seen from its cells is not missed when
-- it is deleted. Edits without a place are looked through, and not the features nearby, which are many more as a
-- rule. It is only asked where the cluster is the one whose transactions the square names.
-- Without edits nothing is looked up; and the planner makes no joins of it, which would ask for each cell again.
CREATE FUNCTION occlusion.valid_cells_condition(scene text) RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT format($q$
        ((SELECT NOT EXISTS (SELECT FROM %1$I.change)) OR NOT EXISTS (
            SELECT FROM %1$I.change AS e
            WHERE e.place OPERATOR(occlusion.&&) occlusion.expand(b.area, b.range)
              AND (e.place OPERATOR(occlusion.&&) b.area
                   OR e.feature IS NOT NULL
                      AND (e.slot IS NULL OR b.visible OPERATOR(occlusion.@>) e.slot::pg_catalog.int8))
              AND NOT pg_catalog.pg_visible_in_snapshot(e.transaction, b.snapshot)
        ) AND NOT EXISTS (
            SELECT FROM %1$I.change AS e
            WHERE e.place IS NULL AND NOT pg_catalog.pg_visible_in_snapshot(e.transaction, b.snapshot)
              AND (SELECT f.envelope FROM %1$I.feature AS f WHERE f.id OPERATOR(pg_catalog.=) e.feature)
                      OPERATOR(occlusion.&&) occlusion.expand(b.area, b.range)
        ))
    $q$, scene)
$$;
COMMENT ON FUNCTION occlusion.valid_cells_condition(text) IS
    'the condition that the view cells of a square, b, are there wherever eyes can be, and hold what can be seen now';

-- That a cell c is one of a square b.
CREATE FUNCTION occlusion.cell_in_block_condition() RETURNS text
LANGUAGE sql IMMUTABLE PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT $q$
        c.id OPERATOR(pg_catalog.>=) (b.id OPERATOR(pg_catalog.<<) 22)
        AND c.id OPERATOR(pg_catalog.<) ((b.id OPERATOR(pg_catalog.+) 1) OPERATOR(pg_catalog.<<) 22)
    $q$
$$;
COMMENT ON FUNCTION occlusion.cell_in_block_condition() IS 'the condition that a view cell, c, is one of a square, b';

-- The cells that hold an eye, $1, in a cluster, $2, and are right; none where the eye is not in the view
-- region, or within a millimetre of a solid. No index is to answer for the cluster: nearly all squares are of one,
-- and without statistics the planner takes them for few.
CREATE FUNCTION occlusion.view_cell_statement(scene text) RETURNS text
LANGUAGE sql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT format($q$
        SELECT c.visible::occlusion.feature_set, c.box::occlusion.box3d, b.range::pg_catalog.float8,
               c.id::pg_catalog.int8, b.snapshot::pg_catalog.pg_snapshot
        FROM %1$I.view_cell_block AS b JOIN %1$I.view_cell AS c ON %4$s
        WHERE b.box OPERATOR(occlusion.@>) $1 AND c.box OPERATOR(occlusion.@>) $1
          AND (b.cluster OPERATOR(pg_catalog.=) $2) IS TRUE AND %2$s AND (SELECT %3$s)
        LIMIT 1
    $q$, scene, occlusion.valid_cells_condition(scene), occlusion.is_eye_condition(scene),
         occlusion.cell_in_block_condition())
$$;
COMMENT ON FUNCTION occlusion.view_cell_statement(text) IS 'the statement that finds the view cell of an eye';

CREATE FUNCTION occlusion.visible_set(scene text, observer occlusion.point3d)
RETURNS TABLE (visible occlusion.feature_set, box occlusion.box3d, range float8)
LANGUAGE c STABLE STRICT PARALLEL SAFE ROWS 1 COST 1000
AS 'MODULE_PATHNAME', 'visible_set_wrapper';
COMMENT ON FUNCTION occlusion.visible_set(text, occlusion.point3d) IS
    'slots of all features that may be seen from anywhere in a box around the observer, out to a range; no row where no view cell is known to be right';

CREATE FUNCTION occlusion.visible_set_change(scene text, origin occlusion.point3d, destination occlusion.point3d)
RETURNS TABLE (appearing occlusion.feature_set, disappearing occlusion.feature_set,
               box occlusion.box3d, range float8)
LANGUAGE sql STABLE STRICT PARALLEL SAFE ROWS 1
BEGIN ATOMIC
    SELECT there.visible OPERATOR(occlusion.-) here.visible, here.visible OPERATOR(occlusion.-) there.visible,
           there.box, there.range
    FROM occlusion.visible_set(scene, origin) AS here
    CROSS JOIN occlusion.visible_set(scene, destination) AS there;
END;
COMMENT ON FUNCTION occlusion.visible_set_change(text, occlusion.point3d, occlusion.point3d) IS
    'which features to load and which to drop when an observer goes from one view cell to another; no row where one of them is not known to be right';

CREATE FUNCTION occlusion.cluster_identity() RETURNS bigint
LANGUAGE c STABLE PARALLEL SAFE AS 'MODULE_PATHNAME', 'cluster_identity_wrapper';
COMMENT ON FUNCTION occlusion.cluster_identity() IS
    'system identifier of the cluster, outside of which its transaction ids mean nothing';

-- A table that view cells rest on and of which row security hides rows from the current user.
CREATE FUNCTION occlusion.hidden_source(scene text) RETURNS text
LANGUAGE sql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp
BEGIN ATOMIC
    SELECT source
    FROM unnest(ARRAY['feature', 'solid_column', 'inner_envelope', 'mesh', 'street',
                      'view_cell', 'view_cell_block', 'change']) WITH ORDINALITY AS s (source, number)
    WHERE row_security_active(format('%I.%I', scene, source))
    ORDER BY number LIMIT 1;
END;
COMMENT ON FUNCTION occlusion.hidden_source(text) IS
    'the first table that view cells rest on and of which row security hides rows from the current user; NULL if there is none';

-- Raises an error where row security would hide features, cells or changes from the current user.
CREATE FUNCTION occlusion.require_all_cells(scene text) RETURNS void
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    source text;
BEGIN
    PERFORM occlusion.require_scene(scene);
    IF to_regclass(format('%I.view_cell', scene)) IS NULL THEN
        RAISE EXCEPTION 'scene "%" has no tables of view cells', scene
            USING ERRCODE = 'object_not_in_prerequisite_state',
                  HINT = format('An older version made it: SELECT occlusion.upgrade_scene(%L) adds them.', scene);
    END IF;
    source := occlusion.hidden_source(scene);
    IF source IS NOT NULL THEN
        RAISE EXCEPTION 'row security hides rows of %.%', quote_ident(scene), source
            USING ERRCODE = 'insufficient_privilege',
                  DETAIL = 'View cells speak of all features.',
                  HINT = 'Ask visible_features, which is answered live then.';
    END IF;
END
$$;
COMMENT ON FUNCTION occlusion.require_all_cells(text) IS
    'raises an error unless the current user sees all features, view cells and changes of a scene';

CREATE FUNCTION occlusion.visible_from(scene text, feature_id bigint)
RETURNS TABLE (box occlusion.box3d, proven boolean)
LANGUAGE c STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
AS 'MODULE_PATHNAME', 'visible_from_wrapper';
COMMENT ON FUNCTION occlusion.visible_from(text, bigint) IS
    'boxes of the streets from somewhere in which a feature may be seen; proven: there is a witness that it can';

CREATE FUNCTION occlusion.visible_from_area(scene text, feature_id bigint)
RETURNS TABLE (area polygon[], proven boolean)
LANGUAGE c STABLE STRICT PARALLEL SAFE ROWS 10 COST 20000
AS 'MODULE_PATHNAME', 'visible_from_area_wrapper';
COMMENT ON FUNCTION occlusion.visible_from_area(text, bigint) IS
    'the plan of the boxes of visible_from as polygons, an outer ring and holes each: those in which every box is proven, and the others';

CREATE FUNCTION occlusion.view_cells(scene text)
RETURNS TABLE (cell bigint, box occlusion.box3d, range float8, visible bigint, proven bigint, share float8)
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE COST 100000
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_all_cells(scene);
    RETURN QUERY EXECUTE format($q$
        SELECT c.id, c.box, b.range, n.visible, n.visible - n.unproven,
               (n.visible - n.unproven)::float8 / nullif(n.visible, 0)
        FROM %1$I.view_cell_block AS b JOIN %1$I.view_cell AS c ON %3$s
        CROSS JOIN LATERAL (
            SELECT occlusion.cardinality(c.visible), occlusion.cardinality(c.unproven)
        ) AS n (visible, unproven)
        WHERE b.cluster = $1 AND %2$s
    $q$, scene, occlusion.valid_cells_condition(scene), occlusion.cell_in_block_condition())
    USING occlusion.cluster_identity();
END
$$;
COMMENT ON FUNCTION occlusion.view_cells(text) IS
    'the view cells that are right: how many features may be seen from each, of how many it is proven that they can, and what share that is';

CREATE FUNCTION occlusion.proven_share(scene text) RETURNS float8
LANGUAGE sql STABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
    SELECT (sum(c.proven) / nullif(sum(c.visible), 0))::float8 FROM occlusion.view_cells(scene) AS c;
END;
COMMENT ON FUNCTION occlusion.proven_share(text) IS
    'of all that may be seen from the view cells of a scene, the share that is proven; NULL where no cell is right';

CREATE FUNCTION occlusion.witnesses(scene text, cell bigint)
RETURNS TABLE (feature_id bigint, eye occlusion.point3d, target occlusion.point3d)
LANGUAGE c VOLATILE STRICT ROWS 100 COST 100000
AS 'MODULE_PATHNAME', 'witnesses_wrapper';
COMMENT ON FUNCTION occlusion.witnesses(text, bigint) IS
    'for each feature that is proven to be visible from a view cell: an eye in the cell, and the end of a line from there that crosses the surface of the feature and meets no other; NULL where none is found any more';

CREATE FUNCTION occlusion.landmarks(scene text)
RETURNS TABLE (feature_id bigint, class text, cells bigint, share float8)
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE COST 100000
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_all_cells(scene);
    RETURN QUERY EXECUTE format($q$
        WITH cell AS (
            SELECT c.visible, occlusion.x(occlusion.size(c.box)) * occlusion.y(occlusion.size(c.box)) AS area
            FROM %1$I.view_cell_block AS b JOIN %1$I.view_cell AS c ON %3$s
            WHERE b.cluster = $1 AND %2$s
        ), seen AS (
            SELECT s.slot, count(*) AS cells, sum(c.area) AS area
            FROM cell AS c CROSS JOIN LATERAL occlusion.unnest(c.visible) AS s (slot) GROUP BY s.slot
        )
        SELECT f.id, f.class, s.cells, s.area / (SELECT sum(c.area) FROM cell AS c)
        FROM seen AS s JOIN %1$I.feature AS f ON f.slot = s.slot
        ORDER BY s.area DESC, f.id
    $q$, scene, occlusion.valid_cells_condition(scene), occlusion.cell_in_block_condition())
    USING occlusion.cluster_identity();
END
$$;
COMMENT ON FUNCTION occlusion.landmarks(text) IS
    'features by the share of the plan of all view cells from which they may be seen, the most visible first';
