//! [`Side`], one of the four sides of the square through which the plan around the eye is seen, and
//! [`Span`], a straight line on it.

use glam::DVec2;

use super::EDGE_ON;

/// How many sides there are, anticlockwise from +x.
pub const SIDES: usize = 4;

/// A side: 0 looks along +x, 1 along +y, 2 along -x, 3 along -y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side(pub usize);

impl Side {
    /// Depth `w` along the side's direction and offset `u` to its left.
    #[inline]
    pub fn frame(self, point: DVec2) -> (f64, f64) {
        match self.0 {
            0 => (point.x, point.y),
            1 => (point.y, -point.x),
            2 => (-point.x, -point.y),
            _ => (-point.y, point.x),
        }
    }

    /// The point at depth 1 and a place.
    #[inline]
    pub fn direction(self, place: f64) -> DVec2 {
        match self.0 {
            0 => DVec2::new(1.0, place),
            1 => DVec2::new(-place, 1.0),
            2 => DVec2::new(-1.0, -place),
            _ => DVec2::new(place, -1.0),
        }
    }

    /// Place `u / w` of a point, from -1 to 1.
    #[inline]
    pub fn place(self, point: DVec2) -> f64 {
        let (w, u) = self.frame(point);
        u / w
    }

    /// The side of a point from which one turns anticlockwise, so that its place is below 1.
    #[inline]
    pub fn leaving(point: DVec2) -> Self {
        let DVec2 { x, y } = point;
        if x > 0.0 && -x <= y && y < x {
            Self(0)
        } else if y > 0.0 && -y < x && x <= y {
            Self(1)
        } else if x < 0.0 && x < y && y <= -x {
            Self(2)
        } else {
            Self(3)
        }
    }

    /// The side of a point to which one turns anticlockwise, so that its place is above -1.
    #[inline]
    pub fn reaching(point: DVec2) -> Self {
        let DVec2 { x, y } = point;
        if x > 0.0 && -x < y && y <= x {
            Self(0)
        } else if y > 0.0 && -y <= x && x < y {
            Self(1)
        } else if x < 0.0 && x <= y && y < -x {
            Self(2)
        } else {
            Self(3)
        }
    }
}

/// A straight line over a range of places on one side: `value(t) = at_zero + rise * t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    pub side: Side,
    pub from: f64,
    pub to: f64,
    pub at_zero: f64,
    pub rise: f64,
}

impl Span {
    #[inline]
    pub fn value(&self, t: f64) -> f64 {
        self.at_zero + self.rise * t
    }

    /// The same line over other places.
    #[inline]
    pub fn part(self, from: f64, to: f64) -> Self {
        Self { from, to, ..self }
    }

    /// Its lowest value.
    #[inline]
    pub fn lowest(&self) -> f64 {
        self.value(self.from).min(self.value(self.to))
    }

    /// Its highest value.
    #[inline]
    pub fn highest(&self) -> f64 {
        self.value(self.from).max(self.value(self.to))
    }

    /// The same line times a factor.
    #[inline]
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            at_zero: self.at_zero * factor,
            rise: self.rise * factor,
            ..self
        }
    }
}

/// How a straight edge in plan, relative to the eye, is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Facing {
    /// It runs anticlockwise around the eye.
    Left,
    /// It runs clockwise.
    Right,
    /// It runs towards the eye or away, or has no length.
    EdgeOn,
}

/// A straight edge in plan, relative to the eye.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    from: DVec2,
    to: DVec2,
    along: DVec2,
    /// Twice the area between the eye and the edge.
    area: f64,
}

impl Edge {
    #[inline]
    pub fn new(from: DVec2, to: DVec2) -> Self {
        let along = to - from;
        Self {
            from,
            to,
            along,
            area: from.perp_dot(along),
        }
    }

    #[inline]
    pub fn facing(&self) -> Facing {
        let reach = chebyshev(self.from).max(chebyshev(self.to)) * chebyshev(self.along);
        if self.area > EDGE_ON * reach {
            Facing::Left
        } else if self.area < -EDGE_ON * reach {
            Facing::Right
        } else {
            Facing::EdgeOn
        }
    }

    /// The inverse depth `1 / w` along the edge, side by side and anticlockwise, for an edge that is
    /// not seen edge on. The flags say whether a span begins and ends where the edge does.
    #[inline]
    pub fn spans(&self) -> impl Iterator<Item = (Span, bool, bool)> {
        // The line through the edge is where `normal · p = 1`.
        let normal = DVec2::new(self.along.y, -self.along.x) / self.area;
        let (first, last) = self.anticlockwise();
        let (begin, end) = (Side::leaving(first), Side::reaching(last));
        let steps = (end.0 + SIDES - begin.0) % SIDES;
        // An edge is seen over less than half a turn.
        let sides = if steps < SIDES - 1 { steps + 1 } else { 0 };
        (0..sides).map(move |step| {
            let side = Side((begin.0 + step) % SIDES);
            let (at_zero, rise) = side.frame(normal);
            let (starts, ends) = (step == 0, step + 1 == sides);
            let span = Span {
                side,
                from: if starts { side.place(first) } else { -1.0 },
                to: if ends { side.place(last) } else { 1.0 },
                at_zero,
                rise,
            };
            (span, starts, ends)
        })
    }

    /// Its ends, the clockwise one first as the eye sees them.
    #[inline]
    pub fn anticlockwise(&self) -> (DVec2, DVec2) {
        if self.area > 0.0 {
            (self.from, self.to)
        } else {
            (self.to, self.from)
        }
    }

    /// The vector whose product with a point of the edge is the height there, given those of its
    /// ends; and what its components are made of, without signs, for the roundings. For an edge that
    /// is not seen edge on.
    pub fn heights(&self, from: f64, to: f64) -> [DVec2; 2] {
        let level = DVec2::new(self.along.y, -self.along.x) * (from / self.area);
        let steep = DVec2::new(-self.from.y, self.from.x) * ((to - from) / self.area);
        [level + steep, level.abs() + steep.abs()]
    }

    /// How wide it is seen, in places, or less.
    pub fn width(&self) -> f64 {
        self.area.abs() / (chebyshev(self.from) * chebyshev(self.to))
    }

    /// Where the edge begins and where it ends.
    pub fn ends(&self) -> [DVec2; 2] {
        [self.from, self.to]
    }
}

/// Distance in plan by the greater of both offsets, which is the depth on the side of the point.
#[inline]
pub fn chebyshev(point: DVec2) -> f64 {
    point.x.abs().max(point.y.abs())
}
