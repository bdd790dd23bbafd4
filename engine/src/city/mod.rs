//! Cities made from a seed, for tests and benchmarks.
//!
//! The same seed gives the same city on every machine, bit for bit: random numbers are whole, plan
//! coordinates lie on a lattice, and of floating-point arithmetic only what IEEE 754 rounds
//! correctly (`+ - * /` and the square root) is used, never sines or logarithms.

mod blocks;
mod cell;
mod feature;
mod generated;
mod hilbert;
mod inner_box;
mod lattice;
mod paving;
mod perimeter;
mod random;
mod rows;
mod scattered;
mod solid;
mod streets;
mod strip;

pub use feature::CityFeature;
pub use generated::{City, CityLayout, generated_city};
pub use scattered::{BoxCity, scattered_city};

use crate::Street;
use geo::Polygon;

/// Eye heights above the ground, metres.
const EYES: [f64; 2] = [1.5, 2.0];

/// A piece of level ground at height 0 from which observers look.
fn street(area: Polygon<f64>) -> Street {
    Street {
        area,
        eye_low: EYES[0],
        eye_high: EYES[1],
    }
}
