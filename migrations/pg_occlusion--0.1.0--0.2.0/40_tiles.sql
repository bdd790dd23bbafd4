-- Packed tiles and the log of edits, and queries that are answered from them.

DROP FUNCTION occlusion.make_city(text, integer, bigint, integer, integer);

-- include sql/40_scene.sql
-- include sql/45_tiles.sql
-- include sql/46_replicas.sql
-- include sql/50_city.sql
-- include sql/70_queries.sql

DROP FUNCTION occlusion.visible_features_statement(text, boolean), occlusion.require_range(float8);

COMMENT ON FUNCTION occlusion.settle_ground(text, bigint[]) IS
    'of some new features, makes the solids of those that do not stand on the ground ungrounded, and removes them where a bottom was added, and so of other buildings that do not any more; returns how many there are of each among the new ones';
