-- The frustum, and the models of what it sees.

-- include sql/35_frustum.sql
-- include sql/75_frustum_queries.sql
-- include sql/85_visible_models.sql
