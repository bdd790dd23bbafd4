//! Well-known binary, in the dialects of ISO 13249-3 and of PostGIS: surfaces only.

use crate::error::Problem;
use crate::limits::{MAX_COORDINATE, MAX_NESTING};
use crate::scene::Surface;

/// Flags of PostGIS's extended dialect, beside the type's number.
const HAS_Z: u32 = 0x8000_0000;
const HAS_M: u32 = 0x4000_0000;
const HAS_SRID: u32 = 0x2000_0000;

/// Reads the surfaces of a geometry: polygons, triangles, and any collection of them, polyhedral
/// surfaces and TINs among them. Points and lines have none. Rings lose their closing vertex and
/// vertices that repeat; one with fewer than three left is dropped, an outer one with its surface.
///
/// # Errors
/// [`Problem`] for bytes that are no geometry, curves, coordinates that are not finite or out of
/// bounds, and polygons without z, which have no place in space.
pub fn read_wkb(bytes: &[u8]) -> Result<Vec<Surface>, Problem> {
    let mut reader = Reader { bytes };
    let mut surfaces = Vec::new();
    reader.geometry(&mut surfaces, 0)?;
    if !reader.bytes.is_empty() {
        return Err(malformed("bytes after the geometry"));
    }
    Ok(surfaces)
}

/// What is left to read.
struct Reader<'a> {
    bytes: &'a [u8],
}

/// How the numbers of one geometry are written.
#[derive(Clone, Copy)]
struct Layout {
    little_endian: bool,
    has_z: bool,
    has_m: bool,
}

impl Reader<'_> {
    fn geometry(&mut self, surfaces: &mut Vec<Surface>, depth: u64) -> Result<(), Problem> {
        if depth > MAX_NESTING {
            return Err(Problem::Limit {
                what: "levels of nesting",
                found: depth,
                limit: MAX_NESTING,
            });
        }
        let little_endian = match self.take::<1>()? {
            [0] => false,
            [1] => true,
            _ => return Err(malformed("no byte order")),
        };
        let code = self.number(little_endian)?;
        if code & HAS_SRID != 0 {
            self.take::<4>()?;
        }
        let (kind, iso) = ((code & 0x0fff_ffff) % 1000, (code & 0x0fff_ffff) / 1000);
        let layout = Layout {
            little_endian,
            has_z: code & HAS_Z != 0 || iso == 1 || iso == 3,
            has_m: code & HAS_M != 0 || iso == 2 || iso == 3,
        };
        match kind {
            1 => self.position(layout).map(drop),
            2 => self.line(layout).map(drop),
            // A polygon, or a triangle.
            3 | 17 => self.polygon(layout, surfaces),
            // Collections: of points, lines, polygons, anything; polyhedral surfaces and TINs.
            4..=7 | 15 | 16 => {
                let count = self.number(little_endian)?;
                (0..count).try_for_each(|_| self.geometry(surfaces, depth + 1))
            }
            _ => Err(Problem::Unsupported {
                what: format!("geometry type {kind}"),
            }),
        }
    }

    fn polygon(&mut self, layout: Layout, surfaces: &mut Vec<Surface>) -> Result<(), Problem> {
        let count = self.number(layout.little_endian)?;
        let mut rings = Vec::new();
        let mut has_area = true;
        for number in 0..count {
            let mut ring = self.line(layout)?;
            ring.dedup();
            while ring.len() > 1 && ring.first() == ring.last() {
                ring.pop();
            }
            if ring.len() >= 3 {
                rings.push(ring);
            } else if number == 0 {
                has_area = false;
            }
        }
        if has_area && !rings.is_empty() {
            if !layout.has_z {
                return Err(malformed("a polygon without z"));
            }
            surfaces.push(Surface {
                rings,
                ..Surface::default()
            });
        }
        Ok(())
    }

    fn line(&mut self, layout: Layout) -> Result<Vec<[f64; 3]>, Problem> {
        let count = self.number(layout.little_endian)?;
        // Each position is read before the next is made room for: a count alone takes no memory.
        (0..count)
            .map(|_| self.position(layout))
            .collect::<Result<_, _>>()
    }

    /// A position; z is 0 where there is none. An empty point is NaN throughout.
    fn position(&mut self, layout: Layout) -> Result<[f64; 3], Problem> {
        let mut position = [self.coordinate(layout)?, self.coordinate(layout)?, 0.0];
        if layout.has_z {
            position[2] = self.coordinate(layout)?;
        }
        if layout.has_m {
            self.take::<8>()?;
        }
        Ok(position.map(|coordinate| coordinate + 0.0))
    }

    fn coordinate(&mut self, layout: Layout) -> Result<f64, Problem> {
        let bytes = self.take::<8>()?;
        let value = if layout.little_endian {
            f64::from_le_bytes(bytes)
        } else {
            f64::from_be_bytes(bytes)
        };
        if value.abs() <= MAX_COORDINATE {
            return Ok(value);
        }
        Err(Problem::Invalid {
            what: "a coordinate".to_owned(),
            found: value.to_string(),
            expected: "a number up to 10^9 metres",
        })
    }

    fn number(&mut self, little_endian: bool) -> Result<u32, Problem> {
        let bytes = self.take::<4>()?;
        Ok(if little_endian {
            u32::from_le_bytes(bytes)
        } else {
            u32::from_be_bytes(bytes)
        })
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], Problem> {
        let (taken, rest) = self
            .bytes
            .split_first_chunk::<N>()
            .ok_or_else(|| malformed("it ends too early"))?;
        self.bytes = rest;
        Ok(*taken)
    }
}

fn malformed(message: &str) -> Problem {
    Problem::Malformed {
        what: "well-known binary".to_owned(),
        message: message.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 3]; 5] = [
        [0.0, 0.0, 5.0],
        [4.0, 0.0, 5.0],
        [4.0, 4.0, 5.0],
        [-0.0, 4.0, 5.0],
        [0.0, 0.0, 5.0],
    ];

    fn polygon(code: u32, rings: &[&[[f64; 3]]], dimensions: usize) -> Vec<u8> {
        let mut bytes = vec![1];
        bytes.extend(code.to_le_bytes());
        bytes.extend((rings.len() as u32).to_le_bytes());
        for ring in rings {
            bytes.extend((ring.len() as u32).to_le_bytes());
            for position in *ring {
                bytes.extend(position[..dimensions].iter().flat_map(|c| c.to_le_bytes()));
            }
        }
        bytes
    }

    fn collection(code: u32, members: &[Vec<u8>]) -> Vec<u8> {
        let mut bytes = vec![0];
        bytes.extend(code.to_be_bytes());
        bytes.extend((members.len() as u32).to_be_bytes());
        bytes.extend(members.concat());
        bytes
    }

    #[test]
    fn both_dialects_and_both_byte_orders_are_read() {
        let iso = polygon(1003, &[&SQUARE], 3);
        let extended = polygon(3 | HAS_Z, &[&SQUARE], 3);
        let surfaces = read_wkb(&collection(1015, &[iso.clone(), extended])).unwrap();
        let expected: Vec<[f64; 3]> = SQUARE[..4].iter().map(|p| p.map(|c| c + 0.0)).collect();
        assert_eq!(surfaces.len(), 2);
        assert!(surfaces.iter().all(|s| s.rings == [expected.clone()]));
        let nested = collection(7, &[collection(1016, &[polygon(1017, &[&SQUARE], 3)]), iso]);
        assert_eq!(read_wkb(&nested).unwrap().len(), 2);
    }

    #[test]
    fn what_has_no_area_is_dropped() {
        let hole = [SQUARE[0], SQUARE[1], SQUARE[0]];
        let surfaces = read_wkb(&polygon(1003, &[&SQUARE, &hole], 3)).unwrap();
        assert_eq!(surfaces[0].rings.len(), 1);
        assert_eq!(read_wkb(&polygon(1003, &[&hole], 3)), Ok(Vec::new()));
        assert_eq!(read_wkb(&polygon(1003, &[], 3)), Ok(Vec::new()));
    }

    #[test]
    fn bytes_that_are_no_surfaces_are_refused() {
        let message = |bytes: &[u8]| read_wkb(bytes).unwrap_err().to_string();
        assert_eq!(
            message(&polygon(3, &[&SQUARE], 2)),
            "well-known binary is malformed: a polygon without z"
        );
        assert_eq!(
            message(&[7]),
            "well-known binary is malformed: no byte order"
        );
        assert_eq!(
            message(&polygon(1010, &[], 3)),
            "geometry type 10 is not supported"
        );
        let mut long = polygon(1003, &[&SQUARE], 3);
        long.push(0);
        assert_eq!(
            message(&long),
            "well-known binary is malformed: bytes after the geometry"
        );
        let far = [[f64::INFINITY; 3]; 4];
        assert_eq!(
            message(&polygon(1003, &[&far], 3)),
            "a coordinate is inf, expected a number up to 10^9 metres"
        );
        let mut deep = Vec::new();
        (0..200).for_each(|_| deep = collection(7, &[std::mem::take(&mut deep)]));
        assert_eq!(
            message(&deep),
            "101 levels of nesting exceed the limit of 100"
        );
    }

    #[test]
    fn no_bytes_panic_or_take_memory_on_the_word_of_a_count() {
        let whole = collection(
            1015,
            &[polygon(1003, &[&SQUARE], 3), polygon(1003, &[&SQUARE], 3)],
        );
        for length in 0..whole.len() {
            assert!(read_wkb(&whole[..length]).is_err());
        }
        for at in 0..whole.len() {
            for value in [0, 1, 0x7f, 0xff] {
                let mut changed = whole.clone();
                changed[at] = value;
                let _ = read_wkb(&changed);
            }
        }
    }
}
