//! Positions as steps of whole millimetres, exact to the last bit.

use serde::{Deserialize, Serialize};

use super::container::malformed;
use crate::error::Problem;

/// The step, metres: what published models are rounded to. Other coordinates cost more bytes.
const STEP: f64 = 0.001;

/// Positions, a column an axis.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(super) struct Coordinates {
    axes: [Axis; 3],
}

/// One coordinate of all positions.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Axis {
    /// Where steps are counted from, as bits.
    origin: f64,
    /// Steps from each coordinate to the next.
    steps: Vec<i64>,
    /// How far the bits of each coordinate are from those that the steps lead to. Most are zero or
    /// one, since the source computed in steps too, from another origin.
    corrections: Vec<i64>,
}

impl Coordinates {
    /// Positions in columns.
    pub(super) fn of(positions: &[[f64; 3]]) -> Self {
        let axis = |i: usize| Axis::of(positions.iter().map(|position| position[i]));
        Self {
            axes: [axis(0), axis(1), axis(2)],
        }
    }

    /// The positions.
    pub(super) fn positions(&self) -> Result<Vec<[f64; 3]>, Problem> {
        let [x, y, z] = &self.axes;
        let lengths = self
            .axes
            .iter()
            .flat_map(|axis| [axis.steps.len(), axis.corrections.len()]);
        if !lengths.into_iter().all(|length| length == x.steps.len()) {
            return Err(malformed("columns of coordinates differ in length"));
        }
        let xy = x.coordinates().zip(y.coordinates());
        Ok(xy
            .zip(z.coordinates())
            .map(|((x, y), z)| [x, y, z])
            .collect())
    }
}

impl Axis {
    fn of(coordinates: impl Iterator<Item = f64> + Clone) -> Self {
        let origin = coordinates.clone().next().filter(|first| first.is_finite());
        let mut axis = Self {
            origin: origin.unwrap_or(0.0),
            ..Self::default()
        };
        let mut before = 0;
        for coordinate in coordinates {
            // Saturates where a coordinate is absurd; the correction makes up for it.
            let steps = ((coordinate - axis.origin) / STEP).round() as i64;
            axis.steps.push(steps.wrapping_sub(before));
            let bits = coordinate.to_bits();
            axis.corrections
                .push(bits.wrapping_sub(axis.predicted_bits(steps)) as i64);
            before = steps;
        }
        axis
    }

    fn coordinates(&self) -> impl Iterator<Item = f64> {
        let mut steps = 0_i64;
        self.steps
            .iter()
            .zip(&self.corrections)
            .map(move |(step, correction)| {
                steps = steps.wrapping_add(*step);
                let bits = self.predicted_bits(steps);
                f64::from_bits(bits.wrapping_add(*correction as u64))
            })
    }

    /// The bits of the coordinate after so many steps from the origin.
    fn predicted_bits(&self, steps: i64) -> u64 {
        (self.origin + steps as f64 * STEP).to_bits()
    }
}
