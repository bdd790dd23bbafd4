//! Triangle meshes: how polygons become triangles, whether a mesh bounds a solid, and the largest
//! axis-aligned box inside it.

mod certificate;
mod clip;
mod deviation;
mod extrusion;
mod foot_cap;
mod free_grid;
mod growth;
mod inner_envelope;
mod mesh_defect;
mod net;
mod seams;
mod triangle_mesh;
mod triangulate;
mod winding_number;

pub use deviation::deviation;
pub use extrusion::{Extrusion, extruded};
pub(crate) use inner_envelope::why_no_seed;
pub use inner_envelope::{GROUND_TOLERANCE, InnerEnvelope, inner_envelope};
pub use mesh_defect::MeshDefect;
pub(crate) use net::Net;
pub use triangle_mesh::{Closedness, TriangleMesh};
pub use triangulate::{PolygonDefect, triangulate};
