//! [`Horizon`], the upper envelope of all that hides, by place around the eye.

use super::PLACE_MARGIN;
use super::projection::{SIDES, Side, Span};

/// Slices of equal width on a side. A slice holds few pieces, and knows the lowest of them.
const SLICES: usize = 64;

/// Slices per unit of place.
const DENSITY: f64 = SLICES as f64 / 2.0;

/// A straight part of the horizon: all below it is hidden, by the occluder `tag`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    pub from: f64,
    pub to: f64,
    pub at_zero: f64,
    pub rise: f64,
    /// Whether what hides begins there, and so does not hide along the sight line that grazes it.
    pub begins: bool,
    /// Whether it ends there.
    pub ends: bool,
    pub tag: u32,
}

impl Piece {
    /// The part of a wall that a span shows.
    pub fn new(span: &Span, begins: bool, ends: bool, tag: u32) -> Self {
        Self {
            from: span.from,
            to: span.to,
            at_zero: span.at_zero,
            rise: span.rise,
            begins,
            ends,
            tag,
        }
    }

    #[inline]
    pub fn value(&self, t: f64) -> f64 {
        self.at_zero + self.rise * t
    }

    /// The part between two places; where it is cut, it goes on beyond.
    #[inline]
    fn part(&self, from: f64, to: f64) -> Self {
        Self {
            from,
            to,
            begins: self.begins && from <= self.from,
            ends: self.ends && to >= self.to,
            ..*self
        }
    }

    #[inline]
    fn lowest(&self) -> f64 {
        self.value(self.from).min(self.value(self.to))
    }
}

/// A narrow range of places with its pieces in order.
#[derive(Clone, Debug, Default)]
struct Slice {
    pieces: Vec<Piece>,
    /// Lowest value, if all of the slice is covered without a crack.
    floor: f64,
}

impl Slice {
    /// Puts in the part of a piece that lies in this slice, keeping the higher of what overlaps.
    /// Every part that is left is one of something that hides, so that no rounding of a crossing
    /// can hide too much.
    fn raise(&mut self, new: &Piece, scratch: &mut Vec<Piece>) {
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
        for &old in &self.pieces[first..last] {
            if old.from < done {
                push(scratch, old.part(old.from, done));
            } else if old.from > done {
                push(scratch, new.part(done, old.from));
            }
            let (from, to) = (done.max(old.from), new.to.min(old.to));
            higher(scratch, new, &old, from, to);
            if old.to > new.to {
                push(scratch, old.part(new.to, old.to));
            }
            done = to;
        }
        if done < new.to {
            push(scratch, new.part(done, new.to));
        }
        self.pieces.splice(first..last, scratch.drain(..));
    }

    /// The floor of these bounds, found anew.
    fn settle(&mut self, from: f64, to: f64) {
        let [first, .., last] = self.pieces[..] else {
            let single = self.pieces.first();
            let whole = single.filter(|piece| piece.from <= from && piece.to >= to);
            self.floor = whole.map_or(f64::NEG_INFINITY, Piece::lowest);
            return;
        };
        let sealed = first.from <= from
            && last.to >= to
            && self.pieces.windows(2).all(|pair| meet(&pair[0], &pair[1]));
        self.floor = if sealed {
            self.pieces
                .iter()
                .map(Piece::lowest)
                .fold(f64::INFINITY, f64::min)
        } else {
            f64::NEG_INFINITY
        };
    }

    /// Calls `seen` with each range of places where a line is not below the horizon, until it
    /// returns false; returns whether it never did.
    fn compare(
        &self,
        line: &Span,
        from: f64,
        to: f64,
        seen: &mut impl FnMut(f64, f64) -> bool,
    ) -> bool {
        if line.value(from).max(line.value(to)) < self.floor {
            return true;
        }
        let first = self.pieces.partition_point(|piece| piece.to <= from);
        let mut done = from;
        let mut before = first.checked_sub(1).map(|at| &self.pieces[at]);
        for piece in &self.pieces[first..] {
            if piece.from > to {
                break;
            }
            let is_gap = piece.from > done;
            if is_gap && !seen(done, piece.from) {
                return false;
            }
            let crack =
                piece.from >= done && piece.begins && !before.is_some_and(|b| meet(b, piece));
            if crack && !is_gap && !seen(piece.from, piece.from) {
                return false;
            }
            let (begin, end) = (done.max(piece.from), to.min(piece.to));
            if !above(line, piece, begin, end, seen) {
                return false;
            }
            done = end;
            before = Some(piece);
            if done >= to {
                break;
            }
        }
        done >= to || seen(done, to)
    }
}

/// Calls `seen` with the part of a range where a line is not below a piece, if there is one.
fn above(
    line: &Span,
    piece: &Piece,
    from: f64,
    to: f64,
    seen: &mut impl FnMut(f64, f64) -> bool,
) -> bool {
    let below_at = |t: f64| line.value(t) < piece.value(t);
    match (below_at(from), below_at(to)) {
        (true, true) => true,
        (false, false) => seen(from, to),
        (first, _) => {
            let crossing = crossing(
                line.at_zero - piece.at_zero,
                line.rise - piece.rise,
                from,
                to,
            );
            if first {
                seen(crossing, to)
            } else {
                seen(from, crossing)
            }
        }
    }
}

/// Where `at_zero + rise * t` changes its sign, between two places.
fn crossing(at_zero: f64, rise: f64, from: f64, to: f64) -> f64 {
    (-at_zero / rise).clamp(from, to)
}

/// Whether pieces in a row cover a new one, so that it adds nothing.
fn covered(pieces: &[Piece], new: &Piece) -> bool {
    let mut done = new.from;
    for old in pieces {
        let (from, to) = (done, new.to.min(old.to));
        let is_below = |t: f64| new.value(t) <= old.value(t);
        if old.from > from || !is_below(from) || !is_below(to) {
            return false;
        }
        done = to;
    }
    done >= new.to
}

/// Adds, of two pieces over one range, the higher parts.
fn higher(scratch: &mut Vec<Piece>, new: &Piece, old: &Piece, from: f64, to: f64) {
    let lead = |t: f64| new.value(t) - old.value(t);
    let (first, last) = (lead(from), lead(to));
    if first <= 0.0 && last <= 0.0 {
        push(scratch, old.part(from, to));
    } else if first >= 0.0 && last >= 0.0 {
        push(scratch, new.part(from, to));
    } else {
        let middle = crossing(new.at_zero - old.at_zero, new.rise - old.rise, from, to);
        let (left, right) = if first > 0.0 { (new, old) } else { (old, new) };
        push(scratch, left.part(from, middle));
        push(scratch, right.part(middle, to));
    }
}

/// Adds a piece, joined to the one before it where both are parts of the same.
fn push(pieces: &mut Vec<Piece>, piece: Piece) {
    if piece.from >= piece.to {
        return;
    }
    if let Some(last) = pieces.last_mut()
        && last.to == piece.from
        && (last.at_zero, last.rise, last.tag) == (piece.at_zero, piece.rise, piece.tag)
        && !(last.ends && piece.begins)
    {
        last.to = piece.to;
        last.ends = piece.ends;
        return;
    }
    pieces.push(piece);
}

/// Whether two pieces leave no crack between them: where one thing ends and another begins at the
/// very same place, the sight line between both grazes them and meets neither.
fn meet(left: &Piece, right: &Piece) -> bool {
    left.to >= right.from && !(left.ends && right.begins)
}

/// The horizon all around.
#[derive(Clone, Debug)]
pub struct Horizon {
    slices: Vec<Slice>,
    scratch: Vec<Piece>,
}

impl Horizon {
    pub fn new() -> Self {
        let mut horizon = Self {
            slices: vec![Slice::default(); SIDES * SLICES],
            scratch: Vec::new(),
        };
        horizon.clear();
        horizon
    }

    /// Nothing hides any more.
    pub fn clear(&mut self) {
        for slice in &mut self.slices {
            slice.pieces.clear();
            slice.floor = f64::NEG_INFINITY;
        }
    }

    /// Adds what hides all below it.
    pub fn raise(&mut self, side: Side, piece: &Piece) {
        // Also of what is not a number.
        if !(piece.from < piece.to
            && piece.value(piece.from).max(piece.value(piece.to)) > f64::NEG_INFINITY)
        {
            return;
        }
        let (first, last) = (slice_after(piece.from), slice_before(piece.to));
        for slice in first..=last {
            let (from, to) = bounds(slice);
            let part = piece.part(piece.from.max(from), piece.to.min(to));
            let slot = &mut self.slices[side.0 * SLICES + slice];
            if part.value(part.from).max(part.value(part.to)) > slot.floor {
                slot.raise(&part, &mut self.scratch);
                slot.settle(from, to);
            }
        }
    }

    /// Whether a piece would add nothing to one slice's worth of the horizon.
    pub fn covers(&self, side: Side, piece: &Piece) -> bool {
        let (first, last) = (slice_after(piece.from), slice_before(piece.to));
        (first..=last).all(|slice| {
            let (from, to) = bounds(slice);
            let part = piece.part(piece.from.max(from), piece.to.min(to));
            let slot = &self.slices[side.0 * SLICES + slice];
            if part.value(part.from).max(part.value(part.to)) <= slot.floor {
                return true;
            }
            let first = slot.pieces.partition_point(|old| old.to <= part.from);
            covered(&slot.pieces[first..], &part)
        })
    }

    /// Whether all of a line is below the horizon.
    pub fn hides(&self, line: &Span) -> bool {
        self.compare(line, &mut |_, _| false)
    }

    /// Calls `seen` with each range of places where a line is not below the horizon, until it
    /// returns false; returns whether it never did. A crack is a range without width.
    pub fn compare(&self, line: &Span, seen: &mut impl FnMut(f64, f64) -> bool) -> bool {
        let from = (line.from - PLACE_MARGIN).max(-1.0);
        let to = (line.to + PLACE_MARGIN).min(1.0);
        // Of what is not a number, nothing is known.
        if from.is_nan() || to.is_nan() || from > to {
            return seen(-1.0, 1.0);
        }
        let (first, last) = (slice_after(from), slice_before(to));
        // A target of no width on a bound belongs to the slice after it.
        let last = last.max(first);
        for slice in first..=last {
            let (begin, end) = bounds(slice);
            let at = line.side.0 * SLICES + slice;
            let crosses = begin > from || (from <= -1.0 && slice == 0);
            if crosses && self.is_cracked_before(at) && !seen(begin, begin) {
                return false;
            }
            let part = (from.max(begin), to.min(end));
            if !self.slices[at].compare(line, part.0, part.1, seen) {
                return false;
            }
        }
        let reaches_end = to >= bounds(last).1;
        let after = (line.side.0 * SLICES + last + 1) % self.slices.len();
        !(reaches_end && self.is_cracked_before(after) && !seen(to, to))
    }

    /// Whether a sight line passes between a slice and the one before it.
    fn is_cracked_before(&self, slice: usize) -> bool {
        let before = (slice + self.slices.len() - 1) % self.slices.len();
        let ends = self.slices[before]
            .pieces
            .last()
            .is_none_or(|piece| piece.ends);
        let begins = self.slices[slice]
            .pieces
            .first()
            .is_none_or(|piece| piece.begins);
        ends && begins
    }
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
