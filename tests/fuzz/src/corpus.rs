//! Files to mutate: small ones that a reader takes, with the words of their format.

use std::fs;
use std::path::Path;

use crate::reader::Reader;

/// What readers are fed, each file in the folder of its reader.
const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/corpus");

/// The files of a reader, in the order of their names.
pub fn seeds(reader: Reader) -> Vec<Vec<u8>> {
    let folder = Path::new(CORPUS).join(reader.name());
    let entries = fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut paths: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    assert!(!paths.is_empty(), "{} is empty", folder.display());
    let read = |path: &std::path::PathBuf| {
        fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    paths.iter().map(read).collect()
}

/// Words that a reader knows.
pub fn words(reader: Reader) -> &'static [&'static str] {
    match reader {
        Reader::Cityjson => &[
            "\"CityJSON\"",
            "\"geometry\"",
            "\"Solid\"",
            "\"MultiSolid\"",
            "\"GeometryInstance\"",
            "\"parents\"",
            "\"children\"",
            "\"template\"",
            "[[[[",
            "]]]]",
            "null",
            "{}",
            "[]",
            "\"semantics\"",
            "\"material\"",
            "\"values\"",
            "\n",
            "\"CityJSONFeature\"",
        ],
        Reader::Vrml97 => &[
            "DEF A ",
            "USE A",
            "Transform {",
            "children [",
            "IndexedFaceSet {",
            "}",
            "]",
            "PROTO",
            "Extrusion {",
            "ElevationGrid {",
            "xDimension 65536",
            "spine [",
            "LOD {",
            "level [",
            "Switch {",
            "choice [",
            "\"",
            "#",
            "solid FALSE",
            "-1,",
            "Sphere {",
            "ROUTE A.b TO C.d",
        ],
        Reader::Gltf => &[
            "\"bufferView\":",
            "\"accessors\":",
            "\"nodes\":",
            "\"children\":[0]",
            "\"matrix\":[",
            "\"sparse\":",
            "\"byteOffset\":",
            "\"mode\":5",
            "\"data:application/octet-stream;base64,\"",
            "\"extensionsRequired\":",
            "[]",
            "{}",
            "null",
            "\"componentType\":5121",
        ],
        Reader::Obj => &[
            "\nf -1 -2 -3",
            "\nf 1//1 2//2",
            "\no ",
            "\ng ",
            "\nusemtl ",
            "\nmtllib a",
            "\\\n",
            "/",
            "\nv ",
            "#",
        ],
        Reader::Ply => &[
            "ply\n",
            "format binary_big_endian 1.0\n",
            "element vertex 4294967295\n",
            "property list uchar int vertex_indices\n",
            "property double x\n",
            "end_header\n",
            "element face 1\n",
            "property list double double ",
        ],
        Reader::Geojson => &[
            "\"Polygon\"",
            "\"MultiPolygon\"",
            "\"GeometryCollection\"",
            "\"geometries\":[",
            "[[[[",
            "\"crs\":",
            "\"height\":",
            "null",
            "\"features\":",
            "\"LineString\"",
            "[]",
            "{}",
        ],
        Reader::OsmPbf => &[
            "building",
            "height",
            "roof:shape",
            "gabled",
            "type",
            "multipolygon",
            "outer",
        ],
        Reader::Packed | Reader::Wkb => &[],
    }
}
