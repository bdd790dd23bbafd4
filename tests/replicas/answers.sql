-- What is asked of a scene that was copied, renamed or replicated. Loaded into each database that has a copy, for
-- somebody, too, who may not read its tiles.
GRANT USAGE ON SCHEMA occlusion TO without_tiles;

-- Eyes all over the streets of a scene.
CREATE FUNCTION eyes(scene text) RETURNS TABLE (number bigint, eye occlusion.point3d) LANGUAGE plpgsql STABLE AS $$
BEGIN
    RETURN QUERY EXECUTE format($q$
        SELECT row_number() OVER (ORDER BY s.id, along), occlusion.point3d(
                   occlusion.x(l) + along * (occlusion.x(u) - occlusion.x(l)), occlusion.y(l) + along * (occlusion.y(u) - occlusion.y(l)), s.eye_high)
        FROM %I.street AS s, generate_series(0.03, 1, 0.19) AS along,
             LATERAL (SELECT occlusion.lower(s.envelope), occlusion.upper(s.envelope)) AS b (l, u)
    $q$, scene);
END
$$;

-- What they see: how much, and a digest.
CREATE FUNCTION live(scene text) RETURNS text LANGUAGE sql STABLE AS $$
    SELECT count(*) || ' ' || coalesce(md5(string_agg((o.number, v.feature_id, v.class, v.envelope, v.distance)::text, ' ' ORDER BY o.number, v.feature_id)), '')
    FROM (SELECT number, eye FROM eyes(scene) WHERE number % 7 = 0 ORDER BY number LIMIT 60) AS o,
         LATERAL occlusion.visible_features(scene, o.eye, 150) AS v
$$;

-- The sets of view cells that are right: how many, and a digest.
CREATE FUNCTION sets(scene text) RETURNS text LANGUAGE sql STABLE AS $$
    SELECT count(*) || ' ' || coalesce(md5(string_agg((o.number, s.visible, s.box, s.range)::text, ' ' ORDER BY o.number)), '')
    FROM eyes(scene) AS o, LATERAL occlusion.visible_set(scene, o.eye) AS s
$$;

-- How many features the eyes see that are not in the set of their cell, and in how many cells was looked.
CREATE FUNCTION missed(scene text, OUT missed bigint, OUT cells bigint) LANGUAGE sql STABLE AS $$
    SELECT coalesce(sum(occlusion.cardinality(occlusion.feature_set(scene, m.seen) OPERATOR(occlusion.-) m.visible)), 0), count(*)
    FROM (SELECT s.visible, (SELECT array_agg(v.feature_id) FROM occlusion.visible_features(scene, o.eye, s.range) AS v) AS seen
          FROM eyes(scene) AS o, LATERAL occlusion.visible_set(scene, o.eye) AS s WHERE o.number % 2 = 0) AS m
$$;
