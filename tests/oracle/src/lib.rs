//! Independent checkers for the claims of `pg_occlusion`: occlusion volumes, inner envelopes,
//! solid columns and their pieces, occluders and lines of sight, each decided exactly on the `f64` values as they are. A
//! certified floating-point filter answers the plain cases, and rational arithmetic the rest; no
//! answer depends on an epsilon. It shares no code with the engine or the extension, so that a
//! mistake there cannot hide here.
//!
//! Frame: metres, z up, right-handed. Points are `[x, y, z]`.

#![forbid(unsafe_code)]

mod aabb;
mod bvh;
mod column;
mod column_check;
mod column_index;
mod column_samples;
mod column_share;
mod contact;
mod determinant;
mod exact;
mod footprint;
mod ground;
mod inner_envelope;
mod interval;
mod mesh;
mod number;
mod occluder;
mod overlap;
mod piece;
mod plane;
mod point_judge;
mod prism;
mod ray_caster;
mod samples;
#[cfg(test)]
mod scenes;
mod section;
mod segment;
mod sight_profile;
mod sight_target;
mod solid;
mod test_point;
mod touch;
mod trace;
mod volume;
mod winding;

pub use aabb::{Aabb, Point};
pub use column::Column;
pub use column_check::{ColumnFault, check_column, check_grounded};
pub use column_index::ColumnIndex;
pub use column_samples::sample_column;
pub use column_share::{SolidVolumes, sample_volumes};
pub use footprint::{MAX_CORNERS, ShapeFault};
pub use ground::{GROUND_TOLERANCE, solid_ground};
pub use inner_envelope::{InnerFault, check_inner_envelope};
pub use mesh::{Mesh, Triangle};
pub use occluder::{Occluder, OccluderIndex, box_hidden_by_any, single_occluder_hides};
pub use piece::{PieceFault, check_piece_in_column};
pub use plane::PlanPoint;
pub use point_judge::{JudgedFeature, LeftOut, PointJudge, Search};
pub use prism::Prism;
pub use ray_caster::{BadTriangle, Hit, MAX_COORDINATE, RayCaster, Sight};
pub use samples::{SAMPLE_INSET, surface_samples};
pub use segment::segment_meets_interior;
pub use trace::{Trace, TraceCut};
pub use volume::{VolumeFault, check_volume};
