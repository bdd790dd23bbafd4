//! [`DataSet`], the boxes that are searched.

use engine::{CityLayout, generated_city};
use fastrand::Rng;

use super::volumes::{self, Streets};
use crate::sql_types::Box3d;
use crate::terminal::grouped;

/// Boxes, in an order along space, and what is asked of them.
pub struct DataSet {
    /// What they are, in words.
    pub name: String,
    /// Class of every row.
    pub class: &'static str,
    /// The boxes.
    pub boxes: Vec<Box3d>,
    /// How many of them overlap a point, where that is chosen.
    pub depth: Option<usize>,
    /// Side of the boxes that are searched for, metres.
    pub reach: f64,
    /// How far eyes see, metres.
    pub range: f64,
    /// Where searches are; inside of boxes if there are none.
    streets: Option<Streets>,
}

impl DataSet {
    /// The envelopes of a city of row houses along streets.
    pub fn city(rows: usize, seed: u64) -> Self {
        let city = generated_city(CityLayout::Streets, rows, seed);
        Self {
            name: format!("{} boxes of a \"streets\" city", grouped(rows)),
            class: "Building",
            boxes: city
                .features()
                .map(|feature| feature.envelope.into())
                .collect(),
            depth: None,
            reach: 240.0,
            range: 500.0,
            streets: None,
        }
    }

    /// Boxes like occlusion volumes, so large that `depth` of them overlap a point of a street.
    pub fn volumes(rows: usize, depth: usize, seed: u64) -> Self {
        let streets = Streets::of_city(rows, seed);
        Self {
            name: format!(
                "{} boxes like occlusion volumes, {} overlap a point",
                grouped(rows),
                grouped(depth)
            ),
            class: "Volume",
            boxes: volumes::volumes(&streets, rows, depth, seed),
            depth: Some(depth),
            reach: 2.0,
            range: 20.0,
            streets: Some(streets),
        }
    }

    /// A place where there are boxes.
    pub fn place(&self, rng: &mut Rng) -> [f64; 3] {
        if let Some(streets) = &self.streets {
            return streets.eye(rng.usize(..streets.len()), rng);
        }
        let Some(Box3d { min, max }) = rng.choice(&self.boxes) else {
            return [0.0; 3];
        };
        std::array::from_fn(|axis| min[axis] + rng.f64() * (max[axis] - min[axis]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_of_a_city_is_in_a_box() {
        let city = DataSet::city(300, 1);
        assert_eq!(city.boxes.len(), 300);
        let mut rng = Rng::with_seed(2);
        for _ in 0..100 {
            let place = city.place(&mut rng);
            assert!(city.boxes.iter().any(|b| b.distance(place) == 0.0));
        }
    }
}
