//! [`Camera::from_matrix`]: a camera taken out of a view-projection matrix.

use super::Camera;
use super::camera::power_to_one;
use glam::{DVec2, DVec3, DVec4};
use thiserror::Error;

/// Least volume that three rows of a matrix may span, as unit vectors.
const SINGULAR: f64 = 1e-12;

/// Greatest sine by which the sides of an image may deviate from right angles, and its near and far
/// plane from parallel: the rounding of matrices in single precision.
const SKEW: f64 = 1e-6;

/// Where two terms of a double-precision matrix cancel to this part, what is left is rounding.
const CANCELLED: f64 = 1e-12;

/// Which depths a matrix lets through, in clip space. Which end is near does not matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthRange {
    /// `-w <= z <= w`, as OpenGL has it.
    MinusOneToOne,
    /// `0 <= z <= w`, as Vulkan, Direct3D, Metal and WebGPU have it.
    ZeroToOne,
}

/// Why a matrix is not that of a camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum MatrixDefect {
    /// Its rows do not span space.
    #[error("is singular")]
    Singular,
    /// Its rays are parallel.
    #[error("is orthographic: it has no centre of projection")]
    Orthographic,
    /// The sides of its image are not at right angles.
    #[error("shears the image")]
    Sheared,
    /// Its near and far plane are oblique.
    #[error("has a near or far plane that is not parallel to the image")]
    Oblique,
    /// No point passes its depth range.
    #[error("lets no depth through")]
    Empty,
    /// Every depth from some on passes.
    #[error("has its far plane at infinity")]
    Endless,
}

impl Camera {
    /// The camera of a matrix, given by its rows, that takes column vectors (x, y, z, 1) to clip
    /// space: what is seen has `-w <= x <= w`, `-w <= y <= w`, and z within the range.
    ///
    /// A matrix that mirrors is taken for one whose y points down, as in Vulkan.
    ///
    /// # Errors
    /// When no camera sees just that: see [`MatrixDefect`].
    pub fn from_matrix(rows: [[f64; 4]; 4], range: DepthRange) -> Result<Self, MatrixDefect> {
        let rows = rows.map(DVec4::from);
        let greatest = rows.iter().map(|row| row.abs().max_element());
        let scale = power_to_one(greatest.fold(f64::MIN_POSITIVE, f64::max));
        let [x, y, z, w] = rows.map(|row| row * scale);
        if w.truncate() == DVec3::ZERO && w.w != 0.0 {
            return Err(MatrixDefect::Orthographic);
        }
        let eye = common_point(x, y, w).ok_or(MatrixDefect::Singular)?;
        // w grows by `steepness` with each metre forward.
        let (forward, steepness) = w.truncate().normalize_and_length();
        let (across, upward) = (x.truncate(), y.truncate());
        let (across_ahead, upward_ahead) = (across.dot(forward), upward.dot(forward));
        let (right, width) = (across - forward * across_ahead).normalize_and_length();
        let (top, height) = (upward - forward * upward_ahead).normalize_and_length();
        if right.dot(top).abs() > SKEW {
            return Err(MatrixDefect::Sheared);
        }
        // +1, or -1 where y points down.
        let upright = right.cross(top).dot(-forward).signum();
        let (near, far) = depths(z, eye, forward, steepness, range)?;
        Ok(Self {
            eye,
            direction: forward,
            up: top * upright,
            fov: 2.0 * steepness.atan2(height),
            aspect: height / width,
            near,
            far,
            shift: DVec2::new(-across_ahead, -upward_ahead * upright) / steepness,
        })
    }
}

/// The point where three planes meet.
fn common_point(a: DVec4, b: DVec4, c: DVec4) -> Option<DVec3> {
    let [p, q, r] = [a, b, c].map(DVec4::truncate);
    let volume = p.dot(q.cross(r));
    let point = (q.cross(r) * a.w + r.cross(p) * b.w + p.cross(q) * c.w) / -volume;
    let spans = volume.abs() > SINGULAR * p.length() * q.length() * r.length();
    (spans && point.is_finite()).then_some(point)
}

/// The depths, in metres along `forward`, between which a matrix's row `z` is in the range.
fn depths(
    z: DVec4,
    eye: DVec3,
    forward: DVec3,
    steepness: f64,
    range: DepthRange,
) -> Result<(f64, f64), MatrixDefect> {
    let (gradient, at_eye) = (z.truncate(), z.truncate().dot(eye) + z.w);
    let slope = gradient.dot(forward);
    if (gradient - forward * slope).length() > SKEW * gradient.length() {
        return Err(MatrixDefect::Oblique);
    }
    // Each is a line over depth that must not be negative, and how much of its slope is rounding.
    let noise = CANCELLED * steepness;
    let below = match range {
        DepthRange::MinusOneToOne => (steepness + slope, at_eye, noise),
        DepthRange::ZeroToOne => (slope, at_eye, 0.0),
    };
    let above = (steepness - slope, -at_eye, noise);
    let (mut near, mut far) = (0.0_f64, f64::INFINITY);
    for (slope, start, noise) in [below, above] {
        if slope > noise {
            near = near.max(-start / slope);
        } else if slope < -noise {
            far = far.min(-start / slope);
        } else if start < 0.0 {
            return Err(MatrixDefect::Empty);
        }
    }
    if far <= near {
        return Err(MatrixDefect::Empty);
    }
    if far.is_infinite() {
        return Err(MatrixDefect::Endless);
    }
    Ok((near, far))
}
