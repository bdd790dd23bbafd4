-- How often scenes were asked.
\pset format unaligned
SELECT occlusion.generate_city('regress_counted', 'streets', 20, 1) > 0 AS t;
SELECT occlusion.reset_scene_counters();
SELECT count(*) > 0 AS t FROM occlusion.visible_features('regress_counted', 'POINT(5 5 1.75)', 300);
SELECT count(*) > 0 AS t FROM occlusion.visible_features('regress_counted', 'POINT(5 6 1.75)', 300);
SELECT count(*) = 0 AS t FROM occlusion.visible_set('regress_counted', 'POINT(5 6 1.75)');
SELECT queries, live, by_cell, by_volumes, features > 0 AS t, sets, sets_missing
FROM occlusion.stat_scenes WHERE scene = 'regress_counted';
-- Everybody reads it, and not everybody begins anew.
CREATE ROLE regress_counted_reader;
GRANT USAGE ON SCHEMA occlusion TO regress_counted_reader;
SET ROLE regress_counted_reader;
SELECT queries FROM occlusion.stat_scenes WHERE scene = 'regress_counted';
SELECT occlusion.reset_scene_counters();
RESET ROLE;
-- What is rolled back was asked, too; a scene of the same name is another one.
BEGIN;
SELECT count(*) > 0 AS t FROM occlusion.visible_features('regress_counted', 'POINT(5 5 1.75)', 300);
ROLLBACK;
SELECT queries FROM occlusion.stat_scenes WHERE scene = 'regress_counted';
SELECT occlusion.drop_scene('regress_counted');
SELECT occlusion.generate_city('regress_counted', 'streets', 20, 1) > 0 AS t;
SELECT count(*) AS asked FROM occlusion.stat_scenes WHERE scene = 'regress_counted';
SELECT occlusion.drop_scene('regress_counted');
DROP OWNED BY regress_counted_reader;
DROP ROLE regress_counted_reader;
