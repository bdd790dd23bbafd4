//! [`LocalGround`], whether a feature stands on the ground or above it.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::Box3d;

/// Features this near to each other share their ground, metres.
const NEARBY: f64 = 50.0;

/// With no other feature nearby, so many of the nearest ones tell the ground.
const NEAREST: usize = 4;

/// A foot this far above the ground nearby is off the ground, metres: more than plinths and steps
/// raise a house, less than the head room under a skywalk.
const HIGHEST_FOOT: f64 = 1.0;

/// The ground as the feet of the features around a place tell it.
#[derive(Clone, Debug)]
pub struct LocalGround {
    feet: RTree<GeomWithData<Rectangle<[f64; 2]>, f64>>,
}

impl LocalGround {
    /// From the outer envelopes of all features of a scene; those that are not finite tell nothing.
    #[must_use]
    pub fn new(envelopes: &[Box3d]) -> Self {
        let finite = envelopes
            .iter()
            .filter(|bounds| bounds.min.is_finite() && bounds.max.is_finite());
        let feet = finite.map(|bounds| {
            let (min, max) = corners(bounds);
            GeomWithData::new(Rectangle::from_corners(min, max), bounds.min.z)
        });
        Self {
            feet: RTree::bulk_load(feet.collect()),
        }
    }

    /// Whether a foot at this height within `envelope` stands on the ground: it is at most a metre
    /// above the median foot of the features within 50 m, the feature itself among them. Where it
    /// would be alone, the nearest few are asked, and a feature that is alone in its scene stands.
    ///
    /// Of two middle feet the lower one counts, so that a skywalk beside a single house is off the
    /// ground.
    #[must_use]
    pub fn holds(&self, envelope: &Box3d, foot: f64) -> bool {
        let (min, max) = corners(envelope);
        let window = AABB::from_corners(min.map(|c| c - NEARBY), max.map(|c| c + NEARBY));
        let mut feet: Vec<f64> = self
            .feet
            .locate_in_envelope_intersecting(window)
            .map(|entry| entry.data)
            .collect();
        if feet.len() < 2 {
            let center = envelope.center();
            let nearest = self.feet.nearest_neighbor_iter([center.x, center.y]);
            feet = nearest.take(NEAREST).map(|entry| entry.data).collect();
        }
        feet.sort_unstable_by(f64::total_cmp);
        let median = feet.get(feet.len().saturating_sub(1) / 2);
        median.is_none_or(|ground| foot - ground <= HIGHEST_FOOT)
    }
}

fn corners(bounds: &Box3d) -> ([f64; 2], [f64; 2]) {
    (
        bounds.min.truncate().to_array(),
        bounds.max.truncate().to_array(),
    )
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// A house of 10 m a side with its foot at `z`.
    fn house(x: f64, z: f64) -> Box3d {
        let min = DVec3::new(85_000.0 + x, 447_000.0, z);
        Box3d {
            min,
            max: min + 10.0,
        }
    }

    fn stand(houses: &[Box3d]) -> Vec<bool> {
        let ground = LocalGround::new(houses);
        houses
            .iter()
            .map(|house| ground.holds(house, house.min.z))
            .collect()
    }

    #[test]
    fn skywalks_are_off_the_ground() {
        assert_eq!(stand(&[house(0.0, 0.0), house(20.0, 6.0)]), [true, false]);
        let row = [
            house(0.0, 0.3),
            house(10.0, 4.5),
            house(20.0, -0.2),
            house(30.0, 0.9),
        ];
        assert_eq!(stand(&row), [true, false, true, true]);
    }

    #[test]
    fn hills_carry_what_stands_on_them() {
        let slope: Vec<Box3d> = (0..20)
            .map(|i| house(60.0 * f64::from(i), 0.5 * f64::from(i)))
            .collect();
        assert!(stand(&slope).iter().all(|&stands| stands));
    }

    #[test]
    fn lonely_features_look_far() {
        let far = [
            house(0.0, 0.0),
            house(500.0, 9.0),
            house(900.0, 0.2),
            house(1400.0, 0.1),
        ];
        assert_eq!(stand(&far), [true, false, true, true]);
        assert_eq!(stand(&far[1..2]), [true]);
        let nowhere = Box3d {
            min: DVec3::NAN,
            max: DVec3::NAN,
        };
        assert!(LocalGround::new(&[nowhere]).holds(&house(0.0, 3.0), 3.0));
    }
}
