-- Packed tiles: the features of a scene as visibility queries read them, and the log of edits since.

CREATE FUNCTION occlusion.log_edit() RETURNS trigger
LANGUAGE c AS 'MODULE_PATHNAME', 'log_edit_wrapper';
COMMENT ON FUNCTION occlusion.log_edit() IS
    'trigger: logs which features were edited, and where, for queries to read them from the tables';

-- Adds the tables of tiles and edits to a scene, with the triggers that keep the log.
CREATE FUNCTION occlusion.add_tiles(scene text) RETURNS void
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    source text;
    moment text;
BEGIN
    EXECUTE format($ddl$
        CREATE TABLE %1$I.tile (
            id bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
            bounds occlusion.box3d NOT NULL,
            features integer NOT NULL,
            version uuid NOT NULL DEFAULT gen_random_uuid(),
            content bytea NOT NULL
        );
        ALTER TABLE %1$I.tile ALTER content SET STORAGE EXTERNAL;
        CREATE INDEX tile_bounds ON %1$I.tile USING gist (bounds);
        COMMENT ON TABLE %1$I.tile IS 'neighbourhoods of features with what hides in them, packed; derived';
        COMMENT ON COLUMN %1$I.tile.id IS 'number of the tile';
        COMMENT ON COLUMN %1$I.tile.bounds IS 'smallest box that holds the outer envelopes of its features, metres';
        COMMENT ON COLUMN %1$I.tile.features IS 'how many features it holds';
        COMMENT ON COLUMN %1$I.tile.version IS 'what no other tile ever has: a backend knows its copies by it';
        COMMENT ON COLUMN %1$I.tile.content IS 'the features, packed';

        CREATE TABLE %1$I.edit (
            feature bigint NOT NULL,
            place occlusion.box3d
        );
        ALTER TABLE %1$I.edit REPLICA IDENTITY FULL;
        CREATE INDEX edit_place ON %1$I.edit USING gist (place);
        CREATE INDEX edit_anywhere ON %1$I.edit (feature) WHERE place IS NULL;
        COMMENT ON TABLE %1$I.edit IS 'log: features edited since the tiles were packed; derived';
        COMMENT ON COLUMN %1$I.edit.feature IS 'feature that was edited';
        COMMENT ON COLUMN %1$I.edit.place IS 'outer envelope before or after; NULL: wherever it is';
    $ddl$, scene);
    FOREACH source IN ARRAY ARRAY['feature', 'solid_column', 'inner_envelope', 'mesh'] LOOP
        FOREACH moment IN ARRAY ARRAY['before', 'after'] LOOP
            EXECUTE format($ddl$
                CREATE TRIGGER log_edit_%2$s %2$s INSERT OR UPDATE OR DELETE ON %1$I.%3$I
                    FOR EACH ROW EXECUTE FUNCTION occlusion.log_edit();
                ALTER TABLE %1$I.%3$I ENABLE ALWAYS TRIGGER log_edit_%2$s;
            $ddl$, scene, moment, source);
        END LOOP;
        EXECUTE format($ddl$
            CREATE TRIGGER log_truncate AFTER TRUNCATE ON %1$I.%2$I
                FOR EACH STATEMENT EXECUTE FUNCTION occlusion.log_edit();
            ALTER TABLE %1$I.%2$I ENABLE ALWAYS TRIGGER log_truncate;
        $ddl$, scene, source);
    END LOOP;
END
$$;
COMMENT ON FUNCTION occlusion.add_tiles(text) IS
    'adds the tables of tiles and edits to a scene, and the triggers that keep the log';

CREATE FUNCTION occlusion.pack_tiles(scene text, optional boolean DEFAULT false) RETURNS bigint
LANGUAGE c VOLATILE STRICT SET search_path = pg_catalog, pg_temp
AS 'MODULE_PATHNAME', 'pack_tiles_wrapper';
COMMENT ON FUNCTION occlusion.pack_tiles(text, boolean) IS
    'packs the features of a scene as tiles, or those edited since with their neighbours, so that queries are fast; optional: where it cannot be done now, a notice and no error; returns how many tiles were written';

CREATE FUNCTION occlusion.upgrade_scene(scene text) RETURNS boolean
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    format integer;
BEGIN
    PERFORM occlusion.require_scene(scene);
    EXECUTE format('SELECT format_version FROM %I.scene_info FOR UPDATE', scene) INTO format;
    IF format > 2 THEN
        RAISE EXCEPTION 'scene "%" is of format %', scene, format
            USING ERRCODE = 'feature_not_supported',
                  DETAIL = 'This version knows formats up to 2.',
                  HINT = 'ALTER EXTENSION pg_occlusion UPDATE brings the version that made it.';
    END IF;
    IF format = 2 THEN
        RETURN false;
    END IF;
    PERFORM occlusion.add_tiles(scene);
    PERFORM occlusion.add_view_cells(scene);
    PERFORM occlusion.add_replica_triggers(scene);
    EXECUTE format('UPDATE %I.scene_info SET format_version = 2', scene);
    PERFORM occlusion.pack_tiles(scene, optional => true);
    RETURN true;
END
$$;
COMMENT ON FUNCTION occlusion.upgrade_scene(text) IS
    'brings a scene that an older version made to the tables of this one; returns whether it was older';
