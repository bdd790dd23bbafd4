-- All that the catalog holds about the objects of the extension, in an order and in words that do not
-- depend on when they were made: two databases with the same extension print the same.
\pset format unaligned
\pset tuples_only on
\pset null -
SET search_path = pg_catalog, pg_temp; -- so that the names of all others are qualified

CREATE TEMP TABLE member AS
SELECT d.classid, d.objid, i.type || ' ' || i.identity AS name
  FROM pg_depend AS d
 CROSS JOIN pg_identify_object(d.classid, d.objid, d.objsubid) AS i
 WHERE d.refclassid = 'pg_extension'::regclass AND d.deptype = 'e'
   AND d.refobjid = (SELECT oid FROM pg_extension WHERE extname = 'pg_occlusion');

-- Rows that are part of a member: in which catalog, and the column that says of which.
CREATE TEMP TABLE part (catalog regclass, owner_catalog regclass, owner name);
INSERT INTO part SELECT DISTINCT classid::regclass, classid::regclass, 'oid'::name FROM member;
INSERT INTO part VALUES
    ('pg_type', 'pg_type', 'typelem'), ('pg_range', 'pg_type', 'rngtypid'), ('pg_enum', 'pg_type', 'enumtypid'),
    ('pg_constraint', 'pg_type', 'contypid'), ('pg_aggregate', 'pg_proc', 'aggfnoid'),
    ('pg_amop', 'pg_opfamily', 'amopfamily'), ('pg_amproc', 'pg_opfamily', 'amprocfamily'),
    ('pg_attribute', 'pg_class', 'attrelid'), ('pg_index', 'pg_class', 'indrelid'),
    ('pg_constraint', 'pg_class', 'conrelid'), ('pg_trigger', 'pg_class', 'tgrelid');

-- Columns that hold numbers of rows, and the catalogs of those.
CREATE TEMP TABLE pointer AS
SELECT k.fktable AS catalog, k.fkcols[1] AS field, k.pktable AS target
  FROM pg_get_catalog_foreign_keys() AS k
  JOIN pg_attribute AS a ON a.attrelid = k.fktable AND a.attname = k.fkcols[1]
 WHERE cardinality(k.fkcols) = 1 AND a.atttypid IN ('oid'::regtype, 'oidvector'::regtype, 'oid[]'::regtype);

-- Columns that say nothing: numbers that each database gives anew, and trees of nodes, which hold such
-- numbers. What the trees mean is among the definitions below, and so is the source of functions.
CREATE TEMP TABLE ignored AS
SELECT attrelid::regclass AS catalog, attname::text AS field
  FROM pg_attribute WHERE attnum > 0 AND (attname = 'oid' OR atttypid = 'pg_node_tree'::regtype)
UNION ALL
SELECT 'pg_proc', 'prosrc'
UNION ALL
SELECT 'pg_attribute', 'attoptions' -- for columns of views some servers keep a number of their own there
UNION ALL
SELECT 'pg_class', unnest('{relfilenode,relpages,reltuples,relallvisible,relallfrozen,relfrozenxid,relminmxid}'::text[]);

CREATE FUNCTION pg_temp.name(catalog regclass, number text) RETURNS text LANGUAGE sql
RETURN CASE WHEN number <> '0' THEN (pg_identify_object(catalog, number::oid, 0)).identity END;

-- A row of a catalog, with names in place of the numbers of other rows.
CREATE FUNCTION pg_temp.named(catalog regclass, fields jsonb) RETURNS jsonb LANGUAGE sql
BEGIN ATOMIC
    SELECT jsonb_object_agg(f.key, CASE
               WHEN p.target IS NULL THEN f.value
               WHEN jsonb_typeof(f.value) <> 'array' THEN to_jsonb(pg_temp.name(p.target, f.value #>> '{}'))
               ELSE (SELECT jsonb_agg(pg_temp.name(p.target, n.number) ORDER BY n.position)
                       FROM jsonb_array_elements_text(f.value) WITH ORDINALITY AS n (number, position))
           END)
      FROM jsonb_each(fields) AS f
      LEFT JOIN pg_temp.pointer AS p ON p.catalog = named.catalog AND p.field = f.key
     WHERE NOT EXISTS (SELECT FROM pg_temp.ignored AS i WHERE i.catalog = named.catalog AND i.field = f.key);
END;

CREATE TEMP TABLE fact (owner text, kind text, fact text);
SELECT format('INSERT INTO fact SELECT m.name, %L, pg_temp.named(%L, to_jsonb(c)) FROM %s AS c JOIN member AS m ON m.objid = c.%I AND m.classid = %L::regclass',
              catalog::text, catalog, catalog, owner, owner_catalog)
  FROM part \gexec
INSERT INTO fact
SELECT name, 'definition', pg_get_functiondef(p.oid)
  FROM member JOIN pg_proc AS p ON p.oid = objid AND classid = 'pg_proc'::regclass WHERE p.prokind <> 'a'
UNION ALL
SELECT name, 'definition', pg_get_function_arguments(p.oid)
  FROM member JOIN pg_proc AS p ON p.oid = objid AND classid = 'pg_proc'::regclass WHERE p.prokind = 'a'
UNION ALL
SELECT name, 'definition', pg_get_viewdef(c.oid)
  FROM member JOIN pg_class AS c ON c.oid = objid AND classid = 'pg_class'::regclass WHERE c.relkind IN ('v', 'm')
UNION ALL
SELECT name, 'definition', pg_get_constraintdef(c.oid)
  FROM member JOIN pg_constraint AS c ON (c.contypid = objid AND classid = 'pg_type'::regclass)
                                      OR (c.conrelid = objid AND classid = 'pg_class'::regclass)
UNION ALL
SELECT name, 'comment on ' || d.objsubid, d.description
  FROM member JOIN pg_description AS d ON d.objoid = objid AND d.classoid = classid
UNION ALL
SELECT name, 'first privileges on ' || i.objsubid, i.initprivs::text
  FROM member JOIN pg_init_privs AS i ON i.objoid = objid AND i.classoid = classid
UNION ALL
SELECT name, 'valid', amvalidate(objid)::text
  FROM member WHERE classid = 'pg_opclass'::regclass
UNION ALL
SELECT 'the extension', 'itself', format('%s in %s, relocatable %s, configuration %s', extversion, extnamespace::regnamespace, extrelocatable, extconfig::regclass[])
  FROM pg_extension WHERE extname = 'pg_occlusion';

SELECT owner, kind, fact FROM fact ORDER BY owner COLLATE "C", kind COLLATE "C", fact COLLATE "C";

DO $$
BEGIN
    IF (SELECT count(*) FROM member) < 50 THEN
        RAISE EXCEPTION 'only % members were found', (SELECT count(*) FROM member);
    END IF;
    IF EXISTS (SELECT FROM fact WHERE kind = 'valid' AND fact <> 'true') THEN
        RAISE EXCEPTION 'an operator class is not valid';
    END IF;
END
$$;
