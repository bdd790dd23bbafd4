//! The checks of what is stored, by exact arithmetic.

use std::collections::HashMap;

use engine::{ConvexPieceOptions, SolidColumn};
use indicatif::ParallelProgressIterator;
use oracle::{
    Column, ColumnFault, GROUND_TOLERANCE, Mesh, Prism, ShapeFault, check_column,
    check_inner_envelope, check_piece_in_column, check_volume, sample_column,
};
use rayon::prelude::*;

use super::fault::Fault;
use crate::scene::{Feature, Scene, Volume, rings};
use crate::terminal;

/// Every convex piece that can be found, the most useful first: volumes that were made from fewer
/// are right all the same.
const ALL_PIECES: ConvexPieceOptions = ConvexPieceOptions {
    most: usize::MAX,
    least_share: 0.0,
};

/// Points of a column that no proof holds for.
const SAMPLES: usize = 20_000;

/// Everything that is wrong with the stored meshes, envelopes and columns.
///
/// Besides the proofs about `samples` points all over the solid columns must be inside.
pub fn check_features(scene: &Scene, samples: usize) -> Vec<Fault> {
    let bar = terminal::bar(scene.features.len(), "envelopes and columns");
    let columns: usize = scene
        .features
        .iter()
        .map(|feature| feature.columns.len())
        .sum();
    let each = samples.div_ceil(columns.max(1));
    let features = scene.features.par_iter().progress_with(bar);
    features
        .flat_map_iter(|feature| feature_faults(feature, each))
        .map(Fault::Stored)
        .collect()
}

fn feature_faults(feature: &Feature, samples: usize) -> Vec<String> {
    [
        mesh_fault(feature),
        outer_fault(feature),
        inner_fault(feature),
    ]
    .into_iter()
    .flatten()
    .chain(column_faults(feature, samples))
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

/// Each solid column lies inside the solid, and a grounded one on its foot. Without a mesh the
/// columns are the solid.
fn column_faults(feature: &Feature, samples: usize) -> Vec<String> {
    let Some(mesh) = &feature.mesh else {
        return Vec::new();
    };
    let fault = |(number, solid): (usize, &SolidColumn)| {
        let fault = match column(solid) {
            Err(fault) => fault.to_string(),
            Ok(column) => column_fault(mesh, solid, &column, samples)?,
        };
        Some(format!("solid column {}: {fault}", number + 1))
    };
    feature
        .columns
        .iter()
        .enumerate()
        .filter_map(fault)
        .collect()
}

/// Why a column is not solid. Where the parts of a solid touch or overlap a face of one of them may
/// run through the column; then no proof is left, and points all over it must be inside.
fn column_fault(
    mesh: &Mesh,
    solid: &SolidColumn,
    column: &Column,
    samples: usize,
) -> Option<String> {
    let fault = match check_column(mesh, column).err() {
        None if samples == 0 => return None,
        None => sample_column(mesh, column, samples, 1).into_iter().next()?,
        Some(ColumnFault::TriangleInside { .. }) => {
            let heights = mesh.vertices.iter().map(|vertex| vertex[2]);
            let foot = heights.fold(f64::INFINITY, f64::min);
            if solid.grounded && solid.bottom - foot > GROUND_TOLERANCE {
                return Some(format!("it is not at the foot of the mesh, {foot}"));
            }
            sample_column(mesh, column, SAMPLES.max(samples), 1)
                .into_iter()
                .next()?
        }
        Some(fault) => fault,
    };
    Some(fault.to_string())
}

/// A column as the oracle takes it.
fn column(solid: &SolidColumn) -> Result<Column, ShapeFault> {
    let rings = rings(&solid.footprint).into_iter().map(|ring| ring.0);
    let rings: Vec<Vec<[f64; 2]>> = rings.collect();
    Column::new(&rings, solid.bottom, solid.top, solid.grounded)
}

/// The convex pieces of a feature, each in something that is stored as solid.
fn pieces(feature: &Feature) -> Result<Vec<Prism>, String> {
    let solids: Result<Vec<Column>, ShapeFault> = feature.solids().map(|s| column(&s)).collect();
    let solids = solids.map_err(|fault| fault.to_string())?;
    let pieces = feature.pieces(&ALL_PIECES);
    for piece in &pieces {
        check_piece_in_column(piece, &solids).map_err(|fault| fault.to_string())?;
    }
    Ok(pieces)
}

/// Checks occlusion volumes against what is solid in a scene.
pub struct VolumeChecker<'a> {
    scene: &'a Scene,
    positions: HashMap<i64, usize>,
    /// The convex pieces of each feature, or why one of them is none.
    pieces: Vec<Result<Vec<Prism>, String>>,
}

impl<'a> VolumeChecker<'a> {
    /// A checker for the volumes of a scene.
    pub fn new(scene: &'a Scene) -> Self {
        Self {
            scene,
            positions: scene.positions(),
            pieces: scene.features.par_iter().map(pieces).collect(),
        }
    }

    /// Everything that is wrong with some volumes.
    pub fn check(&self, volumes: &[Volume]) -> Vec<Fault> {
        let faults = volumes.par_iter().filter_map(|volume| self.fault(volume));
        faults.map(Fault::Stored).collect()
    }

    fn fault(&self, volume: &Volume) -> Option<String> {
        let find = |id: i64| self.positions.get(&id).copied();
        // The tables hold no volume without its features.
        let (occluder, occludee) = (find(volume.occluder)?, find(volume.occludee)?);
        let hidden = &self.scene.features[occludee];
        let fault = match &self.pieces[occluder] {
            Err(fault) => fault.clone(),
            Ok(pieces) if pieces.is_empty() => "nothing of the occluder is solid".to_owned(),
            Ok(pieces) => check_volume(&volume.bounds.into(), pieces, &hidden.envelope.into())
                .err()?
                .to_string(),
        };
        let hider = &self.scene.features[occluder];
        Some(format!("volume of {hider} hiding {hidden}: {fault}"))
    }
}
