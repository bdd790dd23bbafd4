-- Scenes as users of 0.1.0 have them, with things of their own around them.
SELECT occlusion.generate_city('town', 'streets', 200, 1);
SELECT occlusion.generate_city('square', 'blocks', 60, 2);
CALL occlusion.generate_occlusion_volumes('town', smallest => 4);
CALL occlusion.generate_occlusion_volumes('square', smallest => 4, range => 200);

SELECT occlusion.create_scene('hamlet', 28992);
CREATE TABLE house (name text, class text, footprint polygon, height float8, owner text);
INSERT INTO house
SELECT 'house ' || n, 'Building', polygon(box(point(85000 + 14 * n, 447000), point(85010 + 14 * n, 447010 + n))), 5 + n % 4, 'owner ' || n % 3
  FROM generate_series(0, 39) AS n
UNION ALL
VALUES ('wall', 'Wall', polygon '((85000,446980),(85500,446980),(85500,446980.2),(85000,446980.2))', 12, NULL),
       ('line', 'Building', polygon '((85000,447000),(85001,447001))', 3, NULL);
SELECT occlusion.import_features('hamlet', 'house');
SELECT occlusion.generate_view_region('hamlet');
CALL occlusion.generate_occlusion_volumes('hamlet', smallest => 2);
INSERT INTO hamlet.model (feature, level_of_detail, format, content, geometric_error)
SELECT f.id, 3 - m.error, 'obj', m.content, m.error
  FROM hamlet.feature AS f
 CROSS JOIN (VALUES (0, convert_to(E'v 85000 447000 0\nv 85010 447000 0\nv 85010 447010 5\nv 85000 447010 5\nf 1 2 3\nf 1 3 4\n', 'UTF8')),
                    (2, convert_to(E'v 85000 447000 0\nv 85010 447000 0\nv 85010 447010 5\nf 1 2 3\n', 'UTF8'))) AS m (error, content)
 WHERE f.name IN ('house 0', 'house 1');

-- Types, operators and functions in tables, indexes, views and functions of the user's own.
CREATE TABLE place (id int PRIMARY KEY, eye occlusion.point3d NOT NULL, look occlusion.view_cone, area occlusion.view_sector);
INSERT INTO place
SELECT n, eye, occlusion.view_cone(eye, 40 * n % 360, 50 + n, 150), occlusion.view_sector(eye, 70 * n % 360, 90, 120)
  FROM generate_series(1, 30) AS n
 CROSS JOIN LATERAL occlusion.point3d(3 * n + 0.5, 211 * n % 101, 1.6 + n % 2 * 0.3) AS eye;
CREATE TABLE boxes AS SELECT id, envelope AS box FROM town.feature UNION ALL SELECT 1000 + id, envelope FROM square.feature;
CREATE INDEX boxes_box ON boxes USING gist (box);
CREATE VIEW seen AS
SELECT p.id, v.feature_id, v.distance
  FROM place AS p CROSS JOIN occlusion.visible_features('town', p.eye, 80) AS v
 WHERE v.envelope OPERATOR(occlusion.&&) p.look;
VACUUM ANALYZE;
