-- The test of the 2004 report: 326 boxes on both sides of one street, an observer at (5, 500, 1.75)
-- with an acuity of 500 m.
\pset format unaligned

-- How a statement ends, without the lines that change with the server's version.
CREATE FUNCTION pg_temp.outcome(statement text) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    message text;
    detail text;
    hint text;
BEGIN
    EXECUTE statement;
    RETURN 'done';
EXCEPTION WHEN OTHERS THEN
    GET STACKED DIAGNOSTICS message = MESSAGE_TEXT, detail = PG_EXCEPTION_DETAIL, hint = PG_EXCEPTION_HINT;
    RETURN concat_ws(' | ', SQLSTATE, message, nullif(detail, ''), nullif(hint, ''));
END
$$;

SELECT occlusion.create_scene('regress_2004');
SELECT occlusion.generate_city('regress_2004', 'scattered', 326, 1);
SELECT count(*) = 326 AND min(id) = 1 AND max(id) = 326 AS t,
       -- as in the report: inside a square of 1 km, off the street, 0.5 to 100 m in size, on the ground
       bool_and('BOX3D(0 0 0, 1000 1000 100)'::occlusion.box3d OPERATOR(occlusion.@>) envelope) AS t,
       bool_and(y1 <= 475 OR y0 >= 525) AS t,
       bool_and(least(x1 - x0, y1 - y0, z1 - z0) >= 0.5 - 1e-9 AND greatest(x1 - x0, y1 - y0, z1 - z0) <= 100 + 1e-9) AS t,
       bool_and(z0 = 0) AS t,
       least(count(*) FILTER (WHERE y1 <= 475), count(*) FILTER (WHERE y0 >= 525)) > 100 AS t
FROM regress_2004.feature
CROSS JOIN LATERAL (
    SELECT occlusion.x(occlusion.lower(envelope)) AS x0, occlusion.x(occlusion.upper(envelope)) AS x1,
           occlusion.y(occlusion.lower(envelope)) AS y0, occlusion.y(occlusion.upper(envelope)) AS y1,
           occlusion.z(occlusion.lower(envelope)) AS z0, occlusion.z(occlusion.upper(envelope)) AS z1
) AS side;
-- Each box is what hides, too, and its mesh is closed: 12 triangles.
SELECT count(*) = 326 AND bool_and(i.box OPERATOR(occlusion.=) f.envelope) AND bool_and(i.grounded) AS t,
       bool_and(cardinality(m.vertices) = 24 AND cardinality(m.triangles) = 36 AND m.defect IS NULL) AS t
FROM regress_2004.feature AS f
JOIN regress_2004.inner_envelope AS i ON i.feature = f.id
JOIN regress_2004.mesh AS m ON m.feature = f.id;
SELECT area, eye_low, eye_high, envelope FROM regress_2004.street;
-- A feature of the user's gets the next number.
INSERT INTO regress_2004.feature (envelope) VALUES ('BOX3D(0 0 0, 1 1 1)') RETURNING id;
DELETE FROM regress_2004.feature WHERE id = 327;

SET client_min_messages = warning;
CALL occlusion.generate_occlusion_volumes('regress_2004');
RESET client_min_messages;
-- Every volume is in the street, at the height of eyes.
SELECT count(*) > 5000 AS t, bool_and(occluder <> occludee) AS t,
       bool_and((SELECT envelope FROM regress_2004.street) OPERATOR(occlusion.@>) box) AS t,
       count(DISTINCT occludee) > 300 AS t, bool_and(occlusion.volume(box) > 0) AS t
FROM regress_2004.occlusion_volume;
-- What hides stands on the same side of the street as what it hides.
SELECT bool_and(sign(occlusion.y(occlusion.lower(a.envelope)) - 500) = sign(occlusion.y(occlusion.lower(b.envelope)) - 500)) AS t
FROM regress_2004.occlusion_volume AS v
JOIN regress_2004.feature AS a ON a.id = v.occluder
JOIN regress_2004.feature AS b ON b.id = v.occludee;

-- The report's first query: what is in view of the observer, as far as the index of envelopes knows.
-- Its second: what is hidden from the observer's place, each by a single feature. The answer of the report is
-- the first without the second; ours is less, since features also hide together.
CREATE TEMPORARY TABLE half AS
SELECT * FROM (VALUES
    ('north', 'BOX3D(0 500 0, 505 1000 500)'::occlusion.box3d, 'VIEW_SECTOR(5 500 1.75, 45, 90, 500)'::occlusion.view_sector,
     'VIEW_CONE(5 500 1.75, 45, 90, 500, 0)'::occlusion.view_cone),
    ('south', 'BOX3D(0 0 0, 505 500 500)', 'VIEW_SECTOR(5 500 1.75, 135, 90, 500)', 'VIEW_CONE(5 500 1.75, 135, 90, 500, 0)')
) AS h (name, reach, sector, cone);
CREATE TEMPORARY TABLE in_reach AS
SELECT h.name, f.id FROM half AS h JOIN regress_2004.feature AS f ON f.envelope OPERATOR(occlusion.&&) h.reach;
CREATE TEMPORARY TABLE hidden AS
SELECT DISTINCT occludee AS id FROM regress_2004.occlusion_volume
WHERE box OPERATOR(occlusion.@>) 'POINT(5 500 1.75)'::occlusion.point3d;
CREATE TEMPORARY TABLE in_sector AS
SELECT h.name, f.id FROM half AS h JOIN regress_2004.feature AS f ON f.envelope OPERATOR(occlusion.&&) h.sector;
CREATE TEMPORARY TABLE answer AS
SELECT h.name, v.* FROM half AS h, LATERAL occlusion.visible_features('regress_2004', h.sector) AS v;

SELECT h.name,
       (SELECT count(*) FROM in_reach AS r WHERE r.name = h.name) AS in_reach,
       (SELECT count(*) FROM in_sector AS r WHERE r.name = h.name) AS in_sector,
       (SELECT count(*) FROM in_sector AS r JOIN hidden USING (id) WHERE r.name = h.name) AS hidden,
       (SELECT count(*) FROM in_sector AS r WHERE r.name = h.name AND r.id NOT IN (TABLE hidden)) AS not_hidden,
       (SELECT count(*) FROM answer AS a WHERE a.name = h.name) AS answer
FROM half AS h ORDER BY h.name;
-- No feature is returned and hidden; and each is in reach.
SELECT count(*) = 0 AS t FROM hidden AS h JOIN answer AS a ON a.feature_id = h.id;
SELECT count(*) = 0 AS t FROM (SELECT name, feature_id FROM answer EXCEPT ALL SELECT name, id FROM in_sector) AS beyond;
SELECT count(*) = 0 AS t FROM (TABLE in_sector EXCEPT TABLE in_reach) AS beyond;
SELECT bool_and(a.class = f.class AND a.envelope OPERATOR(occlusion.=) f.envelope
                AND a.distance = f.envelope OPERATOR(occlusion.<->) 'POINT(5 500 1.75)'::occlusion.point3d
                AND a.distance <= 500) AS t
FROM answer AS a JOIN regress_2004.feature AS f ON f.id = a.feature_id;
-- A cone of that angle sees no more than the sector; all round sees no less.
SELECT count(*) = 0 AS t FROM (
    SELECT h.name, v.feature_id FROM half AS h, LATERAL occlusion.visible_features('regress_2004', h.cone) AS v
    EXCEPT SELECT name, feature_id FROM answer) AS more;
SELECT count(*) = 0 AS t FROM (
    SELECT feature_id FROM answer
    EXCEPT SELECT feature_id FROM occlusion.visible_features('regress_2004', 'POINT(5 500 1.75)', 500)) AS less;
-- All round is within range and not hidden.
SELECT count(*) = 0 AS t FROM (
    SELECT feature_id FROM occlusion.visible_features('regress_2004', 'POINT(5 500 1.75)', 500)
    EXCEPT ALL SELECT id FROM regress_2004.feature
    WHERE envelope OPERATOR(occlusion.<->) 'POINT(5 500 1.75)'::occlusion.point3d <= 500 AND id NOT IN (TABLE hidden)) AS beyond;

-- The nearest feature is always in the answer.
SELECT count(*) = 1 AS t
FROM (SELECT id FROM regress_2004.feature
      ORDER BY envelope OPERATOR(occlusion.<->) 'POINT(5 500 1.75)'::occlusion.point3d LIMIT 1) AS nearest
JOIN occlusion.visible_features('regress_2004', 'POINT(5 500 1.75)', 500) AS a ON a.feature_id = nearest.id;

-- The same seed is the same city, another seed another one.
CREATE FUNCTION pg_temp.city(scene text, seed int) RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    boxes text;
BEGIN
    PERFORM occlusion.generate_city(scene, 'scattered', 326, seed);
    EXECUTE format('SELECT md5(string_agg(id || envelope::text, $1 ORDER BY id)) FROM %I.feature', scene) INTO boxes USING ' ';
    PERFORM occlusion.drop_scene(scene);
    RETURN boxes;
END
$$;
SELECT pg_temp.city('regress_a', 1) = (SELECT md5(string_agg(id || envelope::text, ' ' ORDER BY id)) FROM regress_2004.feature) AS t,
       pg_temp.city('regress_a', 2) <> pg_temp.city('regress_b', 1) AS t,
       pg_temp.city('regress_a', -7) = pg_temp.city('regress_b', -7) AS t;
-- A smaller city is the beginning of a larger one.
SELECT bool_and(s.envelope OPERATOR(occlusion.=) f.envelope) AND count(*) = 100 AS t
FROM occlusion.make_city('scattered', 100, 1) AS s JOIN regress_2004.feature AS f ON f.id = s.number;

-- Refused; and what is refused leaves nothing behind.
SELECT statement, pg_temp.outcome('SELECT occlusion.generate_city' || statement)
FROM (VALUES
    ($$('regress_a', 'rings', 326, 1)$$),
    ($$('regress_a', '', 326, 1)$$),
    ($$('regress_a', 'scattered', -1, 1)$$),
    ($$('regress_a', 'scattered', 1000001, 1)$$),
    ($$('regress_2004')$$),
    ($$('public')$$),
    ($$(repeat('x', 64))$$)
) AS refused (statement);
SELECT to_regnamespace('regress_a') IS NULL AS t, count(*) = 326 AS t FROM regress_2004.feature;
SELECT occlusion.generate_city('regress_a', NULL) IS NULL AS t, to_regnamespace('regress_a') IS NULL AS t;
-- No features at all is a city, too.
SELECT occlusion.generate_city('regress_a', 'scattered', 0) = 0 AS t;
SELECT count(*) = 0 AS t FROM occlusion.visible_features('regress_a', 'POINT(5 500 1.75)', 500);
SELECT occlusion.drop_scene('regress_a');

SELECT occlusion.drop_scene('regress_2004');
