-- View cells, and the log of changes since.

-- include sql/74_counters.sql
-- include sql/77_view_cells.sql
-- include sql/78_seals.sql

-- include sql/78_visible_ahead.sql
-- include sql/79_scene_status.sql
