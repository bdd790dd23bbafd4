-- Visibility queries. CREATE OR REPLACE, since upgrades run this file too.

-- Whether a point lies in a footprint, within a margin of it included: that of a hole, too.
CREATE OR REPLACE FUNCTION occlusion.covers(footprint polygon[], x float8, y float8, margin float8) RETURNS boolean
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

-- Whether an eye, $1, is in the view region: what was computed ahead counts only there. An eye within a
-- millimetre of a solid counts as inside it, and is not.
CREATE OR REPLACE FUNCTION occlusion.is_eye_condition(scene text) RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT format($q$
        EXISTS (
            SELECT FROM %1$I.street AS s
            WHERE s.envelope OPERATOR(occlusion.@>) $1
              AND s.area[1] OPERATOR(pg_catalog.@>) pg_catalog.point(occlusion.x($1), occlusion.y($1))
              AND NOT EXISTS (
                  SELECT FROM pg_catalog.unnest(s.area[2:]) AS hole
                  WHERE hole OPERATOR(pg_catalog.@>) pg_catalog.point(occlusion.x($1), occlusion.y($1)))
        ) AND NOT EXISTS (
            SELECT FROM %1$I.inner_envelope AS i
            WHERE i.box OPERATOR(occlusion.&&)
                      occlusion.expand(occlusion.box3d($1, $1), 0.001)
        ) AND NOT EXISTS (
            SELECT FROM %1$I.solid_column AS c
            WHERE c.envelope OPERATOR(occlusion.&&)
                      occlusion.expand(occlusion.box3d($1, $1), 0.001)
              AND occlusion.covers(c.footprint, occlusion.x($1), occlusion.y($1), 0.001)
        )
    $q$, scene)
$$;
COMMENT ON FUNCTION occlusion.is_eye_condition(text) IS
    'the condition that an eye is in the view region of a scene';

-- The features that occlusion volumes hide from an eye, $1, and those that hide them.
CREATE OR REPLACE FUNCTION occlusion.hidden_features_statement(scene text) RETURNS text
LANGUAGE sql STABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT format($q$
        SELECT v.occludee, v.occluder
        FROM %1$I.occlusion_volume AS v
        WHERE v.box OPERATOR(occlusion.@>) $1 AND (SELECT %2$s)
    $q$, scene, occlusion.is_eye_condition(scene))
$$;
COMMENT ON FUNCTION occlusion.hidden_features_statement(text) IS
    'the statement that finds what occlusion volumes hide from an eye';

CREATE OR REPLACE FUNCTION occlusion.visible_features(scene text, cone occlusion.view_cone)
RETURNS TABLE (feature_id bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE c STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
SUPPORT occlusion.visible_features_support
AS 'MODULE_PATHNAME', 'visible_features_cone_wrapper';
COMMENT ON FUNCTION occlusion.visible_features(text, occlusion.view_cone) IS
    'features that meet the cone of view and are not hidden from its eye; holds every visible one';

CREATE OR REPLACE FUNCTION occlusion.visible_features(scene text, sector occlusion.view_sector)
RETURNS TABLE (feature_id bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE c STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
SUPPORT occlusion.visible_features_support
AS 'MODULE_PATHNAME', 'visible_features_sector_wrapper';
COMMENT ON FUNCTION occlusion.visible_features(text, occlusion.view_sector) IS
    'features that meet the sector of view and are not hidden from its eye; holds every visible one';

CREATE OR REPLACE FUNCTION occlusion.visible_features(scene text, observer occlusion.point3d, range float8)
RETURNS TABLE (feature_id bigint, class text, envelope occlusion.box3d, distance float8)
LANGUAGE c STABLE STRICT PARALLEL SAFE ROWS 100 COST 10000
SUPPORT occlusion.visible_features_support
AS 'MODULE_PATHNAME', 'visible_features_all_round_wrapper';
COMMENT ON FUNCTION occlusion.visible_features(text, occlusion.point3d, float8) IS
    'features within range of the observer, all round, that are not hidden from there; holds every visible one';

CREATE OR REPLACE FUNCTION occlusion.explain_sight(scene text, cone occlusion.view_cone) RETURNS SETOF text
LANGUAGE c STABLE STRICT PARALLEL SAFE
AS 'MODULE_PATHNAME', 'explain_sight_cone_wrapper';
COMMENT ON FUNCTION occlusion.explain_sight(text, occlusion.view_cone) IS
    'how many tiles and features visible_features looked at to answer';

CREATE OR REPLACE FUNCTION occlusion.explain_visible_features(scene text, cone occlusion.view_cone) RETURNS SETOF text
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    RETURN QUERY SELECT * FROM occlusion.explain_sight(scene, cone);
    RETURN QUERY EXECUTE 'EXPLAIN (ANALYZE, BUFFERS, COSTS OFF, SUMMARY OFF, TIMING OFF) '
        || occlusion.hidden_features_statement(scene) USING occlusion.observer(cone);
END
$$;
COMMENT ON FUNCTION occlusion.explain_visible_features(text, occlusion.view_cone) IS
    'how visible_features answers: what it looked at, and the plan, run, of its question for occlusion volumes';

CREATE OR REPLACE FUNCTION occlusion.explain_sight(scene text, sector occlusion.view_sector) RETURNS SETOF text
LANGUAGE c STABLE STRICT PARALLEL SAFE
AS 'MODULE_PATHNAME', 'explain_sight_sector_wrapper';
COMMENT ON FUNCTION occlusion.explain_sight(text, occlusion.view_sector) IS
    'how many tiles and features visible_features looked at to answer';

CREATE OR REPLACE FUNCTION occlusion.explain_visible_features(scene text, sector occlusion.view_sector) RETURNS SETOF text
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    RETURN QUERY SELECT * FROM occlusion.explain_sight(scene, sector);
    RETURN QUERY EXECUTE 'EXPLAIN (ANALYZE, BUFFERS, COSTS OFF, SUMMARY OFF, TIMING OFF) '
        || occlusion.hidden_features_statement(scene) USING occlusion.observer(sector);
END
$$;
COMMENT ON FUNCTION occlusion.explain_visible_features(text, occlusion.view_sector) IS
    'how visible_features answers: what it looked at, and the plan, run, of its question for occlusion volumes';

CREATE OR REPLACE FUNCTION occlusion.explain_sight(scene text, observer occlusion.point3d, range float8) RETURNS SETOF text
LANGUAGE c STABLE STRICT PARALLEL SAFE
AS 'MODULE_PATHNAME', 'explain_sight_all_round_wrapper';
COMMENT ON FUNCTION occlusion.explain_sight(text, occlusion.point3d, float8) IS
    'how many tiles and features visible_features looked at to answer';

CREATE OR REPLACE FUNCTION occlusion.explain_visible_features(scene text, observer occlusion.point3d, range float8) RETURNS SETOF text
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    RETURN QUERY SELECT * FROM occlusion.explain_sight(scene, observer, range);
    RETURN QUERY EXECUTE 'EXPLAIN (ANALYZE, BUFFERS, COSTS OFF, SUMMARY OFF, TIMING OFF) '
        || occlusion.hidden_features_statement(scene) USING observer;
END
$$;
COMMENT ON FUNCTION occlusion.explain_visible_features(text, occlusion.point3d, float8) IS
    'how visible_features answers: what it looked at, and the plan, run, of its question for occlusion volumes';
