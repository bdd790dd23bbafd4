//! [`simpler`], polygons with fewer corners that hold nothing more.

use geo::{LineString, Polygon};
use glam::DVec2;

use crate::predicates::turn;

/// A polygon without those corners that stick out by no more than this, metres: all of it lies in the one
/// that is given, whose rings turn with the inside on their left.
///
/// A corner is cut off together with the triangle that it makes with its neighbours, if no other corner of
/// the polygon is in there; then the cut lies inside.
pub fn simpler(polygon: &Polygon, most: f64) -> Polygon {
    let rings = std::iter::once(polygon.exterior()).chain(polygon.interiors());
    let mut rings: Vec<Vec<DVec2>> = rings.map(corners).collect();
    for at in 0..rings.len() {
        let mut corner = 0;
        while corner < rings[at].len() {
            if may_go(&rings, at, corner, most) {
                rings[at].remove(corner);
                // The one before has another neighbour now.
                corner = corner.saturating_sub(1);
            } else {
                corner += 1;
            }
        }
    }
    let mut rings = rings.into_iter().map(|ring| {
        let corners = ring.into_iter().map(|corner| (corner.x, corner.y));
        corners.collect::<LineString>()
    });
    let exterior = rings.next().unwrap_or_else(|| LineString::new(Vec::new()));
    Polygon::new(exterior, rings.collect())
}

/// The corners of a closed ring, the first not repeated.
fn corners(ring: &LineString) -> Vec<DVec2> {
    let corners = ring.coords().map(|corner| DVec2::new(corner.x, corner.y));
    corners.skip(1).collect()
}

/// Whether a corner of a ring may be cut off.
fn may_go(rings: &[Vec<DVec2>], ring: usize, corner: usize, most: f64) -> bool {
    let corners = &rings[ring];
    let count = corners.len();
    let [before, here, after] = [count - 1, 0, 1].map(|step| corners[(corner + step) % count]);
    // Twice the area of the triangle.
    let area = turn(before, here, after);
    if count <= 3 || area < 0.0 || area > most * before.distance(after) {
        return false;
    }
    let is_in_the_way = |&&other: &&DVec2| {
        turn(before, here, other) >= 0.0
            && turn(here, after, other) >= 0.0
            && turn(after, before, other) >= 0.0
            && other != before
            && other != after
    };
    // The corner itself, and no other, not even at the same place.
    rings.iter().flatten().filter(is_in_the_way).count() == 1
}

#[cfg(test)]
mod tests {
    use geo::orient::Direction;
    use geo::{Area, BooleanOps, Orient, Relate, polygon};
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn corners_that_stick_out_a_little_are_cut_off() {
        let jagged = polygon![
            (x: 0.0, y: 0.0), (x: 5.0, y: -0.05), (x: 10.0, y: 0.0), (x: 10.0, y: 10.0), (x: 5.0, y: 9.9),
            (x: 0.0, y: 10.0),
        ];
        let cut = simpler(&jagged, 0.1);
        let expected = polygon![
            (x: 0.0, y: 0.0), (x: 10.0, y: 0.0), (x: 10.0, y: 10.0), (x: 5.0, y: 9.9), (x: 0.0, y: 10.0),
        ];
        let same = |a: &Polygon, b: &Polygon| {
            a.exterior().0.len() == b.exterior().0.len() && a.relate(b).is_equal_topo()
        };
        assert!(same(&cut, &expected), "{cut:?}");
        assert!(same(&simpler(&jagged, 0.01), &jagged));
    }

    #[test]
    fn a_cut_goes_through_no_hole_and_leaves_a_triangle() {
        let hole = LineString::from(vec![(4.9, 0.02), (5.0, 0.06), (5.1, 0.02)]);
        let peak = LineString::from(vec![(0.0, 0.0), (10.0, 0.0), (5.0, 0.1)]);
        let pierced = Polygon::new(peak.clone(), vec![hole.clone()]);
        assert!(simpler(&pierced, 1.0).relate(&pierced).is_equal_topo());
        let shallow =
            polygon![(x: 0.0, y: 0.0), (x: 10.0, y: 0.0), (x: 10.0, y: 0.04), (x: 0.0, y: 0.04)];
        assert_eq!(simpler(&shallow, 1.0).exterior().0.len(), 4);
    }

    proptest! {
        #[test]
        fn all_of_it_lies_in_the_one_before(
            lengths in prop::collection::vec(4.0..6.0_f64, 3..40), most in 0.0..1.0_f64, is_far in any::<bool>(),
        ) {
            let place = if is_far { (85_000.0, 447_000.0) } else { (0.0, 0.0) };
            let ring = |scale: f64| {
                let corner = |(at, length): (usize, &f64)| {
                    let angle = at as f64 / lengths.len() as f64 * std::f64::consts::TAU;
                    (place.0 + scale * length * angle.cos(), place.1 + scale * length * angle.sin())
                };
                lengths.iter().enumerate().map(corner).collect::<LineString>()
            };
            let star = Polygon::new(ring(1.0), vec![ring(0.5)]).orient(Direction::Default);
            let cut = simpler(&star, most);
            prop_assert!(cut.difference(&star).unsigned_area() < 1e-5);
            prop_assert!(cut.unsigned_area() < star.unsigned_area() + 1e-5);
        }
    }
}
