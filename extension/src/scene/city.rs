//! Generated cities as rows.

use super::polygon;
use crate::error::Refusal;
use crate::types::Box3d;
use engine::{BoxCity, scattered_city};
use pgrx::iter::TableIterator;
use pgrx::{PgSqlErrorCode, name, pg_extern};

/// Features of one generated city at the most.
const MOST_FEATURES: i32 = 1_000_000;

/// The twelve triangles of a box whose corners are numbered by bits: 1 for x, 2 for y, 4 for z.
const BOX_TRIANGLES: [i32; 36] = [
    0, 2, 3, 0, 3, 1, // bottom
    4, 5, 7, 4, 7, 6, // top
    0, 1, 5, 0, 5, 4, // front
    2, 6, 7, 2, 7, 3, // back
    0, 4, 6, 0, 6, 2, // left
    1, 3, 7, 1, 7, 5, // right
];

/// The features of a generated city, each with its box and the box's mesh.
#[pg_extern(immutable, strict, parallel_safe)]
#[allow(clippy::type_complexity, reason = "the columns of the result")]
fn make_city(
    layout: &str,
    features: i32,
    seed: i64,
) -> TableIterator<
    'static,
    (
        name!(number, i32),
        name!(envelope, Box3d),
        name!(vertices, Vec<f64>),
        name!(triangles, Vec<i32>),
    ),
> {
    let city = city(layout, features, seed);
    TableIterator::new((1..).zip(city.boxes).map(|(number, bounds)| {
        let vertices = bounds
            .corners()
            .iter()
            .flat_map(|corner| corner.to_array())
            .collect();
        (number, Box3d(bounds), vertices, BOX_TRIANGLES.to_vec())
    }))
}

/// The streets of a generated city.
#[pg_extern(immutable, strict, parallel_safe)]
fn make_city_streets(
    layout: &str,
) -> TableIterator<
    'static,
    (
        name!(area, Vec<String>),
        name!(eye_low, f64),
        name!(eye_high, f64),
    ),
> {
    let streets = city(layout, 0, 0).streets;
    TableIterator::new(
        streets
            .into_iter()
            .map(|s| (polygon::area_text(&s.area), s.eye_low, s.eye_high)),
    )
}

fn city(layout: &str, features: i32, seed: i64) -> BoxCity {
    if layout != "scattered" {
        Refusal::new(
            PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
            format!("unknown city layout \"{layout}\""),
        )
        .hint("The layout is 'scattered'.")
        .raise();
    }
    let count = usize::try_from(features)
        .ok()
        .filter(|_| features <= MOST_FEATURES);
    match count {
        Some(count) => scattered_city(count, seed.cast_unsigned()),
        None => Refusal::new(
            PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
            format!("number of features {features} is out of bounds"),
        )
        .detail(format!("It is at least 0 and at most {MOST_FEATURES}."))
        .raise(),
    }
}
