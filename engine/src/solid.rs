//! [`Solid`], a feature's surface with what hides others in it.

use std::fmt::{self, Display, Formatter};

use geo::{BoundingRect, Coord, Polygon};
use glam::DVec3;

use crate::{
    Box3d, ColumnOptions, InnerEnvelope, MeshDefect, PolygonDefect, SolidColumn, SolidColumns,
    TriangleMesh, extruded, inner_envelope, is_building, solid_columns,
};

/// A feature's surface with what hides others in it.
#[derive(Clone, Debug)]
pub struct Solid {
    /// The surface, with its seams closed, and closed at the foot where only its bottom was missing.
    pub mesh: TriangleMesh,
    /// What was added to close it, if something was.
    pub repair: Option<Repair>,
    /// What hides others, or why there is no such thing.
    pub hides: Result<Hides, MeshDefect>,
}

/// A bottom that was added to a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repair {
    /// Height of the bottom, metres.
    pub foot: f64,
    /// How many of the last triangles of the mesh it is.
    pub triangles: usize,
}

impl Display for Repair {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "closed at its foot, {} m", self.foot)
    }
}

/// What hides others.
#[derive(Clone, Debug)]
pub struct Hides {
    /// In its simple form.
    pub inner: Option<InnerEnvelope>,
    /// In its full form.
    pub columns: SolidColumns,
}

impl Solid {
    /// Closes the seams of a surface, and that of a building at its foot, where it lacks just a bottom,
    /// and looks for what hides others in the surface. Only what stands on the ground may be closed; whether it does
    /// shows in its neighbours.
    #[must_use]
    pub fn of(mut mesh: TriangleMesh, class: &str, options: &ColumnOptions) -> Self {
        mesh.close_seams();
        let cap = is_building(class).then(|| mesh.foot_cap()).flatten();
        let repair = cap.and_then(|cap| {
            let triangles = cap.len();
            mesh.triangles.extend(cap);
            let foot = mesh.envelope()?.min.z;
            Some(Repair { foot, triangles })
        });
        Self {
            hides: Hides::of(&mesh, options),
            repair,
            mesh,
        }
    }

    /// Footprints raised from height `bottom` up to `top`, metres: a column each. The simple form is
    /// looked for only where it takes no search: in a single footprint that is a box.
    ///
    /// # Errors
    /// [`PolygonDefect`] as [`extruded`].
    pub fn raised(
        footprints: &[Polygon<f64>],
        bottom: f64,
        top: f64,
    ) -> Result<Self, PolygonDefect> {
        let mut triangles = Vec::new();
        let mut columns = Vec::new();
        for footprint in footprints {
            let solid = extruded(footprint, bottom, top)?;
            triangles.extend(solid.mesh.corners());
            columns.push(solid.column);
        }
        let mesh = TriangleMesh::from_triangles(triangles);
        let hides = Hides {
            inner: own_box(&columns),
            columns: SolidColumns {
                columns,
                share: 1.0,
                volume: mesh.signed_volume(),
            },
        };
        Ok(Self {
            mesh,
            repair: None,
            hides: Ok(hides),
        })
    }
}

/// The box that a single column is, if it is one.
fn own_box(columns: &[SolidColumn]) -> Option<InnerEnvelope> {
    let [
        SolidColumn {
            footprint,
            bottom,
            top,
            grounded,
        },
    ] = columns
    else {
        return None;
    };
    let rectangle = footprint.bounding_rect()?;
    let (min, max) = (rectangle.min(), rectangle.max());
    let corners = &footprint.exterior().0;
    let at_corner = |c: &Coord| (c.x == min.x || c.x == max.x) && (c.y == min.y || c.y == max.y);
    // A simple ring of four corners of the rectangle, the first repeated, is its border.
    let is_box =
        footprint.interiors().is_empty() && corners.len() == 5 && corners.iter().all(at_corner);
    is_box.then(|| InnerEnvelope {
        bounds: Box3d {
            min: DVec3::new(min.x, min.y, *bottom),
            max: DVec3::new(max.x, max.y, *top),
        },
        grounded: *grounded,
    })
}

impl Hides {
    fn of(mesh: &TriangleMesh, options: &ColumnOptions) -> Result<Self, MeshDefect> {
        let columns = solid_columns(mesh, options)?;
        match inner_envelope(mesh) {
            Err(defect) if columns.columns.is_empty() => Err(defect),
            inner => Ok(Self {
                inner: inner.ok(),
                columns,
            }),
        }
    }

    /// Whether something of it stands on the mesh's own foot.
    #[must_use]
    pub fn is_grounded(&self) -> bool {
        self.inner.is_some_and(|inner| inner.grounded)
            || self.columns.columns.iter().any(|column| column.grounded)
    }
}

#[cfg(test)]
mod tests {
    use geo::polygon;

    use super::*;

    #[test]
    fn a_raised_box_is_its_own_inner_envelope() {
        let square = polygon![
            (x: 85_000.1, y: 447_000.0), (x: 85_009.0, y: 447_000.0),
            (x: 85_009.0, y: 447_007.3), (x: 85_000.1, y: 447_007.3),
        ];
        let solid = Solid::raised(std::slice::from_ref(&square), -0.5, 9.0).unwrap();
        let hides = solid.hides.unwrap();
        assert_eq!(hides.inner.map(|inner| inner.bounds), solid.mesh.envelope());
        assert!(hides.is_grounded());
        let searched = inner_envelope(&solid.mesh).map(|inner| inner.bounds).ok();
        assert_eq!(hides.inner.map(|inner| inner.bounds), searched);
    }

    #[test]
    fn other_footprints_are_columns_alone() {
        let triangle = polygon![(x: 0.0, y: 0.0), (x: 9.0, y: 0.0), (x: 9.0, y: 7.0)];
        let two = [
            triangle.clone(),
            polygon![(x: 20.0, y: 0.0), (x: 29.0, y: 0.0), (x: 29.0, y: 7.0)],
        ];
        for (footprints, columns) in [(&two[..1], 1), (&two[..], 2)] {
            let hides = Solid::raised(footprints, 0.0, 3.0).unwrap().hides.unwrap();
            assert_eq!((hides.inner, hides.columns.columns.len()), (None, columns));
        }
        assert!(Solid::raised(&[polygon![]], 0.0, 1.0).is_err());
    }
}
