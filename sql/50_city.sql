-- Making scenes without files, and their view region. CREATE OR REPLACE, since upgrades run this file too.

CREATE OR REPLACE FUNCTION occlusion.make_city(layout text, features integer, seed bigint,
                                    first_part integer DEFAULT 0, parts integer DEFAULT 2147483647)
RETURNS TABLE (number integer, kind text, class text, envelope occlusion.box3d, inner_envelope occlusion.box3d,
               vertices float8[], triangles integer[], footprint text[], top float8, outline text)
LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'make_city_wrapper';
COMMENT ON FUNCTION occlusion.make_city(text, integer, bigint, integer, integer) IS
    'the features of some parts of a generated city, each a small piece of it: their boxes, closed meshes, solid columns and outlines';

CREATE OR REPLACE FUNCTION occlusion.make_city_streets(layout text, features integer, seed bigint)
RETURNS TABLE (area text[], eye_low float8, eye_high float8)
LANGUAGE c IMMUTABLE STRICT PARALLEL SAFE AS 'MODULE_PATHNAME', 'make_city_streets_wrapper';
COMMENT ON FUNCTION occlusion.make_city_streets(text, integer, bigint) IS
    'the streets of a generated city, rings as text';

CREATE OR REPLACE FUNCTION occlusion.generate_city(scene text, layout text DEFAULT 'scattered',
                                        features integer DEFAULT 326, seed integer DEFAULT 1)
RETURNS bigint
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    -- Some 2,000 features in memory at once.
    batch CONSTANT integer := 64;
    -- Smaller cities are done before anybody wonders.
    told_from CONSTANT integer := 100000;
    occupied boolean;
    batches integer := 0;
    added bigint;
    made bigint := 0;
BEGIN
    IF NOT EXISTS (SELECT FROM pg_catalog.pg_namespace AS n WHERE n.nspname = scene) THEN
        PERFORM occlusion.create_scene(scene);
    END IF;
    PERFORM occlusion.require_scene(scene);
    EXECUTE format('SELECT EXISTS (SELECT FROM %1$I.feature) OR EXISTS (SELECT FROM %1$I.street)', scene)
        INTO occupied;
    IF occupied THEN
        RAISE EXCEPTION 'scene "%" is not empty', scene
            USING ERRCODE = 'object_not_in_prerequisite_state',
                  HINT = 'Generate into a new scene.';
    END IF;
    EXECUTE format($q$
        INSERT INTO %1$I.street (name, area, eye_low, eye_high)
        SELECT 'street', s.area::polygon[], s.eye_low, s.eye_high
        FROM occlusion.make_city_streets($1, $2, $3) AS s
    $q$, scene) USING layout, features, seed::bigint;
    WHILE made < features LOOP
        -- The features of a city of blocks or streets come along a space-filling curve.
        EXECUTE format($q$
            WITH city AS MATERIALIZED (
                SELECT $6 + m.number AS id, m.*
                FROM occlusion.make_city($1, $2, $3, $4, $5) AS m
            ),
            feature AS (
                INSERT INTO %1$I.feature (id, name, class, envelope, slot, outline)
                SELECT c.id, c.kind || ' ' || c.id, c.class, c.envelope,
                       CASE WHEN $1 <> 'scattered' THEN c.id - 1 END, c.outline::polygon
                FROM city AS c
                RETURNING id
            ),
            mesh AS (
                INSERT INTO %1$I.mesh (feature, level_of_detail, vertices, triangles)
                SELECT c.id, 1, c.vertices, c.triangles FROM city AS c
            ),
            inner_envelope AS (
                INSERT INTO %1$I.inner_envelope (feature, box, grounded)
                SELECT c.id, c.inner_envelope, true FROM city AS c
            ),
            solid_column AS (
                INSERT INTO %1$I.solid_column (feature, footprint, bottom, top, grounded)
                SELECT c.id, c.footprint::polygon[], 0, c.top, true FROM city AS c
            )
            SELECT count(*) FROM feature
        $q$, scene)
            INTO added
            USING layout, (features - made)::integer, seed::bigint, batch * batches, batch, made;
        batches := batches + 1;
        IF features >= told_from AND (made + added) * 10 / features > made * 10 / features THEN
            RAISE NOTICE 'generate_city: % of % features', made + added, features;
        END IF;
        made := made + added;
    END LOOP;
    EXECUTE format('SELECT pg_catalog.setval(pg_catalog.pg_get_serial_sequence(%L, %L), greatest($1, 1))',
                   format('%I.feature', scene), 'id') USING made;
    PERFORM occlusion.pack_tiles(scene, optional => true);
    RETURN made;
END
$$;
COMMENT ON FUNCTION occlusion.generate_city(text, text, integer, integer) IS
    'fills a new scene with a generated city: scattered (that of the 2004 report), blocks or streets; returns the number of features';

CREATE OR REPLACE FUNCTION occlusion.generate_view_region(scene text, eye_low float8 DEFAULT 1.5,
                                               eye_high float8 DEFAULT 2.0, tile float8 DEFAULT 50)
RETURNS bigint
LANGUAGE c VOLATILE STRICT SET search_path = pg_catalog, pg_temp
AS 'MODULE_PATHNAME', 'generate_view_region_wrapper';
COMMENT ON FUNCTION occlusion.generate_view_region(text, float8, float8, float8) IS
    'replaces the streets of a scene by the open space between its features: inside their hull, outside every footprint; eye heights in metres above the feet of near features; returns the number of streets';
