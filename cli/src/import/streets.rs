//! The streets of an import.

use engine::{Site, Street, TriangleMesh, ViewRegionOptions, covers_ground};
use geo::MultiPolygon;
use rayon::prelude::*;

use super::model::Model;
use super::solid::{self, Solid};

/// What the roads of all files cover, less what solid features stand on.
pub fn of_roads(model: &Model, solids: &[Solid]) -> Vec<Street> {
    if model.roads.is_empty() {
        return Vec::new();
    }
    let surfaces: Vec<TriangleMesh> = model
        .roads
        .par_iter()
        .map(|road| solid::mesh(road.surfaces.iter()))
        .collect();
    let footprints: Vec<MultiPolygon<f64>> = solids
        .par_iter()
        .map(|solid| engine::footprint(&solid.mesh))
        .collect();
    let in_the_way = || model.features.iter().zip(solids).zip(&footprints);
    let sites: Vec<Site> = in_the_way()
        .filter(|((feature, _), _)| !covers_ground(&feature.class))
        .map(|((_, solid), footprint)| Site {
            footprint: footprint.clone(),
            foot: solid.envelope.min.z,
        })
        .collect();
    let built: Vec<MultiPolygon<f64>> = in_the_way()
        .filter(|((_, solid), _)| solid.inner.is_ok())
        .map(|(_, footprint)| footprint.clone())
        .collect();
    let streets = engine::streets_from_surfaces(&surfaces, &sites, &ViewRegionOptions::default());
    engine::without_footprints(streets, &built)
}
