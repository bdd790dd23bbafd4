-- Seals: what proves, after dump and restore or logical replication, that view cells are still right, where
-- transaction ids mean nothing. A seal says: these cells are right where a scene holds this. It names no moment and no server.

CREATE FUNCTION occlusion.framed(value bytea) RETURNS bytea
LANGUAGE sql IMMUTABLE PARALLEL SAFE
RETURN CASE WHEN value IS NULL THEN '\xffffffff'::bytea
            ELSE pg_catalog.int4send(pg_catalog.octet_length(value)) OPERATOR(pg_catalog.||) value END;
COMMENT ON FUNCTION occlusion.framed(bytea) IS 'a value after its length, so that values in a row cannot be taken for others';

-- What a scene holds, in regions of 128 m by the middles of features and streets: a box around all of them, and a digest of
-- all that view cells are computed from, bit by bit and in no order.
CREATE FUNCTION occlusion.scene_digest_statement(scene text) RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT format($q$
        SELECT p.x, p.y, occlusion.extent(h.box) AS box, sha256(string_agg(h.digest, ''::bytea ORDER BY h.digest)) AS content
        FROM (
            SELECT f.envelope AS box, sha256(
                'feature'::bytea || int8send(f.id) || occlusion.framed(int4send(f.slot)) || occlusion.box3d_send(f.envelope)
                || occlusion.framed(poly_send(f.outline)) || occlusion.framed(c.digest)
                || occlusion.framed(occlusion.box3d_send(i.box)) || occlusion.framed(boolsend(i.grounded))
                || occlusion.framed(array_send(m.vertices)) || occlusion.framed(array_send(m.triangles))
                || occlusion.framed(textsend(m.defect))) AS digest
            FROM %1$I.feature AS f
            LEFT JOIN %1$I.inner_envelope AS i ON i.feature = f.id
            LEFT JOIN %1$I.mesh AS m ON m.feature = f.id
            LEFT JOIN (
                SELECT s.feature, string_agg(s.digest, ''::bytea ORDER BY s.digest) AS digest
                FROM (SELECT o.feature, sha256(occlusion.framed(array_send(o.footprint)) || float8send(o.bottom)
                                               || float8send(o.top) || boolsend(o.grounded)) AS digest
                      FROM %1$I.solid_column AS o) AS s
                GROUP BY s.feature
            ) AS c ON c.feature = f.id
            UNION ALL
            SELECT t.envelope, sha256('street'::bytea || occlusion.framed(array_send(t.area))
                                      || float8send(t.eye_low) || float8send(t.eye_high))
            FROM %1$I.street AS t
        ) AS h
        CROSS JOIN LATERAL (
            SELECT least(greatest(floor(occlusion.x(m) / 128), -1e15), 1e15)::bigint,
                   least(greatest(floor(occlusion.y(m) / 128), -1e15), 1e15)::bigint
            FROM occlusion.center(h.box) AS m
        ) AS p (x, y)
        GROUP BY p.x, p.y
    $q$, scene)
$$;
COMMENT ON FUNCTION occlusion.scene_digest_statement(text) IS
    'the statement that digests all that view cells are computed from, region by region';

-- The seal of a square b where the digest of all regions is w.digest: of these, of the square and of its cells.
CREATE FUNCTION occlusion.square_seal_expression(scene text) RETURNS text
LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE
SET search_path = pg_catalog, pg_temp AS $$
    SELECT format($q$
        sha256(w.digest || int8send(b.id) || float8send(b.range) || occlusion.framed(occlusion.box3d_send(b.box))
            || occlusion.framed(occlusion.feature_set_send(b.visible))
            || coalesce((
                SELECT sha256(string_agg(int8send(c.id) || occlusion.box3d_send(c.box)
                                         || occlusion.framed(occlusion.feature_set_send(c.visible))
                                         || occlusion.framed(occlusion.feature_set_send(c.unproven)), ''::bytea ORDER BY c.id))
                FROM %1$I.view_cell AS c WHERE %2$s), ''::bytea))
    $q$, scene, occlusion.cell_in_block_condition())
$$;
COMMENT ON FUNCTION occlusion.square_seal_expression(text) IS 'the seal of a square, b, in a scene whose regions have a digest, w.digest';

-- Raises an error unless the current user sees all that seals are about; then locks out those who plan or compute cells.
CREATE FUNCTION occlusion.lock_seals(scene text) RETURNS void
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    source text;
BEGIN
    PERFORM occlusion.require_all_cells(scene);
    FOREACH source IN ARRAY ARRAY['solid_column', 'inner_envelope', 'mesh', 'seal'] LOOP
        IF row_security_active(format('%I.%I', scene, source)) THEN
            RAISE EXCEPTION 'row security hides rows of %.%', quote_ident(scene), source
                USING ERRCODE = 'insufficient_privilege',
                      DETAIL = 'A seal speaks of all that a scene holds.';
        END IF;
    END LOOP;
    -- In this order: who computes a square has its cells before its row.
    EXECUTE format('LOCK TABLE %I.view_cell_block IN SHARE UPDATE EXCLUSIVE MODE', scene);
    EXECUTE format('LOCK TABLE %I.view_cell IN SHARE ROW EXCLUSIVE MODE', scene);
END
$$;
COMMENT ON FUNCTION occlusion.lock_seals(text) IS
    'raises an error unless the current user sees all that seals are about, and keeps others from computing view cells';

-- Digest and squares are of one snapshot: that of the statement.
CREATE FUNCTION occlusion.seal_view_cells(scene text) RETURNS bigint
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    sealed bigint;
BEGIN
    PERFORM occlusion.lock_seals(scene);
    EXECUTE format('DELETE FROM %I.seal', scene);
    EXECUTE format($q$
        WITH region AS MATERIALIZED (%2$s), kept AS (
            INSERT INTO %1$I.seal (x, y, box, content) SELECT r.x, r.y, r.box, r.content FROM region AS r
        ), whole AS MATERIALIZED (
            SELECT sha256(string_agg(int8send(r.x) || int8send(r.y) || occlusion.box3d_send(r.box) || r.content, ''::bytea
                                     ORDER BY r.x, r.y)) AS digest FROM region AS r
        ), square AS MATERIALIZED (
            SELECT b.id, CASE WHEN b.cluster = $1 AND %3$s THEN %4$s END AS seal
            FROM %1$I.view_cell_block AS b CROSS JOIN whole AS w
        ), written AS (
            UPDATE %1$I.view_cell_block AS b SET seal = s.seal
            FROM square AS s WHERE s.id = b.id AND b.seal IS DISTINCT FROM s.seal
        )
        SELECT count(s.seal) FROM square AS s
    $q$, scene, occlusion.scene_digest_statement(scene), occlusion.valid_cells_condition(scene),
         occlusion.square_seal_expression(scene))
    INTO sealed USING occlusion.cluster_identity();
    RETURN sealed;
END
$$;
COMMENT ON FUNCTION occlusion.seal_view_cells(text) IS
    'writes down what a scene holds and which of its view cells are right for that, for restamp_view_cells; returns how many squares are';

CREATE FUNCTION occlusion.restamp_view_cells(scene text) RETURNS bigint
LANGUAGE plpgsql VOLATILE STRICT
SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    own bigint := occlusion.cluster_identity();
    self xid8;
    now pg_snapshot;
    sealed boolean;
    stamped bigint;
    unproven bigint;
BEGIN
    IF current_setting('transaction_isolation') NOT IN ('read committed', 'read uncommitted') THEN
        RAISE EXCEPTION 'restamp_view_cells runs in transactions that are READ COMMITTED'
            USING ERRCODE = 'invalid_transaction_state',
                  DETAIL = 'An older snapshot does not show what is edited since.';
    END IF;
    PERFORM occlusion.lock_seals(scene);
    EXECUTE format('SELECT EXISTS (SELECT FROM %1$I.view_cell_block WHERE cluster IS DISTINCT FROM $1 AND done)
                           AND NOT EXISTS (SELECT FROM %1$I.view_cell_block WHERE seal IS NOT NULL)', scene)
    INTO sealed USING own;
    IF sealed THEN
        RAISE EXCEPTION 'view cells of scene "%" have no seal', scene
            USING ERRCODE = 'object_not_in_prerequisite_state',
                  DETAIL = 'Nothing tells for which buildings and streets they are right.',
                  HINT = format('CALL occlusion.refresh(%L) computes them. SELECT occlusion.seal_view_cells(%L) before a dump.', scene, scene);
    END IF;
    -- Waits for those who are editing, and lets nobody else begin.
    EXECUTE format('LOCK TABLE %1$I.feature, %1$I.solid_column, %1$I.inner_envelope, %1$I.mesh, %1$I.street IN SHARE MODE', scene);
    self := pg_current_xact_id();
    SELECT pg_current_snapshot() INTO now;
    -- A snapshot takes its own transaction's edits as seen, those to come included.
    IF pg_visible_in_snapshot(self, now) THEN
        SELECT format('%s:%s:%s', least(self, pg_snapshot_xmin(now)), pg_snapshot_xmax(now), string_agg(x::text, ',' ORDER BY x))::pg_snapshot
        INTO now FROM (SELECT self UNION SELECT pg_snapshot_xip(now)) AS s (x);
    END IF;
    EXECUTE format($q$
        WITH region AS MATERIALIZED (%2$s), whole AS MATERIALIZED (
            SELECT sha256(string_agg(int8send(s.x) || int8send(s.y) || occlusion.box3d_send(s.box) || s.content, ''::bytea
                                     ORDER BY s.x, s.y)) AS digest FROM %1$I.seal AS s
        ), differing AS MATERIALIZED (
            SELECT s.box AS before, r.box AS after
            FROM %1$I.seal AS s FULL JOIN region AS r ON r.x = s.x AND r.y = s.y WHERE r.content IS DISTINCT FROM s.content
        ), square AS MATERIALIZED (
            SELECT b.id
            FROM %1$I.view_cell_block AS b CROSS JOIN whole AS w
            WHERE b.cluster IS DISTINCT FROM $1 AND b.seal = %3$s
              AND NOT EXISTS (
                  SELECT FROM differing AS d
                  WHERE d.before OPERATOR(occlusion.&&) occlusion.expand(b.area, b.range)
                     OR d.after OPERATOR(occlusion.&&) occlusion.expand(b.area, b.range))
        )
        UPDATE %1$I.view_cell_block AS b SET snapshot = $2, cluster = $1 FROM square AS s WHERE s.id = b.id
    $q$, scene, occlusion.scene_digest_statement(scene), occlusion.square_seal_expression(scene))
    USING own, now;
    GET DIAGNOSTICS stamped = ROW_COUNT;
    -- Nobody else is editing: what seems to be open is of other transactions than those of this cluster.
    EXECUTE format('DELETE FROM %I.change WHERE NOT pg_visible_in_snapshot(transaction, $1) AND transaction <> $2', scene)
    USING now, self;
    EXECUTE format('SELECT count(*) FROM %I.view_cell_block WHERE cluster IS DISTINCT FROM $1', scene)
    INTO unproven USING own;
    IF unproven > 0 THEN
        RAISE NOTICE '% of % squares stay out of use', unproven, unproven + stamped
            USING DETAIL = 'What is around them, or their cells, are not as they were sealed.',
                  HINT = format('CALL occlusion.refresh(%L) computes them.', scene);
    END IF;
    RETURN stamped;
END
$$;
COMMENT ON FUNCTION occlusion.restamp_view_cells(text) IS
    'gives view cells of another server back to use where all that they were computed from is as it was when they were sealed; returns how many squares these are';
