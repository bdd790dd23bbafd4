//! Whether the edges of a footprint keep apart.

use geo::algorithm::kernels::{Kernel, Orientation};
use geo::{Coord, GeoNum};

use super::Plan;
use super::sweep::{Edge, each_pair};

/// Whether rings touch each other; or why they do not bound an area: edges cross, or a ring touches
/// itself, so that what is inside is anybody's guess.
pub(super) fn do_touch(rings: &[Vec<Plan>]) -> Result<bool, &'static str> {
    let closed = |ring: &Vec<Plan>| ring.iter().chain(ring.first()).copied().collect();
    let closed: Vec<Vec<Plan>> = rings.iter().map(closed).collect();
    let edges = closed
        .iter()
        .enumerate()
        .flat_map(|(i, ring)| Edge::between(ring, i));
    let mut touch = false;
    each_pair(edges.collect(), 0.0, &mut |edge, other| {
        match contact(edge, other) {
            Contact::Crossing => return Err("the outline crosses itself"),
            Contact::Touching if edge.ring != other.ring => touch = true,
            Contact::Touching if !are_neighbours(edge, other, rings[edge.ring].len()) => {
                return Err("the outline touches itself");
            }
            _ => (),
        }
        Ok(())
    })?;
    Ok(touch)
}

/// Whether two edges of a ring of so many share a vertex by their place in it.
fn are_neighbours(edge: &Edge, other: &Edge, count: usize) -> bool {
    let apart = edge.index.abs_diff(other.index);
    apart == 1 || apart + 1 == count
}

/// How two edges meet.
#[derive(Debug, PartialEq)]
enum Contact {
    /// Not at all.
    Apart,
    /// In a point where one of them ends.
    Touching,
    /// In more than that.
    Crossing,
}

fn contact(edge: &Edge, other: &Edge) -> Contact {
    let sides = |line: &Edge, of: &Edge| of.ends.map(|end| side(line.ends, end));
    let (a, b) = (sides(edge, other), sides(other, edge));
    let is_beside =
        |sides: [Orientation; 2]| sides[0] == sides[1] && sides[0] != Orientation::Collinear;
    let is_on = |sides: [Orientation; 2]| sides.contains(&Orientation::Collinear);
    if a == [Orientation::Collinear; 2] {
        return match edge.overlaps(other) {
            true => Contact::Crossing,
            false if edge.ends.iter().any(|end| other.ends.contains(end)) => Contact::Touching,
            false => Contact::Apart,
        };
    }
    if is_beside(a) || is_beside(b) {
        Contact::Apart
    } else if is_on(a) || is_on(b) {
        Contact::Touching
    } else {
        Contact::Crossing
    }
}

/// The side of a line that a point is on, exactly.
fn side([a, b]: [Plan; 2], p: Plan) -> Orientation {
    let coord = |[x, y]: Plan| Coord { x, y };
    <f64 as GeoNum>::Ker::orient2d(coord(a), coord(b), coord(p))
}

#[cfg(test)]
mod tests {
    use super::super::sweep::INTRICATE;
    use super::*;

    #[test]
    fn rings_may_touch_each_other_and_not_cross() {
        let square = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        let bow = vec![[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]];
        let eight = vec![
            [0.0, 0.0],
            [2.0, 2.0],
            [4.0, 4.0],
            [4.0, 0.0],
            [2.0, 2.0],
            [0.0, 4.0],
        ];
        let on_edge = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]];
        let touching = vec![[0.0, 0.0], [2.0, 3.0], [3.0, 2.0]];
        let flush = vec![[1.0, 0.0], [3.0, 0.0], [2.0, 2.0]];
        assert_eq!(do_touch(std::slice::from_ref(&square)), Ok(false));
        assert_eq!(do_touch(&[square.clone(), touching]), Ok(true));
        assert_eq!(
            do_touch(&[square, flush]),
            Err("the outline crosses itself")
        );
        assert_eq!(do_touch(&[bow]), Err("the outline crosses itself"));
        assert_eq!(do_touch(&[eight]), Err("the outline touches itself"));
        assert_eq!(do_touch(&[on_edge]), Err("the outline touches itself"));
    }

    #[test]
    fn an_outline_that_would_take_too_long_is_refused() {
        let tooth = |i| [f64::from(i % 2) * 1e4, f64::from(i)];
        let back = [[-1.0, 3000.0], [-1.0, 0.0]];
        let comb = (0..3000).map(tooth).chain(back).collect();
        assert_eq!(do_touch(&[comb]), Err(INTRICATE));
    }
}
