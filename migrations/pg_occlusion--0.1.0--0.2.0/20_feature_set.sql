-- Sets of features.

-- include sql/15_feature_set.sql

-- include sql/75_feature_slots.sql
