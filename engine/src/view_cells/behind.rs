//! What can be seen through the place of something else: [`may_be_behind`], and in which directions, [`widened`].

use glam::{DVec2, DVec3};

use crate::Box3d;

/// By how much what is looked through is made larger, metres, and as a part of the distances: more than the
/// roundings of what is computed here.
const MARGIN: f64 = 1e-3;
const SHARE: f64 = 1e-9;

/// Whether a line from an eye in `cell` to a point of `target` may pass over or under a point of `place`, or through
/// it; heights do not matter. If in doubt, it may.
///
/// All these lines lie over the convex hull of the plans of both. Two convex polygons are apart if they are so along
/// the normal of an edge of one of them. The edges of the hull are parallel to the axes, or lead from a corner of one box
/// to the same corner of the other.
pub fn may_be_behind(cell: &Box3d, place: &Box3d, target: &Box3d) -> bool {
    let origin = cell.center().truncate();
    let [cell, place, target] = [cell, place, target].map(|bounds| corners(bounds, origin));
    let all = || cell.iter().chain(&target);
    let joins = (0..4).map(|at| (target[at] - cell[at]).perp());
    [DVec2::X, DVec2::Y].into_iter().chain(joins).all(|axis| {
        let along = |corner: &DVec2| corner.dot(axis);
        let reach = all().chain(&place).map(|corner| corner.abs().max_element());
        let margin = axis.abs().element_sum() * (MARGIN + SHARE * reach.fold(0.0, f64::max));
        let [low, high] = range(all().map(along));
        let [from, to] = range(place.iter().map(along));
        low <= to + margin && from <= high + margin
    })
}

/// Boxes through which all lines pass from the middle of a cell of this half edge, metres, to a point that some eye of the
/// cell sees through one of `places`; `None` where a box has no bounds.
///
/// Of an eye at `d` from the middle, let `x` be a point of its line to `b` in a place. Where the line from the middle to
/// `b` has gone as large a part of its way, it is no farther from `x` than `d` on both axes.
pub fn widened(places: &[Box3d], middle: DVec3, half: f64) -> Option<Vec<Box3d>> {
    let widened = |place: &Box3d| {
        let corners = [place.min - middle, place.max - middle];
        let reach = corners.map(|corner| corner.truncate().abs().max_element());
        place.expanded(half + MARGIN + SHARE * reach[0].max(reach[1]))
    };
    places.iter().map(widened).collect()
}

fn corners(bounds: &Box3d, origin: DVec2) -> [DVec2; 4] {
    let [low, high] = [bounds.min, bounds.max].map(|corner| corner.truncate() - origin);
    [
        low,
        DVec2::new(high.x, low.y),
        high,
        DVec2::new(low.x, high.y),
    ]
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn bounds(x: f64, y: f64, width: f64, depth: f64) -> Box3d {
        Box3d::new(DVec3::new(x, y, 0.0), DVec3::new(x + width, y + depth, 3.0))
    }

    fn any_bounds() -> impl Strategy<Value = Box3d> {
        let size = prop_oneof![Just(0.0), 0.0..20.0];
        (-50.0..50.0, -50.0..50.0, size.clone(), size)
            .prop_map(|(x, y, width, depth)| bounds(85_000.0 + x, 447_000.0 + y, width, depth))
    }

    #[test]
    fn what_is_beside_is_not_behind() {
        let (cell, target) = (bounds(0.0, 0.0, 4.0, 4.0), bounds(100.0, 0.0, 4.0, 4.0));
        assert!(may_be_behind(&cell, &bounds(50.0, 3.9, 1.0, 9.0), &target));
        assert!(!may_be_behind(&cell, &bounds(50.0, 4.1, 1.0, 9.0), &target));
        assert!(!may_be_behind(
            &cell,
            &bounds(104.1, 0.0, 1.0, 4.0),
            &target
        ));
        // Beside a slanting line, though within the box around both ends.
        let target = bounds(100.0, 100.0, 4.0, 4.0);
        assert!(may_be_behind(&cell, &bounds(50.0, 50.0, 1.0, 1.0), &target));
        assert!(!may_be_behind(
            &cell,
            &bounds(80.0, 20.0, 9.0, 9.0),
            &target
        ));
    }

    proptest! {
        #[test]
        fn a_line_through_a_place_leads_behind_it(
            cell in any_bounds(),
            place in any_bounds(),
            shares in prop::array::uniform4(0.0..=1.0_f64),
            beyond in 0.0..5.0_f64,
            width in 0.0..9.0_f64,
        ) {
            let point = |bounds: &Box3d, x: f64, y: f64| {
                bounds.min.truncate() + DVec2::new(x, y) * bounds.size().truncate()
            };
            let eye = point(&cell, shares[0], shares[1]);
            let through = point(&place, shares[2], shares[3]);
            let seen = through + (through - eye) * beyond;
            let target = bounds(seen.x - shares[3] * width, seen.y - shares[0] * width, width, width);
            prop_assert!(may_be_behind(&cell, &place, &target));
        }
    }
}
