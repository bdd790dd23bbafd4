//! [`Perimeter`], closed buildings around a courtyard.

use super::cell::Side;
use super::lattice::metres;
use super::random::SplitMix64;
use super::strip::Strip;

/// Least and greatest length of a building along its street, units.
const LENGTH: [i64; 2] = [metres(9), metres(18)];

/// A party wall keeps this from the inner corner of the courtyard, so that each is straight, units.
const OFF_CORNER: i64 = metres(2);

/// A ring of ground along four sides, anticlockwise, each square to the last.
pub struct Perimeter {
    sides: [Side; 4],
    /// Steps from the street to the courtyard.
    depth: i64,
    /// Units in a step.
    step: i64,
}

/// Where a party wall crosses the ring: the side, and steps along it.
#[derive(Clone, Copy)]
struct Wall {
    side: usize,
    along: i64,
}

impl Perimeter {
    pub fn new(sides: [Side; 4], depth: i64, step: i64) -> Self {
        Self { sides, depth, step }
    }

    /// One building that closes the courtyard by itself.
    pub fn whole(&self, _: &mut SplitMix64) -> Vec<Strip> {
        let corners = |inward: i64| self.sides.map(|side| side.point(inward, inward)).to_vec();
        vec![Strip {
            outer: corners(0),
            inner: corners(self.depth),
            closed: true,
        }]
    }

    /// A few long buildings, most of L or U shape.
    pub fn in_large_parts(&self, random: &mut SplitMix64) -> Vec<Strip> {
        let mut walls = Vec::new();
        for side in 0..4 {
            let [first, last] = self.room(side);
            if first <= last && !random.once_in(3) {
                let along = random.whole(first, last);
                walls.push(Wall { side, along });
            }
        }
        self.parts(&walls, random)
    }

    /// Many buildings side by side.
    pub fn in_parts(&self, random: &mut SplitMix64) -> Vec<Strip> {
        let [shortest, longest] = LENGTH.map(|length| length / self.step);
        let mut walls = Vec::new();
        for side in 0..4 {
            let [first, last] = self.room(side);
            let mut along = first + random.whole(0, shortest);
            while along <= last {
                walls.push(Wall { side, along });
                along += random.whole(shortest, longest);
            }
        }
        self.parts(&walls, random)
    }

    /// Where walls may cross a side.
    fn room(&self, side: usize) -> [i64; 2] {
        let off = self.depth + OFF_CORNER / self.step;
        [off, self.sides[side].steps - off]
    }

    /// The buildings from each wall to the next; with a single wall a building would touch itself.
    fn parts(&self, walls: &[Wall], random: &mut SplitMix64) -> Vec<Strip> {
        if walls.len() < 2 {
            return self.whole(random);
        }
        let next = walls.iter().cycle().skip(1);
        let pairs = walls.iter().zip(next);
        pairs.map(|(&from, &to)| self.part(from, to)).collect()
    }

    fn part(&self, from: Wall, to: Wall) -> Strip {
        let around = from.side == to.side && to.along <= from.along;
        let corners = match (to.side + 4 - from.side) % 4 {
            0 if around => 4,
            corners => corners,
        };
        let passed = (1..=corners).map(|corner| (from.side + corner) % 4);
        let wall = |Wall { side, along }: Wall, inward| self.sides[side].point(along, inward);
        let line = |inward: i64| {
            let corner = move |side: usize| self.sides[side].point(inward, inward);
            std::iter::once(wall(from, inward))
                .chain(passed.clone().map(corner))
                .chain([wall(to, inward)])
                .collect()
        };
        Strip {
            outer: line(0),
            inner: line(self.depth),
            closed: false,
        }
    }
}
