//! [`Horizon`], the upper envelope of all that hides, by place around the eye.

use std::ops::Range;

use glam::DVec2;

use super::PLACE_MARGIN;
use super::projection::{Edge, SIDES, Side, Span};

/// A slope above all others.
pub const SUMMIT: f64 = 1e300;

/// Slices of equal width on a side. A slice holds few pieces, and knows the lowest of them.
const SLICES: usize = 64;

/// Slices all around.
pub const COUNT: usize = SIDES * SLICES;

/// Slices per unit of place.
const DENSITY: f64 = SLICES as f64 / 2.0;

/// A narrow range of places.
#[derive(Clone, Debug)]
struct Slice {
    /// Parts of what hides, in order and without overlaps: all below them is hidden.
    pieces: Vec<Span>,
    /// Lowest value, if all of the slice is covered.
    floor: f64,
}

impl Slice {
    /// Where nothing hides.
    const EMPTY: Self = Self {
        pieces: Vec::new(),
        floor: f64::NEG_INFINITY,
    };

    /// Puts in the part of a piece that lies in this slice, keeping the higher of what overlaps.
    /// Every part that is left is one of something that hides, so that no rounding of a crossing
    /// can hide too much.
    fn raise(&mut self, new: &Span, scratch: &mut Vec<Span>) {
        let first = self.pieces.partition_point(|piece| piece.to <= new.from);
        let last = first
            + self.pieces[first..]
                .iter()
                .take_while(|piece| piece.from < new.to)
                .count();
        if covered(&self.pieces[first..last], new) {
            return;
        }
        scratch.clear();
        let mut done = new.from;
        for old in &self.pieces[first..last] {
            if old.from < done {
                push(scratch, old.part(old.from, done));
            } else {
                push(scratch, new.part(done, old.from));
            }
            let (from, to) = (done.max(old.from), new.to.min(old.to));
            higher(scratch, new, old, from, to);
            push(scratch, old.part(new.to, old.to));
            done = to;
        }
        push(scratch, new.part(done, new.to));
        self.pieces.splice(first..last, scratch.drain(..));
    }

    /// The floor of these bounds, found anew.
    fn settle(&mut self, from: f64, to: f64) {
        let mut done = from;
        let mut floor = f64::INFINITY;
        for piece in &self.pieces {
            if piece.from > done {
                break;
            }
            floor = floor.min(piece.lowest());
            done = piece.to;
        }
        self.floor = if done >= to { floor } else { f64::NEG_INFINITY };
    }

    /// Whether a piece would add nothing.
    fn covers(&self, new: &Span) -> bool {
        let first = self.pieces.partition_point(|piece| piece.to <= new.from);
        new.highest() <= self.floor || covered(&self.pieces[first..], new)
    }

    /// Whether all of a line is below the horizon.
    fn hides(&self, line: &Span) -> bool {
        if line.highest() < self.floor {
            return true;
        }
        let first = self.pieces.partition_point(|piece| piece.to <= line.from);
        let mut done = line.from;
        for piece in &self.pieces[first..] {
            let end = line.to.min(piece.to);
            let is_below = |t: f64| line.value(t) < piece.value(t);
            if piece.from > done || !is_below(done) || !is_below(end) {
                return false;
            }
            done = end;
            if done >= line.to {
                return true;
            }
        }
        false
    }

    /// Gives `found` where a line is not below the horizon, or a rounding more.
    fn gaps(&self, line: &Span, found: &mut impl FnMut(f64, f64)) {
        if line.highest() < self.floor {
            return;
        }
        let first = self.pieces.partition_point(|piece| piece.to <= line.from);
        let mut done = line.from;
        for piece in &self.pieces[first..] {
            if piece.from >= line.to {
                break;
            }
            if piece.from > done {
                found(done, piece.from);
            }
            let (from, to) = (done.max(piece.from), line.to.min(piece.to));
            let is_below = |t: f64| line.value(t) < piece.value(t);
            let crossing = (piece.at_zero - line.at_zero) / (line.rise - piece.rise);
            match (is_below(from), is_below(to)) {
                (true, true) => {}
                (true, false) => found(crossing.clamp(from, to), to),
                (false, true) => found(from, crossing.clamp(from, to)),
                (false, false) => found(from, to),
            }
            done = to;
        }
        if done < line.to {
            found(done, line.to);
        }
    }
}

/// Whether pieces in a row cover a new one, so that it adds nothing.
fn covered(pieces: &[Span], new: &Span) -> bool {
    let mut done = new.from;
    for old in pieces {
        let (from, to) = (done, new.to.min(old.to));
        let is_below = |t: f64| new.value(t) <= old.value(t);
        if old.from > from || !is_below(from) || !is_below(to) {
            return false;
        }
        done = to;
        if done >= new.to {
            return true;
        }
    }
    false
}

/// Adds, of two pieces over one range, the higher parts.
fn higher(scratch: &mut Vec<Span>, new: &Span, old: &Span, from: f64, to: f64) {
    let lead = |t: f64| new.value(t) - old.value(t);
    let (first, last) = (lead(from), lead(to));
    if first <= 0.0 && last <= 0.0 {
        push(scratch, old.part(from, to));
    } else if first >= 0.0 && last >= 0.0 {
        push(scratch, new.part(from, to));
    } else {
        let crossing = (old.at_zero - new.at_zero) / (new.rise - old.rise);
        let middle = crossing.clamp(from, to);
        let (left, right) = if first > 0.0 { (new, old) } else { (old, new) };
        push(scratch, left.part(from, middle));
        push(scratch, right.part(middle, to));
    }
}

/// Adds a piece if it has some width, joined to the one before it where both are parts of one line.
fn push(pieces: &mut Vec<Span>, piece: Span) {
    if piece.from >= piece.to {
        return;
    }
    match pieces.last_mut() {
        Some(last)
            if last.to == piece.from
                && (last.at_zero, last.rise) == (piece.at_zero, piece.rise) =>
        {
            last.to = piece.to;
        }
        _ => pieces.push(piece),
    }
}

/// The horizon all around.
#[derive(Clone, Debug)]
pub struct Horizon {
    slices: Vec<Slice>,
    scratch: Vec<Span>,
}

impl Horizon {
    pub fn new() -> Self {
        Self {
            slices: vec![Slice::EMPTY; COUNT],
            scratch: Vec::new(),
        }
    }

    /// Nothing hides any more.
    pub fn clear(&mut self) {
        for slice in &mut self.slices {
            slice.pieces.clear();
            slice.floor = f64::NEG_INFINITY;
        }
    }

    /// Hides all in the directions anticlockwise from one to another.
    pub fn shut_between(&mut self, from: DVec2, to: DVec2) {
        let (begin, end) = (Side::leaving(from), Side::reaching(to));
        let (first, last) = (begin.place(from), end.place(to));
        let steps = match (end.0 + SIDES - begin.0) % SIDES {
            0 if first >= last => SIDES,
            steps => steps,
        };
        for step in 0..=steps {
            self.raise(&Span {
                side: Side((begin.0 + step) % SIDES),
                from: if step == 0 { first } else { -1.0 },
                to: if step == steps { last } else { 1.0 },
                at_zero: SUMMIT,
                rise: 0.0,
            });
        }
    }

    /// Hides all in the directions beside some lines.
    pub fn shut_beside(&mut self, lines: &[Span]) {
        for side in (0..SIDES).map(Side) {
            let mut ends: Vec<(f64, f64)> = lines
                .iter()
                .filter(|line| line.side == side)
                .map(|line| (line.from - PLACE_MARGIN, line.to + PLACE_MARGIN))
                .collect();
            ends.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            ends.push((1.0, 1.0));
            let mut done = -1.0_f64;
            for (from, to) in ends {
                self.raise(&Span {
                    side,
                    from: done,
                    to: from.min(1.0),
                    at_zero: SUMMIT,
                    rise: 0.0,
                });
                done = done.max(to);
            }
        }
    }

    /// Hides all in a slice.
    pub fn shut_slice(&mut self, at: usize) {
        let (from, to) = bounds(at % SLICES);
        let slice = &mut self.slices[at];
        slice.pieces.clear();
        slice.pieces.push(Span {
            side: Side(at / SLICES),
            from,
            to,
            at_zero: SUMMIT,
            rise: 0.0,
        });
        slice.floor = SUMMIT;
    }

    /// Whether what is below an edge, which is not seen edge on and no higher above the eye than this, is
    /// below the lowest of each slice. Other edges may be below the horizon as well.
    pub fn is_above(&self, edge: &Edge, height: f64) -> bool {
        let (first, last) = edge.anticlockwise();
        let (begin, end) = (Side::leaving(first), Side::reaching(last));
        let highest = if begin == end {
            let depths = [begin.frame(first).0, begin.frame(last).0];
            let depth = if height > 0.0 {
                depths[0].min(depths[1])
            } else {
                depths[0].max(depths[1])
            };
            height / depth
        } else {
            // Of a side in between, the nearest point is not known.
            SUMMIT
        };
        let first = begin.0 * SLICES + slice_after(begin.place(first));
        let last = end.0 * SLICES + slice_before(end.place(last));
        let count = (last + COUNT - first) % COUNT;
        (first..=first + count).all(|at| highest <= self.slices[at % COUNT].floor)
    }

    /// Adds what hides all below it.
    pub fn raise(&mut self, piece: &Span) {
        for (at, part) in parts(piece) {
            let slice = &mut self.slices[at];
            if part.highest() > slice.floor {
                slice.raise(&part, &mut self.scratch);
                let (from, to) = bounds(at % SLICES);
                slice.settle(from, to);
            }
        }
    }

    /// Whether a piece would add nothing.
    pub fn covers(&self, piece: &Span) -> bool {
        parts(piece).all(|(at, part)| self.slices[at].covers(&part))
    }

    /// Gives `found` the places at which a line is not below the horizon, from one to another, in
    /// order; those that touch may come in parts.
    pub fn gaps(&self, line: &Span, found: &mut impl FnMut(f64, f64)) {
        let (from, to) = widened(line);
        if from < to {
            for (at, part) in parts(&line.part(from, to)) {
                self.slices[at].gaps(&part, found);
            }
        } else {
            // Of what is not a number, nothing is known.
            found(-1.0, 1.0);
        }
    }

    /// The highest of all that was raised, anticlockwise.
    pub fn pieces(&self) -> impl Iterator<Item = &Span> {
        self.slices.iter().flat_map(|slice| &slice.pieces)
    }

    /// Whether all of a line is below the horizon.
    pub fn hides(&self, line: &Span) -> bool {
        let (from, to) = widened(line);
        // Of what is not a number, nothing is known.
        from < to && parts(&line.part(from, to)).all(|(at, part)| self.slices[at].hides(&part))
    }
}

/// The slices that a line passes, a little widened.
pub fn slices(line: &Span) -> Range<usize> {
    let (from, to) = widened(line);
    let first = line.side.0 * SLICES;
    match from < to {
        true => first + slice_after(from)..first + slice_before(to) + 1,
        // Of what is not a number, nothing is known.
        false => 0..COUNT,
    }
}

/// Where a line may be, given the roundings of places.
fn widened(line: &Span) -> (f64, f64) {
    let from = (line.from - PLACE_MARGIN).max(-1.0);
    (from, (line.to + PLACE_MARGIN).min(1.0))
}

/// The parts of a line in the slices that it passes; none if it has no width.
fn parts(line: &Span) -> impl Iterator<Item = (usize, Span)> + use<> {
    let line = *line;
    let slices = if line.from < line.to {
        slice_after(line.from)..slice_before(line.to) + 1
    } else {
        0..0
    };
    slices.map(move |slice| {
        let (from, to) = bounds(slice);
        let part = line.part(line.from.max(from), line.to.min(to));
        (line.side.0 * SLICES + slice, part)
    })
}

/// The slice in which places from `t` upwards lie.
#[inline]
fn slice_after(t: f64) -> usize {
    let slice = near(t);
    if t < bounds(slice).0 {
        slice - 1
    } else if t >= bounds(slice).1 && slice + 1 < SLICES {
        slice + 1
    } else {
        slice
    }
}

/// The slice in which places up to `t` lie.
#[inline]
fn slice_before(t: f64) -> usize {
    let slice = near(t);
    if t <= bounds(slice).0 && slice > 0 {
        slice - 1
    } else if t > bounds(slice).1 && slice + 1 < SLICES {
        slice + 1
    } else {
        slice
    }
}

/// The slice of a place, give or take one.
#[inline]
fn near(t: f64) -> usize {
    (((t + 1.0) * DENSITY) as usize).min(SLICES - 1)
}

/// The places between which a slice lies; exact.
#[inline]
fn bounds(slice: usize) -> (f64, f64) {
    let at = |slice: usize| slice as f64 / DENSITY - 1.0;
    (at(slice), at(slice + 1))
}
