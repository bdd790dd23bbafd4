//! The checks of what is stored, by exact arithmetic.

use std::collections::HashMap;

use indicatif::ParallelProgressIterator;
use oracle::{Prism, check_inner_envelope, check_volume};
use rayon::prelude::*;

use super::fault::Fault;
use crate::scene::{Feature, Scene, Volume};
use crate::terminal;

/// Everything that is wrong with the stored meshes and envelopes.
pub fn check_features(scene: &Scene) -> Vec<Fault> {
    let bar = terminal::bar(scene.features.len(), "envelopes");
    let features = scene.features.par_iter().progress_with(bar);
    features
        .flat_map_iter(feature_faults)
        .map(Fault::Stored)
        .collect()
}

fn feature_faults(feature: &Feature) -> Vec<String> {
    [
        mesh_fault(feature),
        outer_fault(feature),
        inner_fault(feature),
    ]
    .into_iter()
    .flatten()
    .map(|fault| format!("{feature}: {fault}"))
    .collect()
}

fn mesh_fault(feature: &Feature) -> Option<String> {
    let broken = feature.surface().is_none();
    broken
        .then(|| "the mesh names a vertex that is not there, or one that is not finite".to_owned())
}

/// The outer envelope holds every vertex.
fn outer_fault(feature: &Feature) -> Option<String> {
    let envelope = &feature.envelope;
    let is_inside = |vertex: &[f64; 3]| {
        (0..3).all(|axis| (envelope.min[axis]..=envelope.max[axis]).contains(&vertex[axis]))
    };
    let mesh = feature.mesh.as_ref()?;
    let stray = mesh.vertices.iter().find(|vertex| !is_inside(vertex))?;
    Some(format!("vertex {stray:?} lies outside the outer envelope"))
}

/// The inner envelope lies inside the solid. Without a mesh it is the solid.
fn inner_fault(feature: &Feature) -> Option<String> {
    let (mesh, inner) = (feature.mesh.as_ref()?, feature.inner.as_ref()?);
    let fault = check_inner_envelope(mesh, &inner.bounds.into(), inner.grounded).err()?;
    Some(fault.to_string())
}

/// Checks occlusion volumes against the envelopes of a scene.
pub struct VolumeChecker<'a> {
    scene: &'a Scene,
    positions: HashMap<i64, usize>,
}

impl<'a> VolumeChecker<'a> {
    /// A checker for the volumes of a scene.
    pub fn new(scene: &'a Scene) -> Self {
        Self {
            scene,
            positions: scene.positions(),
        }
    }

    /// Everything that is wrong with some volumes.
    pub fn check(&self, volumes: &[Volume]) -> Vec<Fault> {
        let faults = volumes.par_iter().filter_map(|volume| self.fault(volume));
        faults.map(Fault::Stored).collect()
    }

    fn fault(&self, volume: &Volume) -> Option<String> {
        let find = |id: i64| {
            self.positions
                .get(&id)
                .map(|&position| &self.scene.features[position])
        };
        // The tables hold no volume without its features.
        let (occluder, occludee) = (find(volume.occluder)?, find(volume.occludee)?);
        let fault = match &occluder.inner {
            None => "the occluder has no inner envelope".to_owned(),
            Some(inner) => match Prism::of_box(&inner.bounds.into(), inner.grounded) {
                Err(fault) => fault.to_string(),
                Ok(hider) => {
                    check_volume(&volume.bounds.into(), &[hider], &occludee.envelope.into())
                        .err()?
                        .to_string()
                }
            },
        };
        Some(format!("volume of {occluder} hiding {occludee}: {fault}"))
    }
}
