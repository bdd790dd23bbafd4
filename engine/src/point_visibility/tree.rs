//! [`Tree`], a hierarchy of boxes.

use std::collections::VecDeque;
use std::ops::Range;

use crate::Box3d;

/// Children of a node, at the most.
pub const FANOUT: usize = 4;

/// Boxes in a tree.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// The root first; children of one node are neighbours.
    pub nodes: Vec<Node>,
}

/// A box around other nodes, or around some of the boxes.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    pub bounds: Box3d,
    /// The first of its nodes or boxes.
    pub first: u32,
    pub count: u16,
    /// Whether it holds boxes, and not nodes.
    pub is_leaf: bool,
}

impl Node {
    /// The positions of its nodes or boxes.
    pub fn children(&self) -> Range<u32> {
        self.first..self.first.saturating_add(u32::from(self.count))
    }
}

impl Tree {
    /// The tree over some boxes, and the order in which its leaves hold them.
    pub fn new(boxes: &[Box3d]) -> (Self, Vec<usize>) {
        let mut order: Vec<usize> = (0..boxes.len()).collect();
        let mut nodes = Vec::with_capacity(boxes.len() / 2);
        let mut open = VecDeque::new();
        if !boxes.is_empty() {
            nodes.push(empty());
            open.push_back((0, 0..boxes.len()));
        }
        while let Some((at, range)) = open.pop_front() {
            let bounds = around(boxes, &order[range.clone()]);
            let is_leaf = range.len() <= FANOUT;
            let groups = match is_leaf {
                true => Vec::new(),
                false => groups(boxes, &mut order, range.clone()),
            };
            let (first, count) = match is_leaf {
                true => (range.start, range.len()),
                false => (nodes.len(), groups.len()),
            };
            nodes[at] = Node {
                bounds,
                first: u32::try_from(first).expect("a tile holds fewer than 4 billion features"),
                count: u16::try_from(count).expect("a node holds few"),
                is_leaf,
            };
            for group in groups {
                open.push_back((nodes.len(), group));
                nodes.push(empty());
            }
        }
        (Self { nodes }, order)
    }

    pub fn bounds(&self) -> Option<Box3d> {
        self.nodes.first().map(|root| root.bounds)
    }
}

fn empty() -> Node {
    Node {
        bounds: Box3d::new(glam::DVec3::ZERO, glam::DVec3::ZERO),
        first: 0,
        count: 0,
        is_leaf: true,
    }
}

fn around(boxes: &[Box3d], order: &[usize]) -> Box3d {
    order
        .iter()
        .map(|&at| boxes[at])
        .reduce(|a, b| a.union(&b))
        .expect("a node holds a box")
}

/// A range of the order, longer than a leaf, in four groups: halves of halves, each across the longer way in plan.
fn groups(boxes: &[Box3d], order: &mut [usize], range: Range<usize>) -> Vec<Range<usize>> {
    let mut groups = vec![range];
    while groups.len() < FANOUT {
        let Some(widest) = (0..groups.len())
            .filter(|&at| groups[at].len() > 1)
            .max_by_key(|&at| groups[at].len())
        else {
            break;
        };
        let group = groups[widest].clone();
        let middle = group.start + halve(boxes, &mut order[group.clone()]);
        groups[widest] = group.start..middle;
        groups.insert(widest + 1, middle..group.end);
    }
    groups
}

/// Parts boxes at the median of their centres, across the longer way in plan; returns how many come first.
pub fn halve(boxes: &[Box3d], order: &mut [usize]) -> usize {
    let bounds = around(boxes, order);
    let axis = usize::from(bounds.size().y > bounds.size().x);
    let middle = order.len() / 2;
    let center = |at: usize| boxes[at].min[axis] + boxes[at].max[axis];
    order.select_nth_unstable_by(middle, |&a, &b| center(a).total_cmp(&center(b)));
    middle
}
