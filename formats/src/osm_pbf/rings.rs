//! Rings of ways, put together by the nodes that they share.

use std::collections::HashMap;

/// Why ways do not form rings.
const OPEN: &str = "the ways of the relation do not form rings";

/// Closed rings of ways, which may be pieces of rings in any order and direction.
pub(super) fn rings(ways: &[&[i64]]) -> Result<Vec<Vec<i64>>, &'static str> {
    let mut rings = Vec::new();
    let mut ends: HashMap<i64, Vec<usize>> = HashMap::new();
    let mut used = vec![false; ways.len()];
    for (i, way) in ways.iter().enumerate() {
        let (Some(first), Some(last)) = (way.first(), way.last()) else {
            return Err(OPEN);
        };
        if first == last {
            rings.push(way.to_vec());
            used[i] = true;
        } else {
            ends.entry(*first).or_default().push(i);
            ends.entry(*last).or_default().push(i);
        }
    }
    for i in 0..ways.len() {
        if !std::mem::replace(&mut used[i], true) {
            rings.push(ring_from(ways[i], ways, &mut ends, &mut used)?);
        }
    }
    Ok(rings)
}

/// Goes on from a way, end to end, until the ring closes.
fn ring_from(
    start: &[i64],
    ways: &[&[i64]],
    ends: &mut HashMap<i64, Vec<usize>>,
    used: &mut [bool],
) -> Result<Vec<i64>, &'static str> {
    let mut ring = start.to_vec();
    while ring.first() != ring.last() {
        let end = ring.last().copied().ok_or(OPEN)?;
        let here = ends.get_mut(&end).ok_or(OPEN)?;
        let next = loop {
            let candidate = here.pop().ok_or(OPEN)?;
            if !std::mem::replace(&mut used[candidate], true) {
                break ways[candidate];
            }
        };
        if next.first() == Some(&end) {
            ring.extend(next.iter().skip(1));
        } else {
            ring.extend(next.iter().rev().skip(1));
        }
    }
    Ok(ring)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_in_any_direction_form_rings() {
        let ways: [&[i64]; 4] = [&[1, 2, 3], &[5, 4, 3], &[5, 1], &[7, 8, 9, 7]];
        assert_eq!(
            rings(&ways).unwrap(),
            [vec![7, 8, 9, 7], vec![1, 2, 3, 4, 5, 1]]
        );
    }

    #[test]
    fn gaps_are_refused() {
        for ways in [&[&[1, 2, 3][..], &[3, 4]][..], &[&[]], &[&[1, 2], &[2, 3]]] {
            assert_eq!(rings(ways), Err(OPEN));
        }
    }
}
