-- A role that may only read: every function answers it, shows nothing that row security hides from it, and hides nothing
-- behind what it may not know of, whatever the same session has cached for others.
\pset format unaligned

-- A row of houses, the fourth of them secret, a shed behind each, and a street in front.
SELECT occlusion.create_scene('regress_rights');
CREATE TEMP TABLE building (name text, class text, footprint polygon, height float8);
INSERT INTO building
SELECT kind || ' ' || i, 'Building', polygon(box(point(12 * i + x, y), point(12 * i + x + width, y + depth))), height
FROM generate_series(1, 8) AS i,
     (VALUES ('house', 0, 0, 10, 10, 8), ('shed', 4, 14, 2, 2, 2)) AS k (kind, x, y, width, depth, height);
SELECT occlusion.import_features('regress_rights', 'building');
INSERT INTO regress_rights.model (feature, level_of_detail, format, content, geometric_error)
SELECT id, 1, 'obj', E'v 0 0 0\nv 1 0 0\nv 1 1 1\nf 1 2 3\n', 0 FROM regress_rights.feature;
INSERT INTO regress_rights.street (name, area, eye_low, eye_high)
VALUES ('south', ARRAY['((0,-20),(110,-20),(110,-8),(0,-8))'::polygon], 1.5, 2);
SELECT occlusion.assign_slots('regress_rights');
SELECT occlusion.pack_tiles('regress_rights') > 0 AS t;
SET client_min_messages = warning;
CALL occlusion.generate_occlusion_volumes('regress_rights');
CALL occlusion.generate_view_cells('regress_rights', range => 200);
RESET client_min_messages;

CREATE ROLE regress_rights_reader;
GRANT USAGE ON SCHEMA occlusion, regress_rights TO regress_rights_reader;
GRANT SELECT ON ALL TABLES IN SCHEMA regress_rights TO regress_rights_reader;

-- The secret house, the shed behind it, and a cell in front of it.
SELECT f.id AS secret, f.slot AS secret_slot, s.id AS shed,
       (SELECT min(cell) FROM occlusion.view_cells('regress_rights')
        WHERE box OPERATOR(occlusion.@>) 'POINT(53 -12 1.75)'::occlusion.point3d) AS cell
FROM regress_rights.feature AS f, regress_rights.feature AS s
WHERE f.name = 'house 4' AND s.name = 'shed 4' \gset

-- What is asked, as texts in which HOUSE is the number of the secret house, SHED that of the shed behind it, SLOT the slot of
-- the house, CELL the cell, and E the eye. Each gives the numbers of features that it tells of, or a text.
CREATE TEMP TABLE question AS SELECT row_number() OVER () AS number, * FROM (VALUES
    ('visible_features', $$SELECT feature_id FROM occlusion.visible_features('regress_rights', 'E', 100)$$),
    ('visible_features', $$SELECT feature_id FROM occlusion.visible_features('regress_rights', 'VIEW_CONE(53 -12 1.75, 0, 90, 100, 0)'::occlusion.view_cone)$$),
    ('visible_features', $$SELECT feature_id FROM occlusion.visible_features('regress_rights', 'VIEW_SECTOR(53 -12 1.75, 0, 90, 100)'::occlusion.view_sector)$$),
    ('visible_features', $$SELECT feature_id FROM occlusion.visible_features('regress_rights', occlusion.frustum('E', 0::float8, 0, 0, 90, 1, 0.1, 100))$$),
    ('visible_models', $$SELECT feature_id FROM occlusion.visible_models('regress_rights', 'E', 100)$$),
    ('visible_glb', $$SELECT length(occlusion.visible_glb('regress_rights', 'E'::occlusion.point3d, 100))$$),
    ('feature_models', $$SELECT feature_id FROM occlusion.feature_models('regress_rights', '{HOUSE,SHED}')$$),
    ('merged_models', $$SELECT length(occlusion.merged_models('regress_rights', '{HOUSE}'))$$),
    ('visible_extent', $$SELECT feature_id FROM occlusion.visible_extent('regress_rights', 'E', 100)$$),
    ('hidden_by', $$SELECT occluder FROM occlusion.hidden_by('regress_rights', SHED, 'E')$$),
    ('hidden_by', $$SELECT occluder FROM occlusion.hidden_by('regress_rights', HOUSE, 'E')$$),
    ('isovist', $$SELECT HOUSE FROM occlusion.isovist('regress_rights', 'E', 100) AS isovist (a) WHERE NOT point(53, 12) <@ a$$),
    ('line_of_sight', $$SELECT obstacle FROM occlusion.line_of_sight('regress_rights', 'E', 'POINT(53 14 1)')$$),
    ('visible_ahead', $$SELECT feature_id FROM occlusion.visible_ahead('regress_rights', 'E', 'POINT(1 0 0)', 5, 100)$$),
    ('visible_set', $$SELECT unnest(occlusion.feature_ids('regress_rights', visible)) FROM occlusion.visible_set('regress_rights', 'E')$$),
    ('visible_set', $$SELECT HOUSE FROM occlusion.visible_set('regress_rights', 'E') WHERE visible OPERATOR(occlusion.@>) SLOT::bigint$$),
    ('visible_set_change', $$SELECT count(*) FROM occlusion.visible_set_change('regress_rights', 'E', 'POINT(100 -12 1.75)')$$),
    ('visible_from', $$SELECT count(*) > 0 FROM occlusion.visible_from('regress_rights', HOUSE)$$),
    ('visible_from_area', $$SELECT count(*) > 0 FROM occlusion.visible_from_area('regress_rights', HOUSE)$$),
    ('view_cells', $$SELECT count(*) > 0 FROM occlusion.view_cells('regress_rights')$$),
    ('proven_share', $$SELECT occlusion.proven_share('regress_rights') > 0$$),
    ('witnesses', $$SELECT feature_id FROM occlusion.witnesses('regress_rights', CELL)$$),
    ('landmarks', $$SELECT feature_id FROM occlusion.landmarks('regress_rights')$$),
    ('feature_set', $$SELECT occlusion.feature_set('regress_rights', '{HOUSE}')$$),
    ('feature_ids', $$SELECT unnest(occlusion.feature_ids('regress_rights', '{SLOT}'))$$),
    ('scene_status', $$SELECT features FROM occlusion.scene_status('regress_rights')$$),
    ('nearest_models', $$SELECT feature_id FROM occlusion.nearest_models('regress_rights', '{HOUSE,SHED}', '{house,shed}', '{1,2}', 'glb', NULL, NULL)$$),
    ('progress', $$SELECT count(*) FROM occlusion.progress('regress_rights')$$),
    ('import_report', $$SELECT sum(objects) FROM occlusion.import_report('regress_rights')$$),
    ('explain_sight', $$SELECT line FROM occlusion.explain_sight('regress_rights', 'E', 100) AS line WHERE line LIKE 'Tiles%'$$),
    ('explain_visible_features', $$SELECT line FROM occlusion.explain_visible_features('regress_rights', 'E', 100) AS line WHERE line LIKE 'Tiles%'$$)
) AS q (name, statement);
UPDATE question SET statement =
    replace(replace(replace(replace(replace(statement, '''E''', '''POINT(53 -12 1.75)'''),
            'SLOT', :'secret_slot'), 'CELL', :'cell'), 'HOUSE', :'secret'), 'SHED', :'shed');
GRANT SELECT ON question, building TO regress_rights_reader;

-- No function that tells of a scene is left out.
SELECT DISTINCT p.proname
FROM pg_proc AS p
WHERE p.pronamespace = 'occlusion'::regnamespace AND p.proargnames[1] = 'scene' AND p.provolatile <> 'v' AND p.proretset
  AND p.proname NOT IN (SELECT name FROM question)
ORDER BY p.proname;

-- What each tells: whether of the house, whether of the shed, and if of neither, what.
CREATE FUNCTION pg_temp.told(statement text, secret bigint, shed bigint) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    words text[];
BEGIN
    EXECUTE format('SELECT array_agg(w::text) FROM (%s) AS q (w)', statement) INTO words;
    RETURN concat_ws(', ', CASE WHEN secret::text = ANY (words) THEN 'house' END, CASE WHEN shed::text = ANY (words) THEN 'shed' END,
                     CASE WHEN cardinality(words) = 1 AND words[1] NOT IN (secret::text, shed::text) THEN words[1] END);
EXCEPTION WHEN OTHERS THEN
    RETURN concat_ws(' ', SQLSTATE, regexp_replace(SQLERRM, '\d+', 'N'));
END
$$;
CREATE VIEW pg_temp.all_told AS
SELECT number, name, pg_temp.told(statement, :secret, :shed) FROM question;
GRANT SELECT ON pg_temp.all_told TO regress_rights_reader;
TABLE pg_temp.all_told ORDER BY number;
-- SELECT alone is enough to be told the same.
CREATE TEMP TABLE told AS TABLE pg_temp.all_told;
SET ROLE regress_rights_reader;
CREATE TEMP TABLE told_reader AS TABLE pg_temp.all_told;
RESET ROLE;
SELECT o.number, o.name, o.told, r.told AS told_reader
FROM told AS o JOIN told_reader AS r USING (number) WHERE o.told <> r.told ORDER BY number;

-- Row security: the house is in no answer, and the shed is no longer behind it. What was cached for others is not told.
ALTER TABLE regress_rights.feature ENABLE ROW LEVEL SECURITY;
CREATE POLICY no_secret ON regress_rights.feature TO regress_rights_reader USING (name <> 'house 4');
SET ROLE regress_rights_reader;
TABLE pg_temp.all_told ORDER BY number;
-- Through view cells neither.
SET pg_occlusion.use_cells = on;
SELECT pg_temp.told(statement, :secret, :shed) FROM question WHERE number = 1;
RESET pg_occlusion.use_cells;
-- Who would rather have an error than a part gets one.
SET row_security = off;
SELECT pg_temp.told(statement, :secret, :shed) FROM question WHERE number = 1;
RESET row_security;
RESET ROLE;

-- Turn by turn in one session: each its own answer, and after the policy is gone all of it again.
SELECT pg_temp.told(statement, :secret, :shed) FROM question WHERE number = 1;
SET ROLE regress_rights_reader;
SELECT pg_temp.told(statement, :secret, :shed) FROM question WHERE number = 1;
RESET ROLE;
SELECT o.number, o.name, o.told, r.told AS told_again
FROM told AS o JOIN pg_temp.all_told AS r USING (number) WHERE o.told <> r.told ORDER BY number;
ALTER POLICY no_secret ON regress_rights.feature USING (name <> 'house 4' OR current_setting('regress.clearance', true) = 'high');
SET ROLE regress_rights_reader;
SET regress.clearance = 'high';
SELECT pg_temp.told(statement, :secret, :shed) FROM question WHERE number = 1;
RESET regress.clearance;
SELECT pg_temp.told(statement, :secret, :shed) FROM question WHERE number = 1;
RESET ROLE;
DROP POLICY no_secret ON regress_rights.feature;
ALTER TABLE regress_rights.feature DISABLE ROW LEVEL SECURITY;
SET ROLE regress_rights_reader;
SELECT r.number, r.name, r.told FROM told_reader AS o JOIN pg_temp.all_told AS r USING (number) WHERE o.told <> r.told ORDER BY number;

-- What changes a scene is refused to a reader, and nothing is changed.
CREATE FUNCTION pg_temp.outcome(statement text) RETURNS text LANGUAGE plpgsql AS $$
BEGIN
    EXECUTE statement;
    RETURN 'done';
EXCEPTION WHEN OTHERS THEN
    RETURN concat_ws(' ', SQLSTATE, SQLERRM);
END
$$;
SELECT name, pg_temp.outcome(statement)
FROM (VALUES
    ('edit', $$DELETE FROM regress_rights.feature$$),
    ('pack_tiles', $$SELECT occlusion.pack_tiles('regress_rights')$$),
    ('assign_slots', $$SELECT occlusion.assign_slots('regress_rights')$$),
    ('generate_view_region', $$SELECT occlusion.generate_view_region('regress_rights')$$),
    ('import_features', $$SELECT occlusion.import_features('regress_rights', 'building')$$),
    ('seal_view_cells', $$SELECT occlusion.seal_view_cells('regress_rights')$$),
    ('restamp_view_cells', $$SELECT occlusion.restamp_view_cells('regress_rights')$$),
    ('reset_scene_counters', $$SELECT occlusion.reset_scene_counters()$$),
    ('drop_scene', $$SELECT occlusion.drop_scene('regress_rights')$$)
) AS w (name, statement);
CALL occlusion.generate_occlusion_volumes('regress_rights');
\echo :SQLSTATE
CALL occlusion.generate_view_cells('regress_rights');
\echo :SQLSTATE
CALL occlusion.refresh('regress_rights');
\echo :SQLSTATE
SELECT r.number, r.name, r.told FROM told_reader AS o JOIN pg_temp.all_told AS r USING (number) WHERE o.told <> r.told ORDER BY number;
RESET ROLE;

DROP VIEW pg_temp.all_told;
SELECT occlusion.drop_scene('regress_rights');
DROP OWNED BY regress_rights_reader;
DROP ROLE regress_rights_reader;
