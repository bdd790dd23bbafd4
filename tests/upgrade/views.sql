-- What can be seen in those scenes, as 0.1.0 answers. A later version may hide more, never less.
\pset format unaligned
\pset tuples_only on

-- Observers: the places, and eyes in the streets of each scene.
CREATE TEMP TABLE observer AS
SELECT row_number() OVER (ORDER BY scene, x, y, z) AS number, scene, occlusion.point3d(x, y, z) AS eye
  FROM (SELECT scene, occlusion.x(eye) AS x, occlusion.y(eye) AS y, occlusion.z(eye) AS z
          FROM place, unnest('{town,square}'::text[]) AS scene
        UNION ALL
        SELECT scene, c[0], c[1], z
          FROM (SELECT 'town' AS scene, point(area[1]) AS c, eye_low AS z FROM town.street
                UNION ALL SELECT 'square', point(area[1]), eye_low FROM square.street
                UNION ALL SELECT 'hamlet', point(area[1]), eye_high FROM hamlet.street) AS street) AS place_or_street;
SELECT scene, count(*) FROM observer GROUP BY scene ORDER BY scene;

SELECT 'all round', o.number, o.scene, v.*
  FROM observer AS o CROSS JOIN occlusion.visible_features(o.scene, o.eye, 100) AS v ORDER BY o.number, v.feature_id;
SELECT 'cone', o.number, o.scene, v.*
  FROM observer AS o CROSS JOIN occlusion.visible_features(o.scene, occlusion.view_cone(o.eye, o.number % 360, 60, 150)) AS v
 ORDER BY o.number, v.feature_id;
SELECT 'sector', o.number, o.scene, v.*
  FROM observer AS o CROSS JOIN occlusion.visible_features(o.scene, occlusion.view_sector(o.eye, o.number % 360, 60, 150)) AS v
 ORDER BY o.number, v.feature_id;
SELECT 'models', o.number, v.feature_id, v.class, v.distance, v.level_of_detail, md5(v.content)
  FROM observer AS o CROSS JOIN occlusion.visible_models(o.scene, o.eye, 60, 'cityjson') AS v
 WHERE o.number % 7 = 0 ORDER BY o.number, v.feature_id;
SELECT 'models of a cone', o.number, v.feature_id, v.class, v.distance, v.level_of_detail, md5(v.content)
  FROM observer AS o CROSS JOIN occlusion.visible_models(o.scene, occlusion.view_cone(o.eye, 0, 90, 90), error_angle => 0.5) AS v
 WHERE o.number % 11 = 0 ORDER BY o.number, v.feature_id;
SELECT 'models of a sector', o.number, v.feature_id, v.class, v.distance, v.level_of_detail, md5(v.content)
  FROM observer AS o CROSS JOIN occlusion.visible_models(o.scene, occlusion.view_sector(o.eye, 180, 90, 90)) AS v
 WHERE o.number % 11 = 0 ORDER BY o.number, v.feature_id;
SELECT 'seen', * FROM seen ORDER BY id, feature_id;
