//! [`umbra_in_band`]: from where one box hides another, exactly.
//!
//! For a convex occluder A and a point v, `shadow(v, A) = { v + t(a − v) : a ∈ A, t ≥ 1 }` is
//! convex, and A hides all of the box B from p exactly when p is in the shadow of each corner of
//! B (design: docs/how-it-works.md, "The umbra of one occluder"). The shadow of a box is bounded
//! by the faces that v sees and by planes through v and silhouette edges. Silhouette edges run
//! along an axis, so each such plane is a tangent line in the projection along that axis: in
//! plan a line, and in the two vertical projections, at a given height, a bound on x or y.

use crate::{Box3d, ShadowRegion};
use glam::{DVec2, DVec3};

/// Metres by which an occluder is shrunk on each side before it casts a shadow, so that touching
/// and grazing never hide. It also covers all rounding here, which stays below a micrometre.
pub const OCCLUDER_MARGIN: f64 = 1e-3;

/// A box that hides: the largest one known to be wholly solid inside a feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occluder {
    /// The feature it belongs to.
    pub feature: i64,
    /// The solid box, metres.
    pub bounds: Box3d,
    /// Whether the ground under the box is solid down to any depth.
    pub grounded: bool,
}

/// The plan region from all of which, at every height in `band` (metres, low and high), `occluder`
/// hides all of `occludee`: a convex polygon kept as half-planes. `None` when it is known to be
/// empty inside `window`.
#[must_use]
pub fn umbra_in_band(
    occluder: &Occluder,
    occludee: &Box3d,
    band: [f64; 2],
    window: [DVec2; 2],
) -> Option<ShadowRegion> {
    let mut solid = occluder.bounds.expanded(-OCCLUDER_MARGIN)?;
    let origin = solid.center();
    solid = Box3d {
        min: solid.min - origin,
        max: solid.max - origin,
    };
    if occluder.grounded {
        solid.min.z = f64::NEG_INFINITY;
    }
    let mut region = ShadowRegion::new(origin.truncate(), window);
    let band = band.map(|z| z - origin.z);
    for corner in occludee.corners() {
        bound_by_faces(&mut region, corner - origin, &solid, band)?;
    }
    for corner in occludee.corners() {
        bound_by_profile(&mut region, 0, corner - origin, &solid, band)?;
        bound_by_profile(&mut region, 1, corner - origin, &solid, band)?;
    }
    // The four corners at the foot stand for all eight in plan.
    for corner in &occludee.corners()[..4] {
        bound_in_plan(&mut region, (*corner - origin).truncate(), &solid);
    }
    region.is_possible().then_some(region)
}

/// Bounds the region by the faces of `solid` that the corner sees: the shadow is behind them.
fn bound_by_faces(
    region: &mut ShadowRegion,
    corner: DVec3,
    solid: &Box3d,
    band: [f64; 2],
) -> Option<()> {
    if corner.z >= solid.max.z && band[1] > solid.max.z
        || corner.z <= solid.min.z && band[0] < solid.min.z
    {
        return None;
    }
    for axis in 0..2 {
        if corner[axis] >= solid.max[axis] {
            region.bound_above(axis, solid.max[axis]);
        }
        if corner[axis] <= solid.min[axis] {
            region.bound_below(axis, solid.min[axis]);
        }
    }
    region.is_possible().then_some(())
}

/// Bounds the region by the tangents of the projection onto (`axis`, z), at both ends of the band.
fn bound_by_profile(
    region: &mut ShadowRegion,
    axis: usize,
    corner: DVec3,
    solid: &Box3d,
    band: [f64; 2],
) -> Option<()> {
    let profile = |p: DVec3| DVec2::new(p[axis], p.z);
    for (normal, offset) in tangents(profile(corner), profile(solid.min), profile(solid.max)) {
        for height in band {
            let rest = offset - normal.y * height;
            if normal.x > 0.0 {
                region.bound_above(axis, rest / normal.x);
            } else if normal.x < 0.0 {
                region.bound_below(axis, rest / normal.x);
            } else if rest < 0.0 {
                return None;
            }
        }
    }
    region.is_possible().then_some(())
}

/// Bounds the region by the tangents in plan.
fn bound_in_plan(region: &mut ShadowRegion, corner: DVec2, solid: &Box3d) {
    for (normal, offset) in tangents(corner, solid.min.truncate(), solid.max.truncate()) {
        region.bound(normal, offset);
    }
}

/// The half-planes `normal · p <= offset` through `v` that touch the rectangle and hold it: two
/// for a point outside, none for a point inside. A tangent at a corner at infinity adds nothing
/// to the faces and is left out.
fn tangents(v: DVec2, min: DVec2, max: DVec2) -> impl Iterator<Item = (DVec2, f64)> {
    // Per axis: the side of the rectangle nearest to v and the one across, when v is beyond it.
    let beyond = |i: usize| {
        if v[i] >= max[i] {
            Some((max[i], min[i]))
        } else if v[i] <= min[i] {
            Some((min[i], max[i]))
        } else {
            None
        }
    };
    let touched = match (beyond(0), beyond(1)) {
        (None, None) => [None, None],
        (Some((near, _)), None) => [min.y, max.y].map(|y| Some(DVec2::new(near, y))),
        (None, Some((near, _))) => [min.x, max.x].map(|x| Some(DVec2::new(x, near))),
        (Some((near_x, far_x)), Some((near_y, far_y))) => [
            Some(DVec2::new(near_x, far_y)),
            Some(DVec2::new(far_x, near_y)),
        ],
    };
    // A finite point well inside, to tell the two sides apart.
    let inside = DVec2::new(
        (min.x + max.x) * 0.5,
        max.y - ((max.y - min.y) * 0.5).min(1.0),
    );
    touched
        .into_iter()
        .flatten()
        .filter(|touch| touch.is_finite())
        .map(move |touch| {
            let normal = (touch - v).perp();
            let normal = if normal.dot(inside - touch) > 0.0 {
                -normal
            } else {
                normal
            };
            (normal, normal.dot(v))
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const WINDOW: [DVec2; 2] = [DVec2::new(-1e3, -1e3), DVec2::new(1e3, 1e3)];

    /// Whether the open segment meets the open box, by clipping.
    fn blocks(solid: &Box3d, p: DVec3, q: DVec3) -> bool {
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for axis in 0..3 {
            let run = q[axis] - p[axis];
            let (low, high) = (solid.min[axis] - p[axis], solid.max[axis] - p[axis]);
            if run == 0.0 {
                if low >= 0.0 || high <= 0.0 {
                    return false;
                }
            } else {
                let (a, b) = (low / run, high / run);
                enter = enter.max(a.min(b));
                leave = leave.min(a.max(b));
            }
        }
        enter < leave
    }

    fn hides(occluder: &Occluder, eye: DVec3, occludee: &Box3d, margin: f64) -> bool {
        let Some(mut solid) = occluder.bounds.expanded(-margin) else {
            return false;
        };
        if occluder.grounded {
            solid.min.z = -1e9;
        }
        occludee
            .corners()
            .iter()
            .all(|&corner| blocks(&solid, eye, corner))
    }

    fn solid_box(reach: i32, least: i32) -> impl Strategy<Value = Box3d> {
        let corner = prop::array::uniform3(-reach..reach);
        let size = prop::array::uniform3(least..20);
        (corner, size).prop_map(|(c, s)| {
            let corner = DVec3::from(c.map(f64::from));
            Box3d::new(corner, corner + DVec3::from(s.map(f64::from)))
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]
        #[test]
        fn every_corner_of_a_strip_is_in_the_umbra_and_little_is_lost(
            bounds in solid_box(20, 1),
            occludee in solid_box(40, 0),
            grounded in any::<bool>(),
            low in -30i32..30,
            height in 0i32..3,
            lane in -60i32..60,
            far in any::<bool>(),
        ) {
            let shift = if far { DVec3::new(85_000.0, 447_000.0, 0.0) } else { DVec3::ZERO };
            let moved = |b: Box3d| Box3d { min: b.min + shift, max: b.max + shift };
            let occluder = Occluder { feature: 1, bounds: moved(bounds), grounded };
            let occludee = moved(occludee);
            let band = [f64::from(low), f64::from(low + height)];
            let window = WINDOW.map(|w| w + shift.truncate());
            let region = umbra_in_band(&occluder, &occludee, band, window);
            for axis in 0..2 {
                let across = shift[1 - axis] + f64::from(lane) + 0.25;
                let strip = region.as_ref().and_then(|r| r.strip(axis, across, across + 1.5));
                let point = |along: f64, across: f64, z: f64| if axis == 0 {
                    DVec3::new(along, across, z)
                } else {
                    DVec3::new(across, along, z)
                };
                let in_umbra = |along: f64, margin: f64| [across, across + 1.5].iter().all(|&c| {
                    band.iter().all(|&z| hides(&occluder, point(along, c, z), &occludee, margin))
                });
                if let Some([start, end]) = strip {
                    prop_assert!(in_umbra(start, 0.0) && in_umbra(end, 0.0));
                }
                // Converse: what a clearly smaller occluder hides, the strip holds.
                for i in -40..40 {
                    let along = shift[axis] + f64::from(i) * 2.5 + 0.125;
                    if in_umbra(along, 0.002) {
                        let held = strip.is_some_and(|[a, b]| a <= along && along <= b);
                        prop_assert!(held, "{along} {strip:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_house_does_not_hide_a_sign_on_its_front() {
        let house = Box3d::new(DVec3::ZERO, DVec3::new(10.0, 10.0, 10.0));
        let occluder = Occluder {
            feature: 1,
            bounds: house,
            grounded: true,
        };
        let sign = Box3d::new(DVec3::new(4.0, 0.0, 3.0), DVec3::new(6.0, 0.0, 4.0));
        let region = umbra_in_band(&occluder, &sign, [1.5, 2.0], WINDOW);
        let strip = region.and_then(|r| r.strip(0, -50.0, -49.0));
        assert_eq!(strip, None);
    }
}
