-- Features from rows.

CREATE FUNCTION occlusion.settle_ground(scene text, features bigint[],
                                        OUT aloft bigint, OUT opened bigint)
RETURNS SETOF record
LANGUAGE c VOLATILE STRICT SET search_path = pg_catalog, pg_temp ROWS 1
AS 'MODULE_PATHNAME', 'settle_ground_wrapper';
COMMENT ON FUNCTION occlusion.settle_ground(text, bigint[]) IS
    'of some new features, makes the solids of those that do not stand on the ground ungrounded, and removes them where a bottom was added, and so of other buildings that do not any more; returns how many there are of each among the new ones';

CREATE FUNCTION occlusion.import_rows(scene text, source text, query text) RETURNS bigint
LANGUAGE c VOLATILE STRICT SET search_path = pg_catalog, pg_temp
AS 'MODULE_PATHNAME', 'import_rows_wrapper';
COMMENT ON FUNCTION occlusion.import_rows(text, text, text) IS
    'imports the rows of a query as features; its columns: name text, class text, attributes jsonb, footprint text[] (rings of a polygon), bottom and top float8, surfaces bytea (well-known binary); rows that cannot be used become remarks; returns the number of features';

-- Columns of a relation by name, with their types.
CREATE FUNCTION occlusion.column_type(source regclass, name text) RETURNS text
LANGUAGE sql STABLE PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT format_type(a.atttypid, NULL) FROM pg_attribute AS a
    WHERE a.attrelid = source AND a.attname = name AND a.attnum > 0 AND NOT a.attisdropped
$$;
COMMENT ON FUNCTION occlusion.column_type(regclass, text) IS 'type of a column, null if there is none';

-- SQL for a column of a row "t" as some type, null where there is no such column.
CREATE FUNCTION occlusion.column_value(source regclass, name text, type_name text) RETURNS text
LANGUAGE sql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT CASE WHEN occlusion.column_type(source, name) IS NULL THEN format('NULL::%s', type_name)
                ELSE format('t.%I::%s', name, type_name) END
$$;
COMMENT ON FUNCTION occlusion.column_value(regclass, text, text) IS
    'SQL for a column of a relation as some type; null where there is no such column';

-- SQL for the columns of a row "t" but some, as jsonb. Those of PostGIS's types are left out: not
-- all of their values have a form in JSON.
CREATE FUNCTION occlusion.other_columns(source regclass, used text[]) RETURNS text
LANGUAGE sql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT format('(SELECT to_jsonb(r) FROM (SELECT %s) AS r)',
                  string_agg(format('t.%I', a.attname), ', ' ORDER BY a.attnum))
    FROM pg_attribute AS a
    JOIN pg_type AS y ON y.oid = a.atttypid
    WHERE a.attrelid = source AND a.attnum > 0 AND NOT a.attisdropped AND a.attname <> ALL (used)
      AND y.typname NOT IN ('geometry', 'geography', 'raster')
$$;
COMMENT ON FUNCTION occlusion.other_columns(regclass, text[]) IS
    'SQL for the columns of a relation that are not used otherwise, as jsonb';

CREATE FUNCTION occlusion.import_features(scene text, source regclass,
                                          footprint text DEFAULT 'footprint',
                                          bottom text DEFAULT 'bottom', top text DEFAULT 'top',
                                          height text DEFAULT 'height',
                                          name text DEFAULT 'name', class text DEFAULT 'class')
RETURNS bigint
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    kind text := occlusion.column_type(source, footprint);
    rings text;
    low text := format('coalesce(%s, 0)', occlusion.column_value(source, bottom, 'float8'));
    high text;
BEGIN
    PERFORM occlusion.require_scene(scene);
    rings := CASE kind
        WHEN 'polygon' THEN format('CASE WHEN t.%1$I IS NOT NULL THEN ARRAY[t.%1$I]::text[] END', footprint)
        WHEN 'polygon[]' THEN format('t.%I::text[]', footprint)
    END;
    IF rings IS NULL THEN
        RAISE EXCEPTION 'column "%" of % is no footprint', footprint, source
            USING ERRCODE = 'datatype_mismatch',
                  DETAIL = CASE WHEN kind IS NULL THEN 'There is no such column.'
                                ELSE format('Its type is %s, not polygon or polygon[].', kind) END,
                  HINT = 'Geometries of PostGIS are imported by import_geometries of the extension pg_occlusion_postgis.';
    END IF;
    high := CASE
        WHEN occlusion.column_type(source, top) IS NOT NULL THEN format('t.%I::float8', top)
        WHEN occlusion.column_type(source, height) IS NOT NULL THEN format('%s + t.%I::float8', low, height)
    END;
    IF high IS NULL THEN
        RAISE EXCEPTION 'neither column "%" nor column "%" is in %', top, height, source
            USING ERRCODE = 'undefined_column',
                  DETAIL = 'A footprint needs its highest point, or its height above its lowest.';
    END IF;
    RETURN occlusion.import_rows(scene, source::text, format(
        'SELECT %s, %s, %s, %s, %s, %s, NULL::bytea FROM %s AS t',
        occlusion.column_value(source, name, 'text'), occlusion.column_value(source, class, 'text'),
        occlusion.other_columns(source, ARRAY[footprint, bottom, top, height, name, class]),
        rings, low, high, source));
END
$$;
COMMENT ON FUNCTION occlusion.import_features(text, regclass, text, text, text, text, text, text) IS
    'imports the rows of a table as features: a footprint (polygon, or polygon[] with holes) from its bottom, or 0, up to its top, or by its height, metres; the other columns become attributes; returns the number of features';

CREATE FUNCTION occlusion.import_report(scene text)
RETURNS TABLE (outcome text, reason text, objects bigint, names text[])
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE format($q$
        WITH known AS (
            SELECT CASE
                       WHEN m.feature IS NULL THEN 'no mesh'
                       WHEN m.defect IS NOT NULL THEN 'hides nothing'
                       WHEN m.repair IS NOT NULL THEN 'repaired'
                       ELSE 'solid'
                   END AS outcome,
                   CASE
                       WHEN m.defect IS NOT NULL THEN split_part(m.defect, ':', 1)
                       WHEN m.repair IS NOT NULL THEN split_part(m.repair, ',', 1)
                   END AS reason,
                   coalesce(f.name, f.id::text) AS name
            FROM %1$I.feature AS f LEFT JOIN %1$I.mesh AS m ON m.feature = f.id
            UNION ALL
            SELECT CASE WHEN r.skipped THEN 'skipped' ELSE 'changed' END,
                   r.class || ': ' || r.remark, r.name
            FROM %1$I.import_remark AS r
        )
        SELECT k.outcome, k.reason, count(*),
               CASE WHEN k.outcome <> 'solid' THEN array_agg(k.name ORDER BY k.name) END
        FROM known AS k
        GROUP BY k.outcome, k.reason
        ORDER BY k.outcome = 'solid' DESC, k.outcome, count(*) DESC, k.reason
    $q$, scene);
END
$$;
COMMENT ON FUNCTION occlusion.import_report(text) IS
    'what became of imported objects: how many features are solid, and which hide nothing, were repaired, skipped or changed, and why';
