-- How often scenes were asked.

CREATE FUNCTION occlusion.scene_counters()
RETURNS TABLE (namespace oid, live bigint, by_cell bigint, by_volumes bigint, features bigint, sets bigint, sets_missing bigint)
LANGUAGE c VOLATILE STRICT PARALLEL SAFE ROWS 10
AS 'MODULE_PATHNAME', 'scene_counters_wrapper';
COMMENT ON FUNCTION occlusion.scene_counters() IS
    'how often the scenes of this database were asked since the server was started, by the number of their schema; see the view stat_scenes';

CREATE FUNCTION occlusion.reset_scene_counters() RETURNS void
LANGUAGE c VOLATILE STRICT AS 'MODULE_PATHNAME', 'reset_scene_counters_wrapper';
COMMENT ON FUNCTION occlusion.reset_scene_counters() IS
    'begins to count anew for all scenes of this database';
REVOKE ALL ON FUNCTION occlusion.reset_scene_counters() FROM PUBLIC;

CREATE VIEW occlusion.stat_scenes AS
SELECT n.nspname AS scene, c.live + c.by_cell AS queries, c.live, c.by_cell, c.by_volumes, c.features, c.sets, c.sets_missing
FROM occlusion.scene_counters() AS c JOIN pg_catalog.pg_namespace AS n ON n.oid OPERATOR(pg_catalog.=) c.namespace;
COMMENT ON VIEW occlusion.stat_scenes IS
    'how often each scene of this database was asked since the server was started: answers of visible_features and what rests on it, of them live ones, those through a view cell, those from which occlusion volumes left something out; features returned; visible sets returned, and asked for where no view cell was right';
GRANT SELECT ON occlusion.stat_scenes TO PUBLIC;
