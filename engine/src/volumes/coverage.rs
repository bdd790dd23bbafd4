//! [`Coverage`]: how much street there is in a rectangle, to weigh volumes by what they serve.

use crate::Street;
use glam::DVec2;

/// Cells of one raster at the most; larger blocks get coarser cells.
const MOST_CELLS: f64 = 4e6;

/// A summed-area table of the street area of one block.
///
/// It steers where volumes are worth having, and never decides whether one is right.
#[derive(Debug)]
pub struct Coverage {
    min: DVec2,
    cell: f64,
    columns: usize,
    rows: usize,
    /// Street area below and left of each cell corner, square metres; row by row.
    sums: Vec<f64>,
}

impl Coverage {
    /// Draws `streets` into `window` with cells of about `cell` metres.
    pub fn new(streets: &[&Street], window: [DVec2; 2], cell: f64) -> Self {
        let size = window[1] - window[0];
        let cell = cell.max((size.element_product() / MOST_CELLS).sqrt());
        let columns = (size.x / cell).ceil().max(1.0) as usize;
        let rows = (size.y / cell).ceil().max(1.0) as usize;
        let mut filled = vec![false; columns * rows];
        for street in streets {
            fill(&mut filled, columns, street, window[0], cell);
        }
        let stride = columns + 1;
        let mut sums = vec![0.0; stride * (rows + 1)];
        for row in 0..rows {
            let mut run = 0.0;
            for column in 0..columns {
                run += if filled[row * columns + column] {
                    cell * cell
                } else {
                    0.0
                };
                sums[(row + 1) * stride + column + 1] = sums[row * stride + column + 1] + run;
            }
        }
        Self {
            min: window[0],
            cell,
            columns,
            rows,
            sums,
        }
    }

    /// Street area in square metres within a lane's interval: `span` along `axis`, `lane` across.
    pub fn area(&self, axis: usize, lane: [f64; 2], span: [f64; 2]) -> f64 {
        let corner = |i: usize, j: usize| match axis {
            0 => self.sum(DVec2::new(span[i], lane[j])),
            _ => self.sum(DVec2::new(lane[j], span[i])),
        };
        (corner(1, 1) - corner(0, 1) - corner(1, 0) + corner(0, 0)).max(0.0)
    }

    /// `span` without the parts at its ends that hold no street, kept one cell wide of it.
    pub fn trimmed(&self, axis: usize, lane: [f64; 2], span: [f64; 2]) -> Option<[f64; 2]> {
        let empty = |from: f64, to: f64| self.area(axis, lane, [from, to]) < 1e-6;
        if empty(span[0], span[1]) {
            return None;
        }
        // Bisection: both ends move inward over what is empty.
        let (mut low, mut high) = (0.0, span[1] - span[0]);
        while high - low > self.cell {
            let middle = (low + high) / 2.0;
            if empty(span[0], span[0] + middle) {
                low = middle
            } else {
                high = middle
            }
        }
        let start = span[0] + (low - self.cell).max(0.0);
        (low, high) = (0.0, span[1] - start);
        while high - low > self.cell {
            let middle = (low + high) / 2.0;
            if empty(span[1] - middle, span[1]) {
                low = middle
            } else {
                high = middle
            }
        }
        let end = span[1] - (low - self.cell).max(0.0);
        (start < end).then_some([start, end])
    }

    /// Street area below and left of a point, interpolated within cells.
    fn sum(&self, point: DVec2) -> f64 {
        let most = DVec2::new(self.columns as f64, self.rows as f64);
        let at = ((point - self.min) / self.cell).clamp(DVec2::ZERO, most);
        let (column, row) = (
            (at.x as usize).min(self.columns - 1),
            (at.y as usize).min(self.rows - 1),
        );
        let (s, t) = (at.x - column as f64, at.y - row as f64);
        let base = row * (self.columns + 1) + column;
        let above = base + self.columns + 1;
        (self.sums[base] * (1.0 - s) + self.sums[base + 1] * s) * (1.0 - t)
            + (self.sums[above] * (1.0 - s) + self.sums[above + 1] * s) * t
    }
}

/// Marks the cells whose middle is in the street, by the even-odd rule along each row.
fn fill(filled: &mut [bool], columns: usize, street: &Street, min: DVec2, cell: f64) {
    let rings = || std::iter::once(street.area.exterior()).chain(street.area.interiors());
    for (row, cells) in filled.chunks_mut(columns).enumerate() {
        let y = min.y + (row as f64 + 0.5) * cell;
        let mut crossings: Vec<f64> = rings()
            .flat_map(|ring| ring.lines())
            .filter(|line| (line.start.y > y) != (line.end.y > y))
            .map(|line| {
                let t = (y - line.start.y) / (line.end.y - line.start.y);
                line.start.x + t * (line.end.x - line.start.x)
            })
            .collect();
        crossings.sort_by(f64::total_cmp);
        for pair in crossings.chunks_exact(2) {
            let column = |x: f64| ((x - min.x) / cell - 0.5).ceil().max(0.0) as usize;
            let end = column(pair[1]).min(columns);
            cells[column(pair[0]).min(end)..end].fill(true);
        }
    }
}
