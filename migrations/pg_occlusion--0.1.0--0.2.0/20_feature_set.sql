-- Sets of features.

-- include sql/15_feature_set.sql
