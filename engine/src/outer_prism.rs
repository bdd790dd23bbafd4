//! [`OuterPrism`], the tighter second test for being hidden.

use glam::{DVec2, DVec3};

use crate::predicates::turn;

/// The convex hull of a feature's footprint over the feature's height range: holds all of it.
#[derive(Clone, Debug, PartialEq)]
pub struct OuterPrism {
    /// Corners of the hull, anticlockwise, the first not repeated; each is the place of an input
    /// point bit for bit, and none is on the line between its neighbours. Two corners where all
    /// points are on one line in plan, one where they share their place.
    pub hull: Vec<DVec2>,
    /// Lowest height, metres.
    pub bottom: f64,
    /// Greatest height, metres.
    pub top: f64,
}

impl OuterPrism {
    /// The prism around the points; `None` when there are none or one is not finite.
    ///
    /// Andrew, "Another efficient algorithm for convex hulls in two dimensions", Information
    /// Processing Letters 9(5), 1979, with exact turns.
    #[must_use]
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Option<Self> {
        let (mut bottom, mut top) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut places = Vec::new();
        for point in points {
            if !point.is_finite() {
                return None;
            }
            bottom = bottom.min(point.z);
            top = top.max(point.z);
            places.push(point.truncate());
        }
        if places.is_empty() {
            return None;
        }
        places.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        places.dedup();
        let mut hull = chain(places.iter().copied());
        let above = chain(places.iter().rev().copied());
        // Each chain ends where the other starts.
        hull.pop();
        hull.extend(above);
        if hull.len() > 1 {
            hull.pop();
        }
        Some(Self { hull, bottom, top })
    }
}

/// The convex chain from the first to the last of sorted points, on their right side.
fn chain(places: impl Iterator<Item = DVec2>) -> Vec<DVec2> {
    let mut chain: Vec<DVec2> = Vec::new();
    for place in places {
        while let [.., before, last] = chain[..]
            && turn(before, last, place) <= 0.0
        {
            chain.pop();
        }
        chain.push(place);
    }
    chain
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn prism(points: &[[f64; 3]]) -> OuterPrism {
        OuterPrism::around(points.iter().map(|&p| DVec3::from_array(p))).expect("points")
    }

    #[test]
    fn corners_on_an_edge_and_inside_are_left_out() {
        let square = prism(&[
            [0.0, 0.0, 1.0],
            [2.0, 0.0, 5.0],
            [1.0, 0.0, 0.0],
            [2.0, 2.0, 0.0],
            [0.0, 2.0, 0.0],
            [1.0, 1.0, 9.0],
            [0.0, 0.0, 3.0],
        ]);
        let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(DVec2::from_array);
        assert_eq!(square.hull, corners);
        assert_eq!((square.bottom, square.top), (0.0, 9.0));
    }

    #[test]
    fn points_and_lines_have_hulls_too() {
        assert_eq!(OuterPrism::around([]), None);
        assert_eq!(OuterPrism::around([DVec3::new(0.0, f64::NAN, 0.0)]), None);
        assert_eq!(prism(&[[1.0, 2.0, 3.0]]).hull, [DVec2::new(1.0, 2.0)]);
        assert_eq!(prism(&[[1.0, 2.0, 3.0], [1.0, 2.0, 7.0]]).hull.len(), 1);
        let line = prism(&[[0.0, 0.0, 0.0], [2.0, 2.0, 0.0], [1.0, 1.0, 0.0]]);
        assert_eq!(line.hull, [DVec2::ZERO, DVec2::splat(2.0)]);
    }

    proptest! {
        #[test]
        fn every_point_is_in_the_hull_exactly(
            points in prop::collection::vec(prop::array::uniform3(-500i32..500), 1..60),
            turn_by in 0.0..1.6f64,
        ) {
            let rotation = DVec2::from_angle(turn_by);
            let points: Vec<DVec3> = points
                .iter()
                .map(|p| {
                    let place = rotation.rotate(DVec2::new(f64::from(p[0]), f64::from(p[1])) * 0.1);
                    (place + DVec2::new(85_000.0, 447_000.0)).extend(f64::from(p[2]))
                })
                .collect();
            let prism = OuterPrism::around(points.iter().copied()).expect("points");
            prop_assert!(prism.hull.iter().all(|h| points.iter().any(|p| p.truncate() == *h)));
            let corners = prism.hull.len();
            for i in (0..corners).filter(|_| corners > 2) {
                let (from, to) = (prism.hull[i], prism.hull[(i + 1) % corners]);
                prop_assert!(turn(from, to, prism.hull[(i + 2) % corners]) > 0.0);
                prop_assert!(points.iter().all(|p| turn(from, to, p.truncate()) >= 0.0));
            }
        }
    }
}
