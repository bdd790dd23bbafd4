//! Six square pictures that together see everything around the eye.

use std::collections::{BTreeMap, HashMap};

/// One side of the cube around the eye, named by the axis that it faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Face {
    /// +x
    East,
    /// -x
    West,
    /// +y
    North,
    /// -y
    South,
    /// +z
    Up,
    /// -z
    Down,
}

impl Face {
    /// All six, in the order in which they are drawn.
    pub const ALL: [Face; 6] = [
        Face::East,
        Face::West,
        Face::North,
        Face::South,
        Face::Up,
        Face::Down,
    ];

    /// Coordinates of an eye-relative point in the frame of the face: to the right, upwards,
    /// forward. A permutation with signs, so it is exact.
    pub(crate) fn local<T: Copy + std::ops::Neg<Output = T>>(self, [x, y, z]: [T; 3]) -> [T; 3] {
        match self {
            Face::East => [-y, z, x],
            Face::West => [y, z, -x],
            Face::North => [x, z, y],
            Face::South => [-x, z, -y],
            Face::Up => [x, -y, z],
            Face::Down => [x, y, -z],
        }
    }

    /// The inverse of [`Face::local`].
    fn world(self, [u, v, w]: [f64; 3]) -> [f64; 3] {
        match self {
            Face::East => [w, -u, v],
            Face::West => [-w, u, v],
            Face::North => [u, w, v],
            Face::South => [-u, -w, v],
            Face::Up => [u, -v, w],
            Face::Down => [u, v, -w],
        }
    }
}

/// Direction from the eye through the centre of a pixel, not normalised: its component along the
/// face's axis is 1.
///
/// The exact formula is `forward + ((2x + 1)/n - 1) right + (1 - (2y + 1)/n) up`, with x from the
/// left, y from the top and n the resolution. It is free of rounding when n is a power of two, so
/// a pixel can be recast by other code.
#[must_use]
pub fn pixel_direction(face: Face, x: u32, y: u32, resolution: u32) -> [f64; 3] {
    let n = f64::from(resolution);
    let u = (2.0 * f64::from(x) + 1.0) / n - 1.0;
    let v = 1.0 - (2.0 * f64::from(y) + 1.0) / n;
    face.world([u, v, 1.0])
}

/// Where and how large an id was seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sighting {
    /// Pixels of this id on all faces.
    pub pixels: u64,
    /// Face of the sample pixel.
    pub face: Face,
    /// Column of the sample pixel, from the left. The sample is the middle of the longest
    /// horizontal run of this id, far from silhouettes where that can be had.
    pub x: u32,
    /// Row of the sample pixel, from the top.
    pub y: u32,
}

/// Every id seen, except 0.
pub type Seen = BTreeMap<u32, Sighting>;

/// The ids around an eye: six faces of `resolution` squared pixels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CubeMap {
    resolution: u32,
    faces: Vec<Vec<u32>>,
}

impl CubeMap {
    /// `faces` in the order of [`Face::ALL`].
    pub(crate) fn new(resolution: u32, faces: Vec<Vec<u32>>) -> Self {
        Self { resolution, faces }
    }

    /// Pixels along one side of a face.
    #[must_use]
    pub fn resolution(&self) -> u32 {
        self.resolution
    }

    /// The ids of a face, row by row from the top, each from the left. 0 where nothing is.
    #[must_use]
    pub fn face(&self, face: Face) -> &[u32] {
        &self.faces[face as usize]
    }

    /// The id of a pixel; `None` outside the face.
    #[must_use]
    pub fn id(&self, face: Face, x: u32, y: u32) -> Option<u32> {
        let n = self.resolution as usize;
        let inside = x < self.resolution && y < self.resolution;
        inside.then(|| self.face(face)[y as usize * n + x as usize])
    }

    /// Every id in the map.
    #[must_use]
    pub fn seen(&self) -> Seen {
        let mut tally = Tally::default();
        for face in Face::ALL {
            for (y, row) in self
                .face(face)
                .chunks_exact(self.resolution as usize)
                .enumerate()
            {
                tally.row(face, y as u32, row);
            }
        }
        tally.finish()
    }
}

/// Counts ids row by row, so that faces need not be kept.
#[derive(Default)]
pub(crate) struct Tally {
    ids: HashMap<u32, (Sighting, u32)>,
}

impl Tally {
    /// Adds one row of pixels.
    pub(crate) fn row(&mut self, face: Face, y: u32, row: &[u32]) {
        let mut start = 0;
        for run in row.chunk_by(|a, b| a == b) {
            if run[0] != 0 {
                self.run(run[0], face, [start, y], run.len() as u32);
            }
            start += run.len() as u32;
        }
    }

    /// Adds a horizontal run of one id; the longest one gives the sample.
    fn run(&mut self, id: u32, face: Face, [start, y]: [u32; 2], length: u32) {
        let sample = Sighting {
            pixels: 0,
            face,
            x: start + length / 2,
            y,
        };
        let (sighting, longest) = self.ids.entry(id).or_insert((sample, length));
        let pixels = sighting.pixels + u64::from(length);
        if length > *longest {
            (*sighting, *longest) = (sample, length);
        }
        sighting.pixels = pixels;
    }

    pub(crate) fn finish(self) -> Seen {
        self.ids
            .into_iter()
            .map(|(id, (sighting, _))| (id, sighting))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn local_and_world_are_inverse() {
        for face in Face::ALL {
            assert_eq!(face.local(face.world([2.0, 3.0, 5.0])), [2.0, 3.0, 5.0]);
        }
    }

    #[test]
    fn frames_are_right_handed() {
        for face in Face::ALL {
            let [r, u, f] =
                [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| face.world(axis));
            let cross = [
                r[1] * u[2] - r[2] * u[1],
                r[2] * u[0] - r[0] * u[2],
                r[0] * u[1] - r[1] * u[0],
            ];
            assert_eq!(cross.map(|c| -c + 0.0), f.map(|c| c + 0.0), "{face:?}");
        }
    }

    #[test]
    fn pixel_centres_lie_strictly_inside_their_face() {
        for face in Face::ALL {
            for (x, y) in [(0, 0), (3, 0), (0, 3), (3, 3)] {
                let [u, v, w] = face.local(pixel_direction(face, x, y, 4));
                assert_eq!((u.abs(), v.abs(), w), (0.75, 0.75, 1.0));
            }
        }
        assert_eq!(pixel_direction(Face::East, 0, 0, 2), [1.0, 0.5, 0.5]);
        assert_eq!(pixel_direction(Face::Down, 1, 1, 2), [0.5, -0.5, -1.0]);
    }

    #[test]
    fn tally_counts_and_samples_the_longest_run() {
        let mut tally = Tally::default();
        tally.row(Face::West, 4, &[7, 0, 7, 7, 7, 9]);
        tally.row(Face::Up, 5, &[7, 9, 9, 0, 0, 0]);
        let seen = tally.finish();
        assert_eq!(
            seen[&7],
            Sighting {
                pixels: 5,
                face: Face::West,
                x: 3,
                y: 4
            }
        );
        assert_eq!(
            seen[&9],
            Sighting {
                pixels: 3,
                face: Face::Up,
                x: 2,
                y: 5
            }
        );
        assert_eq!(seen.len(), 2);
    }

    #[test]
    fn pixels_outside_have_no_id() {
        let map = CubeMap::new(1, vec![vec![3]; 6]);
        assert_eq!(map.id(Face::Up, 0, 0), Some(3));
        assert_eq!(map.id(Face::Up, 1, 0), None);
    }
}
