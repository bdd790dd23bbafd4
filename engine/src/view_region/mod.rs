//! Where observers can be.

mod built_over;
mod footprint;
mod local_ground;
mod open_space;
mod region;
mod road;
mod site;
mod street;
mod tiling;

pub use built_over::without_footprints;
pub use footprint::footprint;
pub use local_ground::LocalGround;
pub use open_space::open_space;
pub use region::ViewRegion;
pub use road::streets_from_surfaces;
pub use site::{Site, covers_ground, is_building};
pub use street::Street;
pub use tiling::ViewRegionOptions;
