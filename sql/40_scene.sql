-- Scenes: a schema of ordinary tables for each city. CREATE OR REPLACE, since upgrades run this file too.

-- What every scene holds: the tables and the columns that functions read, with their types. Scenes of
-- format 1 have nothing from "tile" on.
CREATE OR REPLACE FUNCTION occlusion.scene_columns()
RETURNS TABLE (table_name name, column_name name, type_name text)
LANGUAGE sql IMMUTABLE PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    VALUES
        ('scene_info', 'format_version', 'integer'),
        ('scene_info', 'srid', 'integer'),
        ('scene_info', 'attribution', 'text'),
        ('feature', 'id', 'bigint'),
        ('feature', 'class', 'text'),
        ('feature', 'envelope', 'occlusion.box3d'),
        ('feature', 'name', 'text'),
        ('feature', 'slot', 'integer'),
        ('feature', 'outline', 'polygon'),
        ('feature', 'attributes', 'jsonb'),
        ('mesh', 'feature', 'bigint'),
        ('mesh', 'level_of_detail', 'double precision'),
        ('mesh', 'vertices', 'double precision[]'),
        ('mesh', 'triangles', 'integer[]'),
        ('mesh', 'defect', 'text'),
        ('mesh', 'repair', 'text'),
        ('mesh', 'repair_triangles', 'integer'),
        ('shape', 'digest', 'bytea'),
        ('shape', 'content', 'bytea'),
        ('model', 'feature', 'bigint'),
        ('model', 'level_of_detail', 'double precision'),
        ('model', 'format', 'text'),
        ('model', 'content', 'bytea'),
        ('model', 'shape', 'bytea'),
        ('model', 'placement', 'double precision[]'),
        ('model', 'geometric_error', 'double precision'),
        ('inner_envelope', 'feature', 'bigint'),
        ('inner_envelope', 'box', 'occlusion.box3d'),
        ('inner_envelope', 'grounded', 'boolean'),
        ('solid_column', 'feature', 'bigint'),
        ('solid_column', 'footprint', 'polygon[]'),
        ('solid_column', 'bottom', 'double precision'),
        ('solid_column', 'top', 'double precision'),
        ('solid_column', 'grounded', 'boolean'),
        ('solid_column', 'envelope', 'occlusion.box3d'),
        ('street', 'area', 'polygon[]'),
        ('street', 'eye_low', 'double precision'),
        ('street', 'eye_high', 'double precision'),
        ('street', 'envelope', 'occlusion.box3d'),
        ('occlusion_volume', 'occluder', 'bigint'),
        ('occlusion_volume', 'occludee', 'bigint'),
        ('occlusion_volume', 'box', 'occlusion.box3d'),
        ('import_remark', 'remark', 'text'),
        ('job', 'task', 'text'),
        ('tile', 'id', 'bigint'),
        ('tile', 'bounds', 'occlusion.box3d'),
        ('tile', 'version', 'uuid'),
        ('tile', 'content', 'bytea'),
        ('edit', 'feature', 'bigint'),
        ('edit', 'place', 'occlusion.box3d'),
        ('view_cell', 'id', 'bigint'),
        ('view_cell', 'box', 'occlusion.box3d'),
        ('view_cell', 'visible', 'occlusion.feature_set'),
        ('view_cell', 'unproven', 'occlusion.feature_set'),
        ('view_cell_block', 'id', 'bigint'),
        ('view_cell_block', 'area', 'occlusion.box3d'),
        ('view_cell_block', 'range', 'double precision'),
        ('view_cell_block', 'box', 'occlusion.box3d'),
        ('view_cell_block', 'visible', 'occlusion.feature_set'),
        ('view_cell_block', 'snapshot', 'pg_snapshot'),
        ('view_cell_block', 'cluster', 'bigint'),
        ('view_cell_block', 'seal', 'bytea'),
        ('seal', 'x', 'bigint'),
        ('seal', 'y', 'bigint'),
        ('seal', 'box', 'occlusion.box3d'),
        ('seal', 'content', 'bytea'),
        ('change', 'feature', 'bigint'),
        ('change', 'place', 'occlusion.box3d'),
        ('change', 'slot', 'integer'),
        ('change', 'transaction', 'xid8')
$$;
COMMENT ON FUNCTION occlusion.scene_columns() IS 'the tables of a scene and the columns that functions read';

-- Raises an error unless the schema is a scene made of real tables. Functions call it before they
-- read a scene, so that no view, foreign table or type of somebody else's making runs in its place.
CREATE OR REPLACE FUNCTION occlusion.require_scene(scene text) RETURNS void
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    namespace oid;
    wrong record;
BEGIN
    IF octet_length(scene) > 63 THEN
        RAISE EXCEPTION 'scene name "%" is too long', scene
            USING ERRCODE = 'name_too_long',
                  DETAIL = format('The name has %s bytes; at most 63 are allowed.', octet_length(scene));
    END IF;
    SELECT n.oid INTO namespace FROM pg_catalog.pg_namespace AS n WHERE n.nspname = scene;
    IF namespace IS NULL THEN
        RAISE EXCEPTION 'scene "%" does not exist', scene
            USING ERRCODE = 'invalid_schema_name',
                  HINT = format('Make it with SELECT occlusion.create_scene(%L).', scene);
    END IF;
    IF NOT EXISTS (SELECT FROM pg_catalog.pg_class AS c
                   WHERE c.relnamespace = namespace AND c.relname = 'scene_info') THEN
        RAISE EXCEPTION 'schema "%" is not a scene', scene
            USING ERRCODE = 'wrong_object_type',
                  DETAIL = 'It has no table scene_info.',
                  HINT = 'A scene is made by occlusion.create_scene.';
    END IF;
    SELECT e.table_name, e.column_name, e.type_name, c.relkind,
           format_type(a.atttypid, a.atttypmod) AS found
      INTO wrong
      FROM occlusion.scene_columns() AS e
      LEFT JOIN pg_catalog.pg_class AS c ON c.relnamespace = namespace AND c.relname = e.table_name
      LEFT JOIN pg_catalog.pg_attribute AS a
             ON a.attrelid = c.oid AND a.attname = e.column_name AND NOT a.attisdropped
     WHERE (c.relkind IS NULL OR c.relkind NOT IN ('r', 'p')
            OR format_type(a.atttypid, a.atttypmod) IS DISTINCT FROM e.type_name)
       AND NOT (c.relkind IS NULL
                AND e.table_name IN ('tile', 'edit', 'view_cell', 'view_cell_block', 'change', 'seal'))
     LIMIT 1;
    IF FOUND THEN
        RAISE EXCEPTION 'scene "%" is damaged', scene
            USING ERRCODE = 'wrong_object_type',
                  DETAIL = CASE
                      WHEN wrong.relkind IS NULL THEN
                          format('Table "%s" is missing.', wrong.table_name)
                      WHEN wrong.relkind NOT IN ('r', 'p') THEN
                          format('"%s" is not a table.', wrong.table_name)
                      ELSE format('Column "%s" of table "%s" must be of type %s, not %s.',
                                  wrong.column_name, wrong.table_name, wrong.type_name,
                                  coalesce(wrong.found, 'missing'))
                  END,
                  HINT = 'Only real tables of a scene are read, never views in their place.';
    END IF;
END
$$;
COMMENT ON FUNCTION occlusion.require_scene(text) IS 'raises an error unless a schema is a scene of real tables';

CREATE OR REPLACE FUNCTION occlusion.create_scene(scene text, srid integer DEFAULT 0) RETURNS void
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    s text := quote_ident(scene);
BEGIN
    IF octet_length(scene) > 63 THEN
        RAISE EXCEPTION 'scene name "%" is too long', scene
            USING ERRCODE = 'name_too_long',
                  DETAIL = format('The name has %s bytes; at most 63 are allowed.', octet_length(scene));
    END IF;
    IF EXISTS (SELECT FROM pg_catalog.pg_namespace AS n WHERE n.nspname = scene) THEN
        RAISE EXCEPTION 'schema "%" already exists', scene
            USING ERRCODE = 'duplicate_schema',
                  HINT = format('If it is a scene, SELECT occlusion.drop_scene(%L) removes it.', scene);
    END IF;
    EXECUTE format('CREATE SCHEMA %s', s);
    EXECUTE format('COMMENT ON SCHEMA %s IS %L', s, 'a scene of pg_occlusion');

    EXECUTE format($ddl$
        CREATE TABLE %1$s.scene_info (
            singleton boolean PRIMARY KEY DEFAULT true CHECK (singleton),
            format_version integer NOT NULL,
            srid integer NOT NULL,
            ground float8,
            attribution text
        );
        COMMENT ON TABLE %1$s.scene_info IS 'one row; marks this schema as a scene';
        COMMENT ON COLUMN %1$s.scene_info.singleton IS 'keeps it one row';
        COMMENT ON COLUMN %1$s.scene_info.format_version IS 'version of the layout of these tables';
        COMMENT ON COLUMN %1$s.scene_info.srid IS 'EPSG code of the projected frame, 0 if unknown';
        COMMENT ON COLUMN %1$s.scene_info.ground IS 'height of level ground in metres; NULL: from the feet of near features';
        COMMENT ON COLUMN %1$s.scene_info.attribution IS 'whom to credit for the data';
        INSERT INTO %1$s.scene_info (format_version, srid) VALUES (2, %2$s);

        CREATE TABLE %1$s.feature (
            id bigint GENERATED BY DEFAULT AS IDENTITY PRIMARY KEY,
            name text UNIQUE,
            class text NOT NULL DEFAULT 'Generic',
            envelope occlusion.box3d NOT NULL,
            slot integer,
            outline polygon,
            attributes jsonb
        );
        CREATE INDEX feature_envelope ON %1$s.feature USING gist (envelope);
        COMMENT ON TABLE %1$s.feature IS 'one indivisible city object a row';
        COMMENT ON COLUMN %1$s.feature.id IS 'number of the feature';
        COMMENT ON COLUMN %1$s.feature.name IS 'identifier in the source';
        COMMENT ON COLUMN %1$s.feature.class IS 'kind of object, as the source names it';
        COMMENT ON COLUMN %1$s.feature.envelope IS 'outer envelope: smallest box that holds all of the feature, every level of detail';
        COMMENT ON COLUMN %1$s.feature.slot IS 'position along a space-filling order; internal';
        COMMENT ON COLUMN %1$s.feature.outline IS 'outer prism: convex hull of the footprint, over the heights of the envelope';
        COMMENT ON COLUMN %1$s.feature.attributes IS 'attributes of the source';

        CREATE TABLE %1$s.shape (
            digest bytea PRIMARY KEY,
            content bytea NOT NULL
        );
        COMMENT ON TABLE %1$s.shape IS 'shapes that several models are instances of, each once';
        COMMENT ON COLUMN %1$s.shape.digest IS 'digest of the content';
        COMMENT ON COLUMN %1$s.shape.content IS 'the shape in its own frame, packed';

        CREATE TABLE %1$s.model (
            feature bigint NOT NULL REFERENCES %1$s.feature ON DELETE CASCADE,
            level_of_detail float8 NOT NULL,
            format text NOT NULL,
            content bytea,
            shape bytea REFERENCES %1$s.shape,
            placement float8[] CHECK (cardinality(placement) = 12),
            geometric_error float8,
            PRIMARY KEY (feature, level_of_detail, format),
            CHECK ((content IS NULL) <> (shape IS NULL)),
            CHECK ((shape IS NULL) = (placement IS NULL))
        );
        COMMENT ON TABLE %1$s.model IS 'models of features, by level of detail';
        COMMENT ON COLUMN %1$s.model.feature IS 'feature that it shows';
        COMMENT ON COLUMN %1$s.model.level_of_detail IS 'level of detail; the greatest is the best';
        COMMENT ON COLUMN %1$s.model.format IS 'packed as imports write it, or a file format: glb, vrml97, cityjson, obj, ply';
        COMMENT ON COLUMN %1$s.model.content IS 'the model itself; NULL for an instance of a shape';
        COMMENT ON COLUMN %1$s.model.shape IS 'digest of the shape that this model is an instance of';
        COMMENT ON COLUMN %1$s.model.placement IS 'where the instance goes: three rows of a, b, c, d with x'' = a x + b y + c z + d';
        COMMENT ON COLUMN %1$s.model.geometric_error IS 'greatest distance to the best level of detail in metres, if known';

        CREATE TABLE %1$s.mesh (
            feature bigint PRIMARY KEY REFERENCES %1$s.feature ON DELETE CASCADE,
            level_of_detail float8,
            vertices float8[] NOT NULL,
            triangles integer[] NOT NULL,
            defect text,
            repair text,
            repair_triangles integer NOT NULL DEFAULT 0 CHECK (repair_triangles >= 0)
        );
        COMMENT ON TABLE %1$s.mesh IS 'truth: the triangles of the best level of detail of each feature';
        COMMENT ON COLUMN %1$s.mesh.feature IS 'feature whose surface it is';
        COMMENT ON COLUMN %1$s.mesh.level_of_detail IS 'level of detail that was triangulated';
        COMMENT ON COLUMN %1$s.mesh.vertices IS 'x, y, z of vertex 0, of vertex 1, and so on, metres';
        COMMENT ON COLUMN %1$s.mesh.triangles IS 'three vertices a triangle, counted from 0, anticlockwise seen from outside';
        COMMENT ON COLUMN %1$s.mesh.defect IS 'why the mesh encloses no solid and so hides nothing; NULL if it does';
        COMMENT ON COLUMN %1$s.mesh.repair IS 'what was added to the delivered surface to close it; NULL if nothing was';
        COMMENT ON COLUMN %1$s.mesh.repair_triangles IS 'how many of the last triangles were added';

        CREATE TABLE %1$s.inner_envelope (
            feature bigint PRIMARY KEY REFERENCES %1$s.feature ON DELETE CASCADE,
            box occlusion.box3d NOT NULL,
            grounded boolean NOT NULL DEFAULT false
        );
        CREATE INDEX inner_envelope_box ON %1$s.inner_envelope USING gist (box);
        COMMENT ON TABLE %1$s.inner_envelope IS 'what hides: the largest box found wholly inside each solid feature';
        COMMENT ON COLUMN %1$s.inner_envelope.feature IS 'feature that it is part of';
        COMMENT ON COLUMN %1$s.inner_envelope.box IS 'box inside the solid, metres';
        COMMENT ON COLUMN %1$s.inner_envelope.grounded IS 'whether the ground under the box is solid down to any depth';

        CREATE TABLE %1$s.solid_column (
            feature bigint NOT NULL REFERENCES %1$s.feature ON DELETE CASCADE,
            footprint polygon[] NOT NULL CHECK (cardinality(footprint) > 0),
            bottom float8 NOT NULL,
            top float8 NOT NULL CHECK (bottom < top),
            grounded boolean NOT NULL DEFAULT false,
            envelope occlusion.box3d NOT NULL GENERATED ALWAYS AS (occlusion.box3d(
                occlusion.point3d(((box(footprint[1]))[1])[0], ((box(footprint[1]))[1])[1], bottom),
                occlusion.point3d(((box(footprint[1]))[0])[0], ((box(footprint[1]))[0])[1], top)
            )) STORED
        );
        CREATE INDEX solid_column_feature ON %1$s.solid_column (feature);
        CREATE INDEX solid_column_envelope ON %1$s.solid_column USING gist (envelope);
        COMMENT ON TABLE %1$s.solid_column IS 'what hides: prisms wholly inside each solid feature';
        COMMENT ON COLUMN %1$s.solid_column.feature IS 'feature that it is part of';
        COMMENT ON COLUMN %1$s.solid_column.footprint IS 'outer ring anticlockwise, then holes, metres';
        COMMENT ON COLUMN %1$s.solid_column.bottom IS 'lowest height, metres';
        COMMENT ON COLUMN %1$s.solid_column.top IS 'greatest height, metres';
        COMMENT ON COLUMN %1$s.solid_column.grounded IS 'whether the ground under the column is solid down to any depth';
        COMMENT ON COLUMN %1$s.solid_column.envelope IS 'box around it; derived';

        CREATE TABLE %1$s.street (
            id bigint GENERATED BY DEFAULT AS IDENTITY PRIMARY KEY,
            name text,
            area polygon[] NOT NULL CHECK (cardinality(area) > 0),
            eye_low float8 NOT NULL,
            eye_high float8 NOT NULL CHECK (eye_low <= eye_high),
            envelope occlusion.box3d NOT NULL GENERATED ALWAYS AS (occlusion.box3d(
                occlusion.point3d(((box(area[1]))[1])[0], ((box(area[1]))[1])[1], eye_low),
                occlusion.point3d(((box(area[1]))[0])[0], ((box(area[1]))[0])[1], eye_high)
            )) STORED
        );
        CREATE INDEX street_envelope ON %1$s.street USING gist (envelope);
        COMMENT ON TABLE %1$s.street IS 'view region: where observers can be';
        COMMENT ON COLUMN %1$s.street.id IS 'number of the street';
        COMMENT ON COLUMN %1$s.street.name IS 'identifier in the source';
        COMMENT ON COLUMN %1$s.street.area IS 'outer ring, then holes';
        COMMENT ON COLUMN %1$s.street.eye_low IS 'lowest eye, absolute height in metres';
        COMMENT ON COLUMN %1$s.street.eye_high IS 'highest eye, absolute height in metres';
        COMMENT ON COLUMN %1$s.street.envelope IS 'box around all its eyes; derived';

        CREATE TABLE %1$s.occlusion_volume (
            occluder bigint NOT NULL REFERENCES %1$s.feature ON DELETE CASCADE,
            occludee bigint NOT NULL REFERENCES %1$s.feature ON DELETE CASCADE,
            box occlusion.box3d NOT NULL,
            CHECK (occluder <> occludee)
        );
        CREATE INDEX occlusion_volume_box ON %1$s.occlusion_volume USING gist (box);
        CREATE INDEX occlusion_volume_occluder ON %1$s.occlusion_volume (occluder);
        CREATE INDEX occlusion_volume_occludee ON %1$s.occlusion_volume (occludee);
        COMMENT ON TABLE %1$s.occlusion_volume IS 'from everywhere in the box, occluder alone hides all of occludee';
        COMMENT ON COLUMN %1$s.occlusion_volume.occluder IS 'feature that hides';
        COMMENT ON COLUMN %1$s.occlusion_volume.occludee IS 'feature that is hidden';
        COMMENT ON COLUMN %1$s.occlusion_volume.box IS 'eyes from which it is hidden, metres';

        CREATE TABLE %1$s.import_remark (
            source text NOT NULL,
            name text NOT NULL,
            class text NOT NULL,
            skipped boolean NOT NULL,
            remark text NOT NULL
        );
        COMMENT ON TABLE %1$s.import_remark IS 'objects of imported files that were left out or changed';
        COMMENT ON COLUMN %1$s.import_remark.source IS 'file or table that it came from';
        COMMENT ON COLUMN %1$s.import_remark.name IS 'identifier in the source';
        COMMENT ON COLUMN %1$s.import_remark.class IS 'kind of object, as the source names it';
        COMMENT ON COLUMN %1$s.import_remark.skipped IS 'whether it is not in the scene';
        COMMENT ON COLUMN %1$s.import_remark.remark IS 'why it was left out, or what is different';

        CREATE TABLE %1$s.job (
            task text PRIMARY KEY,
            backend integer NOT NULL,
            started timestamptz NOT NULL,
            updated timestamptz NOT NULL,
            done bigint NOT NULL,
            total bigint NOT NULL,
            made bigint NOT NULL,
            finished boolean NOT NULL
        );
        COMMENT ON TABLE %1$s.job IS 'long work on this scene and how far it is';
        COMMENT ON COLUMN %1$s.job.task IS 'procedure';
        COMMENT ON COLUMN %1$s.job.backend IS 'process that runs or ran it';
        COMMENT ON COLUMN %1$s.job.started IS 'when it began';
        COMMENT ON COLUMN %1$s.job.updated IS 'when it last committed a batch';
        COMMENT ON COLUMN %1$s.job.done IS 'features finished';
        COMMENT ON COLUMN %1$s.job.total IS 'features in all';
        COMMENT ON COLUMN %1$s.job.made IS 'rows written';
        COMMENT ON COLUMN %1$s.job.finished IS 'whether it came to its end';

        CREATE TRIGGER forget_volumes AFTER UPDATE OR DELETE ON %1$s.feature
            FOR EACH ROW EXECUTE FUNCTION occlusion.forget_feature_volumes();
        CREATE TRIGGER forget_all_volumes AFTER TRUNCATE ON %1$s.feature
            FOR EACH STATEMENT EXECUTE FUNCTION occlusion.forget_all_volumes();
        CREATE TRIGGER forget_volumes AFTER UPDATE OR DELETE ON %1$s.inner_envelope
            FOR EACH ROW EXECUTE FUNCTION occlusion.forget_occluder_volumes();
        CREATE TRIGGER forget_all_volumes AFTER TRUNCATE ON %1$s.inner_envelope
            FOR EACH STATEMENT EXECUTE FUNCTION occlusion.forget_all_volumes();
        CREATE TRIGGER forget_volumes AFTER UPDATE OR DELETE ON %1$s.solid_column
            FOR EACH ROW EXECUTE FUNCTION occlusion.forget_occluder_volumes();
        CREATE TRIGGER forget_all_volumes AFTER TRUNCATE ON %1$s.solid_column
            FOR EACH STATEMENT EXECUTE FUNCTION occlusion.forget_all_volumes();
        ALTER TABLE %1$s.feature ENABLE ALWAYS TRIGGER forget_volumes;
        ALTER TABLE %1$s.feature ENABLE ALWAYS TRIGGER forget_all_volumes;
        ALTER TABLE %1$s.inner_envelope ENABLE ALWAYS TRIGGER forget_volumes;
        ALTER TABLE %1$s.inner_envelope ENABLE ALWAYS TRIGGER forget_all_volumes;
        ALTER TABLE %1$s.solid_column ENABLE ALWAYS TRIGGER forget_volumes;
        ALTER TABLE %1$s.solid_column ENABLE ALWAYS TRIGGER forget_all_volumes;
    $ddl$, s, srid);
    PERFORM occlusion.add_tiles(scene);
    PERFORM occlusion.add_view_cells(scene);
    PERFORM occlusion.add_replica_triggers(scene);
END
$$;
COMMENT ON FUNCTION occlusion.create_scene(text, integer) IS
    'makes a scene: a schema of that name with the tables of one city';

-- Raises an error where an edit could not drop all its volumes, because row security or an old
-- snapshot keeps some out of sight: they would go on hiding what was edited.
CREATE OR REPLACE FUNCTION occlusion.require_all_volumes(scene name) RETURNS void
LANGUAGE plpgsql VOLATILE STRICT SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    IF row_security_active(format('%I.occlusion_volume', scene)) THEN
        RAISE EXCEPTION 'row security hides occlusion volumes of scene "%"', scene
            USING ERRCODE = 'insufficient_privilege',
                  DETAIL = 'An edit must drop every volume that it invalidates.',
                  HINT = 'Edit as the owner of the scene, or as a role with BYPASSRLS.';
    END IF;
    -- An old snapshot does not show volumes computed since, but locking this row, which every batch
    -- of them updates, fails then (40001).
    IF current_setting('transaction_isolation') <> 'read committed' THEN
        EXECUTE format('SELECT FROM %I.scene_info FOR SHARE', scene);
    END IF;
END
$$;
COMMENT ON FUNCTION occlusion.require_all_volumes(name) IS
    'raises an error where row security or an old snapshot would keep an edit from dropping volumes';

-- Volumes cast by or on a feature whose envelope changed say nothing any more. Foreign keys drop
-- those of deleted features as well, but not where rows arrive by replication.
CREATE OR REPLACE FUNCTION occlusion.forget_feature_volumes() RETURNS trigger
LANGUAGE plpgsql SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    IF TG_OP = 'UPDATE' THEN
        IF OLD.envelope OPERATOR(occlusion.=) NEW.envelope THEN
            RETURN NULL;
        END IF;
    END IF;
    PERFORM occlusion.require_all_volumes(TG_TABLE_SCHEMA);
    EXECUTE format('DELETE FROM %I.occlusion_volume WHERE occluder = $1 OR occludee = $1', TG_TABLE_SCHEMA)
        USING OLD.id;
    RETURN NULL;
END
$$;
COMMENT ON FUNCTION occlusion.forget_feature_volumes() IS 'trigger: drops the volumes of a feature that moved';

CREATE OR REPLACE FUNCTION occlusion.forget_occluder_volumes() RETURNS trigger
LANGUAGE plpgsql SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_all_volumes(TG_TABLE_SCHEMA);
    EXECUTE format('DELETE FROM %I.occlusion_volume WHERE occluder = $1', TG_TABLE_SCHEMA)
        USING OLD.feature;
    RETURN NULL;
END
$$;
COMMENT ON FUNCTION occlusion.forget_occluder_volumes() IS 'trigger: drops the volumes cast by a solid that changed';

-- Truncated, too: to older snapshots a truncated table looks empty, and deleted rows are there. Where the table
-- is in use it is truncated just now by the same command, or there is a cursor on it.
CREATE OR REPLACE FUNCTION occlusion.forget_all_volumes() RETURNS trigger
LANGUAGE plpgsql SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    BEGIN
        EXECUTE format('TRUNCATE %I.occlusion_volume', TG_TABLE_SCHEMA);
    EXCEPTION WHEN object_in_use THEN
        PERFORM occlusion.require_all_volumes(TG_TABLE_SCHEMA);
        EXECUTE format('DELETE FROM %I.occlusion_volume', TG_TABLE_SCHEMA);
    END;
    RETURN NULL;
END
$$;
COMMENT ON FUNCTION occlusion.forget_all_volumes() IS 'trigger: drops all volumes of a scene';

CREATE OR REPLACE FUNCTION occlusion.drop_scene(scene text, force boolean DEFAULT false) RETURNS void
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    tables text;
    reason text;
BEGIN
    IF NOT force THEN
        PERFORM occlusion.require_scene(scene);
        SELECT string_agg(DISTINCT format('%I.%I', scene, table_name), ', ') INTO tables
          FROM occlusion.scene_columns()
         WHERE to_regclass(format('%I.%I', scene, table_name)) IS NOT NULL;
        -- RESTRICT stops at every object of another's making, in the schema or outside it.
        BEGIN
            EXECUTE format('DROP TABLE %s RESTRICT', tables);
            EXECUTE format('DROP SCHEMA %I RESTRICT', scene);
        EXCEPTION WHEN dependent_objects_still_exist THEN
            GET STACKED DIAGNOSTICS reason = PG_EXCEPTION_DETAIL;
            RAISE EXCEPTION 'scene "%" holds objects that are not part of it', scene
                USING ERRCODE = 'dependent_objects_still_exist',
                      DETAIL = reason,
                      HINT = 'Move them, or drop everything with force => true.';
        END;
        RETURN;
    END IF;
    IF NOT EXISTS (SELECT FROM pg_catalog.pg_class AS c
                   JOIN pg_catalog.pg_namespace AS n ON n.oid = c.relnamespace
                   WHERE n.nspname = scene AND c.relname = 'scene_info' AND c.relkind IN ('r', 'p')) THEN
        PERFORM occlusion.require_scene(scene);
    END IF;
    EXECUTE format('DROP SCHEMA %I CASCADE', scene);
END
$$;
COMMENT ON FUNCTION occlusion.drop_scene(text, boolean) IS
    'drops a scene; refuses a schema that is none, and one with foreign objects unless forced';
