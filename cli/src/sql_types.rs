//! The types of the extension, and core's polygon, in PostgreSQL's binary form.

use std::error::Error;

use postgres::types::private::BytesMut;
use postgres::types::{FromSql, IsNull, ToSql, Type, to_sql_checked};

type Refused = Box<dyn Error + Sync + Send>;

/// `occlusion.box3d`: an axis-aligned box, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Box3d {
    /// The corner with the least coordinates.
    pub min: [f64; 3],
    /// The corner with the greatest coordinates.
    pub max: [f64; 3],
}

/// `occlusion.point3d`: a point, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point3d(pub [f64; 3]);

/// Core's `polygon`: one ring, not closed.
#[derive(Clone, Debug, PartialEq)]
pub struct Ring(pub Vec<[f64; 2]>);

impl Box3d {
    /// Distance in metres from a point to the closed box; 0 inside.
    pub fn distance(&self, point: [f64; 3]) -> f64 {
        let [x, y, z] = std::array::from_fn(|axis| {
            point[axis].clamp(self.min[axis], self.max[axis]) - point[axis]
        });
        (x * x + y * y + z * z).sqrt()
    }

    /// Metres between two closed boxes.
    pub fn gap(&self, other: &Self) -> f64 {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|axis| {
            let apart = (self.min[axis] - other.max[axis]).max(other.min[axis] - self.max[axis]);
            apart.max(0.0)
        });
        (x * x + y * y + z * z).sqrt()
    }

    /// Whether a point is in the closed box.
    pub fn holds(&self, point: [f64; 3]) -> bool {
        (0..3).all(|axis| (self.min[axis]..=self.max[axis]).contains(&point[axis]))
    }
}

impl From<engine::Box3d> for Box3d {
    fn from(bounds: engine::Box3d) -> Self {
        Self {
            min: bounds.min.to_array(),
            max: bounds.max.to_array(),
        }
    }
}

impl From<Box3d> for engine::Box3d {
    fn from(bounds: Box3d) -> Self {
        Self {
            min: bounds.min.into(),
            max: bounds.max.into(),
        }
    }
}

impl From<Box3d> for oracle::Aabb {
    fn from(bounds: Box3d) -> Self {
        Self::new(bounds.min, bounds.max)
    }
}

impl ToSql for Box3d {
    fn to_sql(&self, _: &Type, out: &mut BytesMut) -> Result<IsNull, Refused> {
        put(out, self.min.iter().chain(&self.max));
        Ok(IsNull::No)
    }

    fn accepts(ty: &Type) -> bool {
        ty.schema() == "occlusion" && ty.name() == "box3d"
    }

    to_sql_checked!();
}

impl<'a> FromSql<'a> for Box3d {
    fn from_sql(_: &Type, raw: &'a [u8]) -> Result<Self, Refused> {
        let [x, y, z, right, back, top] = numbers(raw)?;
        Ok(Self {
            min: [x, y, z],
            max: [right, back, top],
        })
    }

    fn accepts(ty: &Type) -> bool {
        <Self as ToSql>::accepts(ty)
    }
}

impl ToSql for Point3d {
    fn to_sql(&self, _: &Type, out: &mut BytesMut) -> Result<IsNull, Refused> {
        put(out, &self.0);
        Ok(IsNull::No)
    }

    fn accepts(ty: &Type) -> bool {
        ty.schema() == "occlusion" && ty.name() == "point3d"
    }

    to_sql_checked!();
}

impl<'a> FromSql<'a> for Point3d {
    fn from_sql(_: &Type, raw: &'a [u8]) -> Result<Self, Refused> {
        Ok(Self(numbers(raw)?))
    }

    fn accepts(ty: &Type) -> bool {
        <Self as ToSql>::accepts(ty)
    }
}

impl ToSql for Ring {
    fn to_sql(&self, _: &Type, out: &mut BytesMut) -> Result<IsNull, Refused> {
        out.extend_from_slice(&i32::try_from(self.0.len())?.to_be_bytes());
        put(out, self.0.iter().flatten());
        Ok(IsNull::No)
    }

    fn accepts(ty: &Type) -> bool {
        *ty == Type::POLYGON
    }

    to_sql_checked!();
}

impl<'a> FromSql<'a> for Ring {
    fn from_sql(_: &Type, raw: &'a [u8]) -> Result<Self, Refused> {
        let (_, points) = raw
            .split_at_checked(4)
            .ok_or("a polygon without a length")?;
        let vertex = |bytes: &[u8]| numbers::<2>(bytes);
        Ok(Self(
            points.chunks(16).map(vertex).collect::<Result<_, _>>()?,
        ))
    }

    fn accepts(ty: &Type) -> bool {
        <Self as ToSql>::accepts(ty)
    }
}

fn put<'a>(out: &mut BytesMut, numbers: impl IntoIterator<Item = &'a f64>) {
    for number in numbers {
        out.extend_from_slice(&number.to_be_bytes());
    }
}

/// Exactly `N` numbers.
fn numbers<const N: usize>(raw: &[u8]) -> Result<[f64; N], Refused> {
    let (numbers, rest) = raw.as_chunks::<8>();
    if numbers.len() != N || !rest.is_empty() {
        return Err(format!("{} bytes where {} were expected", raw.len(), 8 * N).into());
    }
    Ok(std::array::from_fn(|i| f64::from_be_bytes(numbers[i])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_survive_the_wire() {
        let bounds = Box3d {
            min: [85_000.1, 447_000.2, -1.5],
            max: [85_001.0, 447_009.0, f64::MAX],
        };
        let mut wire = BytesMut::new();
        bounds.to_sql(&Type::UNKNOWN, &mut wire).unwrap();
        assert_eq!(wire.len(), 48);
        assert_eq!(Box3d::from_sql(&Type::UNKNOWN, &wire).unwrap(), bounds);
        let short = Box3d::from_sql(&Type::UNKNOWN, &wire[1..]).unwrap_err();
        assert_eq!(short.to_string(), "47 bytes where 48 were expected");
    }

    #[test]
    fn rings_survive_the_wire() {
        let ring = Ring(vec![[0.0, 1.0], [2.0, 3.5], [-4.0, 5.0]]);
        let mut wire = BytesMut::new();
        ring.to_sql(&Type::POLYGON, &mut wire).unwrap();
        assert_eq!(wire[..4], 3i32.to_be_bytes());
        assert_eq!(Ring::from_sql(&Type::POLYGON, &wire).unwrap(), ring);
        assert!(Ring::from_sql(&Type::POLYGON, &wire[..30]).is_err());
    }

    #[test]
    fn distance_is_to_the_closed_box() {
        let bounds = Box3d {
            min: [0.0; 3],
            max: [1.0, 1.0, 2.0],
        };
        assert_eq!(bounds.distance([0.5, 1.0, 2.0]), 0.0);
        assert_eq!(bounds.distance([4.0, 5.0, 2.0]), 5.0);
        let other = Box3d {
            min: [4.0, 5.0, 1.0],
            max: [9.0; 3],
        };
        assert_eq!(bounds.gap(&other), 5.0);
        assert_eq!(other.gap(&bounds), 5.0);
        assert_eq!(bounds.gap(&bounds), 0.0);
    }
}
