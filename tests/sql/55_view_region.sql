-- The view region of a scene without streets.
\pset format unaligned

-- How a statement ends, without the lines that change with the server's version.
CREATE FUNCTION pg_temp.outcome(statement text) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    message text;
    detail text;
    hint text;
BEGIN
    EXECUTE statement;
    RETURN 'done';
EXCEPTION WHEN OTHERS THEN
    GET STACKED DIAGNOSTICS message = MESSAGE_TEXT, detail = PG_EXCEPTION_DETAIL, hint = PG_EXCEPTION_HINT;
    RETURN concat_ws(' | ', SQLSTATE, message, nullif(detail, ''), nullif(hint, ''));
END
$$;

-- An empty scene has none.
SELECT occlusion.create_scene('regress_open');
SELECT occlusion.generate_view_region('regress_open') = 0 AS t;
SELECT count(*) = 0 AS t FROM regress_open.street;

-- Four blocks of 3 by 2 houses along a crossing, meshes for some and boxes only for others, with
-- feet at 3 m and coordinates as in the Dutch frame.
CREATE TEMPORARY TABLE house AS
SELECT row_number() OVER () AS id, occlusion.box3d(occlusion.point3d(x, y, 3), occlusion.point3d(x + 10, y + 12, 3 + 6 + i)) AS box
FROM (SELECT 85000 + bx * 50 + i * 10.0 AS x, 447000 + by * 44 + j * 12.0 AS y, i
      FROM generate_series(0, 1) AS bx, generate_series(0, 1) AS by, generate_series(0, 2) AS i, generate_series(0, 1) AS j) AS p;
INSERT INTO regress_open.feature (id, class, envelope) SELECT id, 'Building', box FROM house;
INSERT INTO regress_open.inner_envelope SELECT id, box, true FROM house;
INSERT INTO regress_open.mesh (feature, vertices, triangles)
SELECT id, ARRAY[x0,y0,z0, x1,y0,z0, x0,y1,z0, x1,y1,z0, x0,y0,z1, x1,y0,z1, x0,y1,z1, x1,y1,z1],
       '{0,2,3,0,3,1,4,5,7,4,7,6,0,1,5,0,5,4,2,6,7,2,7,3,0,4,6,0,6,2,1,3,7,1,7,5}'
FROM house, LATERAL (SELECT occlusion.x(occlusion.lower(box)), occlusion.y(occlusion.lower(box)), occlusion.z(occlusion.lower(box)),
                            occlusion.x(occlusion.upper(box)), occlusion.y(occlusion.upper(box)), occlusion.z(occlusion.upper(box))
                    ) AS side (x0, y0, z0, x1, y1, z1)
WHERE id % 2 = 0;
SELECT occlusion.generate_view_region('regress_open') AS made \gset
SELECT count(*) = :made AND count(*) > 0 AS t,
       -- eyes 1.5 to 2 m above the feet
       bool_and(eye_low = 4.5 AND eye_high = 5) AS t,
       -- within the hull of all, which is their box
       bool_and('BOX3D(85000 447000 0, 85080 447068 10)'::occlusion.box3d OPERATOR(occlusion.@>) envelope) AS t
FROM regress_open.street;
-- Outside every footprint: on a grid of points 1 m apart and off the walls, a point is in the view
-- region exactly when no house stands on it.
CREATE TEMPORARY TABLE place AS
SELECT x, y, EXISTS (SELECT FROM house WHERE box OPERATOR(occlusion.@>) occlusion.point3d(x, y, 4)) AS built,
       EXISTS (SELECT FROM regress_open.street AS s
               WHERE s.area[1] @> point(x, y)
                 AND NOT EXISTS (SELECT FROM unnest(s.area[2:]) AS hole WHERE hole @> point(x, y))) AS open
FROM (SELECT 85000.5 + i AS x, 447000.5 + j AS y FROM generate_series(0, 79) AS i, generate_series(0, 67) AS j) AS grid;
SELECT bool_and(open <> built) AS t, count(*) FILTER (WHERE open) > 1000 AND count(*) FILTER (WHERE built) > 1000 AS t FROM place;

-- Called again it replaces, with other eyes and other tiles.
SELECT occlusion.generate_view_region('regress_open', 0.5, 30, 10) AS made \gset
SELECT bool_and(eye_low = 3.5 AND eye_high = 33) AS t, count(*) = :made AND count(*) > 20 AS t,
       bool_and(occlusion.x(occlusion.upper(envelope)) - occlusion.x(occlusion.lower(envelope)) <= 10.001) AS t
FROM regress_open.street;
SELECT bool_and(p.open = EXISTS (
           SELECT FROM regress_open.street AS s
           WHERE s.area[1] @> point(p.x, p.y)
             AND NOT EXISTS (SELECT FROM unnest(s.area[2:]) AS hole WHERE hole @> point(p.x, p.y)))) AS t
FROM place AS p;
SELECT occlusion.generate_view_region('regress_open', 1, 1) > 0 AS t;
SELECT bool_and(eye_low = 4 AND eye_high = 4) AS t FROM regress_open.street;

-- Refused; what was there stays.
CREATE TEMPORARY TABLE before AS SELECT area::text FROM regress_open.street;
SELECT statement, pg_temp.outcome('SELECT occlusion.generate_view_region' || statement)
FROM (VALUES
    ($$('regress_open', 2, 1.5)$$),
    ($$('regress_open', 'NaN', 2)$$),
    ($$('regress_open', 1.5, 'Infinity')$$),
    ($$('regress_open', 1.5, 2, 0)$$),
    ($$('regress_open', 1.5, 2, 0.5)$$),
    ($$('regress_open', 1.5, 2, -50)$$),
    ($$('regress_open', 1.5, 2, 'NaN')$$),
    ($$('regress_nowhere')$$),
    ($$('public')$$)
) AS refused (statement);
SELECT occlusion.generate_view_region(NULL) IS NULL AS t, occlusion.generate_view_region('regress_open', NULL) IS NULL AS t;
SELECT count(*) = 0 AS t FROM (TABLE before EXCEPT SELECT area::text FROM regress_open.street) AS lost;

-- It can be taken back.
BEGIN;
SELECT occlusion.generate_view_region('regress_open', 1.5, 2) > 0 AS t;
ROLLBACK;
SELECT bool_and(eye_low = 4 AND eye_high = 4) AS t FROM regress_open.street;

-- What covers the ground is no obstacle.
INSERT INTO regress_open.feature (id, class, envelope) VALUES (100, 'LandUse', 'BOX3D(85030 447000 3, 85050 447068 3)');
SELECT occlusion.generate_view_region('regress_open') > 0 AS t;
SELECT bool_and(p.open = EXISTS (
           SELECT FROM regress_open.street AS s
           WHERE s.area[1] @> point(p.x, p.y)
             AND NOT EXISTS (SELECT FROM unnest(s.area[2:]) AS hole WHERE hole @> point(p.x, p.y)))) AS t
FROM place AS p;
-- A scene that is built over has no open space.
DELETE FROM regress_open.feature WHERE id <> 1;
SELECT occlusion.generate_view_region('regress_open') = 0 AS t;
SELECT occlusion.drop_scene('regress_open');
