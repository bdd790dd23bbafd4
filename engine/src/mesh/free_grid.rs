//! [`FreeGrid`], the cells that a surface leaves free, and the largest box of them.

use glam::DVec3;

use super::clip::Clip;
use crate::Box3d;

/// Half the width of the thin layer of cells in which the envelope's own faces lie, as a share of
/// the envelope's size.
const SKIN: f64 = 1e-3;

/// A grid around a mesh; a cell is free when no triangle meets it.
///
/// No grid plane holds a vertex, so no triangle lies in one: a triangle that meets the plane
/// between two cells meets a cell, and the union of free cells is free.
pub struct FreeGrid {
    lines: [Vec<f64>; 3],
    /// For each column of cells (x-major), one bit a layer: not free.
    taken: Vec<u64>,
}

/// A box of cells: first and one past the last, on each axis.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct CellBox {
    low: [usize; 3],
    high: [usize; 3],
}

impl FreeGrid {
    /// At most this many cells a side: the layers of a column are the bits of a word.
    pub const MOST_CELLS: usize = 60;

    /// Lays `cells` cells a side (and a thin one at each end) over the envelope, and takes away
    /// what the triangles meet and what can be reached from outside. `None` when the envelope is
    /// too flat for distinct grid lines.
    pub fn new(triangles: &[[DVec3; 3]], envelope: &Box3d, cells: usize) -> Option<Self> {
        let lines: [Vec<f64>; 3] =
            std::array::from_fn(|axis| grid_lines(triangles, envelope, axis, cells));
        if lines.iter().any(|lines| lines.len() < cells + 5) {
            return None;
        }
        let columns = (lines[0].len() - 1) * (lines[1].len() - 1);
        let mut grid = Self {
            lines,
            taken: vec![0; columns],
        };
        let mut clip = [Clip::default(), Clip::default()];
        for triangle in triangles {
            grid.take_triangle(triangle, &mut clip);
        }
        grid.take_connected(0, 0, 0);
        Some(grid)
    }

    fn cells(&self, axis: usize) -> usize {
        self.lines[axis].len() - 1
    }

    fn column(&self, x: usize, y: usize) -> usize {
        x * self.cells(1) + y
    }

    /// Marks the cells that the triangle meets: it is cut into slabs, those into columns, and what
    /// is left spans a run of layers.
    fn take_triangle(&mut self, triangle: &[DVec3; 3], [slab, piece]: &mut [Clip; 2]) {
        slab.reset(triangle);
        let Some((low, high)) = slab.extent(0) else {
            return;
        };
        for x in span(&self.lines[0], low, high) {
            slab.reset(triangle);
            slab.cut(0, self.lines[0][x], self.lines[0][x + 1]);
            let Some((low, high)) = slab.extent(1) else {
                continue;
            };
            for y in span(&self.lines[1], low, high) {
                piece.reset_to(slab);
                piece.cut(1, self.lines[1][y], self.lines[1][y + 1]);
                let Some((low, high)) = piece.extent(2) else {
                    continue;
                };
                let column = self.column(x, y);
                self.taken[column] |= layers(span(&self.lines[2], low, high));
            }
        }
    }

    /// Takes away the free cells that hang together, face by face, with the given one.
    fn take_connected(&mut self, x: usize, y: usize, z: usize) {
        let mut stack = vec![(x, y, 1u64 << z)];
        while let Some((x, y, seed)) = stack.pop() {
            let column = self.column(x, y);
            let free = !self.taken[column] & layers(0..self.cells(2));
            let run = spread(seed & free, free);
            if run == 0 {
                continue;
            }
            self.taken[column] |= run;
            let beside = [
                (x.wrapping_sub(1), y),
                (x + 1, y),
                (x, y.wrapping_sub(1)),
                (x, y + 1),
            ];
            let inside = |&(x, y): &(usize, usize)| x < self.cells(0) && y < self.cells(1);
            stack.extend(
                beside
                    .iter()
                    .filter(|&place| inside(place))
                    .map(|&(x, y)| (x, y, run)),
            );
        }
    }

    /// Takes away the free cells connected with the box's first cell.
    pub fn reject(&mut self, cells: &CellBox) {
        let [x, y, z] = cells.low;
        self.take_connected(x, y, z);
    }

    /// The box in metres.
    pub fn bounds(&self, cells: &CellBox) -> Box3d {
        let corner = |ends: [usize; 3]| {
            DVec3::from_array(std::array::from_fn(|axis| self.lines[axis][ends[axis]]))
        };
        Box3d {
            min: corner(cells.low),
            max: corner(cells.high),
        }
    }

    /// The free box of cells with the largest volume.
    pub fn largest_box(&self) -> Option<CellBox> {
        let mut best = None;
        let mut most = 0.0;
        let layer_count = self.cells(2);
        // Tall boxes first: they prune best, and in a city they win.
        for height in (1..=layer_count).rev() {
            for low in 0..=layer_count - height {
                let high = low + height;
                let rise = self.lines[2][high] - self.lines[2][low];
                let mask = layers(low..high);
                if rise * self.free_area(mask) <= most {
                    continue;
                }
                if let Some((area, [x, y])) = self.largest_rectangle(mask, most / rise) {
                    most = area * rise;
                    best = Some(CellBox {
                        low: [x.0, y.0, low],
                        high: [x.1, y.1, high],
                    });
                }
            }
        }
        best
    }

    /// Total ground area of the columns that are free in the layers of `mask`.
    fn free_area(&self, mask: u64) -> f64 {
        let widths: Vec<f64> = self.lines[1]
            .windows(2)
            .map(|line| line[1] - line[0])
            .collect();
        let rows = self
            .taken
            .chunks(widths.len())
            .zip(self.lines[0].windows(2));
        rows.map(|(row, line)| {
            let free = row
                .iter()
                .zip(&widths)
                .filter(|(taken, _)| *taken & mask == 0);
            free.map(|(_, width)| width).sum::<f64>() * (line[1] - line[0])
        })
        .sum()
    }

    /// The largest rectangle, of more than `least` area, of columns that are free in the layers of
    /// `mask`: row by row, the largest rectangle under the histogram of free runs.
    fn largest_rectangle(&self, mask: u64, least: f64) -> Option<(f64, [(usize, usize); 2])> {
        let (xs, ys) = (&self.lines[0], &self.lines[1]);
        let mut most = least;
        let mut best = None;
        // The first slab of the free run that ends in the current one, for each y.
        let mut starts = vec![0; self.cells(1)];
        let mut open: Vec<(usize, usize)> = Vec::new();
        for x in 0..self.cells(0) {
            for (y, start) in starts.iter_mut().enumerate() {
                if self.taken[self.column(x, y)] & mask != 0 {
                    *start = x + 1;
                }
            }
            open.clear();
            for y in 0..=starts.len() {
                let start = starts.get(y).copied().unwrap_or(usize::MAX);
                let mut from = y;
                // Runs that reach farther back than this one end here.
                while let Some(&(first, run)) = open.last().filter(|(_, run)| *run < start) {
                    open.pop();
                    from = first;
                    let area = (xs[x + 1] - xs[run]) * (ys[y] - ys[first]);
                    if run <= x && area > most {
                        most = area;
                        best = Some((area, [(run, x + 1), (first, y)]));
                    }
                }
                if open.last().is_none_or(|&(_, run)| run > start) {
                    open.push((from, start));
                }
            }
        }
        best
    }
}

/// Increasing grid lines that avoid the vertices: one before the envelope, a skin around each of
/// its faces, and `cells` equal cells between.
fn grid_lines(triangles: &[[DVec3; 3]], envelope: &Box3d, axis: usize, cells: usize) -> Vec<f64> {
    let (low, size) = (envelope.min[axis], envelope.size()[axis]);
    let mut vertices: Vec<f64> = triangles
        .iter()
        .flatten()
        .map(|corner| corner[axis])
        .collect();
    vertices.sort_unstable_by(f64::total_cmp);
    let inner = (0..=cells).map(|i| SKIN + (1.0 - 2.0 * SKIN) * i as f64 / cells as f64);
    let shares = [-2.0 * SKIN, -SKIN]
        .into_iter()
        .chain(inner)
        .chain([1.0 + SKIN, 1.0 + 2.0 * SKIN]);
    let mut lines: Vec<f64> = shares
        .map(|share| {
            let mut line = low + share * size;
            while vertices.binary_search_by(|v| v.total_cmp(&line)).is_ok() {
                line = line.next_up();
            }
            line
        })
        .collect();
    lines.dedup_by(|next, line| *next <= *line);
    lines
}

/// The cells between `lines` whose inside meets `low..=high`.
fn span(lines: &[f64], low: f64, high: f64) -> std::ops::Range<usize> {
    let first = lines.partition_point(|&line| line <= low).saturating_sub(1);
    let end = lines
        .partition_point(|&line| line < high)
        .min(lines.len() - 1);
    first..end.max(first)
}

/// One bit for each layer of the range.
fn layers(range: std::ops::Range<usize>) -> u64 {
    let below = |end: usize| if end >= 64 { u64::MAX } else { (1 << end) - 1 };
    below(range.end) & !below(range.start)
}

/// The runs of `free` bits that hold a bit of `seed`.
fn spread(mut seed: u64, free: u64) -> u64 {
    loop {
        let wider = (seed | seed << 1 | seed >> 1) & free;
        if wider == seed {
            return seed;
        }
        seed = wider;
    }
}
