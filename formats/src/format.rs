//! [`Format`], and which of them a file is in.

use std::fmt;
use std::io::Cursor;
use std::ops::ControlFlow;

use crate::error::{FormatError, Location, Problem};
use crate::input::{Input, ReadOptions, Sink};
use crate::scene::SceneDescription;
use crate::{cityjson, geojson, gltf, obj, osm_pbf, ply, vrml};

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
        let text = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start);
        match text.iter().find(|byte| !byte.is_ascii_whitespace()) {
            _ if start.starts_with(b"glTF") => Some(Self::Gltf),
            Some(b'{') if gltf::is_document(text) => Some(Self::Gltf),
            Some(b'{') => Some(Self::CityJson),
            _ => None,
        }
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
    let start = input
        .fill_buf()
        .map_err(|error| Location::file(name).error(error.into()))?;
    let unknown = || Location::file(name).error(Problem::UnknownFormat);
    let format = Format::recognise(start).ok_or_else(unknown)?;
    match format {
        Format::CityJson => cityjson::read(name, input, options, sink)?,
        Format::OsmPbf => osm_pbf::read(name, input, options, sink)?,
        Format::Vrml97 => vrml::read(name, input, options, sink)?,
        Format::Gltf => gltf::read(name, input, options, sink)?,
        Format::Obj => obj::read(name, input, options, sink)?,
        Format::Ply => ply::read(name, input, options, sink)?,
        Format::GeoJson => geojson::read(name, input, options, sink)?,
    }
    Ok(format)
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
