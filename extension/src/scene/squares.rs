//! [`squares`], the plan of the view region that view cells are computed by.

use crate::error::Refusal;
use engine::{Street, ViewRegion, square_key};
use geo::BoundingRect;
use glam::DVec3;
use pgrx::PgSqlErrorCode;
use std::collections::HashSet;

/// Squares of a scene at the most; a larger one takes larger cells.
const MOST_BLOCKS: usize = 10_000_000;

/// A square, and its number.
pub struct Square {
    pub id: i64,
    pub area: engine::Box3d,
}

/// The squares of a grid on which streets are, along a curve through the plan.
pub fn squares(streets: Vec<Street>, edge: f64) -> Vec<Square> {
    let region = ViewRegion::new(streets);
    let mut places: HashSet<[i64; 2]> = HashSet::new();
    for street in region.streets() {
        let Some(bounds) = street.area.bounding_rect() else {
            continue;
        };
        let [low, high] = [bounds.min(), bounds.max()].map(|corner| corner / edge);
        for x in low.x.floor() as i64..=high.x.floor() as i64 {
            for y in low.y.floor() as i64..=high.y.floor() as i64 {
                places.insert([x, y]);
            }
        }
        if places.len() > MOST_BLOCKS {
            Refusal::new(
                PgSqlErrorCode::ERRCODE_PROGRAM_LIMIT_EXCEEDED,
                format!("the streets take more than {MOST_BLOCKS} squares of {edge} m"),
            )
            .hint("Larger cells make larger squares: largest => 64.")
            .raise();
        }
    }
    let square = |[x, y]: [i64; 2]| {
        let corner = |x: i64, y: i64| DVec3::new(x as f64, y as f64, 0.0) * edge;
        let area = engine::Box3d::new(corner(x, y), corner(x + 1, y + 1));
        region.filled(&area)?;
        Some(Square {
            id: square_key([x, y]).map_or_else(|| refuse_far(), u64::cast_signed),
            area,
        })
    };
    let mut squares: Vec<Square> = places.into_iter().filter_map(square).collect();
    squares.sort_by_key(|square| square.id);
    squares
}

fn refuse_far() -> ! {
    Refusal::new(
        PgSqlErrorCode::ERRCODE_PROGRAM_LIMIT_EXCEEDED,
        "streets are too far from the origin for view cells",
    )
    .detail("View cells reach half a million squares of theirs in each direction.")
    .hint("Larger cells make larger squares: largest => 64.")
    .raise()
}
