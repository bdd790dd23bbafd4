//! [`Staircase`], the choice of the columns that stand on one level.
//!
//! The regions solid from a bottom up to ascending levels are nested, so their connected pieces
//! form a tree: a piece at one level holds the pieces at higher levels. A set of pieces, each a
//! column from the bottom, covers for each piece its area times the height above the next lower
//! piece of the set that holds it. The best set for a given price a column is found by dynamic
//! programming, from the leaves down; the price follows from what is asked.

use std::collections::{HashMap, VecDeque};

use super::plan::Plan;
use super::stacks::Stretch;

/// Halvings in the search for the price of a column: prices that differ by a few per cent choose
/// the same columns.
const PRICES: usize = 10;

/// A connected piece of the region that is solid from the bottom up to a level.
struct Piece {
    level: usize,
    area: f64,
    /// The pieces at higher levels in it.
    inner: Vec<usize>,
    /// Triangles in none of those.
    triangles: Vec<usize>,
}

/// All pieces above one bottom.
pub struct Staircase<'a> {
    levels: &'a [f64],
    bottom: usize,
    /// Pieces, each after those in it.
    pieces: Vec<Piece>,
    /// Pieces that are in no other.
    outermost: Vec<usize>,
}

/// What a staircase is to reach.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// Volume that is enough.
    pub enough: f64,
    /// Volume that each column must add.
    pub least_gain: f64,
    /// Most columns.
    pub most: usize,
}

/// A chosen piece.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Number of the piece.
    pub piece: usize,
    /// Level at which it ends.
    pub level: usize,
    /// The step below that holds it, by its place in the list, which is before this one's.
    pub below: Option<usize>,
}

impl<'a> Staircase<'a> {
    /// The pieces of stretches that are solid from the bottom level up; one a triangle.
    pub fn new(plan: &Plan, levels: &'a [f64], bottom: usize, stretches: &[Stretch]) -> Self {
        let mut staircase = Self {
            levels,
            bottom,
            pieces: Vec::new(),
            outermost: Vec::new(),
        };
        let mut downward: Vec<&Stretch> = stretches.iter().collect();
        downward.sort_by_key(|stretch| std::cmp::Reverse(stretch.to));
        let mut joined = Joined::new(plan.triangles.len());
        for level in downward.chunk_by(|a, b| a.to == b.to) {
            for stretch in level {
                joined.add(stretch.triangle, &plan.neighbours[stretch.triangle]);
            }
            staircase.add_level(level, &mut joined);
        }
        staircase
    }

    /// Adds the pieces that the stretches up to one level belong to; what they hold is there.
    fn add_level(&mut self, stretches: &[&Stretch], joined: &mut Joined) {
        let mut grown: HashMap<usize, usize> = HashMap::new();
        for stretch in stretches {
            let piece = *grown
                .entry(joined.root(stretch.triangle))
                .or_insert_with(|| {
                    self.pieces.push(Piece {
                        level: stretch.to,
                        area: 0.0,
                        inner: Vec::new(),
                        triangles: Vec::new(),
                    });
                    self.pieces.len() - 1
                });
            self.pieces[piece].area += stretch.area;
            self.pieces[piece].triangles.push(stretch.triangle);
        }
        let mut outermost: Vec<usize> = grown.values().copied().collect();
        outermost.sort_unstable();
        for inner in std::mem::take(&mut self.outermost) {
            match grown.get(&joined.root(self.pieces[inner].triangles[0])) {
                Some(&outer) => {
                    self.pieces[outer].area += self.pieces[inner].area;
                    self.pieces[outer].inner.push(inner);
                }
                None => outermost.push(inner),
            }
        }
        self.outermost = outermost;
    }

    /// All triangles of a piece.
    pub fn triangles(&self, piece: usize) -> Vec<usize> {
        let mut triangles = Vec::new();
        let mut left = vec![piece];
        while let Some(piece) = left.pop() {
            triangles.extend(&self.pieces[piece].triangles);
            left.extend(&self.pieces[piece].inner);
        }
        triangles
    }

    /// The fewest steps that reach the goal, or those that come closest; lower ones first.
    pub fn choose(&self, goal: &Goal) -> Vec<Step> {
        let mut chosen: Vec<Step> = Vec::new();
        let mut volume = 0.0;
        // Of pieces that are alike there may be too many at one price and none at the next.
        let mut overfull: Vec<Step> = Vec::new();
        // The price is at least the gain that is asked, so that none adds less.
        let (mut low, mut high) = (goal.least_gain, self.most_volume().max(goal.least_gain));
        let mut price = low;
        for _ in 0..=PRICES {
            let steps = self.best(price);
            let covered = self.volume(&steps);
            let is_few = steps.len() <= goal.most;
            let is_enough = covered >= goal.enough;
            let is_better = if is_enough && volume >= goal.enough {
                steps.len() < chosen.len()
            } else {
                covered > volume
            };
            if is_few && is_better {
                (chosen, volume) = (steps, covered);
            } else if !is_few {
                overfull = steps;
            }
            if is_few && !is_enough {
                high = price;
            } else {
                low = price;
            }
            if low >= high {
                break;
            }
            price = (low * high).sqrt();
        }
        overfull.truncate(goal.most);
        if self.volume(&overfull) > volume {
            return overfull;
        }
        chosen
    }

    /// The volume that steps cover.
    fn volume(&self, steps: &[Step]) -> f64 {
        let gain = |step: &Step| {
            let below = step.below.map_or(self.bottom, |below| steps[below].level);
            self.gain(&self.pieces[step.piece], below)
        };
        steps.iter().map(gain).sum()
    }

    /// More than any step covers.
    fn most_volume(&self) -> f64 {
        let volumes = self
            .pieces
            .iter()
            .map(|piece| self.gain(piece, self.bottom));
        volumes.fold(0.0, f64::max)
    }

    /// The steps whose volume less `price` each is greatest.
    fn best(&self, price: f64) -> Vec<Step> {
        // For each piece and each level below it up to which a step reaches: the most that it and
        // the pieces in it can add.
        let mut worth: Vec<Vec<f64>> = Vec::with_capacity(self.pieces.len());
        for piece in &self.pieces {
            let inside = |below: usize| piece.inner.iter().map(|&i| worth[i][below]).sum::<f64>();
            let above = inside(piece.level - self.bottom);
            let worth_of = (self.bottom..=piece.level).map(|below| {
                let skipped = inside(below - self.bottom);
                skipped.max(self.gain(piece, below) - price + above)
            });
            let worth_of = worth_of.collect();
            worth.push(worth_of);
        }
        let mut steps: Vec<Step> = Vec::new();
        let mut left: VecDeque<(usize, Option<usize>)> =
            self.outermost.iter().map(|&piece| (piece, None)).collect();
        while let Some((number, mut below)) = left.pop_front() {
            let piece = &self.pieces[number];
            let level = below.map_or(self.bottom, |below: usize| steps[below].level);
            let skipped: f64 = piece
                .inner
                .iter()
                .map(|&i| worth[i][level - self.bottom])
                .sum();
            if worth[number][level - self.bottom] > skipped {
                steps.push(Step {
                    piece: number,
                    level: piece.level,
                    below,
                });
                below = Some(steps.len() - 1);
            }
            left.extend(piece.inner.iter().map(|&inner| (inner, below)));
        }
        steps
    }

    fn gain(&self, piece: &Piece, below: usize) -> f64 {
        piece.area * (self.levels[piece.level] - self.levels[below])
    }
}

/// Sets of triangles that hang together: a forest with halved paths.
struct Joined {
    parents: Vec<Option<usize>>,
}

impl Joined {
    fn new(triangles: usize) -> Self {
        Self {
            parents: vec![None; triangles],
        }
    }

    /// Adds a triangle and joins it with those beside it.
    fn add(&mut self, triangle: usize, beside: &[Option<usize>; 3]) {
        self.parents[triangle] = Some(triangle);
        for beside in beside.iter().flatten() {
            if self.parents[*beside].is_some() {
                let (root, other) = (self.root(triangle), self.root(*beside));
                self.parents[other] = Some(root);
            }
        }
    }

    fn root(&mut self, mut triangle: usize) -> usize {
        while let Some(parent) = self.parents[triangle]
            && parent != triangle
        {
            self.parents[triangle] = self.parents[parent];
            triangle = parent;
        }
        triangle
    }
}
