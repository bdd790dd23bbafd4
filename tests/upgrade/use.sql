-- The scenes work on after the update: they are edited, generated again, asked and dropped, and new ones
-- are made beside them. At the end nothing holds the extension, and it is dropped.
\pset tuples_only on
CREATE FUNCTION pg_temp.require(truth boolean, what text) RETURNS void LANGUAGE plpgsql AS $$
BEGIN
    IF truth IS NOT TRUE THEN
        RAISE EXCEPTION 'not true: %', what;
    END IF;
END
$$;

-- An edit drops volumes, by the triggers that the released version made.
CREATE TEMP TABLE moved AS SELECT occluder AS id FROM town.occlusion_volume GROUP BY occluder ORDER BY count(*) DESC LIMIT 1;
UPDATE town.feature SET envelope = occlusion.expand(envelope, 1) WHERE id = (SELECT id FROM moved);
SELECT pg_temp.require(NOT EXISTS (SELECT FROM town.occlusion_volume AS v, moved AS m WHERE m.id IN (v.occluder, v.occludee)),
                       'the volumes of a feature that moved are gone');
SELECT pg_temp.require(EXISTS (SELECT FROM town.occlusion_volume), 'those of the others are there');
DELETE FROM hamlet.solid_column;
SELECT pg_temp.require(NOT EXISTS (SELECT FROM hamlet.occlusion_volume), 'without solids nothing hides');

CREATE TABLE more AS SELECT 'new' AS name, polygon '((85000,447100),(85020,447100),(85020,447120),(85000,447120))' AS footprint, 30 AS height;
SELECT pg_temp.require(occlusion.import_features('hamlet', 'more') = 1, 'a feature is imported');
CALL occlusion.generate_occlusion_volumes('town', smallest => 4);
CALL occlusion.generate_occlusion_volumes('hamlet', smallest => 4);
SELECT pg_temp.require(EXISTS (SELECT FROM town.occlusion_volume AS v, moved AS m WHERE v.occluder = m.id),
                       'what moved hides again once generated');
SELECT pg_temp.require(count(*) > 0 AND count(*) < (SELECT count(*) FROM town.feature), 'some are seen, not all')
  FROM occlusion.visible_features('town', (SELECT occlusion.lower(box) FROM town.occlusion_volume ORDER BY box::text LIMIT 1), 1000);
SELECT pg_temp.require(count(*) > 0, 'the plan is explained')
  FROM occlusion.explain_visible_features('town', occlusion.point3d(50, 50, 1.75), 100);

SELECT pg_temp.require(occlusion.generate_city('village', 'streets', 50, 3) = 50, 'a new scene is made');
CALL occlusion.generate_occlusion_volumes('village', smallest => 4);
SELECT pg_temp.require(EXISTS (SELECT FROM village.occlusion_volume), 'a new scene hides');

SELECT occlusion.drop_scene(scene) FROM unnest('{town,square,hamlet,village}'::text[]) AS scene;
SELECT pg_temp.require(NOT EXISTS (SELECT FROM pg_namespace WHERE nspname IN ('town', 'square', 'hamlet', 'village')), 'the scenes are gone');
DROP VIEW seen;
DROP TABLE place, boxes;
DROP EXTENSION IF EXISTS pg_occlusion_postgis;
DROP EXTENSION pg_occlusion;
SELECT pg_temp.require(NOT EXISTS (SELECT FROM pg_proc AS p JOIN pg_namespace AS n ON n.oid = p.pronamespace WHERE n.nspname = 'occlusion'),
                       'nothing of the extension is left');
