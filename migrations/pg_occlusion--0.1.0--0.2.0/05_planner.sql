-- What the planner asks.

-- include sql/05_planner.sql
