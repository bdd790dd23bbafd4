//! A scene as commands read it from the database.

mod feature;
mod load;
mod street;
mod surfaces;
mod view_cell;
mod volume;

pub use feature::Feature;
pub use load::{Scene, load, load_over, streets_over};
pub use street::{Street, rings};
pub use surfaces::{Surfaces, number};
pub use view_cell::{ViewCell, Witness, no_view_cells, view_cells, witnesses};
pub use volume::{Volume, count_volumes, stream_volumes};
