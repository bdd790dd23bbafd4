//! [`Solid`], a feature's surface with what hides others in it.

use geo::Polygon;

use crate::{
    ColumnOptions, InnerEnvelope, MeshDefect, PolygonDefect, SolidColumns, TriangleMesh, extruded,
    inner_envelope, solid_columns,
};

/// A feature's surface with what hides others in it.
#[derive(Clone, Debug)]
pub struct Solid {
    /// The surface, closed at the foot where only its bottom was missing.
    pub mesh: TriangleMesh,
    /// Height at which the surface was closed, if it was, metres.
    pub closed_at: Option<f64>,
    /// What hides others, or why there is no such thing.
    pub hides: Result<Hides, MeshDefect>,
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
    /// Closes the surface of a feature at its foot, where it lacks just a bottom, and looks for what
    /// hides others in it.
    #[must_use]
    pub fn of(mut mesh: TriangleMesh, options: &ColumnOptions) -> Self {
        let cap = mesh.foot_cap();
        let closed_at = cap.and_then(|cap| {
            mesh.triangles.extend(cap);
            Some(mesh.envelope()?.min.z)
        });
        Self {
            hides: Hides::of(&mesh, options),
            closed_at,
            mesh,
        }
    }

    /// Footprints raised from height `bottom` up to `top`, metres: a column each.
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
            inner: inner_envelope(&mesh).ok(),
            columns: SolidColumns {
                columns,
                share: 1.0,
                volume: mesh.signed_volume(),
            },
        };
        Ok(Self {
            mesh,
            closed_at: None,
            hides: Ok(hides),
        })
    }
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
