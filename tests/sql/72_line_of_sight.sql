-- Lines of sight, exact against meshes, columns and boxes.

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

SELECT occlusion.create_scene('sight city');

-- A house with a mesh of its own: the first `faces` triangles of a box, 12 of which close it.
CREATE FUNCTION pg_temp.add_house(id bigint, x float8, y float8, z float8, size float8, faces integer DEFAULT 12)
RETURNS void LANGUAGE sql AS $$
    INSERT INTO "sight city".feature (id, envelope)
    VALUES (id, occlusion.box3d(occlusion.point3d(x, y, z), occlusion.point3d(x + size, y + size, z + size)));
    INSERT INTO "sight city".mesh (feature, vertices, triangles, defect)
    SELECT id, array_agg(CASE axis WHEN 0 THEN x + size * (corner & 1)
                                   WHEN 1 THEN y + size * (corner >> 1 & 1)
                                   ELSE z + size * (corner >> 2) END ORDER BY corner, axis),
           ('{0,2,3,0,3,1,4,5,7,4,7,6,0,1,5,0,5,4,2,6,7,2,7,3,0,4,6,0,6,2,1,3,7,1,7,5}'::integer[])[:3 * faces],
           CASE WHEN faces < 12 THEN 'open' END
    FROM generate_series(0, 7) AS corner, generate_series(0, 2) AS axis;
$$;
CREATE FUNCTION pg_temp.sight(a text, b text, OUT visible boolean, OUT obstacle bigint, OUT distance float8, OUT point text)
LANGUAGE sql STABLE AS $$
    SELECT l.visible, l.obstacle, l.distance, l.point::text
    FROM occlusion.line_of_sight('sight city', ('POINT(' || a || ')')::occlusion.point3d,
                                 ('POINT(' || b || ')')::occlusion.point3d) AS l
$$;

SELECT pg_temp.add_house(1, 10, 0, 0, 10), pg_temp.add_house(2, 30, 0, 0, 10), pg_temp.add_house(3, 40, 0, 0, 10),
       pg_temp.add_house(4, 60, 10, 0, 10);

-- What is behind a house, on its front, on its back, in it, before it, over it.
SELECT how, s.*
FROM (VALUES
    (1, 'behind', '0 5 2', '25 5 2'),
    (2, 'far behind', '0 5 2', '90 5 2'),
    (3, 'from the other side', '90 5 2', '0 5 2'),
    (4, 'on the front', '0 5 2', '10 4 9'),
    (5, 'on the back', '0 5 2', '20 5 2'),
    (6, 'inside', '0 5 2', '15 5 2'),
    (7, 'before', '0 5 2', '9 5 2'),
    (8, 'over', '0 5 12', '90 5 11'),
    (9, 'on the roof, from above', '15 5 20', '15 5 10'),
    (10, 'rising and falling', '5 5 2', '29 9 10'),
    (11, 'itself', '0 5 2', '0 5 2'),
    (12, 'itself, inside', '15 5 2', '15 5 2')
) AS v (number, how, a, b), LATERAL pg_temp.sight(a, b) AS s ORDER BY number;

-- Touching is not hiding: along walls and roofs, past edges and corners, between houses that touch.
SELECT bool_and(s.visible AND s.obstacle IS NULL AND s.distance IS NULL AND s.point IS NULL) AS t
FROM (VALUES
    ('0 0 2', '90 0 2'), ('0 5 10', '59 5 10'), ('0 0 0', '90 0 0'), ('0 0 10', '90 0 10'), ('40 -5 2', '40 15 2'),
    ('5 5 2', '15 -5 2'), ('5 -5 10', '15 5 10'), ('10 5 2', '10 5 30'), ('10 -5 15', '10 15 5'),
    ('10 10 10', '30 10 10'), ('20 10 2', '60 10 2')
) AS v (a, b), LATERAL pg_temp.sight(a, b) AS s;

-- A house that holds the eye hides nothing until the line has left it and comes back; nor another's front.
SELECT s.* FROM (VALUES (1, '15 5 2', '25 5 2'), (2, '15 5 2', '16 5 2'), (3, '15 5 2', '30 5 2'), (4, '15 5 2', '31 5 2'),
                        (5, '10 5 2', '12 5 2'), (6, '39 5 2', '60 5 2')) AS v (number, a, b),
     LATERAL pg_temp.sight(a, b) AS s ORDER BY number;

-- What encloses no solid hides where its surface is crossed: a box with no wall to the east, and an awning.
SELECT pg_temp.add_house(5, 100, 0, 0, 10, 10), pg_temp.add_house(6, 120, 0, 0, 10, 2);
SELECT s.*
FROM (VALUES
    (1, '95 5 2', '105 5 2'), (2, '105 5 2', '115 5 2'), (3, '115 5 2', '90 5 2'), (4, '125 5 -5', '125 5 5'),
    (5, '125 3 -5', '125 3 5'), (6, '120 5 -5', '120 5 5'), (7, '115 5 0', '135 5 0'), (8, '125 5 -5', '125 5 0')
) AS v (number, a, b), LATERAL pg_temp.sight(a, b) AS s ORDER BY number;

-- Without a mesh columns hide, which do not reach below their bottoms, and else the box inside.
INSERT INTO "sight city".feature (id, envelope) VALUES
    (7, 'BOX3D(200 0 0, 230 10 10)'), (8, 'BOX3D(240 0 0, 250 10 10)'), (9, 'BOX3D(260 0 0, 270 10 10)');
INSERT INTO "sight city".solid_column (feature, footprint, bottom, top, grounded) VALUES
    (7, ARRAY[polygon '((200,0),(210,0),(210,10),(200,10))'], 2, 10, true),
    (7, ARRAY[polygon '((210,0),(230,0),(230,10),(210,10))', polygon '((215,3),(215,7),(225,7),(225,3))'], 2, 10, true);
INSERT INTO "sight city".inner_envelope (feature, box) VALUES
    (7, 'BOX3D(200 0 0, 230 10 10)'), (8, 'BOX3D(241 1 0, 249 9 9)');
SELECT s.*
FROM (VALUES
    (1, '195 5 5', '235 5 5'), (2, '195 5 1', '235 5 1'), (3, '195 5 2', '235 5 2'), (4, '220 5 5', '235 5 5'),
    (5, '220 4 5', '220 6 5'), (6, '220 3 5', '220 7 5'), (7, '205 5 5', '220 5 5'), (8, '205 5 5', '226 5 5'),
    (9, '210 -5 5', '210 15 5'), (10, '235 5 5', '255 5 5'), (11, '235 1 5', '255 1 5'), (12, '255 5 5', '275 5 5')
) AS v (number, a, b), LATERAL pg_temp.sight(a, b) AS s ORDER BY number;

-- Two in one place: the least number. Where real cities are, a coordinate away, and far out.
SELECT pg_temp.add_house(21, 85000.1, 447000.3, -1.7, 12.1), pg_temp.add_house(20, 85000.1, 447000.3, -1.7, 7);
SELECT s.obstacle, s.distance = 85000.1::float8 - 84990 AS t, s.point
FROM pg_temp.sight('84990 447003 1', '85090 447003 1') AS s;
SELECT bool_and(s.visible = v.visible) AS t
FROM (VALUES ('84990 447000.3 1', '85090 447000.3 1', true), ('84990 447000.30000000005 1', '85090 447000.30000000005 1', false),
             ('-1e15 447003 1', '1e15 447003 1', false), ('-1e300 447003 1', '1e300 447003 1', false),
             ('1e300 1e300 1e300', '-1e300 1e300 1e300', true), ('85001 447001 1e-300', '85001 447001 -1e-300', true)
) AS v (a, b, visible), LATERAL pg_temp.sight(a, b) AS s;

-- A long line reads no more than it must, and every house that it meets: many in a row, and only then one.
INSERT INTO "sight city".feature (id, envelope)
SELECT 1000 + i, occlusion.box3d(occlusion.point3d(1000 + i, 1000 + i, 0), occlusion.point3d(1000.5 + i, 1000.5 + i, 5))
FROM generate_series(0, 1999) AS i;
INSERT INTO "sight city".inner_envelope (feature, box)
SELECT id, envelope FROM "sight city".feature WHERE id >= 1000;
SELECT s.visible, s.obstacle FROM pg_temp.sight('900 900 2', '4000 4000 2') AS s;
SELECT s.visible, s.obstacle FROM pg_temp.sight('4000 4000 2', '900 900 2') AS s;
SELECT s.visible, s.obstacle FROM pg_temp.sight('900 900 5', '4000 4000 5') AS s;
SELECT s.visible, s.obstacle FROM pg_temp.sight('2700 2701 2', '2780.5 2779 2') AS s;

-- Meshes that are not what they claim.
SELECT pg_temp.add_house(30, 300, 0, 0, 10), pg_temp.add_house(31, 320, 0, 0, 10), pg_temp.add_house(32, 340, 0, 0, 10),
       pg_temp.add_house(33, 360, 0, 0, 10), pg_temp.add_house(34, 380, 0, 0, 10);
UPDATE "sight city".mesh SET triangles = triangles[:30] WHERE feature = 30; -- open, said to be closed
UPDATE "sight city".mesh SET vertices[5] = 'NaN' WHERE feature = 31;
UPDATE "sight city".mesh SET triangles[5] = -1 WHERE feature = 32;
UPDATE "sight city".mesh SET triangles = triangles[:35] WHERE feature = 33;
UPDATE "sight city".mesh SET vertices[5] = NULL WHERE feature = 34;
SELECT s.visible, s.obstacle, s.distance FROM pg_temp.sight('295 5 2', '315 5 2') AS s;
SELECT s.visible FROM pg_temp.sight('315 5 2', '395 5 2') AS s;

-- One view of the tables for a whole statement, whatever has been written before.
BEGIN;
DELETE FROM "sight city".feature WHERE id = 1;
SELECT s.visible, s.obstacle FROM pg_temp.sight('0 5 2', '90 5 2') AS s;
WITH gone AS (DELETE FROM "sight city".feature WHERE id = 2 RETURNING id)
SELECT gone.id, s.visible, s.obstacle FROM gone, LATERAL pg_temp.sight('0 5 2', '90 5 2') AS s;
SELECT s.visible, s.obstacle FROM pg_temp.sight('0 5 2', '90 5 2') AS s;
ROLLBACK;

-- By many at once, in parallel workers too.
SET max_parallel_workers_per_gather = 2;
SET parallel_setup_cost = 0;
SET parallel_tuple_cost = 0;
SET min_parallel_table_scan_size = 0;
EXPLAIN (COSTS OFF)
SELECT count(*) FILTER (WHERE l.visible)
FROM "sight city".feature AS f, LATERAL occlusion.line_of_sight('sight city', 'POINT(-50 -50 90)', occlusion.center(f.envelope)) AS l
WHERE f.id < 1000;
SELECT count(*) FILTER (WHERE NOT l.visible AND l.obstacle = f.id), count(*) FILTER (WHERE NOT l.visible), count(*)
FROM "sight city".feature AS f, LATERAL occlusion.line_of_sight('sight city', 'POINT(-50 -50 90)', occlusion.center(f.envelope)) AS l
WHERE f.id < 1000;
RESET max_parallel_workers_per_gather;
RESET parallel_setup_cost;
RESET parallel_tuple_cost;
RESET min_parallel_table_scan_size;

-- Nulls give no row; errors.
SELECT count(*) = 0 AS t FROM occlusion.line_of_sight(NULL, 'POINT(0 0 0)', 'POINT(1 0 0)');
SELECT count(*) = 0 AS t FROM occlusion.line_of_sight('sight city', 'POINT(0 0 0)', NULL);
CREATE ROLE sight_reader;
GRANT USAGE ON SCHEMA occlusion, "sight city" TO sight_reader;
SET ROLE sight_reader;
\pset format unaligned
SELECT pg_temp.outcome(statement)
FROM (VALUES
    ($$SELECT * FROM occlusion.line_of_sight('sight city', 'POINT(0 0 0)', 'POINT(1 0 0)')$$),
    ($$SELECT * FROM occlusion.line_of_sight('nowhere', 'POINT(0 0 0)', 'POINT(1 0 0)')$$),
    ($$SELECT * FROM occlusion.line_of_sight('nowhere', 'POINT(0 0 0)', 'POINT(0 0 0)')$$),
    ($$SELECT * FROM occlusion.line_of_sight('public', 'POINT(0 0 0)', 'POINT(1 0 0)')$$),
    ($$SELECT * FROM occlusion.line_of_sight('sight city', 'POINT(0 0 NaN)', 'POINT(1 0 0)')$$),
    ($$SELECT * FROM occlusion.line_of_sight('sight city', 'POINT(0 0 1e999)', 'POINT(1 0 0)')$$)
) AS refused (statement);
\pset format aligned
RESET ROLE;
REVOKE ALL ON SCHEMA occlusion, "sight city" FROM sight_reader;
DROP ROLE sight_reader;
SELECT occlusion.drop_scene('sight city');
