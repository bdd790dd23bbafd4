//! [`Search`], a place and what is asked there.

use std::fmt::Write;

use fastrand::Rng;

use super::data_set::DataSet;
use crate::sql_types::{Box3d, Point3d};

/// Half the width of a sector, degrees.
const HALF_ANGLE: f64 = 30.0;

/// Sides of the polygon that stands for the arc of a sector: at 500 m it is 0.07 m outside.
const SIDES: u32 = 32;

/// Height of eyes, metres.
const EYE: f64 = 1.75;

/// A place and what is asked there.
#[derive(Clone, Debug)]
pub struct Search {
    /// What overlaps this box?
    pub bounds: Box3d,
    /// What holds this point, and what is near to it?
    pub point: Point3d,
    /// What is seen from here?
    pub eye: Point3d,
    /// Where the eye looks, degrees clockwise from +y.
    pub heading: f64,
    /// How far it sees, metres.
    pub range: f64,
}

/// Different searches where there are boxes.
pub fn searches(data: &DataSet, count: usize, seed: u64) -> Vec<Search> {
    let mut rng = Rng::with_seed(seed);
    let mut search = || {
        let [x, y, z] = data.place(&mut rng);
        let half = data.reach / 2.0;
        Search {
            bounds: Box3d {
                min: [x - half, y - half, z - half],
                max: [x + half, y + half, z + half],
            },
            point: Point3d([x, y, z]),
            eye: Point3d([x, y, EYE]),
            heading: 360.0 * rng.f64(),
            range: data.range,
        }
    };
    (0..count).map(|_| search()).collect()
}

impl Search {
    /// A closed ring around the sector in plan, as tight as its sides allow.
    pub fn outline(&self) -> Vec<[f64; 2]> {
        let Point3d([x, y, _]) = self.eye;
        let step = 2.0 * HALF_ANGLE / f64::from(SIDES);
        let radius = self.range / (step / 2.0).to_radians().cos();
        let on_arc = |i: u32| {
            let (east, north) = (self.heading - HALF_ANGLE + f64::from(i) * step)
                .to_radians()
                .sin_cos();
            [x + radius * east, y + radius * north]
        };
        let arc = (0..=SIDES).map(on_arc);
        [[x, y]].into_iter().chain(arc).chain([[x, y]]).collect()
    }

    /// The box around the sector, whose ring is given.
    pub fn around(&self, outline: &[[f64; 2]]) -> Box3d {
        let Point3d([.., z]) = self.eye;
        let bound = |axis: usize, better: fn(f64, f64) -> f64| {
            outline
                .iter()
                .map(|corner| corner[axis])
                .reduce(better)
                .unwrap_or_default()
        };
        Box3d {
            min: [bound(0, f64::min), bound(1, f64::min), z - self.range],
            max: [bound(0, f64::max), bound(1, f64::max), z + self.range],
        }
    }
}

/// A ring as the text of a polygon.
pub fn well_known_text(ring: &[[f64; 2]]) -> String {
    let mut text = String::from("POLYGON((");
    for (i, [x, y]) in ring.iter().enumerate() {
        let comma = if i == 0 { "" } else { "," };
        // Writing to a string does not fail.
        let _ = write!(text, "{comma}{x} {y}");
    }
    text + "))"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn north_east() -> Search {
        Search {
            bounds: Box3d {
                min: [0.0; 3],
                max: [1.0; 3],
            },
            point: Point3d([0.0; 3]),
            eye: Point3d([1000.0, 2000.0, 2.0]),
            heading: 30.0,
            range: 500.0,
        }
    }

    #[test]
    fn the_outline_holds_the_sector_and_little_more() {
        let outline = north_east().outline();
        assert_eq!(outline.first(), outline.last());
        for ring in outline[1..outline.len() - 1].windows(2) {
            let middle = [0, 1].map(|axis| (ring[0][axis] + ring[1][axis]) / 2.0);
            let near = (middle[0] - 1000.0).hypot(middle[1] - 2000.0);
            let far = (ring[0][0] - 1000.0).hypot(ring[0][1] - 2000.0);
            assert!(near > 500.0 - 1e-9 && far < 500.1, "{near} {far}");
        }
    }

    #[test]
    fn the_box_around_a_sector_is_that_of_its_outline() {
        let search = north_east();
        let around = search.around(&search.outline());
        assert_eq!(around.min, [1000.0, 2000.0, -498.0]);
        assert!((around.max[1] - 2500.0).abs() < 0.1 && around.max[2] == 502.0);
        let side = 1000.0 + 500.0 * 60_f64.to_radians().sin();
        assert!((around.max[0] - side).abs() < 0.1, "{around:?}");
    }

    #[test]
    fn rings_become_text() {
        let text = well_known_text(&[[0.5, -1.0], [2.0, 3.0], [0.5, -1.0]]);
        assert_eq!(text, "POLYGON((0.5 -1,2 3,0.5 -1))");
    }
}
