-- What is derived, where rows arrive by logical replication. Tables arrive one after the other at first, some may not be
-- published, and others may be written here: what is derived there need not be what the tables hold here.

-- Trigger, fired by rows that arrive and by nothing else. Tiles, volumes and logs are each server's own: its triggers
-- write the logs, and a query reads the tables until tiles are packed here. A truncation cannot be passed over; without
-- their log tiles and cells say nothing.
CREATE FUNCTION occlusion.pass_over() RETURNS trigger
LANGUAGE plpgsql SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    IF TG_OP = 'TRUNCATE' THEN
        IF TG_TABLE_NAME = 'edit' THEN
            EXECUTE format('DELETE FROM %I.tile', TG_TABLE_SCHEMA);
        ELSIF TG_TABLE_NAME = 'change' THEN
            EXECUTE format('DELETE FROM %I.view_cell_block', TG_TABLE_SCHEMA);
        END IF;
    END IF;
    RETURN NULL;
END
$$;
COMMENT ON FUNCTION occlusion.pass_over() IS
    'trigger: passes over what arrives by logical replication where each server has its own';

-- Trigger, fired by the same. View cells that arrive are nobody's here until restamp_view_cells proves them, even where
-- both servers have one identifier, as copies of one cluster have. What arrives takes the place of what is here.
CREATE FUNCTION occlusion.receive_cells() RETURNS trigger
LANGUAGE plpgsql SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    IF TG_TABLE_NAME = 'seal' THEN
        IF TG_OP = 'INSERT' THEN
            EXECUTE format('DELETE FROM %I.seal WHERE x = $1 AND y = $2', TG_TABLE_SCHEMA) USING NEW.x, NEW.y;
        END IF;
    ELSIF TG_TABLE_NAME = 'view_cell_block' THEN
        IF TG_OP = 'INSERT' THEN
            EXECUTE format('DELETE FROM %I.view_cell_block WHERE id = $1', TG_TABLE_SCHEMA) USING NEW.id;
        END IF;
        IF TG_OP <> 'DELETE' AND NEW.cluster = occlusion.cluster_identity() THEN
            NEW.cluster := 0;
        END IF;
    ELSE
        EXECUTE format('UPDATE %I.view_cell_block SET cluster = 0 WHERE id = $1 >> 22 AND cluster = $2', TG_TABLE_SCHEMA)
            USING coalesce(NEW.id, OLD.id), occlusion.cluster_identity();
        IF TG_OP = 'INSERT' THEN
            EXECUTE format('DELETE FROM %I.view_cell WHERE id = $1', TG_TABLE_SCHEMA) USING NEW.id;
        END IF;
    END IF;
    RETURN CASE WHEN TG_OP = 'DELETE' THEN OLD ELSE NEW END;
END
$$;
COMMENT ON FUNCTION occlusion.receive_cells() IS
    'trigger: keeps view cells that arrive by logical replication out of use until they are restamped';

-- What other triggers write here is not what arrives: they run at a depth.
CREATE FUNCTION occlusion.add_replica_triggers(scene text) RETURNS void
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    derived text;
BEGIN
    FOREACH derived IN ARRAY ARRAY['tile', 'edit', 'change', 'occlusion_volume', 'job',
                                   'view_cell', 'view_cell_block', 'seal'] LOOP
        EXECUTE format($ddl$
            CREATE TRIGGER receive BEFORE INSERT OR UPDATE OR DELETE ON %1$I.%2$I
                FOR EACH ROW WHEN (pg_catalog.pg_trigger_depth() = 0) EXECUTE FUNCTION occlusion.%3$s();
            ALTER TABLE %1$I.%2$I ENABLE REPLICA TRIGGER receive;
        $ddl$, scene, derived,
            CASE WHEN derived IN ('view_cell', 'view_cell_block', 'seal') THEN 'receive_cells' ELSE 'pass_over' END);
        IF derived IN ('edit', 'change') THEN
            EXECUTE format($ddl$
                CREATE TRIGGER receive_truncate BEFORE TRUNCATE ON %1$I.%2$I
                    FOR EACH STATEMENT WHEN (pg_catalog.pg_trigger_depth() = 0) EXECUTE FUNCTION occlusion.pass_over();
                ALTER TABLE %1$I.%2$I ENABLE REPLICA TRIGGER receive_truncate;
            $ddl$, scene, derived);
        END IF;
    END LOOP;
    -- These have no key, and a published table whose rows are deleted needs something to find them by.
    EXECUTE format($ddl$
        ALTER TABLE %1$I.occlusion_volume REPLICA IDENTITY FULL;
        ALTER TABLE %1$I.import_remark REPLICA IDENTITY FULL;
    $ddl$, scene);
END
$$;
COMMENT ON FUNCTION occlusion.add_replica_triggers(text) IS
    'adds to a scene the triggers that keep apart what each server derives, where rows arrive by logical replication';
