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
