//! [`Truth`], what rays are cast at and by what.

use engine::ConvexPieceOptions;
use oracle::{Occluder, OccluderIndex, Point, Prism, RayCaster, Triangle, surface_samples};
use rayon::prelude::*;

use crate::failure::Failure;
use crate::scene::{Scene, Surfaces, number};

/// The real surfaces of a scene, prepared for exact checks.
pub struct Truth {
    /// For exact rays.
    pub caster: RayCaster,
    /// Points on each feature to aim rays at.
    pub targets: Vec<Vec<Point>>,
    /// For what single convex pieces hide.
    pub occluders: OccluderIndex,
}

impl Truth {
    /// The truth of a scene, with `rays` targets a feature.
    pub fn new(
        scene: &Scene,
        surfaces: &Surfaces,
        rays: usize,
        seed: u64,
    ) -> Result<Self, Failure> {
        let of_feature = |id: u32| -> Vec<Triangle> {
            let from = surfaces.triangles.partition_point(|(other, _)| *other < id);
            let same = surfaces.triangles[from..]
                .iter()
                .take_while(|(other, _)| *other == id);
            same.map(|(_, corners)| *corners).collect()
        };
        let targets = (0..scene.features.len()).map(|position| {
            let id = number(position);
            surface_samples(&of_feature(id), rays, seed ^ u64::from(id).rotate_left(32))
        });
        Ok(Self {
            caster: RayCaster::new(&surfaces.triangles).map_err(Failure::machine)?,
            targets: targets.collect(),
            occluders: OccluderIndex::new(&occluders(scene)),
        })
    }
}

fn occluders(scene: &Scene) -> Vec<Occluder> {
    let pieces: Vec<Vec<Prism>> = scene
        .features
        .par_iter()
        .map(|feature| feature.pieces(&ConvexPieceOptions::default()))
        .collect();
    let numbered = pieces.into_iter().enumerate();
    numbered
        .flat_map(|(position, pieces)| {
            let id = number(position);
            pieces.into_iter().map(move |solid| Occluder { id, solid })
        })
        .collect()
}
