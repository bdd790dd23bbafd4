//! `line_of_sight`, whether one point can be seen from another past the features of a scene.

use crate::scene::{polygon, quoted};
use crate::snapshot_read::{Reader, Row, Statement, read};
use crate::types::{Box3d, Point3d};
use engine::{Share, SightLine, TriangleMesh, extruded};
use glam::DVec3;
use pgrx::iter::TableIterator;
use pgrx::{IntoDatum, name, pg_extern};
use std::collections::HashMap;

/// A piece of the line near more features than this is halved, so that what lies behind an obstacle
/// is not read.
const MOST_AT_ONCE: usize = 32;

/// Length in metres of a piece that is not halved, however many features are near.
const SHORTEST_PIECE: f64 = 16.0;

/// Whether the second point can be seen from the first, and what is in the way first.
#[pg_extern(stable, strict, parallel_safe)]
#[allow(clippy::type_complexity, reason = "the columns of the result")]
fn line_of_sight(
    scene: &str,
    a: Point3d,
    b: Point3d,
) -> TableIterator<
    'static,
    (
        name!(visible, bool),
        name!(obstacle, Option<i64>),
        name!(distance, Option<f64>),
        name!(point, Option<Point3d>),
    ),
> {
    let obstacle = read(|reader| {
        require(reader, scene);
        let line = SightLine::new(a.0, b.0)?;
        let Obstacle { feature, share } = Search::new(reader, scene, &line).first()?;
        Some((feature, line.distance(&share), Point3d(line.point(&share))))
    });
    TableIterator::once(match obstacle {
        None => (true, None, None, None),
        Some((feature, distance, point)) => (false, Some(feature), Some(distance), Some(point)),
    })
}

/// As [`crate::scene::require`], under the snapshot of the call.
fn require(reader: &Reader, scene: &str) {
    reader
        .statement("SELECT occlusion.require_scene($1)", &[String::type_oid()])
        .rows(&[scene.into()], 0, |_| ());
}

/// A feature that is in the way, and from where on.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Obstacle {
    share: Share,
    feature: i64,
}

/// The way along a line, front to back, through the features of a scene.
struct Search<'call> {
    line: &'call SightLine,
    near: Statement<'call>,
    meshes: Statement<'call>,
    columns: Statement<'call>,
    boxes: Statement<'call>,
    /// Features that need no second look.
    seen: Vec<i64>,
    /// The nearest of them that is in the way.
    first: Option<Obstacle>,
}

impl<'call> Search<'call> {
    fn new(reader: &Reader<'call>, scene: &str, line: &'call SightLine) -> Self {
        let scene = quoted(scene);
        let of_features = |query: &str| reader.statement(query, &[Vec::<i64>::type_oid()]);
        Self {
            line,
            near: reader.statement(
                &format!(
                    "SELECT id, envelope FROM {scene}.feature \
                     WHERE envelope OPERATOR(occlusion.&&) $1 \
                       AND id OPERATOR(pg_catalog.<>) ALL ($2)"
                ),
                &[Box3d::type_oid(), Vec::<i64>::type_oid()],
            ),
            meshes: of_features(&format!(
                "SELECT near.feature, m.vertices, m.triangles, m.defect IS NULL \
                 FROM pg_catalog.unnest($1) AS near (feature) LEFT JOIN {scene}.mesh AS m \
                   ON m.feature OPERATOR(pg_catalog.=) near.feature"
            )),
            columns: of_features(&format!(
                "SELECT feature, footprint::pg_catalog.text[], bottom, top \
                 FROM {scene}.solid_column WHERE feature OPERATOR(pg_catalog.=) ANY ($1)"
            )),
            boxes: of_features(&format!(
                "SELECT feature, box FROM {scene}.inner_envelope \
                 WHERE feature OPERATOR(pg_catalog.=) ANY ($1)"
            )),
            seen: Vec::new(),
            first: None,
        }
    }

    /// The first obstacle; of several in one place that with the least number.
    fn first(mut self) -> Option<Obstacle> {
        self.walk(0.0, 1.0);
        self.first
    }

    /// Looks at what is near the line between two shares of the way, unless an obstacle comes before.
    fn walk(&mut self, from: f64, to: f64) {
        let is_behind = |first: &Obstacle| first.share < Share::of(from);
        if self.first.as_ref().is_some_and(is_behind) {
            return;
        }
        let middle = 0.5 * from + 0.5 * to;
        let length = self.line.distance(&Share::of(1.0)) * (to - from);
        let may_halve = length > SHORTEST_PIECE && from < middle && middle < to;
        let most = if may_halve { MOST_AT_ONCE + 1 } else { 0 };
        let near: Vec<(i64, Box3d)> = self
            .near
            .rows(
                &[
                    Box3d(self.line.piece(from, to)).into(),
                    self.seen.clone().into(),
                ],
                most,
                |row| row.get(1).zip(row.get(2)),
            )
            .into_iter()
            .flatten()
            .collect();
        if may_halve && near.len() > MOST_AT_ONCE {
            self.walk(from, middle);
            self.walk(middle, to);
            return;
        }
        self.seen.extend(near.iter().map(|(feature, _)| feature));
        let met = near
            .into_iter()
            .filter(|(_, envelope)| self.line.meets(&envelope.0));
        let met: Vec<i64> = met.map(|(feature, _)| feature).collect();
        if !met.is_empty() {
            self.look(met);
        }
    }

    /// Finds where the line is stopped by some features: by their meshes, by the columns of those that
    /// have none, or by the boxes of those that have no columns either.
    fn look(&mut self, features: Vec<i64>) {
        let line = self.line;
        let looks = self.meshes.rows(&[features.into()], 0, |row| {
            row.get(1).map(|feature: i64| (feature, at_mesh(line, row)))
        });
        let mut bare = Vec::new();
        for (feature, look) in looks.into_iter().flatten() {
            match look {
                Some(share) => self.note(feature, share),
                None => bare.push(feature),
            }
        }
        let columns = solids(&self.columns, &bare, column);
        bare.retain(|feature| !columns.contains_key(feature));
        let boxes = solids(&self.boxes, &bare, inner_box);
        for (feature, triangles) in columns.into_iter().chain(boxes) {
            self.note(
                feature,
                line.enters(&TriangleMesh::from_triangles(triangles)),
            );
        }
    }

    fn note(&mut self, feature: i64, share: Option<Share>) {
        let new = share.map(|share| Obstacle { share, feature });
        self.first = self.first.take().into_iter().chain(new).min();
    }
}

/// Where a line is stopped by the mesh of a row of vertices, triangles, and whether they enclose a
/// solid; `None` where there is no mesh. What a damaged one bounds is not known, so it stops nothing.
fn at_mesh(line: &SightLine, row: &Row) -> Option<Option<Share>> {
    let vertices: Vec<Option<f64>> = row.get(2)?;
    let triangles: Vec<Option<i32>> = row.get(3)?;
    let is_solid = row.get(4).unwrap_or(false);
    let mesh = mesh(&vertices, &triangles);
    Some(mesh.and_then(|mesh| {
        if is_solid {
            line.enters(&mesh)
        } else {
            line.passes_through(&mesh)
        }
    }))
}

fn mesh(vertices: &[Option<f64>], triangles: &[Option<i32>]) -> Option<TriangleMesh> {
    let (vertices, no_number) = vertices.as_chunks::<3>();
    let (triangles, no_corner) = triangles.as_chunks::<3>();
    let corner = |number: &Option<i32>| u32::try_from((*number)?).ok();
    let is_whole = no_number.is_empty() && no_corner.is_empty();
    is_whole.then_some(TriangleMesh {
        vertices: vertices
            .iter()
            .map(|&[x, y, z]| Some(DVec3::new(x?, y?, z?)))
            .collect::<Option<_>>()?,
        triangles: triangles
            .iter()
            .map(|[a, b, c]| Some([corner(a)?, corner(b)?, corner(c)?]))
            .collect::<Option<_>>()?,
        untriangulable_faces: 0,
    })
}

/// The triangles around what a statement gives of each feature that it gives something of.
fn solids(
    statement: &Statement,
    features: &[i64],
    solid: fn(&Row) -> Option<TriangleMesh>,
) -> HashMap<i64, Vec<[DVec3; 3]>> {
    let mut solids: HashMap<i64, Vec<[DVec3; 3]>> = HashMap::new();
    if features.is_empty() {
        return solids;
    }
    let rows = statement.rows(&[features.to_vec().into()], 0, |row| {
        row.get(1).map(|feature: i64| (feature, solid(row)))
    });
    for (feature, solid) in rows.into_iter().flatten() {
        let triangles = solids.entry(feature).or_default();
        triangles.extend(solid.iter().flat_map(TriangleMesh::corners));
    }
    solids
}

/// The column of a row of footprint, bottom and top; `None` where the footprint is no polygon.
fn column(row: &Row) -> Option<TriangleMesh> {
    let rings: Vec<Option<String>> = row.get(2)?;
    let rings: Vec<String> = rings.into_iter().collect::<Option<_>>()?;
    let (bottom, top): (f64, f64) = row.get(3).zip(row.get(4))?;
    Some(extruded(&polygon::area(&rings)?, bottom, top).ok()?.mesh)
}

/// The box of a row; `None` where it is flat.
fn inner_box(row: &Row) -> Option<TriangleMesh> {
    let bounds: engine::Box3d = row.get::<Box3d>(2)?.0;
    let corner = |x: f64, y: f64| geo::Coord { x, y };
    let (min, max) = (bounds.min, bounds.max);
    let footprint = geo::Rect::new(corner(min.x, min.y), corner(max.x, max.y)).to_polygon();
    Some(extruded(&footprint, min.z, max.z).ok()?.mesh)
}
