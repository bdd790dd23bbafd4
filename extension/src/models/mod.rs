//! Models of features, read from a scene and written as files.

mod content;
mod format;
mod read;

use crate::error::or_raise;
use crate::scene;
use format::FileFormat;
use pgrx::iter::TableIterator;
use pgrx::{name, pg_extern};
use read::{Choice, models};

/// The model of each feature as a file of its own, in the order asked for.
#[pg_extern(stable, parallel_safe)]
#[allow(clippy::type_complexity, reason = "the columns of the result")]
fn feature_models(
    scene: Option<&str>,
    features: Option<Vec<Option<i64>>>,
    format: Option<&str>,
    level_of_detail: Option<f64>,
    most_error: Option<Vec<Option<f64>>>,
) -> TableIterator<
    'static,
    (
        name!(feature_id, i64),
        name!(level_of_detail, Option<f64>),
        name!(content, Option<Vec<u8>>),
    ),
> {
    let scene = scene::given(scene, "scene");
    let format = or_raise(FileFormat::parse(scene::given(format, "format")));
    scene::require(scene);
    let choice = Choice::new(features, level_of_detail, most_error);
    let srid = read::srid(scene);
    let rows = models(scene, &choice).into_iter().map(move |row| {
        let content = row.model.map(|model| format.write(&[model], srid));
        (row.feature, row.level_of_detail, content)
    });
    TableIterator::new(rows.collect::<Vec<_>>())
}

/// The models of features as one file.
#[pg_extern(stable, parallel_safe)]
fn merged_models(
    scene: Option<&str>,
    features: Option<Vec<Option<i64>>>,
    format: Option<&str>,
    level_of_detail: Option<f64>,
    most_error: Option<Vec<Option<f64>>>,
) -> Vec<u8> {
    let scene = scene::given(scene, "scene");
    let format = or_raise(FileFormat::parse(scene::given(format, "format")));
    scene::require(scene);
    let choice = Choice::new(features, level_of_detail, most_error);
    let srid = read::srid(scene);
    let models: Vec<formats::Model> = models(scene, &choice)
        .into_iter()
        .filter_map(|row| row.model)
        .collect();
    format.write(&models, srid)
}
