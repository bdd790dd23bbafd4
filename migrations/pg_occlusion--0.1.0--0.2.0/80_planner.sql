-- What the planner asks.

-- include sql/37_planner.sql
-- include sql/87_planner_queries.sql
