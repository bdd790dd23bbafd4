-- Casts between types of PostGIS and those of pg_occlusion.
-- Bodies are bound when they are created, so that they find PostGIS whatever schema it is in.

CREATE FUNCTION occlusion.box3d(shape geometry) RETURNS occlusion.box3d
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN CASE WHEN NOT ST_IsEmpty(shape) THEN
    occlusion.box3d(occlusion.point3d(ST_XMin(shape), ST_YMin(shape), ST_ZMin(shape)),
                    occlusion.point3d(ST_XMax(shape), ST_YMax(shape), ST_ZMax(shape))) END;
COMMENT ON FUNCTION occlusion.box3d(geometry) IS
    'smallest box around a geometry; at height 0 where it has no z; null for an empty one';

CREATE FUNCTION occlusion.geometry(bounds occlusion.box3d) RETURNS geometry
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN CAST(ST_3DMakeBox(
    ST_MakePoint(occlusion.x(occlusion.lower(bounds)), occlusion.y(occlusion.lower(bounds)),
                 occlusion.z(occlusion.lower(bounds))),
    ST_MakePoint(occlusion.x(occlusion.upper(bounds)), occlusion.y(occlusion.upper(bounds)),
                 occlusion.z(occlusion.upper(bounds)))) AS geometry);
COMMENT ON FUNCTION occlusion.geometry(occlusion.box3d) IS 'the faces of a box, without a reference system';

CREATE FUNCTION occlusion.point3d(shape geometry) RETURNS occlusion.point3d
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN CASE WHEN NOT ST_IsEmpty(shape) THEN
    occlusion.point3d(ST_X(shape), ST_Y(shape), coalesce(ST_Z(shape), 0)) END;
COMMENT ON FUNCTION occlusion.point3d(geometry) IS
    'a point of PostGIS, at height 0 where it has no z; null for an empty one';

CREATE FUNCTION occlusion.geometry(place occlusion.point3d) RETURNS geometry
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN ST_MakePoint(occlusion.x(place), occlusion.y(place), occlusion.z(place));
COMMENT ON FUNCTION occlusion.geometry(occlusion.point3d) IS 'a point, without a reference system';

CREATE FUNCTION occlusion.geometry(area polygon[]) RETURNS geometry
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN CASE WHEN cardinality(area) > 0 THEN
    ST_MakePolygon(ST_ExteriorRing(CAST(area[1] AS geometry)),
                   ARRAY(SELECT ST_ExteriorRing(CAST(hole AS geometry)) FROM unnest(area[2:]) AS hole)) END;
COMMENT ON FUNCTION occlusion.geometry(polygon[]) IS
    'the polygon of an outer ring and holes, as streets and solid columns have it';

CREATE CAST (geometry AS occlusion.box3d) WITH FUNCTION occlusion.box3d(geometry);
CREATE CAST (occlusion.box3d AS geometry) WITH FUNCTION occlusion.geometry(occlusion.box3d);
CREATE CAST (geometry AS occlusion.point3d) WITH FUNCTION occlusion.point3d(geometry);
CREATE CAST (occlusion.point3d AS geometry) WITH FUNCTION occlusion.geometry(occlusion.point3d);
CREATE CAST (polygon[] AS geometry) WITH FUNCTION occlusion.geometry(polygon[]);

-- PostGIS has a type box3d, too, in a schema whose name only the server knows.
DO $do$
DECLARE
    theirs text := (SELECT format('%I.box3d', n.nspname)
                    FROM pg_catalog.pg_extension AS e
                    JOIN pg_catalog.pg_namespace AS n ON n.oid = e.extnamespace
                    WHERE e.extname = 'postgis');
BEGIN
    EXECUTE format($sql$
        CREATE FUNCTION occlusion.box3d(bounds %1$s) RETURNS occlusion.box3d
        LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
        RETURN occlusion.box3d(occlusion.point3d(ST_XMin(bounds), ST_YMin(bounds), ST_ZMin(bounds)),
                               occlusion.point3d(ST_XMax(bounds), ST_YMax(bounds), ST_ZMax(bounds)));
        COMMENT ON FUNCTION occlusion.box3d(%1$s) IS 'a box of PostGIS';

        CREATE FUNCTION occlusion.postgis_box3d(bounds occlusion.box3d) RETURNS %1$s
        LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
        RETURN ST_3DMakeBox(
            ST_MakePoint(occlusion.x(occlusion.lower(bounds)), occlusion.y(occlusion.lower(bounds)),
                         occlusion.z(occlusion.lower(bounds))),
            ST_MakePoint(occlusion.x(occlusion.upper(bounds)), occlusion.y(occlusion.upper(bounds)),
                         occlusion.z(occlusion.upper(bounds))));
        COMMENT ON FUNCTION occlusion.postgis_box3d(occlusion.box3d) IS 'a box as PostGIS has it';

        CREATE CAST (%1$s AS occlusion.box3d) WITH FUNCTION occlusion.box3d(%1$s);
        CREATE CAST (occlusion.box3d AS %1$s) WITH FUNCTION occlusion.postgis_box3d(occlusion.box3d);
    $sql$, theirs);
END
$do$;
-- Scenes from geometry tables.

-- Whether a geometry is made of faces in space, rather than a footprint that is to be raised.
CREATE FUNCTION occlusion.has_faces(shape geometry) RETURNS boolean
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN ST_Zmflag(shape) IN (2, 3) AND ST_Dimension(shape) >= 2
       AND (ST_ZMin(shape) < ST_ZMax(shape) OR GeometryType(shape) NOT IN ('POLYGON', 'MULTIPOLYGON'));
COMMENT ON FUNCTION occlusion.has_faces(geometry) IS
    'whether a geometry is made of faces in space: it has z, and is no level polygon';

CREATE FUNCTION occlusion.faces(shape geometry) RETURNS bytea
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN CASE WHEN occlusion.has_faces(shape) THEN ST_AsBinary(shape) END;
COMMENT ON FUNCTION occlusion.faces(geometry) IS
    'the faces of a geometry as well-known binary; null for a footprint';

-- Rings as core's polygon writes them; between the polygons of a collection stands a null.
CREATE FUNCTION occlusion.footprint_rings(shape geometry) RETURNS text[]
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN CASE WHEN NOT occlusion.has_faces(shape) THEN (
    WITH part AS (
        SELECT d.path, d.geom FROM ST_Dump(shape) AS d WHERE GeometryType(d.geom) = 'POLYGON'
    ), ring AS (
        SELECT part.path, r.path[1] AS number, CAST(CAST(r.geom AS polygon) AS text) AS points
        FROM part, ST_DumpRings(ST_Force2D(part.geom)) AS r
        UNION ALL
        SELECT part.path, 1000000000, NULL FROM part
    )
    SELECT array_agg(ring.points ORDER BY ring.path, ring.number) FROM ring) END;
COMMENT ON FUNCTION occlusion.footprint_rings(geometry) IS
    'the rings of the polygons of a footprint, a null after each polygon; null for faces in space';

CREATE FUNCTION occlusion.level_of(shape geometry) RETURNS float8
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN CASE WHEN ST_Zmflag(shape) IN (2, 3) THEN ST_ZMin(shape) END;
COMMENT ON FUNCTION occlusion.level_of(geometry) IS 'height of a level footprint; null without z';

-- The reference systems in a column of geometries.
CREATE FUNCTION occlusion.srid_of(shape geometry) RETURNS integer
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
RETURN ST_SRID(shape);
COMMENT ON FUNCTION occlusion.srid_of(geometry) IS 'reference system of a geometry';

CREATE FUNCTION occlusion.is_geographic(srid integer) RETURNS boolean
LANGUAGE sql STABLE STRICT PARALLEL SAFE
RETURN EXISTS (SELECT FROM spatial_ref_sys AS s
               WHERE s.srid = is_geographic.srid AND s.proj4text LIKE '%+proj=longlat%');
COMMENT ON FUNCTION occlusion.is_geographic(integer) IS
    'whether coordinates of a reference system are degrees';

CREATE FUNCTION occlusion.import_geometries(scene text, source regclass, geometry text DEFAULT 'geom',
                                            bottom text DEFAULT 'bottom', top text DEFAULT 'top',
                                            height text DEFAULT 'height',
                                            name text DEFAULT 'name', class text DEFAULT 'class')
RETURNS bigint
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    kind text := occlusion.column_type(source, geometry);
    known integer;
    srids integer[];
    low text;
    high text;
BEGIN
    PERFORM occlusion.require_scene(scene);
    IF kind IS NULL OR kind NOT LIKE '%geometry' THEN
        RAISE EXCEPTION 'column "%" of % is no geometry', geometry, source
            USING ERRCODE = 'datatype_mismatch',
                  DETAIL = CASE WHEN kind IS NULL THEN 'There is no such column.'
                                ELSE format('Its type is %s.', kind) END;
    END IF;
    EXECUTE format('SELECT array_agg(DISTINCT occlusion.srid_of(t.%I)) FILTER (WHERE t.%1$I IS NOT NULL) FROM %s AS t',
                   geometry, source) INTO srids;
    EXECUTE format('SELECT srid FROM %I.scene_info', scene) INTO known;
    IF cardinality(srids) > 1 THEN
        RAISE EXCEPTION 'column "%" of % holds several reference systems', geometry, source
            USING ERRCODE = 'data_exception', DETAIL = format('They are %s.', array_to_string(srids, ', '));
    ELSIF occlusion.is_geographic(srids[1]) THEN
        RAISE EXCEPTION 'coordinates in SRID % are degrees', srids[1]
            USING ERRCODE = 'data_exception',
                  HINT = 'Bring them into a projected system with ST_Transform.';
    ELSIF known <> 0 AND srids[1] NOT IN (0, known) THEN
        RAISE EXCEPTION 'scene "%" has SRID %, not %', scene, known, srids[1]
            USING ERRCODE = 'data_exception', HINT = 'Bring the geometries into it with ST_Transform.';
    END IF;
    low := format('coalesce(%s, occlusion.level_of(t.%I), 0)',
                  occlusion.column_value(source, bottom, 'float8'), geometry);
    high := CASE
        WHEN occlusion.column_type(source, top) IS NOT NULL THEN format('t.%I::float8', top)
        WHEN occlusion.column_type(source, height) IS NOT NULL THEN format('%s + t.%I::float8', low, height)
        ELSE 'NULL::float8'
    END;
    IF known = 0 AND srids[1] <> 0 THEN
        EXECUTE format('UPDATE %I.scene_info SET srid = $1', scene) USING srids[1];
    END IF;
    RETURN occlusion.import_rows(scene, source::text, format(
        'SELECT %s, %s, %s, occlusion.footprint_rings(t.%I), %s, %s, '
        'occlusion.faces(t.%4$I) FROM %7$s AS t',
        occlusion.column_value(source, name, 'text'), occlusion.column_value(source, class, 'text'),
        occlusion.other_columns(source, ARRAY[geometry, bottom, top, height, name, class]),
        geometry, low, high, source));
END
$$;
COMMENT ON FUNCTION occlusion.import_geometries(text, regclass, text, text, text, text, text, text) IS
    'imports the rows of a geometry table as features: faces in space (polyhedral surfaces, TINs, multipolygons with z) as they are, footprints from their bottom, or their own level, up to their top, or by their height, metres; the other columns become attributes; returns the number of features';
