-- Lines of sight.

-- include sql/72_line_of_sight.sql
