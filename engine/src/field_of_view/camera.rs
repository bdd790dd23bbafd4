//! [`Camera`], the numbers that make a [`Frustum`](super::Frustum).

use glam::{DVec2, DVec3};

/// Least sine of the angle between the direction and the up vector of a camera: with less, which
/// side is up is noise.
const PARALLEL: f64 = 1e-9;

/// A pinhole camera with a flat, rectangular image, a near plane and a far plane. Metres and
/// radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The centre of projection.
    pub eye: DVec3,
    /// Whereto the camera looks, of any length; near and far plane are across it.
    pub direction: DVec3,
    /// What is up in the image, of any length; only its part across the direction counts.
    pub up: DVec3,
    /// Full vertical aperture of the image were it centred, more than 0 and less than a half turn.
    pub fov: f64,
    /// Width of the image by its height.
    pub aspect: f64,
    /// Distance of the near plane, along the direction, 0 or more.
    pub near: f64,
    /// Distance of the far plane, along the direction, more than that of the near plane.
    pub far: f64,
    /// How far the middle of the image lies right of and above the direction, in halves of its
    /// width and height; 0 for most cameras.
    pub shift: DVec2,
}

impl Camera {
    /// Unit vectors to the right, up and forward. `None` when the direction or the up vector is
    /// zero, or both are parallel.
    #[must_use]
    pub fn axes(&self) -> Option<[DVec3; 3]> {
        let (direction, up) = (near_one(self.direction), near_one(self.up));
        let forward = direction.try_normalize()?;
        let right = exact_cross(direction, up);
        if right.length() <= PARALLEL * direction.length() * up.length() {
            return None;
        }
        let right = right.try_normalize()?;
        Some([right, right.cross(forward), forward])
    }

    /// The rays from the eye to the corners of the image, each one metre deep: lower left, lower
    /// right, upper right, upper left. `None` as for [`Camera::axes`].
    #[must_use]
    pub fn rays(&self) -> Option<[DVec3; 4]> {
        let [right, up, forward] = self.axes()?;
        let half_height = (self.fov / 2.0).tan();
        let half_width = half_height * self.aspect;
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        Some(corners.map(|(x, y)| {
            let across = (self.shift.x + x) * half_width;
            let upward = (self.shift.y + y) * half_height;
            forward + right * across + up * upward
        }))
    }

    /// The corners of the frustum: those on the near plane, then those on the far plane, in the
    /// order of the rays. `None` as for [`Camera::axes`].
    #[must_use]
    pub fn corners(&self) -> Option<[DVec3; 8]> {
        let rays = self.rays()?;
        Some(std::array::from_fn(|i| {
            let depth = if i < 4 { self.near } else { self.far };
            self.eye + rays[i % 4] * depth
        }))
    }
}

/// The power of two that brings a positive number into [1, 2), as far as there is one.
pub(super) fn power_to_one(number: f64) -> f64 {
    let exponent = number.log2().floor().clamp(-1000.0, 1000.0);
    2_f64.powi(-exponent as i32)
}

/// A vector scaled, without rounding, so that its products neither overflow nor vanish.
fn near_one(v: DVec3) -> DVec3 {
    let longest = v.abs().max_element();
    if longest > 0.0 {
        v * power_to_one(longest)
    } else {
        v
    }
}

/// The cross product with each component right to its last bits, even of vectors that are almost
/// parallel: the direction of the result does not suffer from cancellation.
fn exact_cross(a: DVec3, b: DVec3) -> DVec3 {
    // Kahan's difference of two products.
    let difference = |p: f64, q: f64, r: f64, s: f64| {
        let subtracted = r * s;
        let lost = r.mul_add(-s, subtracted);
        p.mul_add(q, -subtracted) + lost
    };
    DVec3::new(
        difference(a.y, b.z, a.z, b.y),
        difference(a.z, b.x, a.x, b.z),
        difference(a.x, b.y, a.y, b.x),
    )
}
