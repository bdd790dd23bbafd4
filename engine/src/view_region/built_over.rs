//! [`without_footprints`], streets less what is built on them.

use geo::{BooleanOps, BoundingRect, MultiPolygon, Polygon, unary_union};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::street::Street;
use super::tiling::without_slivers;

/// The streets without the part that lies inside one of the footprints: a road model often runs
/// through the buildings above it, and nobody stands there.
///
/// Rings turn as they do in all streets, and slivers are dropped; a street that no footprint
/// touches stays as it is.
#[must_use]
pub fn without_footprints(streets: Vec<Street>, footprints: &[MultiPolygon<f64>]) -> Vec<Street> {
    let entries = footprints.iter().flatten().filter_map(|footprint| {
        let rect = footprint.bounding_rect()?;
        let corners =
            Rectangle::from_corners([rect.min().x, rect.min().y], [rect.max().x, rect.max().y]);
        Some(GeomWithData::new(corners, footprint))
    });
    let tree = RTree::bulk_load(entries.collect());
    streets
        .into_iter()
        .flat_map(|street| cut(street, &tree))
        .collect()
}

type Footprints<'a> = RTree<GeomWithData<Rectangle<[f64; 2]>, &'a Polygon<f64>>>;

/// The pieces of one street.
fn cut(street: Street, footprints: &Footprints) -> Vec<Street> {
    let Some(rect) = street.area.bounding_rect() else {
        return Vec::new();
    };
    let window = AABB::from_corners([rect.min().x, rect.min().y], [rect.max().x, rect.max().y]);
    let near: Vec<&Polygon<f64>> = footprints
        .locate_in_envelope_intersecting(window)
        .map(|entry| entry.data)
        .collect();
    if near.is_empty() {
        return vec![street];
    }
    let rest = street.area.difference(&unary_union(near));
    let piece = |area| Street { area, ..street };
    rest.into_iter()
        .filter_map(without_slivers)
        .map(piece)
        .collect()
}

#[cfg(test)]
mod tests {
    use geo::{Area, Rect};

    use super::*;

    fn square(x: f64, y: f64, size: f64) -> Polygon<f64> {
        let corner = |d: f64| (85_000.0 + x + d, 447_000.0 + y + d);
        Rect::new(corner(0.0), corner(size)).to_polygon()
    }

    fn street(area: Polygon<f64>) -> Street {
        Street {
            area,
            eye_low: 1.5,
            eye_high: 2.0,
        }
    }

    fn area(streets: &[Street]) -> f64 {
        streets.iter().map(|s| s.area.unsigned_area()).sum()
    }

    #[test]
    fn what_is_built_over_is_cut_out() {
        let streets = vec![
            street(square(0.0, 0.0, 10.0)),
            street(square(100.0, 0.0, 10.0)),
        ];
        let corner = MultiPolygon::new(vec![square(8.0, 8.0, 20.0), square(-5.0, -5.0, 6.0)]);
        let inside: MultiPolygon<f64> = square(4.0, 4.0, 2.0).into();
        let left = without_footprints(streets.clone(), &[corner, inside]);
        assert_eq!(left.len(), 2);
        assert!((area(&left) - (200.0 - 4.0 - 1.0 - 4.0)).abs() < 1e-4);
        assert_eq!(left[0].area.interiors().len(), 1);
        assert_eq!(left[1], streets[1]);
    }

    #[test]
    fn streets_may_fall_apart_or_vanish() {
        let streets = vec![street(square(0.0, 0.0, 10.0))];
        let wall = Rect::new((85_004.0, 446_990.0), (85_006.0, 447_020.0)).to_polygon();
        let halves = without_footprints(streets.clone(), &[wall.into()]);
        assert_eq!(halves.len(), 2);
        assert!((area(&halves) - 80.0).abs() < 1e-4);
        assert!(without_footprints(streets, &[square(-1.0, -1.0, 12.0).into()]).is_empty());
    }
}
