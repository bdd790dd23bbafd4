//! [`ShadowCaster`]: from where one convex prism hides a box, exactly.
//!
//! For a convex occluder A and a point v, `shadow(v, A) = { v + t(a − v) : a ∈ A, t ≥ 1 }` is
//! convex, and A hides all of the box B from p exactly when p is in the shadow of each corner of
//! B (design: docs/how-it-works.md, "The umbra of one occluder"). The shadow of a prism is bounded
//! by the faces that v sees and by planes through v and silhouette edges. Upright edges give
//! tangents in plan. The edges at the top and bottom of a side give, at a given height, lines
//! parallel to that side, so all of them together are one bound along the side's normal.

use crate::convex_polygon::{Side, shrunk, sides};
use crate::{Box3d, ConvexPrism, ShadowRegion};
use glam::{DVec2, DVec3};

/// Metres by which an occluder is shrunk on each side before it casts a shadow, so that touching
/// and grazing never hide. It also covers all rounding here, which stays below ten micrometres.
pub const OCCLUDER_MARGIN: f64 = 1e-3;

/// A solid that hides.
#[derive(Clone, Debug, PartialEq)]
pub struct Occluder {
    /// The feature that it is a part of.
    pub feature: i64,
    /// A prism inside the feature's solid.
    pub prism: ConvexPrism,
}

/// A prism made ready to cast shadows: shrunk by [`OCCLUDER_MARGIN`], endless downwards when it is
/// grounded, and relative to its middle.
#[derive(Clone, Debug)]
pub struct ShadowCaster {
    origin: DVec3,
    sides: Vec<Side>,
    bottom: f64,
    top: f64,
}

impl ShadowCaster {
    /// `None` when nothing is left of the prism after shrinking.
    #[must_use]
    pub fn new(prism: &ConvexPrism) -> Option<Self> {
        let origin = prism.envelope().center();
        let bottom = prism.bottom() - origin.z + OCCLUDER_MARGIN;
        let top = prism.top() - origin.z - OCCLUDER_MARGIN;
        let footprint = prism.footprint().iter().map(|&v| v - origin.truncate());
        let sides = sides(&shrunk(footprint.collect(), OCCLUDER_MARGIN));
        (bottom < top && sides.len() >= 3).then_some(Self {
            origin,
            sides,
            bottom: if prism.grounded() {
                f64::NEG_INFINITY
            } else {
                bottom
            },
            top,
        })
    }

    /// The plan region from all of which, at every height in `band` (metres, low and high), the
    /// prism hides all of `occludee`. `None` when it is empty inside `window`.
    #[must_use]
    pub fn umbra_in_band(
        &self,
        occludee: &Box3d,
        band: [f64; 2],
        window: [DVec2; 2],
    ) -> Option<ShadowRegion> {
        let occludee = Box3d {
            min: occludee.min - self.origin,
            max: occludee.max - self.origin,
        };
        let band = band.map(|z| z - self.origin.z);
        let seen_from_above = occludee.max.z >= self.top;
        let seen_from_below = occludee.min.z <= self.bottom;
        if seen_from_above && band[1] > self.top || seen_from_below && band[0] < self.bottom {
            return None;
        }
        let mut region = ShadowRegion::new(self.origin.truncate(), window);
        for side in &self.sides {
            if let Some(limit) = self.limit(side, &occludee, band) {
                region = region.bounded(side.normal, limit)?;
            }
        }
        // The four corners at the foot stand for all eight in plan.
        for corner in &occludee.corners()[..4] {
            for (normal, offset) in self.tangents(corner.truncate()).into_iter().flatten() {
                region = region.bounded(normal, offset)?;
            }
        }
        Some(region.without_idle())
    }

    /// How far along the normal of `side` the shadow of the whole occludee goes at most, because
    /// of the side's face and the edges at its top and bottom. Seen along the side, the occludee
    /// is a rectangle; its four corners stand for all eight.
    fn limit(&self, side: &Side, occludee: &Box3d, band: [f64; 2]) -> Option<f64> {
        let middle = side.normal.dot(occludee.center().truncate());
        let half = side.normal.abs().dot(occludee.size().truncate()) * 0.5;
        let mut limit = f64::INFINITY;
        for along in [middle - half, middle + half] {
            let seen = along >= side.offset;
            if seen {
                limit = limit.min(side.offset);
            }
            for height in [occludee.min.z, occludee.max.z] {
                for (edge, face_seen) in [
                    (self.top, height >= self.top),
                    (self.bottom, height <= self.bottom),
                ] {
                    // Only the edge between a face that is seen and one that is not is silhouette.
                    if seen == face_seen {
                        continue;
                    }
                    for eye in band {
                        let mut steps = (eye - height) / (edge - height);
                        if face_seen {
                            // Eye and edge are on the same side, also where rounding is in doubt.
                            steps = steps.abs();
                        }
                        limit = limit.min(along + steps * (side.offset - along));
                    }
                }
            }
        }
        limit.is_finite().then_some(limit)
    }

    /// The half-planes `normal · p <= offset` through `v` that touch the footprint and hold it: two
    /// for a point outside, none for a point inside.
    fn tangents(&self, v: DVec2) -> [Option<(DVec2, f64)>; 2] {
        let count = self.sides.len();
        let sees = |i: usize| self.sides[i % count].normal.dot(v) >= self.sides[i % count].offset;
        let half_plane = |normal: DVec2| (normal, normal.dot(v));
        let first = (0..count).find(|&i| !sees(i) && sees(i + 1));
        let last = (0..count).find(|&i| sees(i) && !sees(i + 1));
        let touch = |i: usize| self.sides[(i + 1) % count].corner;
        [
            first.map(|i| half_plane((touch(i) - v).perp())),
            last.map(|i| half_plane((v - touch(i)).perp())),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const WINDOW: [DVec2; 2] = [DVec2::new(-1e3, -1e3), DVec2::new(1e3, 1e3)];

    /// Whether the open segment meets the inside of the prism less `margin`, by clipping.
    fn blocks(prism: &ConvexPrism, margin: f64, p: DVec3, q: DVec3) -> bool {
        let footprint = prism.footprint();
        let upright = (0..footprint.len()).map(|i| {
            let along = footprint[(i + 1) % footprint.len()] - footprint[i];
            let outward = DVec2::new(along.y, -along.x) / along.length();
            (outward.extend(0.0), footprint[i].extend(0.0))
        });
        let level = [
            (DVec3::Z, DVec3::Z * prism.top()),
            (
                -DVec3::Z,
                DVec3::Z
                    * if prism.grounded() {
                        -1e9
                    } else {
                        prism.bottom()
                    },
            ),
        ];
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for (normal, point) in upright.chain(level) {
            let depth = |r: DVec3| normal.dot(point - r) - margin;
            let (a, b) = (depth(p), depth(q));
            if a <= 0.0 && b <= 0.0 {
                return false;
            }
            if a < 0.0 || b < 0.0 {
                let t = a / (a - b);
                if a < 0.0 {
                    enter = enter.max(t)
                } else {
                    leave = leave.min(t)
                }
            }
        }
        enter < leave
    }

    fn hides(prism: &ConvexPrism, margin: f64, eye: DVec3, occludee: &Box3d) -> bool {
        occludee
            .corners()
            .iter()
            .all(|&corner| blocks(prism, margin, eye, corner))
    }

    fn solid_box(reach: i32, least: i32) -> impl Strategy<Value = Box3d> {
        let corner = prop::array::uniform3(-reach..reach);
        let size = prop::array::uniform3(least..20);
        (corner, size).prop_map(|(c, s)| {
            let corner = DVec3::from(c.map(f64::from));
            Box3d::new(corner, corner + DVec3::from(s.map(f64::from)))
        })
    }

    /// Corners on an ellipse, turned: 3 to 12 of them, some close together.
    fn round_prism() -> impl Strategy<Value = ConvexPrism> {
        let corners = prop::collection::btree_set(0..360i32, 3..=ConvexPrism::MOST_VERTICES);
        (corners, solid_box(20, 1), 0..90i32, any::<bool>()).prop_map(
            |(corners, bounds, turned, grounded)| {
                let turned = DVec2::from_angle(f64::from(turned).to_radians());
                let half = bounds.size().truncate() * 0.7;
                let footprint = corners.into_iter().map(|degrees| {
                    let on_circle = DVec2::from_angle(f64::from(degrees).to_radians());
                    bounds.center().truncate() + turned.rotate(on_circle * half)
                });
                let (bottom, top) = (bounds.min.z, bounds.max.z);
                ConvexPrism::new(footprint.collect(), bottom, top, grounded)
                    .expect("an ellipse is convex")
            },
        )
    }

    fn any_prism() -> impl Strategy<Value = ConvexPrism> {
        let boxes = (solid_box(20, 1), any::<bool>());
        prop_oneof![
            boxes.prop_map(|(b, grounded)| ConvexPrism::from_box(&b, grounded).expect("not flat")),
            round_prism(),
        ]
    }

    fn moved(prism: &ConvexPrism, shift: DVec3) -> ConvexPrism {
        let footprint = prism
            .footprint()
            .iter()
            .map(|&v| v + shift.truncate())
            .collect();
        let (bottom, top) = (prism.bottom() + shift.z, prism.top() + shift.z);
        ConvexPrism::new(footprint, bottom, top, prism.grounded()).expect("convex after rounding")
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]
        #[test]
        fn every_corner_of_a_strip_is_in_the_umbra_and_little_is_lost(
            prism in any_prism(),
            occludee in solid_box(40, 0),
            low in -30i32..30,
            height in 0i32..3,
            lane in -60i32..60,
            far in any::<bool>(),
        ) {
            let shift = if far { DVec3::new(85_000.0, 447_000.0, 0.0) } else { DVec3::ZERO };
            let prism = moved(&prism, shift);
            let occludee = Box3d { min: occludee.min + shift, max: occludee.max + shift };
            let band = [f64::from(low), f64::from(low + height)];
            let window = WINDOW.map(|w| w + shift.truncate());
            let region = ShadowCaster::new(&prism)
                .and_then(|caster| caster.umbra_in_band(&occludee, band, window));
            for axis in 0..2 {
                let across = shift[1 - axis] + f64::from(lane) + 0.25;
                let strip = region.as_ref().and_then(|r| r.strip(axis, across, across + 1.5));
                let point = |along: f64, across: f64, z: f64| if axis == 0 {
                    DVec3::new(along, across, z)
                } else {
                    DVec3::new(across, along, z)
                };
                let in_umbra = |along: f64, margin: f64| [across, across + 1.5].iter().all(|&c| {
                    band.iter().all(|&z| hides(&prism, margin, point(along, c, z), &occludee))
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
        let caster = ConvexPrism::from_box(&house, true).and_then(|p| ShadowCaster::new(&p));
        let sign = Box3d::new(DVec3::new(4.0, 0.0, 3.0), DVec3::new(6.0, 0.0, 4.0));
        let region = caster
            .expect("thick")
            .umbra_in_band(&sign, [1.5, 2.0], WINDOW);
        assert!(region.is_none_or(|r| r.strip(0, -50.0, -49.0).is_none()));
    }

    #[test]
    fn shrinking_takes_sides_and_whole_prisms_away() {
        let caster = |footprint: &[[f64; 2]]| {
            let footprint = footprint.iter().map(|&v| DVec2::from(v)).collect();
            ShadowCaster::new(&ConvexPrism::new(footprint, 0.0, 1.0, true).expect("convex"))
        };
        let bevelled = [
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, 4.0],
            [1e-4, 4.0],
            [0.0, 3.9999],
        ];
        assert_eq!(caster(&bevelled).expect("wide").sides.len(), 4);
        assert!(caster(&[[0.0, 0.0], [9.0, 0.0], [9.0, 0.002], [0.0, 0.002]]).is_none());
        let sheet =
            ConvexPrism::from_box(&Box3d::new(DVec3::ZERO, DVec3::new(1.0, 1.0, 0.002)), true);
        assert!(ShadowCaster::new(&sheet.expect("not flat")).is_none());
    }
}
