-- View cells, and the log of changes since.

-- include sql/77_view_cells.sql
