//! [`Contender`], an index and how it is asked.

/// What is searched for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// What overlaps a box.
    Overlap,
    /// What a horizontal sector of 60 degrees meets.
    Sector,
    /// What a cone of 60 degrees meets.
    Cone,
    /// What holds a point.
    Point,
    /// The ten that are nearest to a point.
    Nearest,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Overlap,
        Self::Sector,
        Self::Cone,
        Self::Point,
        Self::Nearest,
    ];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Overlap => "box",
            Self::Sector => "sector",
            Self::Cone => "cone",
            Self::Point => "point in box",
            Self::Nearest => "nearest 10",
        }
    }
}

/// An index over a table of its own, and how it is asked. In its texts `b` is a row of the table
/// and `q` a search; what they are made from is called `box` and `search`.
#[derive(Clone, Copy, Debug)]
pub struct Contender {
    /// What it is called.
    pub name: &'static str,
    /// Name of its table.
    pub table: &'static str,
    /// The extension that it needs besides ours.
    pub extension: Option<&'static str>,
    /// A statement that must run before its index can be made.
    pub preparation: Option<&'static str>,
    /// Columns of its table besides id and class.
    pub columns: &'static str,
    /// Columns of its searches besides the id.
    pub searches: &'static str,
    /// Access method and column of the index.
    pub index: &'static str,
    /// Whether its keys are boxes in single precision, a little wider than those in the table.
    pub single_precision: bool,
    /// What follows `FROM` to find what overlaps `q.box`.
    pub overlap: &'static str,
    /// The same for what is in the sector.
    pub sector: &'static str,
    /// The same for what is in the cone, where there are cones.
    pub cone: Option<&'static str>,
    /// The same for what holds `q.point`.
    pub point: &'static str,
    /// The same for the ten nearest to `q.point`, where the index knows distances.
    pub nearest: Option<&'static str>,
}

/// Name of our own first contender.
pub const OURS: &str = BOX3D.name;

/// Name of PostGIS' index in space.
pub const ND: &str = POSTGIS_ND.name;

/// Name of the index of contrib's cube.
pub const CUBE: &str = CUBE_GIST.name;

const BOX3D: Contender = Contender {
    name: "box3d GiST",
    table: "box3d_gist",
    extension: None,
    preparation: None,
    columns: "box.key",
    searches: "search.box, search.point,
        occlusion.view_sector(search.eye, search.heading, 60, search.range) AS sector,
        occlusion.view_cone(search.eye, search.heading, 60, search.range) AS cone,
        occlusion.expand(search.box, 0.02) AS wide_box,
        occlusion.expand(occlusion.box3d(search.point, search.point), 0.02) AS wide_point",
    index: "gist (key occlusion.box3d_ops)",
    single_precision: false,
    overlap: "WHERE b.key OPERATOR(occlusion.&&) q.box",
    sector: "WHERE b.key OPERATOR(occlusion.&&) q.sector",
    cone: Some("WHERE b.key OPERATOR(occlusion.&&) q.cone"),
    point: "WHERE b.key OPERATOR(occlusion.@>) q.point",
    nearest: Some("ORDER BY b.key OPERATOR(occlusion.<->) q.point LIMIT 10"),
};

/// What operator classes can be made by.
pub const SUPERUSER: &str = "superuser";

/// Finds a little more than ours: what keys in single precision may find besides, in cities that
/// reach less than 100 km from their origin.
pub const GENEROUS: Contender = Contender {
    overlap: "WHERE b.key OPERATOR(occlusion.&&) q.wide_box",
    point: "WHERE b.key OPERATOR(occlusion.&&) q.wide_point",
    ..BOX3D
};

/// Our operator class without its order of a sorted build.
const UNSORTED: Contender = Contender {
    name: "box3d GiST, build not sorted",
    table: "box3d_unsorted",
    preparation: Some(
        "CREATE OPERATOR CLASS box3d_unsorted_ops FOR TYPE occlusion.box3d USING gist AS
            OPERATOR 3 occlusion.&& (occlusion.box3d, occlusion.box3d),
            OPERATOR 27 occlusion.@> (occlusion.box3d, occlusion.point3d),
            OPERATOR 33 occlusion.&& (occlusion.box3d, occlusion.view_cone),
            OPERATOR 43 occlusion.&& (occlusion.box3d, occlusion.view_sector),
            OPERATOR 25 occlusion.<-> (occlusion.box3d, occlusion.point3d)
                FOR ORDER BY pg_catalog.float_ops,
            FUNCTION 1 occlusion.box3d_gist_consistent(internal, occlusion.box3d, smallint, oid, internal),
            FUNCTION 2 occlusion.box3d_gist_union(internal, internal),
            FUNCTION 5 occlusion.box3d_gist_penalty(internal, internal, internal),
            FUNCTION 6 occlusion.box3d_gist_picksplit(internal, internal),
            FUNCTION 7 occlusion.box3d_gist_same(occlusion.box3d, occlusion.box3d, internal),
            FUNCTION 8 occlusion.box3d_gist_distance(internal, occlusion.box3d, smallint, oid, internal),
            FUNCTION 9 occlusion.box3d_gist_fetch(internal)",
    ),
    index: "gist (key box3d_unsorted_ops)",
    ..BOX3D
};

const BOX3D_SPGIST: Contender = Contender {
    name: "box3d SP-GiST",
    table: "box3d_spgist",
    index: "spgist (key)",
    ..BOX3D
};

const BOX3D_BRIN: Contender = Contender {
    name: "box3d BRIN",
    table: "box3d_brin",
    index: "brin (key)",
    nearest: None,
    ..BOX3D
};

/// A key is the diagonal of the box: the smallest geometry with that box. Of a sector the exact
/// test is that of a polygon around it; distances in height are left out, in its favour.
const POSTGIS_ND: Contender = Contender {
    name: "PostGIS n-D GiST",
    table: "postgis_nd",
    extension: Some("postgis"),
    columns: "ST_MakeLine(ST_MakePoint(box.x, box.y, box.z),
        ST_MakePoint(box.right, box.back, box.top)) AS key",
    searches: "
        ST_MakeLine(ST_MakePoint(search.x, search.y, search.z),
            ST_MakePoint(search.right, search.back, search.top)) AS box,
        ST_MakePoint(search.px, search.py, search.pz) AS point,
        ST_GeomFromText(search.sector) AS sector,
        ST_MakeLine(ST_MakePoint(search.west, search.south, search.lowest),
            ST_MakePoint(search.east, search.north, search.highest)) AS around",
    index: "gist (key gist_geometry_ops_nd)",
    single_precision: true,
    overlap: "WHERE b.key &&& q.box",
    sector: "WHERE b.key &&& q.around AND ST_Intersects(ST_Envelope(b.key), q.sector)",
    cone: None,
    point: "WHERE b.key &&& q.point",
    nearest: Some("ORDER BY b.key <<->> q.point LIMIT 10"),
    ..BOX3D
};

const POSTGIS_2D: Contender = Contender {
    name: "PostGIS 2D GiST + z",
    table: "postgis_2d",
    columns: "ST_MakeEnvelope(box.x, box.y, box.right, box.back) AS key,
        box.z AS bottom, box.top",
    searches: "
        ST_MakeEnvelope(search.x, search.y, search.right, search.back) AS box,
        search.z AS bottom, search.top,
        ST_MakePoint(search.px, search.py) AS point, search.pz,
        ST_GeomFromText(search.sector) AS sector,
        search.lowest, search.highest",
    index: "gist (key)",
    overlap: "WHERE b.key && q.box AND b.bottom <= q.top AND b.top >= q.bottom",
    sector: "WHERE ST_Intersects(b.key, q.sector) AND b.bottom <= q.highest AND b.top >= q.lowest",
    point: "WHERE b.key && q.point AND b.bottom <= q.pz AND b.top >= q.pz",
    nearest: Some("ORDER BY b.key <-> q.point LIMIT 10"),
    ..POSTGIS_ND
};

/// A sector is told by the distance, and the bearing of a box's centre.
const CUBE_GIST: Contender = Contender {
    name: "cube GiST",
    table: "cube_gist",
    extension: Some("cube"),
    columns: "cube(ARRAY[box.x, box.y, box.z], ARRAY[box.right, box.back, box.top]) AS key",
    searches: "
        cube(ARRAY[search.x, search.y, search.z],
            ARRAY[search.right, search.back, search.top]) AS box,
        cube(ARRAY[search.px, search.py, search.pz]) AS point,
        cube(ARRAY[search.ex, search.ey, search.ez]) AS eye,
        cube(ARRAY[search.west, search.south, search.lowest],
            ARRAY[search.east, search.north, search.highest]) AS around,
        search.range, search.ex, search.ey,
        sind(search.heading) AS ahead_x, cosd(search.heading) AS ahead_y",
    index: "gist (key)",
    single_precision: false,
    overlap: "WHERE b.key && q.box",
    sector: "CROSS JOIN LATERAL (
            SELECT (cube_ll_coord(b.key, 1) + cube_ur_coord(b.key, 1)) / 2 - q.ex AS dx,
                   (cube_ll_coord(b.key, 2) + cube_ur_coord(b.key, 2)) / 2 - q.ey AS dy) AS d
        WHERE b.key && q.around AND (b.key <-> q.eye) <= q.range
          AND d.dx * q.ahead_x + d.dy * q.ahead_y >= cosd(30) * sqrt(d.dx * d.dx + d.dy * d.dy)",
    point: "WHERE b.key @> q.point",
    nearest: Some("ORDER BY b.key <-> q.point LIMIT 10"),
    ..POSTGIS_ND
};

impl Contender {
    /// All of them, ours first; a build that is not sorted only where it is asked for.
    pub fn all(unsorted: bool) -> Vec<Self> {
        let mut all = vec![BOX3D];
        all.extend(unsorted.then_some(UNSORTED));
        all.extend([BOX3D_SPGIST, BOX3D_BRIN, POSTGIS_ND, POSTGIS_2D, CUBE_GIST]);
        all
    }

    /// What it needs that a database may not give: an extension, a superuser.
    pub fn needs(&self) -> impl Iterator<Item = &'static str> {
        let superuser = self.preparation.map(|_| SUPERUSER);
        self.extension.into_iter().chain(superuser)
    }

    /// Whether it is somebody else's.
    pub fn is_rival(&self) -> bool {
        self.extension.is_some()
    }

    /// What answers a search `q`, if it can: the columns of boxes from its table on.
    fn answer(&self, kind: Kind) -> Option<String> {
        let rest = match kind {
            Kind::Overlap => Some(self.overlap),
            Kind::Sector => Some(self.sector),
            Kind::Cone => self.cone,
            Kind::Point => Some(self.point),
            Kind::Nearest => self.nearest,
        };
        let Self { table, .. } = self;
        Some(format!(
            "FROM {table}_search AS q \
             CROSS JOIN LATERAL (SELECT b.id, b.class FROM {table} AS b {}) AS r",
            rest?
        ))
    }

    /// The statement for one search, by its id.
    pub fn single(&self, kind: Kind) -> Option<String> {
        let answer = self.answer(kind)?;
        Some(format!("SELECT r.id, r.class {answer} WHERE q.id = $1"))
    }

    /// The statement for all searches. It counts a payload column, so that no index gets away
    /// without reading the table.
    pub fn batch(&self, kind: Kind) -> Option<String> {
        Some(format!("SELECT count(r.class) {}", self.answer(kind)?))
    }

    /// The statement for the ids that the first searches find.
    pub fn pairs(&self, kind: Kind, searches: usize) -> Option<String> {
        let answer = self.answer(kind)?;
        Some(format!(
            "SELECT q.id AS search, r.id {answer} WHERE q.id < {searches}"
        ))
    }
}
