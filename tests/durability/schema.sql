-- A table for each kind of index, and a scene; and the means to compare what an index or packed tiles answer with what
-- is there.
CREATE EXTENSION pg_occlusion;
CREATE TABLE by_gist (id bigint GENERATED ALWAYS AS IDENTITY, box occlusion.box3d);
CREATE TABLE by_spgist (LIKE by_gist INCLUDING IDENTITY);
CREATE TABLE by_brin (LIKE by_gist INCLUDING IDENTITY);

-- Adds, moves and removes some rows: street-like ones, touching, flat, and the same over and over.
CREATE PROCEDURE work(part text, round int) LANGUAGE plpgsql AS $$
BEGIN
    EXECUTE format($q$
        INSERT INTO %I (box)
        SELECT occlusion.box3d(occlusion.point3d(85000 + x, 447000 + y, 0),
                               occlusion.point3d(85000 + x + i %% 3 * 5, 447000 + y + 8, i %% 4 * 3))
        FROM generate_series(1, 400) AS i
        CROSS JOIN LATERAL (SELECT (i * 37 + $1 * 11) %% 1000 AS x, (i * 53 + $1 * 7) %% 1000 AS y) AS place$q$, part) USING round;
    EXECUTE format('UPDATE %I SET box = occlusion.translate(box, 3, 0, 1) WHERE id %% 17 = $1 %% 17', part) USING round;
    EXECUTE format('DELETE FROM %I WHERE id %% 13 = $1 %% 13', part) USING round;
END
$$;

-- The ids that an operator finds in a table, by its index or by reading all of it.
CREATE FUNCTION found(part text, condition text, by_index boolean) RETURNS bigint[] LANGUAGE plpgsql AS $$
DECLARE
    statement text := format('SELECT array_agg(id ORDER BY id) FROM %I WHERE box OPERATOR(occlusion.%s', part, condition);
    ids bigint[];
    line text;
    plan text := '';
BEGIN
    PERFORM set_config('enable_seqscan', CASE WHEN by_index THEN 'off' ELSE 'on' END, true);
    PERFORM set_config('enable_indexscan', CASE WHEN by_index THEN 'on' ELSE 'off' END, true);
    PERFORM set_config('enable_bitmapscan', CASE WHEN by_index THEN 'on' ELSE 'off' END, true);
    FOR line IN EXECUTE 'EXPLAIN (COSTS OFF) ' || statement LOOP
        plan := plan || line;
    END LOOP;
    ASSERT by_index = (plan ~ 'Index'), plan;
    EXECUTE statement INTO ids;
    RETURN ids;
END
$$;

-- One row a table: how many questions were asked, how many rows found, and whether the index was right in all.
CREATE VIEW verdict AS
SELECT part, count(*) AS questions, sum(cardinality(plain)) AS rows, bool_and(indexed IS NOT DISTINCT FROM plain) AS right
FROM (VALUES ('by_gist'), ('by_spgist'), ('by_brin')) AS p (part),
     (VALUES ('&&) ''BOX3D(85100 447100 0, 85200 447300 5)''::occlusion.box3d'), ('@>) ''POINT(85400 447404 2)''::occlusion.point3d'),
             ('<@) ''BOX3D(85500 447000 0, 86100 447500 9)''::occlusion.box3d'), ('<<) ''BOX3D(85050 0 0, 85060 0 0)''::occlusion.box3d'),
             ('/>>) ''BOX3D(0 0 0, 0 0 8)''::occlusion.box3d'),
             ('&&) ''VIEW_CONE(85300 447300 1.75, 45, 60, 300, 0)''::occlusion.view_cone'),
             ('&&) ''VIEW_SECTOR(85700 447700 1.75, 200, 90, 300)''::occlusion.view_sector')) AS q (condition),
     LATERAL (SELECT found(part, condition, true) AS indexed, found(part, condition, false) AS plain) AS f
GROUP BY part ORDER BY part;

-- A town, and somebody who may not read its tiles and is answered from its tables.
SELECT occlusion.generate_city('town', 'streets', 1000, 1);
CREATE ROLE without_tiles;
GRANT USAGE ON SCHEMA public, occlusion, town TO without_tiles;
GRANT SELECT ON ALL TABLES IN SCHEMA town TO without_tiles;
REVOKE SELECT ON town.tile, town.edit FROM without_tiles;

-- A quarter that nobody edits, for view cells and occlusion volumes.
SELECT occlusion.generate_city('quarter', 'streets', 400, 2);
CALL occlusion.generate_occlusion_volumes('quarter', smallest => 8, range => 100);

-- Moves, lowers, removes and adds some houses, and packs the tiles now and then.
CREATE PROCEDURE edit_town(round int) LANGUAGE plpgsql AS $$
BEGIN
    UPDATE town.feature SET envelope = occlusion.translate(envelope, 1, 1, 0) WHERE id % 211 = round % 211;
    UPDATE town.solid_column SET top = (bottom + top) / 2 WHERE feature % 223 = round % 223 AND top > 1;
    DELETE FROM town.feature WHERE id % 499 = round % 499 AND id > 1000;
    INSERT INTO town.feature (envelope) SELECT occlusion.expand(envelope, 0.5) FROM town.feature WHERE id % 97 = round % 97 AND id <= 1000;
    IF round % 5 = 0 THEN
        PERFORM occlusion.pack_tiles('town');
    END IF;
END
$$;

-- What some observers see, all that is returned.
CREATE FUNCTION seen_in_town() RETURNS text LANGUAGE sql STABLE AS $$
    SELECT count(*) || ' ' || md5(string_agg((o.x, v.feature_id, v.class, v.envelope, v.distance)::text, ' ' ORDER BY o.x, v.feature_id))
    FROM (SELECT occlusion.x(c) AS cx, occlusion.y(c) AS cy FROM occlusion.center('BOX3D(-100 -1000 0, 900 -100 0)'::occlusion.box3d) AS c) AS middle,
         generate_series(-300, 300, 60) AS o (x),
         LATERAL occlusion.visible_features('town', occlusion.point3d(cx + o.x, cy - o.x, 1.7 + (o.x + 300) / 30), 250) AS v
$$;
