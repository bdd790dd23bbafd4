//! `line_of_sight`, whether one point can be seen from another past the features of a scene.

use super::base::{column_of, upright};
use super::statements::{Ask, Statements};
use super::stored_mesh::mesh_of;
use super::surfaces;
use super::tables::Tables;
use crate::snapshot_read::{Moment, Row};
use crate::types::{Box3d, Point3d};
use engine::{Share, SightLine, TriangleMesh};
use pgrx::iter::TableIterator;
use pgrx::pg_sys::Datum;
use pgrx::{IntoDatum, name, pg_extern};
use std::rc::Rc;

/// A piece of the line near more features than this is halved, so that what lies behind an obstacle
/// is not read.
const MOST_AT_ONCE: i64 = 32;

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
    let statements = Statements::of(scene, &Tables::of(scene));
    let obstacle = SightLine::new(a.0, b.0).and_then(|line| {
        let Obstacle { feature, share } = Search::new(statements, &line).first()?;
        Some((feature, line.distance(&share), Point3d(line.point(&share))))
    });
    TableIterator::once(match obstacle {
        None => (true, None, None, None),
        Some((feature, distance, point)) => (false, Some(feature), Some(distance), Some(point)),
    })
}

/// A feature that is in the way, and from where on.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Obstacle {
    share: Share,
    feature: i64,
}

/// The way along a line, front to back, through the features of a scene.
struct Search<'a> {
    line: &'a SightLine,
    statements: Rc<Statements>,
    /// Features that need no second look.
    seen: Vec<i64>,
    /// The nearest of them that is in the way.
    first: Option<Obstacle>,
}

impl<'a> Search<'a> {
    fn new(statements: Rc<Statements>, line: &'a SightLine) -> Self {
        Self {
            line,
            statements,
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
        let piece = Box3d(self.line.piece(from, to)).into_datum();
        let arguments: Vec<Datum> = piece.into_iter().chain(array(&self.seen)).collect();
        let mut near: Vec<(i64, Box3d)> = Vec::new();
        let asked = self.statements.get(Ask::EnvelopesNear);
        asked.read_some(Moment::Query, &arguments, most, |row| {
            near.extend(row.get(1).zip(row.get(2)));
        });
        if may_halve && near.len() > MOST_AT_ONCE as usize {
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
        let mut looks = Vec::new();
        let meshes = self.statements.get(Ask::Meshes);
        meshes.read(Moment::Query, &array(&features), |row| {
            looks.extend(
                row.get::<i64>(1)
                    .map(|feature| (feature, at_mesh(line, row))),
            );
        });
        let mut bare = Vec::new();
        for (feature, look) in looks {
            match look {
                Some(share) => self.note(feature, share),
                None => bare.push(feature),
            }
        }
        let solids = |ask, features: &[i64], solid| {
            surfaces::solids(&self.statements, Moment::Query, ask, features, solid)
        };
        let columns = solids(Ask::Columns, &bare, column_of);
        bare.retain(|feature| !columns.contains_key(feature));
        let boxes = solids(Ask::AllInnerEnvelopes, &bare, |row| {
            row.get::<Box3d>(2).map(|bounds| upright(&bounds.0))
        });
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
    let is_solid = row.get(4).unwrap_or(false);
    Some(mesh_of(row)?.and_then(|mesh| {
        if is_solid {
            line.enters(&mesh)
        } else {
            line.passes_through(&mesh)
        }
    }))
}

/// Numbers of features as an argument.
fn array(features: &[i64]) -> Vec<Datum> {
    features.to_vec().into_datum().into_iter().collect()
}
