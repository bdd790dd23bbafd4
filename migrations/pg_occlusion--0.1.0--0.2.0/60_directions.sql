-- Directions, isovists, what hides, and lines of sight.

-- include sql/71_directions.sql
-- include sql/72_line_of_sight.sql
