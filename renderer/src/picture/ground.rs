//! What lies flat on the ground in a perspective: soil, streets, field of view.

use super::palette::{self, Rgb};
use super::surface::{SurfaceVertex, linear, relative};
use super::{Area, PictureScene};
use earcut::Earcut;

/// Half the side of the ground in metres: it ends in the haze.
const GROUND_REACH: f64 = 30_000.0;

/// Flat triangles in painter's order, drawn without depth: they all lie in one plane.
pub(crate) fn ground(
    scene: &PictureScene,
    eye: [f64; 3],
    height: f64,
    with_field_of_view: bool,
) -> Vec<SurfaceVertex> {
    let mut layer = Layer {
        eye,
        height,
        vertices: Vec::new(),
    };
    let [x, y, _] = eye;
    let r = GROUND_REACH;
    let soil = vec![
        [x - r, y - r],
        [x + r, y - r],
        [x + r, y + r],
        [x - r, y + r],
    ];
    layer.push(
        &Area {
            exterior: soil,
            holes: vec![],
        },
        palette::GROUND,
        1.0,
    );
    for street in &scene.streets {
        layer.push(street, palette::STREET_ON_GROUND, 1.0);
    }
    if let Some(observer) = scene.observer.as_ref().filter(|_| with_field_of_view) {
        let area = Area {
            exterior: observer.field_of_view(),
            holes: vec![],
        };
        layer.push(&area, palette::FIELD_OF_VIEW, palette::FIELD_OF_VIEW_ALPHA);
    }
    layer.vertices
}

struct Layer {
    eye: [f64; 3],
    height: f64,
    vertices: Vec<SurfaceVertex>,
}

impl Layer {
    fn push(&mut self, area: &Area, color: Rgb, alpha: f32) {
        let color = linear(color, alpha);
        self.vertices
            .extend(triangulate(area).into_iter().map(|[x, y]| SurfaceVertex {
                position: relative([x, y, self.height], self.eye),
                normal: [0.0, 0.0, 1.0],
                color,
                surface: 0,
            }));
    }
}

/// Corners of the triangles of a polygon, three each. Empty for a polygon that is not finite.
pub(crate) fn triangulate(area: &Area) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = open(&area.exterior).to_vec();
    let mut holes: Vec<u32> = Vec::new();
    for hole in area
        .holes
        .iter()
        .map(|hole| open(hole))
        .filter(|hole| hole.len() > 2)
    {
        holes.push(points.len() as u32);
        points.extend(hole);
    }
    if open(&area.exterior).len() < 3 || !points.iter().flatten().all(|c| c.is_finite()) {
        return Vec::new();
    }
    let mut corners: Vec<u32> = Vec::new();
    Earcut::new().earcut(points.iter().copied(), &holes, &mut corners);
    corners
        .into_iter()
        .map(|corner| points[corner as usize])
        .collect()
}

/// A ring without its repeated last point.
pub(crate) fn open(ring: &[[f64; 2]]) -> &[[f64; 2]] {
    match ring {
        [first, .., last] if first == last => &ring[..ring.len() - 1],
        _ => ring,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(half: f64) -> Vec<[f64; 2]> {
        vec![
            [-half, -half],
            [half, -half],
            [half, half],
            [-half, half],
            [-half, -half],
        ]
    }

    fn area(corners: &[[f64; 2]]) -> f64 {
        let cross = |t: &[[f64; 2]]| {
            (t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[1][1] - t[0][1]) * (t[2][0] - t[0][0])
        };
        corners.chunks(3).map(|t| cross(t).abs() / 2.0).sum()
    }

    #[test]
    fn holes_are_left_open() {
        let street = Area {
            exterior: square(4.0),
            holes: vec![square(1.0)],
        };
        assert_eq!(area(&triangulate(&street)), 64.0 - 4.0);
    }

    #[test]
    fn degenerate_areas_are_empty() {
        assert!(triangulate(&Area::default()).is_empty());
        let line = Area {
            exterior: vec![[0.0; 2], [1.0, 1.0], [0.0; 2]],
            holes: vec![],
        };
        assert!(triangulate(&line).is_empty());
        let broken = Area {
            exterior: vec![[f64::NAN; 2]; 5],
            holes: vec![],
        };
        assert!(triangulate(&broken).is_empty());
    }
}
