//! [`Surfaces`], everything of a scene that can be seen.

use oracle::Triangle;
use renderer::SceneMesh;

use super::feature::Feature;
use super::load::Scene;

/// The triangles of a scene: the surfaces of its features, each under a number of its own, and the
/// solid ground under them under one number together.
#[derive(Clone, Debug)]
pub struct Surfaces {
    /// Each triangle with its number.
    pub triangles: Vec<(u32, Triangle)>,
}

/// The number under which a feature is drawn, by its position in the scene; 0 is nothing.
pub fn number(position: usize) -> u32 {
    u32::try_from(position + 1).unwrap_or(u32::MAX)
}

impl Surfaces {
    /// All that can be seen in a scene.
    pub fn of(scene: &Scene) -> Self {
        let eyes = scene.streets.iter().map(|street| street.eye_low);
        Self::seen_from(&scene.features, eyes)
    }

    /// All that can be seen of some features by eyes at some heights.
    pub fn seen_from(features: &[Feature], eyes: impl Iterator<Item = f64>) -> Self {
        let lowest = lowest(features, eyes);
        let surfaces = features.iter().enumerate().flat_map(|(position, feature)| {
            let surface = feature.surface().unwrap_or_default();
            surface
                .into_iter()
                .map(move |triangle| (number(position), triangle))
        });
        let ground = features.iter().flat_map(|feature| feature.ground(lowest));
        let ground = ground.map(|triangle| (number(features.len()), triangle));
        Self {
            triangles: surfaces.chain(ground).collect(),
        }
    }

    /// For the renderer.
    pub fn mesh(&self) -> SceneMesh {
        let first = |triangle: usize| u32::try_from(3 * triangle).unwrap_or(u32::MAX - 2);
        let triangles = (0..self.triangles.len()).map(first);
        SceneMesh {
            positions: self
                .triangles
                .iter()
                .flat_map(|(_, corners)| *corners)
                .collect(),
            triangles: triangles.map(|i| [i, i + 1, i + 2]).collect(),
            ids: self.triangles.iter().map(|(id, _)| *id).collect(),
        }
    }
}

/// A height below everything that can be seen or looked from.
fn lowest(features: &[Feature], eyes: impl Iterator<Item = f64>) -> f64 {
    let feet = features.iter().map(|feature| feature.envelope.min[2]);
    feet.chain(eyes).fold(0.0, f64::min) - 1.0
}
