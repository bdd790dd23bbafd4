//! OpenStreetMap PBF: buildings by the Simple 3D Buildings rules, walls, bridges and streets.
//!
//! - Everything stands on a plane at height zero, since the format knows no terrain.
//! - `height` comes before `building:levels`, of 3 m each and without the roof, and both before a
//!   height for the kind of building. Tags that are no lengths are ignored and told.
//! - Where parts lie inside of an outline, they are the building, and what they lack is as for the
//!   outline. A part that is alone becomes a building.
//! - Roofs are flat, skillion, gabled, saltbox, gambrel, round, hipped, pyramidal or domes. Others
//!   become the nearest of these, or flat, at full height, where the outline does not fit: a hipped
//!   roof needs four corners, pyramids and domes a middle that sees every side. Both are told. A
//!   skillion roof without a direction slopes across the building.
//! - Walls are widened lines, or areas. Areas of bridges are slabs 5 m up for each layer.
//! - Streets are as wide as `width` says, or 3 m a lane and 2 m a pavement, or as their kind mostly
//!   is. Tunnels, passages, bridges and what lies underground are left out. Squares are pedestrian
//!   areas, `place=square` and car parks under the open sky.

mod blob;
mod block;
mod building;
mod city;
mod gather;
mod kind;
mod nodes;
mod owners;
mod plan;
mod rings;
mod street;
mod structure;
mod tags;
mod vertical;
mod wire;

use city::City;
use gather::Elements;

use crate::batch::Batch;
use crate::error::{FormatError, Location, Problem};
use crate::input::{Input, ReadOptions, Sink};
use crate::limits::Limits;
use crate::projection::Projection;
use crate::scene::SceneDescription;

/// Whom the licence asks to credit.
const ATTRIBUTION: &str = "OpenStreetMap contributors, https://www.openstreetmap.org/copyright";

/// Reads a file.
pub(crate) fn read(
    name: &str,
    input: &mut dyn Input,
    options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
) -> Result<(), FormatError> {
    let place = Location::file(name);
    read_problem(input, options, sink).map_err(|problem| place.error(problem))
}

fn read_problem(
    input: &mut dyn Input,
    options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
) -> Result<(), Problem> {
    let mut elements = Elements::gather(input, &Limits::STANDARD)?;
    let mut nodes = std::mem::take(&mut elements.nodes);
    let projection = match nodes.centre() {
        Some(centre) => Some(Projection::to_srid_or_zone(options.srid, centre)?),
        None => options.srid.map(Projection::to_srid).transpose()?,
    };
    if let Some(projection) = &projection {
        nodes.project(projection);
    }
    let scene = SceneDescription {
        srid: projection.as_ref().map(Projection::srid),
        attribution: Some(ATTRIBUTION.to_owned()),
        ..SceneDescription::default()
    };
    let mut batch = Batch::new(scene, options, sink);
    // The end of the reading asked for by the sink is no error.
    if City::new(&elements, nodes)?.give(&mut batch).is_continue() {
        let _ = batch.finish();
    }
    Ok(())
}
