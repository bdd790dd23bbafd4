//! [`Placement`], where an instance of a shape goes.

use serde::{Deserialize, Serialize};

use crate::scene::Surface;

/// An affine map from the frame of a shape to that of the scene, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Placement {
    /// Row by row: three factors for x, y and z, then what is added.
    pub rows: [[f64; 4]; 3],
}

impl Placement {
    /// Leaves everything where it is.
    pub const IDENTITY: Self = Self::moved_by([0.0; 3]);

    /// Moves everything by the same way.
    pub const fn moved_by([x, y, z]: [f64; 3]) -> Self {
        Self {
            rows: [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z]],
        }
    }

    /// Where a position goes. Never gives a negative zero.
    pub fn apply(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        self.rows
            .map(|[a, b, c, by]| (a * x + b * y + c * z + by) + 0.0)
    }

    /// This placement after another one: a child's within its parent's.
    pub fn after(&self, first: &Self) -> Self {
        let column = |j: usize| first.rows.map(|row| row[j]);
        let linear = |row: &[f64; 4], v: [f64; 3]| row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
        let rows = self.rows.map(|row| {
            let [a, b, c, by] = [0, 1, 2, 3].map(|j| linear(&row, column(j)));
            [a, b, c, by + row[3]]
        });
        Self { rows }
    }

    /// Whether it turns shapes inside out, so that rings have to be reversed.
    pub fn mirrors(&self) -> bool {
        self.determinant() < 0.0
    }

    /// Whether it leaves no volume, so that rings may fall together.
    pub fn flattens(&self) -> bool {
        self.determinant() == 0.0
    }

    fn determinant(&self) -> f64 {
        let [[a, b, c, _], [d, e, f, _], [g, h, i, _]] = self.rows;
        a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    }

    /// A surface, placed; still seen anticlockwise from outside.
    pub fn surface(&self, surface: &Surface) -> Surface {
        let ring = |ring: &Vec<[f64; 3]>| {
            let mut ring: Vec<_> = ring.iter().map(|&position| self.apply(position)).collect();
            if self.mirrors() {
                ring.reverse();
            }
            ring
        };
        Surface {
            rings: surface.rings.iter().map(ring).collect(),
            ..*surface
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const QUARTER_TURN: Placement = Placement {
        rows: [
            [0.0, -2.0, 0.0, 1.0],
            [2.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.5],
        ],
    };

    #[test]
    fn rows_apply_to_positions() {
        assert_eq!(QUARTER_TURN.apply([1.0, 2.0, 3.0]), [-3.0, 2.0, 3.5]);
        assert!(!QUARTER_TURN.mirrors());
    }

    #[test]
    fn a_child_is_placed_before_its_parent() {
        let both = QUARTER_TURN.after(&Placement::moved_by([1.0, 1.0, 1.0]));
        assert_eq!(both.apply([0.0; 3]), QUARTER_TURN.apply([1.0; 3]));
        assert_eq!(
            both.apply([4.0, 5.0, 6.0]),
            QUARTER_TURN.apply([5.0, 6.0, 7.0])
        );
        assert_eq!(QUARTER_TURN.after(&Placement::IDENTITY), QUARTER_TURN);
    }

    #[test]
    fn mirrors_reverse_rings() {
        let mut mirror = Placement::IDENTITY;
        mirror.rows[0][0] = -1.0;
        let surface = Surface {
            rings: vec![vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]],
            material: Some(2),
            semantic: None,
        };
        let placed = mirror.surface(&surface);
        let ring = vec![[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0; 3]];
        assert_eq!((placed.rings, placed.material), (vec![ring], Some(2)));
    }
}
