//! OpenStreetMap PBF: buildings by the Simple 3D Buildings rules, walls, bridges and streets, all
//! standing on a plane at height zero.

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
