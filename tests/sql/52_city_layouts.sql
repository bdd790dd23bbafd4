-- Generated cities of blocks and of streets: rows, order, bounds, and the same for the same seed.
\pset format unaligned

SELECT occlusion.generate_city('regress_blocks', 'blocks', 1500, 1);
SELECT occlusion.generate_city('regress_streets', 'streets', 1500, 1);

-- What each scene holds, one row a layout.
CREATE FUNCTION pg_temp.described(scene text) RETURNS TABLE (line text) LANGUAGE plpgsql AS $$
BEGIN
    RETURN QUERY EXECUTE format($q$
        SELECT concat_ws(' ',
            count(*), min(f.id), max(f.id), count(f.name), min(f.slot), max(f.slot), count(DISTINCT f.slot),
            string_agg(DISTINCT f.class, ','),
            string_agg(DISTINCT split_part(f.name, ' ', 1), ',' ORDER BY split_part(f.name, ' ', 1)),
            -- heights of 6 to 40 m, all on the ground
            bool_and(occlusion.z(occlusion.upper(f.envelope)) BETWEEN 6 AND 40), bool_and(occlusion.z(occlusion.lower(f.envelope)) = 0),
            -- what hides is inside what is seen
            bool_and(f.envelope OPERATOR(occlusion.@>) i.box), bool_and(i.grounded), bool_and(occlusion.volume(i.box) > 50),
            bool_and(m.defect IS NULL AND m.level_of_detail = '1'))
        FROM %1$I.feature AS f JOIN %1$I.mesh AS m ON m.feature = f.id JOIN %1$I.inner_envelope AS i ON i.feature = f.id
    $q$, scene);
END
$$;
SELECT pg_temp.described('regress_blocks');
SELECT pg_temp.described('regress_streets');

-- Meshes are closed: each directed edge has its opposite.
CREATE FUNCTION pg_temp.open_meshes(scene text) RETURNS bigint LANGUAGE plpgsql AS $$
DECLARE
    found bigint;
BEGIN
    EXECUTE format($q$
        WITH edge AS (
            SELECT m.feature, m.triangles[3 * t + c + 1] AS head, m.triangles[3 * t + (c + 1) %% 3 + 1] AS tail
            FROM %1$I.mesh AS m, generate_series(0, cardinality(m.triangles) / 3 - 1) AS t, generate_series(0, 2) AS c
            WHERE m.feature <= 300
        )
        SELECT count(*) FROM (
            (SELECT feature, head, tail FROM edge EXCEPT ALL SELECT feature, tail, head FROM edge)
        ) AS unpaired
    $q$, scene) INTO found;
    RETURN found;
END
$$;
SELECT pg_temp.open_meshes('regress_blocks') = 0 AS t, pg_temp.open_meshes('regress_streets') = 0 AS t;

-- Streets are where observers stand; each feature has one within 120 m.
SELECT count(*) > 300 AS t, bool_and(eye_low = 1.5 AND eye_high = 2.0) AS t, count(DISTINCT name) = 1 AS t FROM regress_blocks.street;
SELECT count(*) > 80 AS t, bool_and(eye_low = 1.5 AND eye_high = 2.0) AS t FROM regress_streets.street;
SELECT count(*) = 0 AS t FROM regress_streets.feature AS f
WHERE NOT EXISTS (SELECT FROM regress_streets.street AS s WHERE s.envelope OPERATOR(occlusion.<->) f.envelope < 120);
-- Nobody stands inside what hides.
SELECT count(*) = 0 AS t
FROM regress_streets.inner_envelope AS i JOIN regress_streets.street AS s ON s.envelope OPERATOR(occlusion.&&) i.box
WHERE cardinality(s.area) = 1
  AND s.area[1] @> point((occlusion.x(occlusion.lower(i.box)) + occlusion.x(occlusion.upper(i.box))) / 2,
                         (occlusion.y(occlusion.lower(i.box)) + occlusion.y(occlusion.upper(i.box))) / 2);
-- A square goes around its tower; a building around its courtyard.
SELECT count(*) > 0 AS t FROM occlusion.make_city_streets('streets', 20000, 3) WHERE cardinality(area) = 2;
SELECT count(*) > 5 AS t, bool_and(top BETWEEN 6 AND 40) AS t FROM occlusion.make_city('blocks', 1500, 1) WHERE cardinality(footprint) = 2;
-- A solid column is as wide as its feature.
SELECT bool_and(occlusion.x(occlusion.upper(c.envelope)) = ((box(c.footprint[1]::polygon))[0])[0]
            AND occlusion.y(occlusion.lower(c.envelope)) = ((box(c.footprint[1]::polygon))[1])[1]
            AND c.top <= occlusion.z(occlusion.upper(c.envelope))) AS t
FROM occlusion.make_city('streets', 1500, 1) AS c;

-- The same seed is the same city, another seed another one, for good.
CREATE FUNCTION pg_temp.digest(layout text, features int, seed int) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    result text;
BEGIN
    PERFORM occlusion.generate_city('regress_again', layout, features, seed);
    SELECT md5(string_agg(concat_ws(' ', f.id, f.name, f.envelope, i.box, m.vertices, m.triangles), ' ' ORDER BY f.id))
           || (SELECT md5(string_agg(s.area::text, ' ' ORDER BY s.id)) FROM regress_again.street AS s)
      INTO result
      FROM regress_again.feature AS f
      JOIN regress_again.mesh AS m ON m.feature = f.id
      JOIN regress_again.inner_envelope AS i ON i.feature = f.id;
    PERFORM occlusion.drop_scene('regress_again');
    RETURN result;
END
$$;
SELECT layout, pg_temp.digest(layout, 700, 1) AS digest, pg_temp.digest(layout, 700, 1) <> pg_temp.digest(layout, 700, -1) AS t
FROM (VALUES ('scattered'), ('blocks'), ('streets')) AS l (layout);
-- A smaller city is the beginning of a larger one; parts make up the whole.
SELECT count(*) = 400 AND bool_and(s.envelope OPERATOR(occlusion.=) f.envelope) AS t
FROM occlusion.make_city('streets', 400, 1) AS s JOIN regress_streets.feature AS f ON f.id = s.number;
SELECT layout, count(*) = 500 AS t
FROM (VALUES ('scattered'), ('blocks'), ('streets')) AS l (layout),
     LATERAL (SELECT m.envelope::text FROM occlusion.make_city(layout, 500, 9) AS m
              INTERSECT ALL
              SELECT m.envelope::text FROM generate_series(0, 99) AS part, occlusion.make_city(layout, 500, 9, part, 1) AS m) AS same
GROUP BY layout ORDER BY layout;
-- Features that follow each other are near each other, past squares too.
SELECT bool_and(f.envelope OPERATOR(occlusion.<->) g.envelope < 600) AS t
FROM regress_streets.feature AS f JOIN regress_streets.feature AS g ON g.slot = f.slot + 1;

-- No features: streets all the same. Parts that are not there: nothing.
SELECT occlusion.generate_city('regress_none', 'streets', 0) = 0 AS t;
SELECT count(*) > 0 AS t FROM regress_none.street;
SELECT count(*) = 0 AS t FROM occlusion.make_city('blocks', 10, 1, -5, 0);
SELECT count(*) = 0 AS t FROM occlusion.make_city('blocks', 10, 1, 3, -1);

-- Volumes and answers work on them.
SET client_min_messages = warning;
SELECT occlusion.drop_scene('regress_streets');
SELECT occlusion.generate_city('regress_streets', 'streets', 150, 1);
CALL occlusion.generate_occlusion_volumes('regress_streets', smallest => 4);
RESET client_min_messages;
SELECT count(*) > 100 AS t FROM regress_streets.occlusion_volume;

SELECT occlusion.drop_scene(scene) FROM unnest(ARRAY['regress_blocks', 'regress_streets', 'regress_none']) AS scene;
