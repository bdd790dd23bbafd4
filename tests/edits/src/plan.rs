//! Numbers in the text forms of geometric types.

/// A place in plan, metres.
pub type Place = [f64; 2];

/// A box: its least corner, and its greatest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub min: [f64; 3],
    pub max: [f64; 3],
}

impl Bounds {
    /// Of `BOX3D(x y z, x y z)`.
    pub fn parse(text: &str) -> Self {
        let n = numbers(text);
        Self {
            min: [n[0], n[1], n[2]],
            max: [n[3], n[4], n[5]],
        }
    }

    /// As a literal.
    pub fn sql(&self) -> String {
        let [[a, b, c], [d, e, f]] = [self.min, self.max];
        format!("'BOX3D({a:?} {b:?} {c:?}, {d:?} {e:?} {f:?})'::occlusion.box3d")
    }

    /// Metres from a point; 0 inside.
    pub fn distance(&self, point: [f64; 3]) -> f64 {
        let squares = (0..3).map(|axis| {
            let apart = point[axis].clamp(self.min[axis], self.max[axis]) - point[axis];
            apart * apart
        });
        squares.sum::<f64>().sqrt()
    }

    /// Whether its plan holds that of a point: eyes may have been raised since it was made.
    pub fn is_over(&self, point: [f64; 3]) -> bool {
        (0..2).all(|axis| (self.min[axis]..=self.max[axis]).contains(&point[axis]))
    }
}

/// The corners of `((x,y),…)`.
pub fn ring(text: &str) -> Vec<Place> {
    numbers(text).chunks(2).map(|c| [c[0], c[1]]).collect()
}

/// A ring as a literal.
pub fn ring_sql(ring: &[Place]) -> String {
    let corners: Vec<String> = ring.iter().map(|[x, y]| format!("({x:?},{y:?})")).collect();
    format!("polygon '({})'", corners.join(","))
}

/// A point as a literal.
pub fn point_sql([x, y, z]: [f64; 3]) -> String {
    format!("'POINT({x:?} {y:?} {z:?})'::occlusion.point3d")
}

/// All numbers from the first parenthesis to the last.
fn numbers(text: &str) -> Vec<f64> {
    let is_part = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let (_, text) = text.split_once('(').unwrap_or_default();
    let (text, _) = text.rsplit_once(')').unwrap_or_default();
    let words = text.split(|c| !is_part(c)).filter(|word| !word.is_empty());
    words.map(|word| word.parse().expect("a number")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let bounds = Bounds {
            min: [-0.1, 85_000.25, 0.0],
            max: [1e-9, 447_000.0, 3.0],
        };
        assert_eq!(Bounds::parse(&bounds.sql()), bounds);
        let corners = vec![[0.1, 0.0], [85_000.1, -3.0], [1e-7, 4.0]];
        assert_eq!(ring(&ring_sql(&corners)), corners);
    }
}
