//! A bounding volume hierarchy over boxes, walked along lines. It may offer too much, never too
//! little: exact tests follow.

use crate::aabb::{Aabb, Point};

/// Boxes in a leaf at most; fewer make the tree deeper, more make leaves dearer to test.
const LEAF: usize = 4;
/// Candidate splits along an axis; more gain under 1 % and slow the building.
const BINS: usize = 16;
/// Depth from which nodes are split into halves of equal count, so that 2^32 boxes fit the stack.
const BALANCED_DEPTH: usize = 60;
/// Room on the stack of a walk: the deepest tree and one more.
const STACK: usize = 96;
/// Widening of the far parameter against that of the near one: each takes at most 4 roundings of
/// 2^-53 (T. Ize, "Robust BVH ray traversal", 2013, section 3), 16 are granted.
const WIDENED: f64 = 1.0 + 8.0 * f64::EPSILON;

/// A tree over boxes; coordinates up to `1e100`, so that no difference or product overflows.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    nodes: Vec<Node>,
    items: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Aabb,
    /// First item of a leaf, or the left child, which the right one follows.
    first: u32,
    /// Number of items; zero for an inner node.
    count: u32,
}

/// A line from an origin, prepared for slab tests.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Probe {
    origin: Point,
    inverse: Point,
    backward: [bool; 3],
}

impl Probe {
    /// The line from `origin` in `direction`, each of its entries rounded at most once.
    pub(crate) fn new(origin: Point, direction: Point) -> Self {
        let inverse = direction.map(|entry| {
            let inverse = 1.0 / entry;
            // An entry too small to invert bounds nothing; NaN is passed over by min and max.
            if entry != 0.0 && inverse.is_infinite() {
                f64::NAN
            } else {
                inverse
            }
        });
        Self {
            origin,
            inverse,
            backward: direction.map(f64::is_sign_negative),
        }
    }

    /// Where the line enters the box, if it may do so before the parameter `limit`.
    #[inline]
    fn enters(&self, bounds: &Aabb, limit: f64) -> Option<f64> {
        let (mut near, mut far) = (0f64, limit);
        for axis in 0..3 {
            let (mut enter, mut leave) = (bounds.min[axis], bounds.max[axis]);
            if self.backward[axis] {
                std::mem::swap(&mut enter, &mut leave);
            }
            near = near.max((enter - self.origin[axis]) * self.inverse[axis]);
            far = far.min((leave - self.origin[axis]) * self.inverse[axis]);
        }
        (near <= far * WIDENED + f64::MIN_POSITIVE).then_some(near)
    }
}

impl Bvh {
    /// The tree over `boxes`, known by their positions.
    pub(crate) fn new(boxes: &[Aabb]) -> Self {
        let count = u32::try_from(boxes.len()).unwrap_or(u32::MAX);
        let mut builder = Builder {
            boxes,
            nodes: Vec::new(),
            items: (0..count).collect(),
        };
        if count > 0 {
            let root = builder.leaf(0, count as usize);
            builder.nodes.push(root);
            builder.split(0, 0);
        }
        Self {
            nodes: builder.nodes,
            items: builder.items,
        }
    }

    /// The boxes in the order of the leaves; visits give positions in it.
    pub(crate) fn items(&self) -> &[u32] {
        &self.items
    }

    /// Visits every leaf that the line may meet at a parameter from 0 to `limit`, near ones first.
    /// The visitor takes a range of `items` and returns the new limit, or `None` to stop.
    pub(crate) fn walk(
        &self,
        probe: &Probe,
        mut limit: f64,
        mut visit: impl FnMut(std::ops::Range<usize>) -> Option<f64>,
    ) {
        let mut stack = [(0u32, 0f64); STACK];
        let mut height = 0;
        let mut current = self
            .nodes
            .first()
            .and_then(|root| probe.enters(&root.bounds, limit))
            .map(|_| 0);
        while let Some(index) = current {
            let node = &self.nodes[index as usize];
            current = None;
            if node.count > 0 {
                let first = node.first as usize;
                match visit(first..first + node.count as usize) {
                    Some(new) => limit = new,
                    None => return,
                }
            } else {
                let (left, right) = (node.first, node.first + 1);
                let entries =
                    [left, right].map(|i| probe.enters(&self.nodes[i as usize].bounds, limit));
                current = match entries {
                    [Some(a), Some(b)] => {
                        let (near, far) = if a <= b {
                            (left, (right, b))
                        } else {
                            (right, (left, a))
                        };
                        stack[height] = far;
                        height += 1;
                        Some(near)
                    }
                    [Some(_), None] => Some(left),
                    [None, Some(_)] => Some(right),
                    [None, None] => None,
                };
            }
            while current.is_none() && height > 0 {
                height -= 1;
                let (index, near) = stack[height];
                current = (near <= limit * WIDENED + f64::MIN_POSITIVE).then_some(index);
            }
        }
    }
}

struct Builder<'a> {
    boxes: &'a [Aabb],
    nodes: Vec<Node>,
    items: Vec<u32>,
}

impl Builder<'_> {
    fn leaf(&self, first: usize, count: usize) -> Node {
        let bounds = self.items[first..first + count]
            .iter()
            .map(|&item| self.boxes[item as usize])
            .reduce(|a, b| a.union(&b))
            .unwrap_or(Aabb {
                min: [0.0; 3],
                max: [0.0; 3],
            });
        Node {
            bounds,
            first: first as u32,
            count: count as u32,
        }
    }

    /// Splits the leaf `index` and what becomes of it, down to small leaves.
    fn split(&mut self, index: usize, depth: usize) {
        let Node { first, count, .. } = self.nodes[index];
        let (first, count) = (first as usize, count as usize);
        if count <= LEAF {
            return;
        }
        let middle = self.partition(first, count, depth);
        let left = self.nodes.len();
        let children = [
            self.leaf(first, middle),
            self.leaf(first + middle, count - middle),
        ];
        self.nodes.extend(children);
        self.nodes[index].first = left as u32;
        self.nodes[index].count = 0;
        self.split(left, depth + 1);
        self.split(left + 1, depth + 1);
    }

    /// Reorders the items of a node and returns how many go left: the surface area heuristic over
    /// bins of the longest axis (I. Wald, "On fast construction of SAH-based bounding volume
    /// hierarchies", 2007), or the median where that fails.
    fn partition(&mut self, first: usize, count: usize, depth: usize) -> usize {
        let boxes = self.boxes;
        let items = &mut self.items[first..first + count];
        let centres: Vec<Point> = items
            .iter()
            .map(|&item| centre(&boxes[item as usize]))
            .collect();
        let span = Aabb::around(&centres);
        let extent = |axis: usize| span.max[axis] - span.min[axis];
        let axis = (0..3)
            .max_by(|&i, &j| extent(i).total_cmp(&extent(j)))
            .unwrap_or(0);
        let bin = |item: u32| {
            let along = centre(&boxes[item as usize])[axis] - span.min[axis];
            ((along / extent(axis) * BINS as f64) as usize).min(BINS - 1)
        };
        if depth < BALANCED_DEPTH
            && extent(axis) > 0.0
            && let Some(cut) = cheapest_cut(boxes, items, bin)
        {
            items.sort_by_key(|&item| bin(item));
            return items.partition_point(|&item| bin(item) <= cut);
        }
        let middle = count / 2;
        items.select_nth_unstable_by(middle, |&i, &j| {
            centre(&boxes[i as usize])[axis].total_cmp(&centre(&boxes[j as usize])[axis])
        });
        middle
    }
}

/// The last bin of the left side at the least cost, `None` if all items fall into one bin.
fn cheapest_cut(boxes: &[Aabb], items: &[u32], bin: impl Fn(u32) -> usize) -> Option<usize> {
    let mut bins: [(Option<Aabb>, usize); BINS] = [(None, 0); BINS];
    for &item in items {
        let (bounds, count) = &mut bins[bin(item)];
        *bounds = join(*bounds, Some(boxes[item as usize]));
        *count += 1;
    }
    let cost = |side: &[(Option<Aabb>, usize)]| {
        let bounds = side.iter().fold(None, |bounds, bin| join(bounds, bin.0));
        let count: usize = side.iter().map(|bin| bin.1).sum();
        bounds.map(|bounds| area(&bounds) * count as f64)
    };
    (0..BINS - 1)
        .filter_map(|cut| {
            let (left, right) = bins.split_at(cut + 1);
            Some((cost(left)? + cost(right)?, cut))
        })
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, cut)| cut)
}

fn join(a: Option<Aabb>, b: Option<Aabb>) -> Option<Aabb> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.union(&b)),
        (a, b) => a.or(b),
    }
}

fn centre(aabb: &Aabb) -> Point {
    std::array::from_fn(|axis| 0.5 * aabb.min[axis] + 0.5 * aabb.max[axis])
}

/// Half the surface.
fn area(aabb: &Aabb) -> f64 {
    let [x, y, z] = std::array::from_fn(|axis| aabb.max[axis] - aabb.min[axis]);
    x * y + y * z + z * x
}
