//! [`Reader`], what is under attack.

use std::io::Cursor;
use std::ops::ControlFlow;

use clap::ValueEnum;
use formats::{Format, ReadOptions};

/// A reader of bytes from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Reader {
    /// CityJSON and CityJSONSeq
    Cityjson,
    /// OpenStreetMap PBF
    OsmPbf,
    /// VRML97
    Vrml97,
    /// glTF and GLB
    Gltf,
    /// OBJ
    Obj,
    /// PLY
    Ply,
    /// GeoJSON
    Geojson,
    /// Models as they are stored
    Packed,
    /// Well-known binary
    Wkb,
}

impl Reader {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Cityjson,
        Self::OsmPbf,
        Self::Vrml97,
        Self::Gltf,
        Self::Obj,
        Self::Ply,
        Self::Geojson,
        Self::Packed,
        Self::Wkb,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cityjson => "cityjson",
            Self::OsmPbf => "osm-pbf",
            Self::Vrml97 => "vrml97",
            Self::Gltf => "gltf",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Geojson => "geojson",
            Self::Packed => "packed",
            Self::Wkb => "wkb",
        }
    }

    /// Reads bytes; says whether they were taken.
    pub fn read(self, bytes: &[u8]) -> bool {
        let format = match self {
            Self::Packed => return formats::unpack(bytes).is_ok(),
            Self::Wkb => return formats::read_wkb(bytes).is_ok(),
            Self::Cityjson => Format::CityJson,
            Self::OsmPbf => Format::OsmPbf,
            Self::Vrml97 => Format::Vrml97,
            Self::Gltf => Format::Gltf,
            Self::Obj => Format::Obj,
            Self::Ply => Format::Ply,
            Self::Geojson => Format::GeoJson,
        };
        let options = ReadOptions {
            companion: &|_| Ok(vec![0; 64]),
            ..ReadOptions::default()
        };
        let mut sink = |_| ControlFlow::Continue(());
        formats::read_as(
            format,
            "input",
            &mut Cursor::new(bytes),
            &options,
            &mut sink,
        )
        .is_ok()
    }
}
