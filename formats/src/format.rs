//! [`Format`], and which of them a file is in.

use std::fmt;
use std::io::{self, Cursor, Read, SeekFrom};
use std::ops::ControlFlow;

use crate::error::{FormatError, Location};
use crate::input::{Input, ReadOptions, Sink};
use crate::scene::SceneDescription;
use crate::{cityjson, geojson, gltf, obj, osm_pbf, ply, recognition, vrml};

/// How much of a file is looked at to recognise its format, bytes.
const START_BYTES: u64 = 4096;

/// A file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// CityJSON 1.1 or 2.0, or CityJSONSeq.
    CityJson,
    /// OpenStreetMap PBF.
    OsmPbf,
    /// VRML97.
    Vrml97,
    /// glTF 2.0 or GLB.
    Gltf,
    /// Wavefront OBJ.
    Obj,
    /// PLY.
    Ply,
    /// GeoJSON.
    GeoJson,
}

impl Format {
    /// The format of a file that begins with these bytes; a few hundred are enough.
    pub fn recognise(start: &[u8]) -> Option<Self> {
        recognition::recognise(start).ok()
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::CityJson => "cityjson",
            Self::OsmPbf => "openstreetmap pbf",
            Self::Vrml97 => "vrml97",
            Self::Gltf => "gltf",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::GeoJson => "geojson",
        })
    }
}

/// Reads a file, whatever its format, batch by batch. `name` is for errors only.
///
/// # Errors
/// [`FormatError`] when the format is unknown, or with what the format's reader finds wrong.
pub fn read(
    name: &str,
    input: &mut dyn Input,
    options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
) -> Result<Format, FormatError> {
    let place = Location::file(name);
    let start = start_of(input).map_err(|error| place.error(error.into()))?;
    let format = recognition::recognise(&start).map_err(|problem| place.error(problem))?;
    read_as(format, name, input, options, sink)?;
    Ok(format)
}

/// Reads a file of a known format, batch by batch. `name` is for errors only.
///
/// # Errors
/// [`FormatError`] with what the format's reader finds wrong.
pub fn read_as(
    format: Format,
    name: &str,
    input: &mut dyn Input,
    options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
) -> Result<(), FormatError> {
    match format {
        Format::CityJson => cityjson::read(name, input, options, sink),
        Format::OsmPbf => osm_pbf::read(name, input, options, sink),
        Format::Vrml97 => vrml::read(name, input, options, sink),
        Format::Gltf => gltf::read(name, input, options, sink),
        Format::Obj => obj::read(name, input, options, sink),
        Format::Ply => ply::read(name, input, options, sink),
        Format::GeoJson => geojson::read(name, input, options, sink),
    }
}

/// The first bytes of a file, which stays where it is.
fn start_of(input: &mut dyn Input) -> io::Result<Vec<u8>> {
    let mut start = input.fill_buf()?.to_vec();
    // What cannot go back has no more to show than what it has at hand.
    if (start.len() as u64) < START_BYTES
        && let Ok(position) = input.stream_position()
    {
        start.clear();
        (&mut *input).take(START_BYTES).read_to_end(&mut start)?;
        input.seek(SeekFrom::Start(position))?;
    }
    Ok(start)
}

/// Reads all of a file that is in memory.
///
/// # Errors
/// As [`read`].
pub fn read_bytes(
    name: &str,
    bytes: &[u8],
    options: &ReadOptions<'_>,
) -> Result<SceneDescription, FormatError> {
    let mut scene = SceneDescription::default();
    read(name, &mut Cursor::new(bytes), options, &mut |batch| {
        scene.add(batch);
        ControlFlow::Continue(())
    })?;
    Ok(scene)
}
