//! Generated cities as rows.

use super::polygon;
use crate::error::Refusal;
use crate::types::Box3d;
use engine::{City, CityLayout, OuterPrism, generated_city};
use pgrx::iter::TableIterator;
use pgrx::{PgSqlErrorCode, name, pg_extern};

/// Features of one generated city at the most.
const MOST_FEATURES: i32 = 1_000_000;

/// The features of some parts of a generated city, numbered from 1: what each is called, its class,
/// boxes and mesh, its one solid column, which stands on the ground, and its outline.
#[pg_extern(immutable, strict, parallel_safe)]
#[allow(clippy::type_complexity, reason = "the columns of the result")]
fn make_city(
    layout: &str,
    features: i32,
    seed: i64,
    first_part: i32,
    parts: i32,
) -> TableIterator<
    'static,
    (
        name!(number, i32),
        name!(kind, &'static str),
        name!(class, &'static str),
        name!(envelope, Box3d),
        name!(inner_envelope, Box3d),
        name!(vertices, Vec<f64>),
        name!(triangles, Vec<i32>),
        name!(footprint, Vec<String>),
        name!(top, f64),
        name!(outline, Option<String>),
    ),
> {
    let part = |number: i32| u32::try_from(number).unwrap_or_default();
    let first = part(first_part);
    let city = city(layout, features, seed);
    let made = city.features_of(first..first.saturating_add(part(parts)));
    TableIterator::new((1..).zip(made).map(|(number, feature)| {
        let mesh = &feature.mesh;
        let vertices = mesh.vertices.iter().flat_map(|vertex| vertex.to_array());
        let corners = mesh.triangles.as_flattened();
        let prism = OuterPrism::around(mesh.vertices.iter().copied());
        (
            number,
            feature.kind,
            feature.class,
            Box3d(feature.envelope),
            Box3d(feature.inner_envelope),
            vertices.collect(),
            corners.iter().map(|corner| corner.cast_signed()).collect(),
            polygon::area_text(&feature.column.footprint),
            feature.column.top,
            prism.map(|prism| polygon::corners_text(&prism.hull)),
        )
    }))
}

/// The streets of a generated city.
#[pg_extern(immutable, strict, parallel_safe)]
#[allow(clippy::type_complexity, reason = "the columns of the result")]
fn make_city_streets(
    layout: &str,
    features: i32,
    seed: i64,
) -> TableIterator<
    'static,
    (
        name!(area, Vec<String>),
        name!(eye_low, f64),
        name!(eye_high, f64),
    ),
> {
    let streets = city(layout, features, seed).streets();
    TableIterator::new(streets.map(|s| (polygon::area_text(&s.area), s.eye_low, s.eye_high)))
}

fn city(layout: &str, features: i32, seed: i64) -> City {
    let Some(known) = CityLayout::ALL.into_iter().find(|l| l.name() == layout) else {
        let [first, second, third] = CityLayout::ALL.map(CityLayout::name);
        Refusal::new(
            PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
            format!("unknown city layout \"{layout}\""),
        )
        .hint(format!("The layout is '{first}', '{second}' or '{third}'."))
        .raise();
    };
    let count = usize::try_from(features)
        .ok()
        .filter(|_| features <= MOST_FEATURES);
    match count {
        Some(count) => generated_city(known, count, seed.cast_unsigned()),
        None => Refusal::new(
            PgSqlErrorCode::ERRCODE_INVALID_PARAMETER_VALUE,
            format!("number of features {features} is out of bounds"),
        )
        .detail(format!("It is at least 0 and at most {MOST_FEATURES}."))
        .raise(),
    }
}
