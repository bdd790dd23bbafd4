//! A scene as commands read it from the database.

mod feature;
mod load;
mod street;
mod surfaces;
mod volume;

pub use feature::Feature;
#[cfg(feature = "embree")]
pub use load::load_over;
pub use load::{Scene, load};
pub use street::{Street, rings};
pub use surfaces::{Surfaces, number};
pub use volume::{Volume, count_volumes, stream_volumes};
