//! Where observers can be.

mod footprint;
mod open_space;
mod road;
mod site;
mod street;
mod tiling;

pub use footprint::footprint;
pub use open_space::open_space;
pub use road::streets_from_surfaces;
pub use site::Site;
pub use street::Street;
pub use tiling::ViewRegionOptions;
