//! The SQL types: fixed length, passed by reference, one file each, or a folder.

mod array;
mod box3d;
mod datum;
mod frustum;
mod frustum_make;
mod number;
mod ordering;
mod point3d;
mod text;
mod view_cone;
mod view_sector;
mod wire;

pub use box3d::Box3d;
pub use datum::Raw;
pub use frustum::Frustum;
pub use point3d::Point3d;
pub use view_cone::ViewCone;
pub use view_sector::ViewSector;

/// Text as a `cstring` result; none of ours holds a zero byte.
fn text_result(text: String) -> std::ffi::CString {
    std::ffi::CString::new(text).unwrap_or_default()
}
