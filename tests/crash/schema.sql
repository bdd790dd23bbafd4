-- Edits of a scene with a ledger of them, and the means to say what is wrong with a scene after a crash.
CREATE EXTENSION pg_occlusion;
-- Scenes come later.
SET check_function_bodies = off;

-- Jobs and editors have roles of their own: their processes are known by them.
CREATE ROLE worker LOGIN SUPERUSER;
CREATE ROLE editor LOGIN SUPERUSER;
-- Somebody who may not read tiles and is answered from the tables.
CREATE ROLE without_tiles;
GRANT USAGE ON SCHEMA public, occlusion TO without_tiles;

-- What was edited, written by the transaction that did it.
CREATE TABLE ledger (
    scene name NOT NULL,
    number integer NOT NULL,
    kind text NOT NULL,
    feature bigint NOT NULL,
    before occlusion.box3d,
    after occlusion.box3d,
    transaction xid8 NOT NULL DEFAULT pg_current_xact_id(),
    PRIMARY KEY (scene, number)
);

-- A number from 0 to 1 by chance.
CREATE FUNCTION chance(seed bigint, number bigint) RETURNS float8 LANGUAGE sql IMMUTABLE AS $$
    SELECT (hashint8extended(number, seed) & 1048575) / 1048576.0::float8
$$;

-- A box, a polygon, vertices: shrunk by a quarter on their plot and shifted there, or with other heights. Generated cities
-- have coordinates with few bits, so that all is exact.
CREATE TYPE fit AS (cx float8, cy float8, scale float8, dx float8, dy float8, height float8);

CREATE FUNCTION fitted(p occlusion.point3d, f fit) RETURNS occlusion.point3d LANGUAGE sql IMMUTABLE AS $$
    SELECT occlusion.point3d((occlusion.x(p) - f.cx) * f.scale + f.cx + f.dx, (occlusion.y(p) - f.cy) * f.scale + f.cy + f.dy,
                             occlusion.z(p) * f.height)
$$;
CREATE FUNCTION fitted(b occlusion.box3d, f fit) RETURNS occlusion.box3d LANGUAGE sql IMMUTABLE AS $$
    SELECT occlusion.box3d(fitted(occlusion.lower(b), f), fitted(occlusion.upper(b), f))
$$;
CREATE FUNCTION fitted(p polygon, f fit) RETURNS polygon LANGUAGE sql IMMUTABLE AS $$
    SELECT polygon((path(p) - point(f.cx, f.cy)) * point(f.scale, 0) + point(f.cx, f.cy) + point(f.dx, f.dy))
$$;
CREATE FUNCTION fitted(vertices float8[], f fit) RETURNS float8[] LANGUAGE sql IMMUTABLE AS $$
    SELECT array_agg(CASE n % 3 WHEN 1 THEN (v - f.cx) * f.scale + f.cx + f.dx
                                WHEN 2 THEN (v - f.cy) * f.scale + f.cy + f.dy ELSE v * f.height END ORDER BY n)
    FROM unnest(vertices) WITH ORDINALITY AS u (v, n)
$$;

-- Deletes, moves, lowers or raises a house by chance, or brings back one that was deleted, as it is in the scene "stock".
-- Returns its number; it is for autocommit, or the ledger's transaction would be that of others, too.
CREATE FUNCTION edit(scene name, seed bigint, number integer) RETURNS integer LANGUAGE plpgsql AS $$
DECLARE
    kind text := (ARRAY['delete', 'move', 'lower', 'raise', 'add'])[1 + trunc(5 * chance(seed, number * 8))];
    house bigint;
    first occlusion.box3d;
    last occlusion.box3d;
    f fit;
BEGIN
    IF kind = 'add' THEN
        EXECUTE format('SELECT k.id FROM stock.feature AS k
                        WHERE NOT EXISTS (SELECT FROM %I.feature AS f WHERE f.name = k.name)
                        ORDER BY chance($1, k.id) LIMIT 1', scene) INTO house USING seed + number;
    END IF;
    IF house IS NOT NULL THEN
        EXECUTE format($q$
            WITH one AS (
                INSERT INTO %1$I.feature (name, class, envelope, outline)
                SELECT name, class, envelope, outline FROM stock.feature WHERE id = $1
                RETURNING id, envelope
            ), mesh AS (
                INSERT INTO %1$I.mesh (feature, level_of_detail, vertices, triangles)
                SELECT one.id, m.level_of_detail, m.vertices, m.triangles FROM stock.mesh AS m, one WHERE m.feature = $1
            ), inner_envelope AS (
                INSERT INTO %1$I.inner_envelope (feature, box, grounded)
                SELECT one.id, e.box, e.grounded FROM stock.inner_envelope AS e, one WHERE e.feature = $1
            ), solid_column AS (
                INSERT INTO %1$I.solid_column (feature, footprint, bottom, top, grounded)
                SELECT one.id, c.footprint, c.bottom, c.top, c.grounded FROM stock.solid_column AS c, one WHERE c.feature = $1
            )
            SELECT id, envelope FROM one
        $q$, scene) INTO house, last USING house;
    ELSE
        EXECUTE format('SELECT id, envelope FROM %I.feature ORDER BY chance($1, id) LIMIT 1', scene)
            INTO house, first USING seed + number;
        IF kind IN ('delete', 'add') THEN
            kind := 'delete';
            EXECUTE format('DELETE FROM %I.feature WHERE id = $1', scene) USING house;
        ELSE
            f := (occlusion.x(occlusion.center(first)), occlusion.y(occlusion.center(first)), 1, 0, 0, 1);
            CASE kind
                WHEN 'move' THEN
                    f.scale := 0.75;
                    f.dx := occlusion.x(occlusion.size(first)) / 16 * (1 - 2 * round(chance(seed, number * 8 + 1)));
                    f.dy := occlusion.y(occlusion.size(first)) / 16 * (1 - 2 * round(chance(seed, number * 8 + 2)));
                WHEN 'lower' THEN f.height := 0.75;
                WHEN 'raise' THEN f.height := 1.5;
            END CASE;
            last := fitted(first, f);
            EXECUTE format('UPDATE %I.feature SET envelope = $2, outline = fitted(outline, $3) WHERE id = $1', scene)
                USING house, last, f;
            EXECUTE format('UPDATE %I.mesh SET vertices = fitted(vertices, $2) WHERE feature = $1', scene) USING house, f;
            EXECUTE format('UPDATE %I.inner_envelope SET box = fitted(box, $2) WHERE feature = $1', scene) USING house, f;
            EXECUTE format('UPDATE %I.solid_column SET bottom = bottom * ($2).height, top = top * ($2).height,
                            footprint = ARRAY(SELECT fitted(r, $2) FROM unnest(footprint) WITH ORDINALITY AS u (r, n) ORDER BY n)
                            WHERE feature = $1', scene) USING house, f;
        END IF;
    END IF;
    INSERT INTO ledger (scene, number, kind, feature, before, after) VALUES (scene, number, kind, house, first, last);
    RETURN number;
END
$$;

-- A scene of houses along streets, and the same as stock for what is brought back.
CREATE PROCEDURE make_town(houses integer, seed integer) LANGUAGE plpgsql AS $$
DECLARE
    scene text;
BEGIN
    DELETE FROM ledger;
    FOREACH scene IN ARRAY ARRAY['stock', 'town'] LOOP
        IF to_regnamespace(scene) IS NOT NULL THEN
            PERFORM occlusion.drop_scene(scene);
        END IF;
        PERFORM occlusion.generate_city(scene, 'streets', houses, seed);
    END LOOP;
END
$$;

-- Every third house of the town as GeoJSON, a flat one on the plot of the first column.
CREATE FUNCTION third() RETURNS jsonb LANGUAGE sql AS $$
    SELECT jsonb_build_object(
        'type', 'FeatureCollection', 'crs', '{"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::28992"}}'::jsonb,
        'features', jsonb_agg(jsonb_build_object(
            'type', 'Feature', 'id', f.name, 'properties', jsonb_build_object('height', c.top),
            'geometry', jsonb_build_object('type', 'Polygon', 'coordinates', jsonb_build_array(ring || jsonb_build_array(ring -> 0))))
            ORDER BY f.id))
    FROM town.feature AS f
    CROSS JOIN LATERAL (SELECT * FROM town.solid_column WHERE feature = f.id LIMIT 1) AS c
    CROSS JOIN LATERAL (SELECT translate(c.footprint[1]::text, '()', '[]')::jsonb AS ring) AS r
    WHERE f.id % 3 = 0
$$;

-- Eyes in the streets by chance.
CREATE FUNCTION eyes(scene name, seed bigint, observers integer) RETURNS SETOF occlusion.point3d LANGUAGE plpgsql AS $$
BEGIN
    RETURN QUERY EXECUTE format($q$
        SELECT occlusion.point3d(px, py, s.eye_low + (s.eye_high - s.eye_low) * chance($1, n * 4 + 2))
        FROM generate_series(1, 10000) AS n
        JOIN (SELECT *, row_number() OVER (ORDER BY id) - 1 AS place, count(*) OVER () AS streets FROM %I.street) AS s
          ON s.place = trunc(chance($1, n * 4 + 3) * s.streets),
             LATERAL (SELECT occlusion.lower(s.envelope) AS a, occlusion.size(s.envelope) AS d) AS e,
             LATERAL (SELECT occlusion.x(a) + occlusion.x(d) * chance($1, n * 4) AS px,
                             occlusion.y(a) + occlusion.y(d) * chance($1, n * 4 + 1) AS py) AS p
        WHERE s.area[1] @> point(px, py) AND NOT point(px, py) <@ ANY (s.area[2:])
        ORDER BY n LIMIT $2
    $q$, scene) USING seed, observers;
    IF NOT FOUND THEN
        RAISE EXCEPTION 'scene "%" has no place for an eye', scene;
    END IF;
END
$$;

-- All that some observers see.
CREATE FUNCTION seen(scene name, eyes occlusion.point3d[], range float8) RETURNS text LANGUAGE sql AS $$
    SELECT count(*) || ' ' || md5(string_agg((n, v.feature_id, v.class, v.envelope, v.distance)::text, ' ' ORDER BY n, v.feature_id))
    FROM unnest(eyes) WITH ORDINALITY AS e (eye, n), LATERAL occlusion.visible_features(scene, e.eye, range) AS v
$$;

-- What an import writes, without numbers that another one may choose otherwise; NULL where there is no scene.
CREATE FUNCTION content(scene name) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    found text;
BEGIN
    IF to_regnamespace(quote_ident(scene)) IS NULL THEN
        RETURN NULL;
    END IF;
    EXECUTE format($q$
        SELECT (SELECT count(*) FROM %1$I.feature) || ' ' || md5(concat_ws(E'\n',
            (SELECT string_agg((f.name, f.class, f.envelope, f.outline, f.attributes)::text, ' ' ORDER BY f.name) FROM %1$I.feature AS f),
            (SELECT string_agg((f.name, m.vertices, m.triangles, m.defect, m.repair)::text, ' ' ORDER BY f.name)
             FROM %1$I.mesh AS m JOIN %1$I.feature AS f ON f.id = m.feature),
            (SELECT string_agg((f.name, e.box, e.grounded)::text, ' ' ORDER BY f.name)
             FROM %1$I.inner_envelope AS e JOIN %1$I.feature AS f ON f.id = e.feature),
            (SELECT string_agg(line, ' ' ORDER BY line)
             FROM (SELECT (f.name, c.footprint, c.bottom, c.top, c.grounded)::text AS line
                   FROM %1$I.solid_column AS c JOIN %1$I.feature AS f ON f.id = c.feature) AS c),
            (SELECT string_agg((f.name, m.level_of_detail, m.format, m.content, s.content, m.placement)::text, ' '
                               ORDER BY f.name, m.level_of_detail, m.format)
             FROM %1$I.model AS m JOIN %1$I.feature AS f ON f.id = m.feature LEFT JOIN %1$I.shape AS s ON s.digest = m.shape),
            (SELECT string_agg(line, ' ' ORDER BY line)
             FROM (SELECT (s.name, s.area, s.eye_low, s.eye_high)::text AS line FROM %1$I.street AS s) AS s),
            (SELECT string_agg(r::text, ' ' ORDER BY r::text) FROM %1$I.import_remark AS r),
            (SELECT i::text FROM %1$I.scene_info AS i)))
    $q$, scene) INTO found;
    RETURN found;
END
$$;

-- What was computed, one line a square or occludee, with the transactions that wrote it: squares that are done, or of those the
-- right ones.
CREATE FUNCTION computed(scene name, right_only boolean) RETURNS SETOF text LANGUAGE plpgsql AS $$
BEGIN
    IF to_regnamespace(quote_ident(scene)) IS NULL THEN
        RETURN;
    END IF;
    RETURN QUERY EXECUTE format($q$
        SELECT 'square ' || b.id || ' ' || coalesce(md5(string_agg((c.id, c.xmin, c.box, c.visible, c.unproven)::text, ' ' ORDER BY c.id)), 'empty')
        FROM (SELECT * FROM %1$I.view_cell_block AS b WHERE b.done AND (NOT $1 OR %2$s)) AS b
        LEFT JOIN %1$I.view_cell AS c ON %3$s
        GROUP BY b.id
        UNION ALL
        SELECT 'volumes ' || v.occludee || ' ' || md5(string_agg((v.occluder, v.xmin, v.box)::text, ' ' ORDER BY v::text))
        FROM %1$I.occlusion_volume AS v GROUP BY v.occludee
    $q$, scene, occlusion.valid_cells_condition(scene), occlusion.cell_in_block_condition()) USING right_only;
END
$$;

-- The same of volumes, whoever computed them.
CREATE FUNCTION volumes(scene name) RETURNS SETOF text LANGUAGE plpgsql AS $$
BEGIN
    RETURN QUERY EXECUTE format($q$
        SELECT v.occludee || ' ' || md5(string_agg((v.occluder, v.box)::text, ' ' ORDER BY v::text))
        FROM %I.occlusion_volume AS v GROUP BY v.occludee
    $q$, scene);
END
$$;

-- How many squares are done and not, how many features have volumes, and whether all squares are done and the work is not
-- finished all the same: the next call begins anew then.
CREATE FUNCTION standing(scene name) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    found text;
BEGIN
    EXECUTE format($q$
        SELECT concat_ws(' ', count(*) FILTER (WHERE done), count(*) FILTER (WHERE NOT done),
                         (SELECT count(DISTINCT occludee) FROM %1$I.occlusion_volume),
                         (count(*) > 0 AND bool_and(done)
                          AND EXISTS (SELECT FROM %1$I.job WHERE task = 'generate_view_cells' AND NOT finished))::text)
        FROM %1$I.view_cell_block
    $q$, scene) INTO found;
    RETURN found;
END
$$;

-- What is wrong with a scene, whatever was interrupted; to be asked while nobody works on it. "fresh": it was computed once and
-- not edited, so that each count is known.
CREATE FUNCTION faults(scene name, seed bigint, observers integer, range float8, fresh boolean) RETURNS SETOF text LANGUAGE plpgsql AS $$
DECLARE
    eyes occlusion.point3d[] := ARRAY(SELECT eyes(scene, seed, observers));
    in_block text := occlusion.cell_in_block_condition();
    is_right text := format('b.done AND b.cluster = occlusion.cluster_identity() AND %s', occlusion.valid_cells_condition(scene));
    by_tiles text;
    by_tables text;
BEGIN
    IF cardinality(eyes) <> observers THEN
        RETURN NEXT format('only %s eyes', cardinality(eyes));
    END IF;

    -- Squares and cells.
    RETURN QUERY EXECUTE format($q$
        SELECT 'square ' || b.id || ' is done without a snapshot of this cluster' FROM %1$I.view_cell_block AS b
        WHERE b.done AND (b.snapshot IS NULL OR b.cluster IS DISTINCT FROM occlusion.cluster_identity())
        UNION ALL
        SELECT 'square ' || b.id || CASE WHEN b.snapshot IS NULL THEN ' was never done and has cells' ELSE ' lacks cells, or has others' END
        FROM %1$I.view_cell_block AS b
        CROSS JOIN LATERAL (
            SELECT count(*) AS cells, max(c.id) AS last, occlusion.extent(c.box) AS box,
                   coalesce(occlusion.feature_set_union(c.visible), '{}') AS visible
            FROM %1$I.view_cell AS c WHERE %2$s
        ) AS c
        WHERE (b.snapshot IS NULL AND c.cells > 0)
           OR c.last <> (b.id << 22) + c.cells - 1
           OR c.box::text IS DISTINCT FROM b.box::text OR c.visible::text <> b.visible::text
        UNION ALL
        SELECT 'cell ' || c.id || ' is of no square' FROM %1$I.view_cell AS c
        WHERE NOT EXISTS (SELECT FROM %1$I.view_cell_block AS b WHERE %2$s)
        UNION ALL
        SELECT 'cell ' || c.id || ' lies outside of its square' FROM %1$I.view_cell AS c JOIN %1$I.view_cell_block AS b ON %2$s
        WHERE occlusion.x(occlusion.lower(c.box)) < occlusion.x(occlusion.lower(b.area))
           OR occlusion.y(occlusion.lower(c.box)) < occlusion.y(occlusion.lower(b.area))
           OR occlusion.x(occlusion.upper(c.box)) > occlusion.x(occlusion.upper(b.area))
           OR occlusion.y(occlusion.upper(c.box)) > occlusion.y(occlusion.upper(b.area))
        UNION ALL
        SELECT 'cells ' || c.id || ' and ' || d.id || ' overlap' FROM %1$I.view_cell AS c JOIN %1$I.view_cell AS d
        ON c.id < d.id AND c.box OPERATOR(occlusion.&&) d.box AND occlusion.volume(occlusion.intersection(c.box, d.box)) > 0
    $q$, scene, in_block);

    -- Progress: a square and its count are written together, and so are a batch of volumes and its count.
    RETURN QUERY EXECUTE format($q$
        SELECT format('%%s is %%s, %%s of %%s done, with %%s squares left', p.task, p.state, p.done, p.total, b.open)
        FROM occlusion.progress(%1$L) AS p
        CROSS JOIN (SELECT count(*) FILTER (WHERE NOT done) AS open FROM %1$I.view_cell_block) AS b
        WHERE p.state = 'running' OR p.done > p.total OR (p.state = 'finished' AND p.done <> p.total)
           OR (p.task = 'generate_view_cells' AND p.total - p.done <> b.open)
        UNION ALL
        SELECT 'squares are planned and no work is known' FROM %1$I.view_cell_block
        WHERE NOT EXISTS (SELECT FROM %1$I.job WHERE task = 'generate_view_cells')
        GROUP BY ()  HAVING count(*) > 0
        UNION ALL
        SELECT format('%%s made %%s, of which %%s are there', j.task, j.made, n.rows)
        FROM %1$I.job AS j
        CROSS JOIN LATERAL (SELECT CASE j.task WHEN 'generate_view_cells' THEN (SELECT count(*) FROM %1$I.view_cell)
                                               ELSE (SELECT count(*) FROM %1$I.occlusion_volume) END) AS n (rows)
        WHERE $1 AND j.made <> n.rows
    $q$, scene) USING fresh;

    -- Edits: all are there, and no square that does not know one near it is taken for right.
    RETURN QUERY EXECUTE format($q$
        SELECT format('edit %%s is lost: feature %%s is %%s, not %%s', l.number, l.feature, f.envelope, l.after)
        FROM (SELECT DISTINCT ON (feature) * FROM ledger WHERE scene = %1$L ORDER BY feature, number DESC) AS l
        LEFT JOIN %1$I.feature AS f ON f.id = l.feature
        WHERE f.envelope::text IS DISTINCT FROM l.after::text
        UNION ALL
        SELECT format('edit %%s is lost: no ledger has it', n) FROM generate_series(1, (SELECT max(number) FROM ledger WHERE scene = %1$L)) AS n
        WHERE NOT EXISTS (SELECT FROM ledger WHERE scene = %1$L AND number = n)
        UNION ALL
        SELECT format('square %%s is taken for right and does not know edit %%s', b.id, l.number)
        FROM %1$I.view_cell_block AS b JOIN ledger AS l
          ON l.scene = %1$L AND l.kind <> 'delete' AND NOT pg_visible_in_snapshot(l.transaction, b.snapshot)
             AND (l.before OPERATOR(occlusion.&&) occlusion.expand(b.box, b.range)
                  OR l.after OPERATOR(occlusion.&&) occlusion.expand(b.box, b.range))
        WHERE %2$s
    $q$, scene, is_right);

    -- Answers: packed tiles against tables, and both answers and sets against sight lines to the corners of meshes.
    EXECUTE format('GRANT USAGE ON SCHEMA %1$I TO without_tiles; GRANT SELECT ON ALL TABLES IN SCHEMA %1$I TO without_tiles;
                    REVOKE SELECT ON %1$I.tile, %1$I.edit FROM without_tiles', scene);
    by_tiles := seen(scene, eyes, range);
    PERFORM set_config('role', 'without_tiles', true);
    EXECUTE 'SELECT public.seen($1, $2, $3)' INTO by_tables USING scene, eyes, range;
    PERFORM set_config('role', 'none', true);
    IF by_tiles IS DISTINCT FROM by_tables OR by_tiles !~ '^[1-9]' THEN
        RETURN NEXT format('packed tiles answer otherwise than tables: %s, %s', by_tiles, by_tables);
    END IF;
    RETURN QUERY EXECUTE format($q$
        SELECT DISTINCT format('eye %%s sees feature %%s, which %%s lacks', e.eye, f.id,
                               CASE WHEN live.has THEN 'its set' ELSE 'its answer' END)
        FROM unnest($1) AS e (eye)
        LEFT JOIN LATERAL occlusion.visible_set(%1$L, e.eye) AS s ON true
        CROSS JOIN LATERAL (SELECT array_agg(v.feature_id) AS ids FROM occlusion.visible_features(%1$L, e.eye, $2) AS v) AS v
        JOIN %1$I.feature AS f ON occlusion.distance(f.envelope, e.eye) < $2
        CROSS JOIN LATERAL (SELECT coalesce(f.id = ANY (v.ids), false) AS has) AS live
        JOIN %1$I.mesh AS m ON m.feature = f.id
        CROSS JOIN LATERAL generate_series(1, cardinality(m.vertices), 3) AS at
        CROSS JOIN LATERAL (SELECT occlusion.point3d(m.vertices[at], m.vertices[at + 1], m.vertices[at + 2])) AS p (corner)
        CROSS JOIN LATERAL occlusion.line_of_sight(%1$L, e.eye, p.corner) AS l
        WHERE (NOT live.has OR NOT s.visible OPERATOR(occlusion.@>) f.slot::bigint
               OR (s.visible IS NOT NULL AND f.slot IS NULL))
          AND occlusion.distance(e.eye, p.corner) < $2 AND l.visible
    $q$, scene) USING eyes, range;
END
$$;
