//! [`Level`], a feature's model at one level of detail.

use engine::TriangleMesh;
use formats::{Feature, Geometry, PackedShape, Placement, Problem, Surface};
use glam::DVec3;

/// A feature's model at one level of detail, as it is stored.
#[derive(Clone, Debug)]
pub struct Level {
    /// Which level it is.
    pub level_of_detail: f64,
    /// The model itself, or which shape it is an instance of.
    pub model: StoredModel,
    /// Greatest distance to the best level, metres.
    pub geometric_error: Option<f64>,
}

/// A model for the database.
#[derive(Clone, Debug)]
pub enum StoredModel {
    /// Geometries of its own, packed.
    Own(Vec<u8>),
    /// A shape that others may share, and where it goes.
    Instance(PackedShape, Placement),
}

impl Level {
    /// All levels of a feature, the best last. `best` is the mesh of the best one.
    pub fn of(feature: &Feature, best: &TriangleMesh) -> Result<Vec<Self>, Problem> {
        let mut levels: Vec<f64> = feature
            .geometries
            .iter()
            .map(|g| g.level_of_detail)
            .collect();
        levels.sort_unstable_by(f64::total_cmp);
        levels.dedup();
        let finest = levels.last().copied();
        levels
            .into_iter()
            .map(|level| {
                let geometries = geometries_at(&feature.geometries, level);
                let geometric_error = if Some(level) == finest {
                    Some(0.0)
                } else {
                    engine::deviation(best, &mesh(geometries.iter().copied()))
                };
                Ok(Self {
                    level_of_detail: level,
                    model: StoredModel::of(feature, &geometries)?,
                    geometric_error,
                })
            })
            .collect()
    }
}

impl StoredModel {
    fn of(feature: &Feature, geometries: &[&Geometry]) -> Result<Self, Problem> {
        if let [
            Geometry {
                part: None,
                shape,
                placement: Some(placement),
                ..
            },
        ] = geometries
        {
            return Ok(Self::Instance(formats::pack_shape(shape)?, *placement));
        }
        let geometries: Vec<Geometry> = geometries.iter().map(|&g| g.clone()).collect();
        Ok(Self::Own(formats::pack(&geometries, &feature.parts)?))
    }
}

/// The geometries that show a feature at its best.
pub fn best_geometries(feature: &Feature) -> Vec<&Geometry> {
    let levels = feature.geometries.iter().map(|g| g.level_of_detail);
    geometries_at(
        &feature.geometries,
        levels.fold(f64::NEG_INFINITY, f64::max),
    )
}

/// The geometries that show a feature at one level of detail: of each part the highest level up to
/// it, or else its lowest. Levels below 1 are footprints, stand-ins for the surface: they show only
/// themselves.
fn geometries_at(geometries: &[Geometry], level: f64) -> Vec<&Geometry> {
    let is_candidate = |g: &&Geometry| {
        if level < 1.0 {
            g.level_of_detail == level
        } else {
            g.level_of_detail >= 1.0
        }
    };
    let rank = |g: &Geometry| {
        if g.level_of_detail <= level {
            (1, g.level_of_detail)
        } else {
            (0, -g.level_of_detail)
        }
    };
    let candidates: Vec<&Geometry> = geometries.iter().filter(is_candidate).collect();
    let is_chosen = |g: &&&Geometry| {
        let same_part = candidates.iter().filter(|other| other.part == g.part);
        same_part.into_iter().all(|other| rank(other) <= rank(g))
    };
    candidates.iter().filter(is_chosen).copied().collect()
}

/// The triangles of geometries.
pub fn mesh<'a>(geometries: impl IntoIterator<Item = &'a Geometry>) -> TriangleMesh {
    let surfaces: Vec<_> = geometries.into_iter().map(Geometry::surfaces).collect();
    mesh_of_surfaces(surfaces.iter().flat_map(|surfaces| surfaces.iter()))
}

/// The triangles of surfaces.
pub fn mesh_of_surfaces<'a>(surfaces: impl Iterator<Item = &'a Surface>) -> TriangleMesh {
    let ring = |ring: &Vec<[f64; 3]>| ring.iter().map(|&point| DVec3::from(point)).collect();
    TriangleMesh::from_polygons(
        surfaces.map(|surface| surface.rings.iter().map(ring).collect::<Vec<Vec<DVec3>>>()),
    )
}
