//! Where a perspective picture is taken from.

use super::{Observer, PictureScene, bounds};
use crate::error::{Error, Result};
use crate::scene_mesh::is_drawable;

/// A camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Where it stands, in metres.
    pub eye: [f64; 3],
    /// The point in the middle of the picture.
    pub target: [f64; 3],
    /// Opening angle from bottom to top in degrees.
    pub vertical_angle: f64,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

/// Opening angles of the ready-made views in degrees.
const STREET_ANGLE: f64 = 55.0;
const AERIAL_ANGLE: f64 = 38.0;

/// Height of an aerial view over its distance from the middle.
const AERIAL_SLOPE: f64 = 0.8;

/// Aerial views are tried farther and farther away by this factor, this often.
const AERIAL_STEP: f64 = 1.05;
const AERIAL_STEPS: i32 = 80;

/// Free part of an aerial view along each edge.
const AERIAL_EDGE: f32 = 0.05;

/// Right, up and forward, of unit length.
pub(crate) type Axes = [[f64; 3]; 3];

impl View {
    /// What the observer sees, looking along the heading, slightly upwards.
    #[must_use]
    pub fn from_observer(observer: &Observer, width: u32, height: u32) -> Self {
        let (sin, cos) = observer.heading.to_radians().sin_cos();
        let [x, y, z] = observer.eye;
        let target = [x + sin, y + cos, z + 0.12];
        Self {
            eye: observer.eye,
            target,
            vertical_angle: STREET_ANGLE,
            width,
            height,
        }
    }

    /// From the air, over the observer's shoulder: as near as the whole field of view, or, without
    /// an observer, the whole scene from the south, fits into the picture.
    #[must_use]
    pub fn from_above(scene: &PictureScene, width: u32, height: u32) -> Self {
        let (points, heading, ground) = match &scene.observer {
            Some(observer) => (observer.field_of_view(), observer.heading, observer.eye[2]),
            None => (
                corners(scene.bounds().unwrap_or(([0.0; 2], [1.0; 2]))),
                0.0,
                0.0,
            ),
        };
        let (low, high) = bounds(points.iter().copied()).unwrap_or(([0.0; 2], [1.0; 2]));
        let [x, y] = [0, 1].map(|axis| (low[axis] + high[axis]) / 2.0);
        let (sin, cos) = heading.to_radians().sin_cos();
        let from = |reach: f64| Self {
            eye: [
                x - reach * sin,
                y - reach * cos,
                ground + AERIAL_SLOPE * reach,
            ],
            target: [x, y, ground],
            vertical_angle: AERIAL_ANGLE,
            width,
            height,
        };
        let size = (high[0] - low[0]).max(high[1] - low[1]).max(1.0);
        let steps = (0..AERIAL_STEPS).map(|step| from(size * AERIAL_STEP.powi(step) / 4.0));
        let mut views = steps.filter(|view| view.holds(&points, ground));
        views.next().unwrap_or_else(|| from(2.0 * size))
    }

    /// True when all of these places on the ground are in the picture, off its edges.
    fn holds(&self, points: &[[f64; 2]], ground: f64) -> bool {
        let Ok(axes) = self.axes() else { return false };
        let size = [self.width, self.height].map(|side| side as f32);
        let is_inside = |&[x, y]: &[f64; 2]| {
            self.project(&axes, [x, y, ground]).is_some_and(|pixel| {
                (0..2).all(|i| (AERIAL_EDGE..1.0 - AERIAL_EDGE).contains(&(pixel[i] / size[i])))
            })
        };
        points.iter().all(is_inside)
    }

    /// Refuses cameras that see nothing, and returns the axes of the others.
    pub(crate) fn axes(&self) -> Result<Axes> {
        if !is_drawable(&self.eye) || !is_drawable(&self.target) {
            let message = format!("from {:?} to {:?}", self.eye, self.target);
            return Err(Error::View(message));
        }
        if !(self.vertical_angle > 0.0 && self.vertical_angle < 180.0) {
            return Err(Error::View(format!(
                "an opening angle of {} degrees",
                self.vertical_angle
            )));
        }
        let forward = std::array::from_fn(|axis| self.target[axis] - self.eye[axis]);
        let forward = unit(forward)
            .ok_or_else(|| Error::View(format!("eye and target both at {:?}", self.eye)))?;
        // Straight up or down, north is the top of the picture.
        let right = unit([forward[1], -forward[0], 0.0]).unwrap_or([1.0, 0.0, 0.0]);
        Ok([right, cross(right, forward), forward])
    }

    /// Tangents of half the opening angle, across and up.
    pub(crate) fn tangents(&self) -> [f64; 2] {
        let up = (self.vertical_angle.to_radians() / 2.0).tan();
        [up * f64::from(self.width) / f64::from(self.height), up]
    }

    /// Where a point appears, in pixels; `None` behind the camera.
    pub(crate) fn project(&self, axes: &Axes, point: [f64; 3]) -> Option<[f32; 2]> {
        let relative = std::array::from_fn(|axis| point[axis] - self.eye[axis]);
        let [u, v, w] = axes.map(|axis| dot(axis, relative));
        let [across, up] = self.tangents();
        let x = (1.0 + u / (w * across)) / 2.0 * f64::from(self.width);
        let y = (1.0 - v / (w * up)) / 2.0 * f64::from(self.height);
        (w > 0.0).then_some([x as f32, y as f32])
    }
}

fn corners((low, high): ([f64; 2], [f64; 2])) -> Vec<[f64; 2]> {
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The same direction with length 1; `None` when there is none.
pub(crate) fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(v, v).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|c| c / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view(target: [f64; 3]) -> View {
        View {
            eye: [0.0; 3],
            target,
            vertical_angle: 90.0,
            width: 200,
            height: 100,
        }
    }

    #[test]
    fn north_looks_north() {
        let view = view([0.0, 5.0, 0.0]);
        let axes = view.axes().unwrap();
        assert_eq!(axes, [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
        assert_eq!(view.project(&axes, [0.0, 9.0, 0.0]), Some([100.0, 50.0]));
        let [x, y] = view.project(&axes, [9.0, 9.0, 4.5]).unwrap();
        assert!(
            (x - 150.0).abs() < 1e-3 && (y - 25.0).abs() < 1e-3,
            "{x} {y}"
        );
        assert_eq!(view.project(&axes, [0.0, -1.0, 0.0]), None);
    }

    #[test]
    fn straight_down_has_north_on_top() {
        let axes = view([0.0, 0.0, -1.0]).axes().unwrap();
        assert_eq!(axes[1], [0.0, 1.0, 0.0]);
    }

    #[test]
    fn blind_cameras_are_refused() {
        assert!(view([0.0; 3]).axes().is_err());
        assert!(view([f64::NAN, 0.0, 0.0]).axes().is_err());
        assert!(
            View {
                vertical_angle: 180.0,
                ..view([1.0; 3])
            }
            .axes()
            .is_err()
        );
    }

    #[test]
    fn views_from_above_hold_the_field_of_view() {
        let eye = [100.0, 200.0, 1.75];
        for angle in [2.0, 60.0, 200.0, 360.0] {
            let observer = Observer {
                eye,
                heading: 40.0,
                angle,
                range: 300.0,
            };
            let scene = PictureScene {
                observer: Some(observer),
                ..Default::default()
            };
            let view = View::from_above(&scene, 1200, 800);
            let axes = view.axes().unwrap();
            for [x, y] in observer.field_of_view() {
                let [px, py] = view.project(&axes, [x, y, 0.0]).unwrap();
                assert!(
                    (0.0..1200.0).contains(&px) && (0.0..800.0).contains(&py),
                    "{px} {py}"
                );
            }
        }
    }
}
