//! [`ShapeBuilder`], which turns rings of polygons into the surfaces of a shape.

use crate::error::Problem;
use crate::limits::{Budget, MAX_COORDINATE};
use crate::scene::{Shape, Surface};

/// Most vertices of one feature's surfaces: with all that goes with them they take some 60 bytes
/// each, which holds memory below 1 GB whatever a file describes in few bytes.
pub(crate) const MAX_FEATURE_VERTICES: usize = 10_000_000;

/// A shape under way.
#[derive(Debug)]
pub(crate) struct ShapeBuilder {
    /// What has been built so far.
    pub(crate) shape: Shape,
    /// Rings dropped because fewer than three distinct vertices were left of them.
    pub(crate) degenerate_rings: usize,
    /// Vertices of all surfaces.
    pub(crate) vertices: usize,
    max_vertices: usize,
}

impl ShapeBuilder {
    /// A shape without surfaces, of at most so many vertices.
    pub(crate) fn new(max_vertices: usize) -> Self {
        Self {
            shape: Shape::default(),
            degenerate_rings: 0,
            vertices: 0,
            max_vertices,
        }
    }

    /// Adds a polygon without holes, unless too little of it is left without repeated vertices.
    pub(crate) fn add(
        &mut self,
        ring: Vec<[f64; 3]>,
        material: Option<u32>,
        budget: &mut Budget,
    ) -> Result<(), Problem> {
        let ring = without_repetitions(ring);
        if !has_three_distinct(&ring) {
            self.degenerate_rings += 1;
            return Ok(());
        }
        ring.iter().try_for_each(check_position)?;
        budget.surfaces(1)?;
        self.vertices += ring.len();
        if self.vertices > self.max_vertices {
            return Err(Problem::Limit {
                what: "vertices of one feature",
                found: self.vertices as u64,
                limit: self.max_vertices as u64,
            });
        }
        self.shape.surfaces.push(Surface {
            rings: vec![ring],
            material,
            semantic: None,
        });
        Ok(())
    }
}

/// Refuses positions that are no numbers or too far away.
pub(crate) fn check_position(position: &[f64; 3]) -> Result<(), Problem> {
    let range = -MAX_COORDINATE..=MAX_COORDINATE;
    match position.iter().find(|c| !range.contains(c)) {
        None => Ok(()),
        Some(coordinate) => Err(Problem::Invalid {
            what: "coordinate".to_owned(),
            found: format!("{coordinate:?}"),
            expected: "a number of metres up to 1e9",
        }),
    }
}

/// The ring without vertices that are equal to the one before them.
fn without_repetitions(mut ring: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    ring.dedup();
    while ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    ring.shrink_to_fit();
    ring
}

fn has_three_distinct(ring: &[[f64; 3]]) -> bool {
    let Some(first) = ring.first() else {
        return false;
    };
    let mut others = ring.iter().filter(|position| *position != first);
    let second = others.next();
    others.any(|position| Some(position) != second)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::Limits;

    const A: [f64; 3] = [0.0; 3];
    const B: [f64; 3] = [1.0, 0.0, 0.0];
    const C: [f64; 3] = [0.0, 1.0, 0.0];

    fn budget() -> Budget {
        Budget::new(&Limits::STANDARD, 0).unwrap()
    }

    #[test]
    fn repeated_vertices_go_and_the_ring_where_too_few_are_left() {
        let mut builder = ShapeBuilder::new(100);
        let rings = [vec![], vec![A, B, A, B], vec![A, A, B, C, C, A, A]];
        for ring in rings {
            builder.add(ring, Some(1), &mut budget()).unwrap();
        }
        let [surface] = &builder.shape.surfaces[..] else {
            panic!("{builder:?}");
        };
        assert_eq!(surface.rings, [[A, B, C]]);
        assert_eq!((builder.degenerate_rings, builder.vertices), (2, 3));
    }

    #[test]
    fn the_limit_and_the_range_are_named() {
        let mut builder = ShapeBuilder::new(4);
        builder.add(vec![A, B, C], None, &mut budget()).unwrap();
        let more = builder.add(vec![A, B, C], None, &mut budget());
        assert_eq!(
            more.unwrap_err().to_string(),
            "6 vertices of one feature exceed the limit of 4"
        );
        let far = builder.add(vec![A, B, [f64::NAN, 0.0, 0.0]], None, &mut budget());
        assert_eq!(
            far.unwrap_err().to_string(),
            "coordinate is NaN, expected a number of metres up to 1e9"
        );
    }
}
