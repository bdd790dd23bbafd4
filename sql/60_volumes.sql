-- Occlusion volumes.

CREATE PROCEDURE occlusion.generate_occlusion_volumes(scene text, smallest float8 DEFAULT 1,
                                                      range float8 DEFAULT NULL,
                                                      worth float8 DEFAULT NULL)
LANGUAGE c AS 'MODULE_PATHNAME', 'generate_occlusion_volumes_wrapper';
COMMENT ON PROCEDURE occlusion.generate_occlusion_volumes(text, float8, float8, float8) IS
    'computes from where single features hide others, along all streets; replaces what is there, commits batch by batch. smallest: least width of a lane in metres; range: farthest look in metres, NULL for any; worth: square metres of street that each volume must add, NULL for the larger of 4 times smallest squared and a 20,000th of the street area';

CREATE FUNCTION occlusion.progress(scene text)
RETURNS TABLE (task text, done bigint, total bigint, made bigint, per_second float8,
               time_left interval, state text)
LANGUAGE plpgsql STABLE STRICT
SET search_path = pg_catalog, pg_temp AS $$
BEGIN
    PERFORM occlusion.require_scene(scene);
    RETURN QUERY EXECUTE format($q$
        SELECT j.task, j.done, j.total, j.made, r.rate,
               CASE WHEN NOT j.finished AND r.rate > 0
                    THEN make_interval(secs => (j.total - j.done) / r.rate) END,
               CASE WHEN j.finished THEN 'finished'
                    WHEN EXISTS (SELECT FROM pg_catalog.pg_stat_activity AS a WHERE a.pid = j.backend)
                    THEN 'running' ELSE 'interrupted' END
        FROM %I.job AS j
        CROSS JOIN LATERAL (
            SELECT j.done / nullif(extract(epoch FROM j.updated - j.started), 0)::float8 AS rate
        ) AS r
        ORDER BY j.started
    $q$, scene);
END
$$;
COMMENT ON FUNCTION occlusion.progress(text) IS 'how far the long work on a scene is';
