-- Visibility queries.

-- Whether a point lies in a footprint, within a margin of it included: that of a hole, too.
CREATE FUNCTION occlusion.covers(footprint polygon[], x float8, y float8, margin float8) RETURNS boolean
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
BEGIN ATOMIC
    SELECT footprint[1] OPERATOR(pg_catalog.<->) pg_catalog.point(x, y) <= margin
       AND NOT EXISTS (
           SELECT FROM pg_catalog.unnest(footprint[2:]) AS hole
           WHERE hole OPERATOR(pg_catalog.@>) pg_catalog.point(x, y)
             AND pg_catalog.path(hole) OPERATOR(pg_catalog.<->) pg_catalog.point(x, y) > margin);
END;
COMMENT ON FUNCTION occlusion.covers(polygon[], float8, float8, float8) IS
    'whether a point lies in a footprint (outer ring, then holes) or within a margin of it, metres';

-- The statement behind visible_features. Parameters: $1 the eye; $2 the field of view, or the
-- range when all round. Margins: an eye within a millimetre of a solid counts as inside it, and the
-- box that preselects all round is a millimetre larger, so that its rounding loses nothing in range.
CREATE FUNCTION occlusion.visible_features_statement(scene text, all_round boolean) RETURNS text
LANGUAGE sql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT format($q$
        WITH eye AS MATERIALIZED (
            SELECT EXISTS (
                SELECT FROM %1$I.street AS s
                WHERE s.envelope OPERATOR(occlusion.@>) $1
                  AND s.area[1] @> point(occlusion.x($1), occlusion.y($1))
                  AND NOT EXISTS (
                      SELECT FROM unnest(s.area[2:]) AS hole
                      WHERE hole @> point(occlusion.x($1), occlusion.y($1)))
            ) AND NOT EXISTS (
                SELECT FROM %1$I.inner_envelope AS i
                WHERE i.box OPERATOR(occlusion.&&)
                          occlusion.expand(occlusion.box3d($1, $1), 0.001)
            ) AND NOT EXISTS (
                SELECT FROM %1$I.solid_column AS c
                WHERE c.envelope OPERATOR(occlusion.&&)
                          occlusion.expand(occlusion.box3d($1, $1), 0.001)
                  AND occlusion.covers(c.footprint, occlusion.x($1), occlusion.y($1), 0.001)
            ) AS in_view_region
        )
        SELECT f.id, f.class, f.envelope, f.envelope OPERATOR(occlusion.<->) $1
        FROM %1$I.feature AS f
        WHERE %2$s
          AND f.id NOT IN (
              SELECT v.occludee
              FROM %1$I.occlusion_volume AS v
              WHERE v.box OPERATOR(occlusion.@>) $1
                AND (SELECT eye.in_view_region FROM eye))
    $q$, scene, CASE WHEN all_round
        THEN 'f.envelope OPERATOR(occlusion.&&) occlusion.expand(occlusion.box3d($1, $1), $2 + 0.001)'
             ' AND f.envelope OPERATOR(occlusion.<->) $1 <= $2 * (1 + 1e-12)'
        ELSE 'f.envelope OPERATOR(occlusion.&&) $2' END)
$$;
COMMENT ON FUNCTION occlusion.visible_features_statement(text, boolean) IS
    'the statement that visible_features runs';

CREATE FUNCTION occlusion.visible_features(scene text, cone occlusion.view_cone)
RETURNS TABLE (feature_id bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
SUPPORT occlusion.visible_features_support
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE occlusion.visible_features_statement(scene, false)
        USING occlusion.observer(cone), cone;
END
$$;
COMMENT ON FUNCTION occlusion.visible_features(text, occlusion.view_cone) IS
    'features that meet the cone of view and are not hidden from its eye; holds every visible one';

CREATE FUNCTION occlusion.visible_features(scene text, sector occlusion.view_sector)
RETURNS TABLE (feature_id bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
SUPPORT occlusion.visible_features_support
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE occlusion.visible_features_statement(scene, false)
        USING occlusion.observer(sector), sector;
END
$$;
COMMENT ON FUNCTION occlusion.visible_features(text, occlusion.view_sector) IS
    'features that meet the sector of view and are not hidden from its eye; holds every visible one';

CREATE FUNCTION occlusion.visible_features(scene text, observer occlusion.point3d, range float8)
RETURNS TABLE (feature_id bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE plpgsql STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
SUPPORT occlusion.visible_features_support
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    PERFORM occlusion.require_range(range);
    RETURN QUERY EXECUTE occlusion.visible_features_statement(scene, true) USING observer, range;
END
$$;
COMMENT ON FUNCTION occlusion.visible_features(text, occlusion.point3d, float8) IS
    'features within range of the observer, all round, that are not hidden from there; holds every visible one';

CREATE FUNCTION occlusion.require_range(range float8) RETURNS void
LANGUAGE plpgsql IMMUTABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    IF NOT (range >= 0 AND range < 'infinity') THEN
        RAISE EXCEPTION 'range % is out of bounds', range
            USING ERRCODE = 'invalid_parameter_value',
                  DETAIL = 'A range is a finite number of metres, 0 or more.';
    END IF;
END
$$;
COMMENT ON FUNCTION occlusion.require_range(float8) IS 'raises an error unless a range is finite and not negative';

CREATE FUNCTION occlusion.explain_visible_features(scene text, cone occlusion.view_cone) RETURNS SETOF text
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE 'EXPLAIN (ANALYZE, BUFFERS, COSTS OFF, SUMMARY OFF, TIMING OFF) '
        || occlusion.visible_features_statement(scene, false) USING occlusion.observer(cone), cone;
END
$$;
COMMENT ON FUNCTION occlusion.explain_visible_features(text, occlusion.view_cone) IS
    'how visible_features answers: its plan, run, with the buffers that it read';

CREATE FUNCTION occlusion.explain_visible_features(scene text, sector occlusion.view_sector) RETURNS SETOF text
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE 'EXPLAIN (ANALYZE, BUFFERS, COSTS OFF, SUMMARY OFF, TIMING OFF) '
        || occlusion.visible_features_statement(scene, false) USING occlusion.observer(sector), sector;
END
$$;
COMMENT ON FUNCTION occlusion.explain_visible_features(text, occlusion.view_sector) IS
    'how visible_features answers: its plan, run, with the buffers that it read';

CREATE FUNCTION occlusion.explain_visible_features(scene text, observer occlusion.point3d, range float8)
RETURNS SETOF text
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    PERFORM occlusion.require_range(range);
    RETURN QUERY EXECUTE 'EXPLAIN (ANALYZE, BUFFERS, COSTS OFF, SUMMARY OFF, TIMING OFF) '
        || occlusion.visible_features_statement(scene, true) USING observer, range;
END
$$;
COMMENT ON FUNCTION occlusion.explain_visible_features(text, occlusion.point3d, float8) IS
    'how visible_features answers: its plan, run, with the buffers that it read';
