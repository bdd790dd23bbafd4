//! How a full page is divided: the R*-tree's split (Beckmann et al. 1990, section 4.2). It sorts
//! along each axis, takes the axis with the least total margin, and on it the cut with the least
//! overlap; margins rank flat boxes, whose volumes are all 0.

use engine::Box3d;

/// Least share of the entries that each side gets.
const LEAST_SHARE: f64 = 0.4;

/// One division of the sorted entries.
struct Cut {
    at: usize,
    overlap: f64,
    margin: f64,
}

/// The positions of `keys` in two groups, each with at least one.
pub fn split(keys: &[Box3d]) -> [Vec<usize>; 2] {
    let candidates = (0..3).flat_map(|axis| {
        [false, true].map(|by_upper| {
            let order = sorted(keys, axis, by_upper);
            let cuts = cuts(keys, &order);
            let total: f64 = cuts.iter().map(|cut| cut.margin).sum();
            (order, cuts, total)
        })
    });
    let best = candidates.min_by(|a, b| a.2.total_cmp(&b.2));
    let Some((order, cuts, _)) = best else {
        unreachable!("there are three axes")
    };
    let cut = cuts.iter().min_by(|a, b| {
        a.overlap
            .total_cmp(&b.overlap)
            .then(a.margin.total_cmp(&b.margin))
    });
    let at = cut.map_or(order.len() / 2, |cut| cut.at);
    [order[..at].to_vec(), order[at..].to_vec()]
}

/// Positions in the order of one end along an axis.
fn sorted(keys: &[Box3d], axis: usize, by_upper: bool) -> Vec<usize> {
    let ends = |key: &Box3d| {
        if by_upper {
            [key.max[axis], key.min[axis]]
        } else {
            [key.min[axis], key.max[axis]]
        }
    };
    let mut order: Vec<usize> = (0..keys.len()).collect();
    order.sort_by(|&a, &b| {
        let (a, b) = (ends(&keys[a]), ends(&keys[b]));
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
    });
    order
}

/// All balanced cuts of an order, with the boxes' overlap and margin on both sides.
fn cuts(keys: &[Box3d], order: &[usize]) -> Vec<Cut> {
    let running = |positions: &mut dyn Iterator<Item = usize>| -> Vec<Box3d> {
        positions
            .map(|position| keys[position])
            .scan(None, |so_far: &mut Option<Box3d>, key| {
                let grown = so_far.map_or(key, |b| b.union(&key));
                *so_far = Some(grown);
                Some(grown)
            })
            .collect()
    };
    let left = running(&mut order.iter().copied());
    let right = running(&mut order.iter().rev().copied());
    let count = order.len();
    let least = ((count as f64 * LEAST_SHARE) as usize).max(1);
    (least..=count - least)
        .map(|at| {
            let (a, b) = (left[at - 1], right[count - at - 1]);
            let shared = (a.max.min(b.max) - a.min.max(b.min)).max(glam::DVec3::ZERO);
            Cut {
                at,
                overlap: shared.element_product(),
                margin: a.margin() + b.margin(),
            }
        })
        .collect()
}
