//! [`Contender`], a way to answer what can be seen from a point.

use postgres::Client;

use super::SCHEMA;
use crate::database::{literal, quoted};
use crate::failure::Failure;

/// Drops all that the benchmark made.
pub const CLOSE: &str = "DROP SCHEMA IF EXISTS occlusion_bench_point CASCADE";

/// What a way says of its answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Claim {
    /// Everything that can be seen is in them.
    Complete,
    /// Something may be missing.
    Incomplete,
    /// They are about a part of what is around.
    OfAPart,
}

/// A way to answer. Its question begins after `SELECT`, and `q` is an observer.
pub struct Contender {
    /// What it is called.
    pub name: &'static str,
    /// What a trial holds it to.
    #[cfg_attr(not(feature = "embree"), expect(dead_code))]
    pub claim: Claim,
    from: String,
}

impl Contender {
    /// All ways for one scene and range, ours first.
    pub fn all(scene: &str, range: f64, has_postgis: bool, has_volumes: bool) -> Vec<Self> {
        let literal = literal(scene);
        let schema = quoted(scene);
        let around = format!("occlusion.expand(occlusion.box3d(q.eye, q.eye), {range:?})");
        let in_range = format!(
            "f.envelope OPERATOR(occlusion.&&) {around} \
             AND f.envelope OPERATOR(occlusion.<->) q.eye <= {range:?}"
        );
        let mut all = vec![
            Self::new(
                "visible_features",
                Claim::Complete,
                format!(
                    "v.feature_id, v.class FROM occlusion.visible_features({literal}, q.eye, {range:?}) AS v"
                ),
            ),
            Self::new(
                "the same, in a cone of 60 degrees",
                Claim::OfAPart,
                format!(
                    "v.feature_id, v.class FROM occlusion.visible_features({literal}, \
                         occlusion.view_cone(q.eye, q.id * 77 % 360, 60, {range:?})) AS v"
                ),
            ),
            Self::new(
                "box3d, in range only",
                Claim::Complete,
                format!("f.id, f.class FROM {schema}.feature AS f WHERE {in_range}"),
            ),
        ];
        if has_volumes {
            let from = format!(
                "f.id, f.class FROM {schema}.feature AS f LEFT JOIN ( \
                     SELECT DISTINCT o.occludee FROM {schema}.occlusion_volume AS o \
                     WHERE o.box OPERATOR(occlusion.@>) q.eye) AS h ON h.occludee = f.id \
                 WHERE {in_range} AND h.occludee IS NULL"
            );
            all.push(Self::new(
                "2004: less what volumes hide",
                Claim::Complete,
                from,
            ));
        }
        if has_postgis {
            all.extend(Self::of_postgis(range));
        }
        all
    }

    fn of_postgis(range: f64) -> [Self; 3] {
        let distance = "greatest(b.x - q.x, 0, q.x - b.right) ^ 2 + greatest(b.y - q.y, 0, q.y - b.back) ^ 2 \
                        + greatest(b.z - q.z, 0, q.z - b.top) ^ 2";
        let reach = format!("q.x - {range:?}, q.y - {range:?}");
        let far = format!("q.x + {range:?}, q.y + {range:?}");
        let near_in_space = format!(
            "b.space OPERATOR(public.&&&) public.ST_MakeLine(public.ST_MakePoint({reach}, q.z - {range:?}), \
                                       public.ST_MakePoint({far}, q.z + {range:?})) \
             AND {distance} <= {range:?} ^ 2"
        );
        let in_space = format!("{SCHEMA}.building AS b WHERE {near_in_space}");
        let in_plan = format!(
            "{SCHEMA}.building AS b \
             WHERE b.plan OPERATOR(public.&&) public.ST_MakeEnvelope({reach}, {far}) \
               AND b.z <= q.z + {range:?} AND b.top >= q.z - {range:?} AND {distance} <= {range:?} ^ 2"
        );
        let line = "public.ST_MakeLine(public.ST_MakePoint(q.x, q.y, q.z), \
                    public.ST_MakePoint((b.x + b.right) / 2, (b.y + b.back) / 2, (b.z + b.top) / 2))";
        let sight_lines = format!(
            "b.id, b.class FROM {in_space} AND NOT EXISTS ( \
                 SELECT FROM {SCHEMA}.building AS s \
                 WHERE s.space OPERATOR(public.&&&) {line} AND s.id <> b.id \
                   AND public.ST_3DIntersects(s.solid, {line}))"
        );
        [
            Self::new(
                "PostGIS n-D, in range only",
                Claim::Complete,
                format!("b.id, b.class FROM {in_space}"),
            ),
            Self::new(
                "PostGIS 2D and z, in range only",
                Claim::Complete,
                format!("b.id, b.class FROM {in_plan}"),
            ),
            Self::new(
                "PostGIS, a sight line to each middle",
                Claim::Incomplete,
                sight_lines,
            ),
        ]
    }

    fn new(name: &'static str, claim: Claim, from: String) -> Self {
        Self { name, claim, from }
    }

    /// Asks for one observer.
    pub fn single(&self) -> String {
        format!(
            "SELECT a.* FROM {SCHEMA}.observer AS q, LATERAL (SELECT {}) AS a WHERE q.id = $1",
            self.from
        )
    }

    /// Asks for the first so many observers in one statement.
    pub fn batch(&self, observers: usize) -> String {
        format!(
            "SELECT count(*) FROM {SCHEMA}.observer AS q, LATERAL (SELECT {}) AS a WHERE q.id < {observers}",
            self.from
        )
    }
}

/// Whether there is PostGIS, in the schema public; it is created where it can be.
pub fn find_postgis(client: &mut Client) -> Result<bool, Failure> {
    let available = "SELECT FROM pg_catalog.pg_available_extensions WHERE name = 'postgis'";
    if client.query_opt(available, &[])?.is_none() {
        return Ok(false);
    }
    client.batch_execute("CREATE EXTENSION IF NOT EXISTS postgis SCHEMA public")?;
    Ok(true)
}

/// Whether a scene has occlusion volumes.
pub fn has_volumes(client: &mut Client, scene: &str) -> Result<bool, Failure> {
    let statement = format!("SELECT FROM {}.occlusion_volume LIMIT 1", quoted(scene));
    Ok(client.query_opt(&statement, &[])?.is_some())
}

/// Makes the table of PostGIS: the envelope of each feature in space, in plan, and as a closed surface.
pub fn prepare(client: &mut Client, scene: &str) -> Result<(), Failure> {
    let feature = format!("{}.feature", quoted(scene));
    let face = |corners: [&str; 4]| {
        let ring: Vec<String> = corners
            .iter()
            .chain(&corners[..1])
            .map(|corner| {
                let at = |n: usize, low: &str, high: &str| match &corner[n..=n] {
                    "0" => low.to_owned(),
                    _ => high.to_owned(),
                };
                let (x, y, z) = (
                    at(0, "b.x", "b.right"),
                    at(1, "b.y", "b.back"),
                    at(2, "b.z", "b.top"),
                );
                format!("{x} || ' ' || {y} || ' ' || {z}")
            })
            .collect();
        format!("'((' || {} || '))'", ring.join(" || ',' || "))
    };
    let faces = [
        ["000", "010", "110", "100"],
        ["001", "101", "111", "011"],
        ["000", "100", "101", "001"],
        ["100", "110", "111", "101"],
        ["110", "010", "011", "111"],
        ["010", "000", "001", "011"],
    ];
    let surface = faces.map(face).join(" || ',' || ");
    client.batch_execute(&format!(
        "CREATE UNLOGGED TABLE {SCHEMA}.building AS
         SELECT b.*, public.ST_MakeLine(public.ST_MakePoint(b.x, b.y, b.z),
                                        public.ST_MakePoint(b.right, b.back, b.top)) AS space,
                public.ST_MakeEnvelope(b.x, b.y, b.right, b.back) AS plan,
                public.ST_GeomFromText('POLYHEDRALSURFACE Z (' || {surface} || ')') AS solid
         FROM (SELECT id, class,
                      occlusion.x(occlusion.lower(envelope)) AS x, occlusion.x(occlusion.upper(envelope)) AS right,
                      occlusion.y(occlusion.lower(envelope)) AS y, occlusion.y(occlusion.upper(envelope)) AS back,
                      occlusion.z(occlusion.lower(envelope)) AS z, occlusion.z(occlusion.upper(envelope)) AS top
               FROM {feature} ORDER BY slot NULLS LAST, id) AS b;
         CREATE INDEX ON {SCHEMA}.building USING gist (space public.gist_geometry_ops_nd);
         CREATE INDEX ON {SCHEMA}.building USING gist (plan)"
    ))?;
    Ok(client.batch_execute(&format!("VACUUM ANALYZE {SCHEMA}.building"))?)
}
