-- Operators of box3d: against arithmetic on the six numbers, and against cases known by hand.
SET search_path = occlusion, public;

-- Boxes of every relation: nested, touching in a face, an edge and a corner, apart by the least
-- amount that a number can hold, flat in each direction, single points, far and huge.
CREATE TEMPORARY TABLE number (axis text, lower float8, upper float8);
INSERT INTO number VALUES
    ('x', 0, 1), ('x', 1, 2), ('x', 0.25, 0.75), ('x', 1, 1), ('x', 1.0000000000000002, 3), ('x', -0.0, 0),
    ('y', 0, 1), ('y', 1, 1), ('y', -5, 5),
    ('z', 0, 1), ('z', 0, 0), ('z', 0.5, 7);
CREATE TEMPORARY TABLE sample AS
SELECT x.lower + shift.x AS x0, y.lower + shift.y AS y0, z.lower + shift.z AS z0,
       x.upper + shift.x AS x1, y.upper + shift.y AS y1, z.upper + shift.z AS z1
FROM number AS x, number AS y, number AS z,
     (VALUES (0::float8, 0::float8, 0::float8), (85000, 447000, 0), (1e15, -1e15, 1e15)) AS shift (x, y, z)
WHERE x.axis = 'x' AND y.axis = 'y' AND z.axis = 'z';
ALTER TABLE sample ADD number serial, ADD box box3d;
UPDATE sample SET box = box3d(point3d(x1, y0, z1), point3d(x0, y1, z0));

CREATE TEMPORARY VIEW pair AS
SELECT a.box AS a, b.box AS b, a.number <= b.number AS once,
       a.x0 <= b.x1 AND b.x0 <= a.x1 AND a.y0 <= b.y1 AND b.y0 <= a.y1 AND a.z0 <= b.z1 AND b.z0 <= a.z1 AS meets,
       a.x0 <= b.x0 AND b.x1 <= a.x1 AND a.y0 <= b.y0 AND b.y1 <= a.y1 AND a.z0 <= b.z0 AND b.z1 <= a.z1 AS contains,
       (a.x0, a.y0, a.z0, a.x1, a.y1, a.z1) = (b.x0, b.y0, b.z0, b.x1, b.y1, b.z1) AS equals,
       greatest(a.x0 - b.x1, b.x0 - a.x1, 0) AS dx,
       greatest(a.y0 - b.y1, b.y0 - a.y1, 0) AS dy,
       greatest(a.z0 - b.z1, b.z0 - a.z1, 0) AS dz
FROM sample AS a, sample AS b;

SELECT bool_and((a && b) = meets) AS t,
       bool_and((a @> b) = contains) AS t,
       bool_and((b <@ a) = contains) AS t,
       bool_and((a = b) = equals) AS t,
       bool_and((a ~= b) = equals) AS t,
       -- every answer occurs often enough to mean something
       least(count(*) FILTER (WHERE meets), count(*) FILTER (WHERE NOT meets),
             count(*) FILTER (WHERE contains), count(*) FILTER (WHERE NOT contains)) > 300 AS t
FROM pair;

-- Commutators.
SELECT bool_and((a && b) = (b && a)) AS t,
       bool_and((a @> b) = (b <@ a)) AS t,
       bool_and((a = b) = (b = a)) AS t,
       bool_and((a ~= b) = (b ~= a)) AS t,
       bool_and((a <-> b) = (b <-> a)) AS t
FROM pair;

-- Distance: 0 exactly where boxes meet, and the Euclidean one elsewhere, to rounding.
SELECT bool_and(((a <-> b) = 0) = meets) AS t,
       bool_and(abs((a <-> b) - sqrt(dx * dx + dy * dy + dz * dz)) <= 1e-15 * (a <-> b)) AS t
FROM pair;
SELECT 'BOX3D(0 0 0, 1 1 1)'::box3d <-> 'BOX3D(4 5 1, 9 9 9)'::box3d = 5 AS t,
       'BOX3D(0 0 0, 1 1 1)'::box3d <-> 'BOX3D(3 4 7, 3 4 7)'::box3d = 7 AS t,
       'BOX3D(1e150 0 0, 1e150 0 0)'::box3d <-> 'BOX3D(0 1e-300 0, 0 1 0)'::box3d = 1e150 AS t;

-- Points: as boxes without extent.
SELECT bool_and((a.box @> p) = (a.box @> box3d(p, p))) AS t,
       bool_and((p <@ a.box) = (a.box @> p)) AS t,
       bool_and((a.box <-> p) = (a.box <-> box3d(p, p))) AS t,
       bool_and((p <-> a.box) = (a.box <-> p)) AS t,
       bool_and(a.box @> p) FILTER (WHERE a.number = b.number) AS t,
       count(*) FILTER (WHERE a.box @> p AND a.number <> b.number) > 300 AS t
FROM sample AS a, sample AS b, LATERAL (VALUES (lower(b.box)), (upper(b.box))) AS corner (p);
SELECT 'BOX3D(0 0 0, 1 1 1)'::box3d @> 'POINT(1 1 1)'::point3d AS t,
       NOT 'BOX3D(0 0 0, 1 1 1)'::box3d @> 'POINT(1.0000000000000002 1 1)'::point3d AS t,
       'BOX3D(0 0 0, 1 1 1)'::box3d <-> 'POINT(0.5 0.5 0.5)'::point3d = 0 AS t,
       'POINT(4 5 0)'::point3d <-> 'BOX3D(0 0 0, 1 1 1)'::box3d = 5 AS t;

-- A cone that looks north: 90 degrees wide, 10 m far, eye at (0, 0, 0).
CREATE TEMPORARY TABLE cone_case (meets boolean, box box3d, why text);
INSERT INTO cone_case VALUES
    (true, 'BOX3D(-1 5 -1, 1 6 1)', 'ahead'),
    (true, 'BOX3D(-1 -1 -1, 1 1 1)', 'around the eye'),
    (true, 'BOX3D(0 0 0, 0 0 0)', 'the eye'),
    (true, 'BOX3D(-1 -1 -1, 1 0 1)', 'touches the eye with a face'),
    (false, 'BOX3D(-1 -6 -1, 1 -5 1)', 'behind'),
    (false, 'BOX3D(-1 -6 -1, 1 -0.001 1)', 'close behind'),
    (true, 'BOX3D(-1 10 -1, 1 11 1)', 'touches the end of the range'),
    (true, 'BOX3D(0 10 0, 0 10 0)', 'a point at the end of the range'),
    (false, 'BOX3D(-1 10.001 -1, 1 11 1)', 'beyond the range'),
    (false, 'BOX3D(7.072 7.072 -1, 9 9 1)', 'near corner beyond the range, box around it not'),
    (false, 'BOX3D(6 2 -1, 7 5.99 1)', 'right of the edge'),
    (true, 'BOX3D(6 2 -1, 7 6.01 1)', 'cut by the edge at its corner'),
    (true, 'BOX3D(-100 5 -100, 100 5 100)', 'a wall across'),
    (true, 'BOX3D(-0.001 -50 -50, 0.001 50 50)', 'a wall along'),
    (true, 'BOX3D(-1 5 4.9, 1 5 9)', 'below the upper edge'),
    (false, 'BOX3D(-1 4 4.2, 1 4 9)', 'above the upper edge'),
    (false, 'BOX3D(3 4 3, 3.1 4.1 3.1)', 'within 45 degrees both level and upright, not within the cone'),
    (true, 'BOX3D(-1000 -1000 -1000, 1000 1000 1000)', 'holds the cone'),
    (true, 'BOX3D(-0.1 4.9 -0.1, 0.1 5.1 0.1)', 'inside the cone');
SELECT why, (box && cone) = meets AS t, (cone && box) = meets AS t
FROM cone_case, (VALUES ('VIEW_CONE(0 0 0, 0, 90, 10, 0)'::view_cone)) AS c (cone);

-- The same cases turned: east, south, west, up, down; and far from the origin.
CREATE FUNCTION pg_temp.turned(p point3d, way text) RETURNS point3d LANGUAGE sql AS $$
    SELECT CASE way
        WHEN 'east' THEN occlusion.point3d(occlusion.y(p), -occlusion.x(p), occlusion.z(p))
        WHEN 'south' THEN occlusion.point3d(-occlusion.x(p), -occlusion.y(p), occlusion.z(p))
        WHEN 'west' THEN occlusion.point3d(-occlusion.y(p), occlusion.x(p), occlusion.z(p))
        WHEN 'up' THEN occlusion.point3d(occlusion.x(p), -occlusion.z(p), occlusion.y(p))
        WHEN 'down' THEN occlusion.point3d(occlusion.x(p), occlusion.z(p), -occlusion.y(p))
        WHEN 'far' THEN occlusion.point3d(occlusion.x(p) + 85000, occlusion.y(p) + 447000, occlusion.z(p))
    END
$$;
-- Where a box touches the range exactly, a turn by a rounded angle may miss it.
SELECT way, bool_and((turned && cone) = meets) AS t
FROM cone_case
CROSS JOIN (VALUES
    ('east', 'VIEW_CONE(0 0 0, 90, 90, 10, 0)'::view_cone), ('south', 'VIEW_CONE(0 0 0, 180, 90, 10, 0)'),
    ('west', 'VIEW_CONE(0 0 0, -90, 90, 10, 0)'), ('up', 'VIEW_CONE(0 0 0, 0, 90, 10, 90)'),
    ('down', 'VIEW_CONE(0 0 0, 123, 90, 10, -90)'), ('far', 'VIEW_CONE(85000 447000 0, 360, 90, 10, 0)')
) AS turn (way, cone)
CROSS JOIN LATERAL (
    SELECT box3d(pg_temp.turned(lower(box), way), pg_temp.turned(upper(box), way)) AS turned
) AS t
GROUP BY way ORDER BY way;

-- A sector has no upper or lower edge: 90 degrees wide, 10 m far, any pitch.
CREATE TEMPORARY TABLE sector_case (meets boolean, box box3d, why text);
INSERT INTO sector_case VALUES
    (true, 'BOX3D(-1 5 -1, 1 6 1)', 'ahead'),
    (true, 'BOX3D(0 0 0, 0 0 0)', 'the eye'),
    (true, 'BOX3D(0 0 9, 0 0 9)', 'a point right above the eye'),
    (true, 'BOX3D(0 0 -10, 0 0 -10)', 'a point right below, at the end of the range'),
    (false, 'BOX3D(0 0 10.001, 0 0 11)', 'right above, beyond the range'),
    (false, 'BOX3D(-1 -6 -1, 1 -0.001 1)', 'behind'),
    (true, 'BOX3D(-1 1 8, 1 2 9)', 'steeply above, ahead'),
    (false, 'BOX3D(-1 -2 8, 1 -1 9)', 'steeply above, behind'),
    (true, 'BOX3D(3 4 3, 3.1 4.1 3.1)', 'off the cone, within the sector'),
    (false, 'BOX3D(6 2 -1, 7 5.99 1)', 'right of the edge'),
    (true, 'BOX3D(6 2 -1, 7 6.01 1)', 'cut by the edge at its corner'),
    (true, 'BOX3D(-1 10 -1, 1 11 1)', 'touches the end of the range'),
    (false, 'BOX3D(-1 10.001 -1, 1 11 1)', 'beyond the range'),
    (false, 'BOX3D(-1 8 6.001, 1 9 7)', 'beyond the range in space, within it on the map'),
    (true, 'BOX3D(-1 8 5.999, 1 9 7)', 'just within the range in space'),
    (true, 'BOX3D(-100 5 -100, 100 5 100)', 'a wall across'),
    (true, 'BOX3D(-1000 -1000 -1000, 1000 1000 1000)', 'holds the sector');
SELECT why, (box && sector) = meets AS t, (sector && box) = meets AS t
FROM sector_case, (VALUES ('VIEW_SECTOR(0 0 0, 0, 90, 10)'::view_sector)) AS s (sector);

-- More than a half circle: what is left out is a wedge behind.
SELECT 'BOX3D(-1 -6 -1, 1 -5 1)'::box3d && 'VIEW_SECTOR(0 0 0, 0, 359, 10)'::view_sector AS t,
       NOT 'BOX3D(-0.01 -6 -1, 0.01 -5 1)'::box3d && 'VIEW_SECTOR(0 0 0, 0, 359, 10)'::view_sector AS t,
       'BOX3D(-6 -1 -1, -5 1 1)'::box3d && 'VIEW_SECTOR(0 0 0, 0, 270, 10)'::view_sector AS t,
       NOT 'BOX3D(-1 -6 -1, 1 -5 1)'::box3d && 'VIEW_SECTOR(0 0 0, 0, 270, 10)'::view_sector AS t,
       'BOX3D(-6 -1 -1, -5 -1 1)'::box3d && 'VIEW_CONE(0 0 0, 0, 270, 10, 0)'::view_cone AS t,
       NOT 'BOX3D(-1 -6 -1, 1 -5 1)'::box3d && 'VIEW_CONE(0 0 0, 0, 270, 10, 0)'::view_cone AS t;

-- No range: only what holds the eye.
SELECT 'BOX3D(0 0 0, 1 1 1)'::box3d && 'VIEW_CONE(0 0 0, 0, 60, 0, 0)'::view_cone AS t,
       NOT 'BOX3D(0 0.001 0, 1 1 1)'::box3d && 'VIEW_CONE(0 0 0, 0, 60, 0, 0)'::view_cone AS t,
       'BOX3D(0 0 0, 1 1 1)'::box3d && 'VIEW_SECTOR(0 0 0, 0, 60, 0)'::view_sector AS t,
       NOT 'BOX3D(0 0.001 0, 1 1 1)'::box3d && 'VIEW_SECTOR(0 0 0, 0, 60, 0)'::view_sector AS t;

-- Nothing visible is missed: a box with a point in the field of view meets it. Points by the
-- golden ratio, so that they are the same everywhere.
WITH point AS (
    SELECT 85000 + 40 * (i * 0.6180339887498949 - floor(i * 0.6180339887498949)) - 20 AS x,
           447000 + 40 * (i * 0.7548776662466927 - floor(i * 0.7548776662466927)) - 20 AS y,
           40 * (i * 0.5698402909980532 - floor(i * 0.5698402909980532)) - 20 AS z, i
    FROM generate_series(1, 20000) AS i
), seen AS (
    SELECT p.*, heading, angle, pitch, d,
           degrees(acos(greatest(-1, least(1, (
               (x - 85000) * sin(radians(heading)) * cos(radians(pitch))
               + (y - 447000) * cos(radians(heading)) * cos(radians(pitch)) + z * sin(radians(pitch))) / d)))) AS off_axis,
           abs(mod((degrees(atan2(x - 85000, y - 447000)) - heading + 900)::numeric, 360) - 180) AS off_heading
    FROM point AS p
    CROSS JOIN (VALUES (30::float8, 60::float8, 0::float8), (200, 200, -45), (350, 3, 10)) AS look (heading, angle, pitch)
    CROSS JOIN LATERAL (SELECT sqrt((x - 85000) ^ 2 + (y - 447000) ^ 2 + z ^ 2) AS d) AS distance
), answered AS (
    SELECT d <= 15 - 1e-6 AND off_axis <= angle / 2 - 1e-6 AS in_cone,
           d >= 15 + 1e-6 OR off_axis >= angle / 2 + 1e-6 AS off_cone,
           d <= 15 - 1e-6 AND off_heading <= angle / 2 - 1e-6 AS in_sector,
           d >= 15 + 1e-6 OR off_heading >= angle / 2 + 1e-6 AS off_sector,
           box3d(point3d(x, y, z), point3d(x, y, z)) AS just,
           box3d(point3d(x, y, z), point3d(x + mod(i, 7) - 3, y + mod(i, 5) - 2, z + mod(i, 3) - 1)) AS around,
           view_cone(point3d(85000, 447000, 0), heading, angle, 15, pitch) AS cone,
           view_sector(point3d(85000, 447000, 0), heading, angle, 15) AS sector
    FROM seen
)
SELECT bool_and(just && cone) FILTER (WHERE in_cone) AS t,
       bool_and(around && cone) FILTER (WHERE in_cone) AS t,
       bool_and(NOT just && cone) FILTER (WHERE off_cone) AS t,
       bool_and(just && sector) FILTER (WHERE in_sector) AS t,
       bool_and(around && sector) FILTER (WHERE in_sector) AS t,
       bool_and(NOT just && sector) FILTER (WHERE off_sector) AS t,
       least(count(*) FILTER (WHERE in_cone), count(*) FILTER (WHERE in_sector)) > 2500 AS t
FROM answered;

-- So does a box of any size around one.
SELECT bool_and(box && 'VIEW_CONE(110 110 10, 225, 1, 5, -30)'::view_cone) AS t,
       bool_and(box && 'VIEW_SECTOR(110 110 10, 225, 1, 5)'::view_sector) AS t
FROM (VALUES ('BOX3D(100 100 0, 120 120 20)'::box3d), ('BOX3D(-1e6 -1e6 -1e6, 1e6 1e6 1e6)'),
             ('BOX3D(-1e15 -3 -1e15, 1e15 1e15 1e9)'), ('BOX3D(-1e15 0 -1, 1e300 1000000000000001 50)'),
             ('BOX3D(-1e308 -1e308 -1e308, 1e308 1e308 1e308)')) AS around (box);
