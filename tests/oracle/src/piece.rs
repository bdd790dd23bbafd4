//! The check that a convex piece comes from the columns of its feature.

use thiserror::Error;

use crate::column::Column;
use crate::exact::Rational;
use crate::interval::Interval;
use crate::plane::{Outline, PlanPoint, Spot, spot};
use crate::prism::Prism;
use crate::section::lies_within;

/// Why a piece is not part of a column.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PieceFault {
    /// No column holds the piece.
    #[error("none of {columns} columns holds the piece over {corners:?} from {bottom} to {top}")]
    InNoColumn {
        /// How many columns there are.
        columns: usize,
        /// The corners of the piece.
        corners: Vec<[f64; 2]>,
        /// Its bottom.
        bottom: f64,
        /// Its top.
        top: f64,
    },
    /// Columns hold the piece, but none of them is grounded as it claims to be.
    #[error("column {column} holds the piece and is not grounded as the piece is")]
    NotGrounded {
        /// The position of the first such column.
        column: usize,
    },
}

/// Checks that the convex `piece`, with its ground if it is grounded, lies in one of `columns`, and
/// returns the position of the first that holds it. Faces may touch. Exact.
///
/// # Errors
/// That no column holds it, or none that is grounded as it is.
pub fn check_piece_in_column(piece: &Prism, columns: &[Column]) -> Result<usize, PieceFault> {
    let holding = || (0..columns.len()).filter(|&column| holds(&columns[column], piece));
    let deep = |&column: &usize| columns[column].grounded || !piece.grounded;
    holding().find(deep).ok_or_else(|| match holding().next() {
        Some(column) => PieceFault::NotGrounded { column },
        None => PieceFault::InNoColumn {
            columns: columns.len(),
            corners: piece.edges.iter().map(|edge| edge[0]).collect(),
            bottom: piece.bottom,
            top: piece.top,
        },
    })
}

/// Whether the column, with its ground, holds the piece without its own.
fn holds(column: &Column, piece: &Prism) -> bool {
    let within = |bound: [f64; 2], axis: usize| {
        let (min, max) = (piece.bounds.min[axis], piece.bounds.max[axis]);
        bound[0] <= min && max <= bound[1]
    };
    let footprint = &column.footprint;
    piece.top <= column.top
        && column.solid_bottom() <= piece.bottom
        && (0..2).all(|axis| within([footprint.min[axis], footprint.max[axis]], axis))
        && holds_in_plan(column, piece)
}

fn holds_in_plan(column: &Column, piece: &Prism) -> bool {
    let corners: Vec<PlanPoint> = piece.edges.iter().map(|edge| edge[0]).collect();
    let outline = Outline::around(&corners, &column.footprint.edges);
    let filter: Vec<Spot<Interval>> = corners.iter().map(|corner| spot(*corner)).collect();
    lies_within(&filter, &outline)
        .or_else(|| {
            let exact: Vec<Spot<Rational>> = corners.iter().map(|corner| spot(*corner)).collect();
            lies_within(&exact, &outline)
        })
        // Rationals always decide.
        .unwrap_or(false)
}
