//! Footprints with heights and roofs as closed surfaces, and lines with a width as areas.

mod appearance;
mod crossing;
mod extruded;
mod fan;
mod fold;
mod footprint;
mod frame;
mod length;
mod roof;
mod street_width;
mod strip;
mod sweep;
#[cfg(test)]
mod tests;

pub(crate) use appearance::Appearance;
pub(crate) use extruded::{Extruded, Top};
pub(crate) use footprint::{Footprint, is_inside, line_string};
pub(crate) use length::{MAX_HEIGHT, length};
pub(crate) use roof::{Rise, Roof, RoofShape};
pub(crate) use street_width::{STREET_WIDTHS, street_width};
pub(crate) use strip::{Ends, strips};

/// Height of a storey where only storeys are counted, metres.
pub(crate) const LEVEL_HEIGHT: f64 = 3.0;

/// Most vertices of the footprints of one feature; as surfaces they take up to 250 bytes each.
pub(crate) const MAX_FEATURE_VERTICES: usize = 1_000_000;

/// A position in plan, metres.
pub(crate) type Plan = [f64; 2];

/// An outer ring and its holes in space.
type Rings = Vec<Vec<[f64; 3]>>;
