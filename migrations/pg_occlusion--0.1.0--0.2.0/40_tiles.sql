-- Packed tiles and the log of edits, and queries that are answered from them.

DROP FUNCTION occlusion.make_city(text, integer, bigint, integer, integer);

-- include sql/40_scene.sql
-- include sql/45_tiles.sql
-- include sql/46_replicas.sql
-- include sql/50_city.sql
-- include sql/70_queries.sql

DROP FUNCTION occlusion.visible_features_statement(text, boolean), occlusion.require_range(float8);
