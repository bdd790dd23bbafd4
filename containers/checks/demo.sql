-- What the service "check" of docker-compose.yml asks unless CHECKS names another folder: an assertion that does
-- not hold is an error, with its text, and ends the check with a status other than 0.

DO $$
DECLARE
    eye constant occlusion.point3d := 'POINT(-58 -62 1.75)';
    near bigint;
    seen bigint;
    hidden bigint;
BEGIN
    SELECT count(*) INTO near FROM demo.feature WHERE envelope OPERATOR(occlusion.<->) eye <= 200;
    SELECT count(*) INTO seen FROM occlusion.visible_features('demo', eye, 200);
    ASSERT seen > 0, 'nothing is visible in the demo scene';
    ASSERT seen < near, format('all of %s houses are visible, so nothing hides', near);

    -- Visible live means visible by view cell.
    ASSERT NOT EXISTS (
        SELECT feature_id FROM occlusion.visible_features('demo', eye, 200)
        EXCEPT
        SELECT unnest(occlusion.feature_ids('demo', visible)) FROM occlusion.visible_set('demo', eye)
    ), 'the view cell lacks what is visible from a point in it';

    -- An edit counts at once: without what hides it, a hidden house is visible.
    SELECT id INTO hidden FROM demo.feature
    WHERE envelope OPERATOR(occlusion.<->) eye <= 200
      AND id NOT IN (SELECT feature_id FROM occlusion.visible_features('demo', eye, 200))
    ORDER BY id LIMIT 1;
    BEGIN
        DELETE FROM demo.feature WHERE id <> hidden;
        ASSERT EXISTS (SELECT FROM occlusion.visible_features('demo', eye, 200) WHERE feature_id = hidden),
            format('house %s is alone, and hidden', hidden);
        RAISE EXCEPTION USING ERRCODE = 'OC000', MESSAGE = 'the scene stays as it was';
    EXCEPTION WHEN SQLSTATE 'OC000' THEN
    END;
    RAISE NOTICE '% of % houses are visible', seen, near;
END $$;
