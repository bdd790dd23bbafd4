//! The SQL types, one file or folder each: of fixed length, but for sets.

mod array;
mod box3d;
mod datum;
mod feature_set;
mod frustum;
mod number;
mod ordering;
mod point3d;
mod ring;
mod text;
mod view_cone;
mod view_sector;
mod wire;

pub use box3d::Box3d;
pub use datum::{Raw, read};
pub use feature_set::StoredSet;
pub use frustum::Frustum;
pub use number::shortest;
pub use point3d::Point3d;
pub use ring::{Path, Ring, ring, rings};
pub use view_cone::ViewCone;
pub use view_sector::ViewSector;

/// Text as a `cstring` result; none of ours holds a zero byte.
fn text_result(text: String) -> std::ffi::CString {
    std::ffi::CString::new(text).unwrap_or_default()
}
