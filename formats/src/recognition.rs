//! Which format a file is in, by its first bytes.

use crate::error::Problem;
use crate::format::Format;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// What some files begin with that are not read, and what to do about them.
const REFUSED_STARTS: [(&[u8], &str); 13] = [
    (
        b"PK\x03\x04",
        "a zip archive, such as kmz (unpack it first)",
    ),
    (b"\x1f\x8b", "gzip (unpack it first)"),
    (b"BZh", "bzip2 (unpack it first)"),
    (b"\x28\xb5\x2f\xfd", "zstandard (unpack it first)"),
    (b"\xfd7zXZ", "xz (unpack it first)"),
    (b"\xff\xfe", "utf-16 text (save it as utf-8)"),
    (b"\xfe\xff", "utf-16 text (save it as utf-8)"),
    (b"#VRML V1.0", "vrml 1.0 (convert it to vrml97)"),
    (b"#X3D", "x3d (convert it to vrml97 or gltf)"),
    (b"ISO-10303-21", "ifc (convert it to cityjson or gltf)"),
    (
        b"SQLite format 3\0",
        "a database, such as geopackage (convert it to geojson)",
    ),
    (b"solid ", "stl (convert it to obj or ply)"),
    (b"Kaydara FBX", "fbx (convert it to gltf)"),
];

/// Root elements of kinds of XML, and what to do about them.
const REFUSED_XML: [(&str, &str); 6] = [
    ("CityModel", "citygml (convert it to cityjson)"),
    ("X3D", "x3d (convert it to vrml97 or gltf)"),
    ("osm", "openstreetmap xml (convert it to openstreetmap pbf)"),
    ("kml", "kml (convert it to geojson)"),
    ("COLLADA", "collada (convert it to gltf)"),
    (
        "FeatureCollection",
        "gml (convert it to geojson or cityjson)",
    ),
];

/// Types of GeoJSON.
const GEOJSON_TYPES: [&[u8]; 9] = [
    b"FeatureCollection",
    b"Feature",
    b"GeometryCollection",
    b"Point",
    b"MultiPoint",
    b"LineString",
    b"MultiLineString",
    b"Polygon",
    b"MultiPolygon",
];

/// First words of a line of OBJ.
const OBJ_KEYWORDS: [&str; 11] = [
    "v", "vt", "vn", "vp", "f", "l", "p", "o", "g", "s", "mtllib",
];

/// The format of a file that begins with these bytes, or why it is not read.
pub(crate) fn recognise(start: &[u8]) -> Result<Format, Problem> {
    if is_osm_pbf(start) {
        return Ok(Format::OsmPbf);
    }
    if start.starts_with(b"glTF") {
        return Ok(Format::Gltf);
    }
    let start = start.strip_prefix(BYTE_ORDER_MARK).unwrap_or(start);
    if let Some((_, what)) = REFUSED_STARTS
        .iter()
        .find(|(bytes, _)| start.starts_with(bytes))
    {
        return Err(refused(what));
    }
    let text = start.trim_ascii_start();
    match text.first() {
        None => Err(Problem::Empty),
        Some(b'{') => json(text),
        Some(b'<') => Err(refused(xml(text))),
        Some(_) if text.starts_with(b"#VRML V2.0") => Ok(Format::Vrml97),
        Some(_) if is_ply(text) => Ok(Format::Ply),
        Some(_) if is_obj(text) => Ok(Format::Obj),
        Some(_) => Err(Problem::UnknownFormat),
    }
}

fn refused(what: &str) -> Problem {
    Problem::Unsupported {
        what: what.to_owned(),
    }
}

/// A blob's header of less than 64 KiB that begins with the type of the first blob.
fn is_osm_pbf(start: &[u8]) -> bool {
    start.starts_with(&[0, 0]) && start.get(4..15) == Some(b"\x0a\x09OSMHeader")
}

fn is_ply(text: &[u8]) -> bool {
    text.strip_prefix(b"ply")
        .is_some_and(|rest| matches!(rest.first(), Some(b'\n' | b'\r')))
}

/// Whether the first line that is no comment begins with a word of OBJ. The last line may be cut.
fn is_obj(text: &[u8]) -> bool {
    let text = String::from_utf8_lossy(text);
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    match lines.find(|line| !line.starts_with('#')) {
        Some(line) => {
            let word = line.split_whitespace().next().unwrap_or_default();
            OBJ_KEYWORDS.contains(&word) || word == "usemtl"
        }
        // Nothing but comments as far as can be seen: no other format has these.
        None => true,
    }
}

/// What kind of XML it is, by its root element.
fn xml(text: &[u8]) -> &'static str {
    let text = String::from_utf8_lossy(text);
    let is_name = |c: char| c.is_alphanumeric() || matches!(c, ':' | '_');
    let elements = text.split('<').skip(1);
    let names = elements.map(|rest| rest.split(|c| !is_name(c)).next().unwrap_or_default());
    // Declarations and comments begin with another character, so that they have no name.
    let root = names
        .into_iter()
        .find(|name| !name.is_empty())
        .unwrap_or_default();
    let root = root.rsplit(':').next().unwrap_or_default();
    let known = REFUSED_XML.iter().find(|(name, _)| *name == root);
    known.map_or("xml (convert it to cityjson or geojson)", |(_, what)| what)
}

/// Which kind of JSON it is, by the first member of the root object that tells. Where none does it
/// is CityJSON, whose reader says what is missing.
fn json(text: &[u8]) -> Result<Format, Problem> {
    for (key, value) in RootMembers(Scanner(text)) {
        match (key, value) {
            (b"type", b"CityJSON" | b"CityJSONFeature") => return Ok(Format::CityJson),
            (b"type", b"Topology") => return Err(refused("topojson (convert it to geojson)")),
            (b"type", kind) if GEOJSON_TYPES.contains(&kind) => return Ok(Format::GeoJson),
            (b"CityObjects" | b"geometry-templates", _) => return Ok(Format::CityJson),
            (b"features" | b"coordinates" | b"geometries" | b"bbox", _) => {
                return Ok(Format::GeoJson);
            }
            (b"asset" | b"buffers" | b"bufferViews" | b"accessors" | b"meshes", _)
            | (b"scene" | b"scenes" | b"nodes" | b"extensionsUsed", _) => return Ok(Format::Gltf),
            _ => (),
        }
    }
    Ok(Format::CityJson)
}

/// The members of the object that a text begins with, as far as the text goes: the names, and the
/// values that are strings, both as they are written.
struct RootMembers<'a>(Scanner<'a>);

impl<'a> Iterator for RootMembers<'a> {
    type Item = (&'a [u8], &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            match self.0.next()? {
                Token::Text(name) => {
                    let is_name = matches!(self.0.next()?, Token::Mark(b':'));
                    return is_name.then(|| (name, self.0.value()));
                }
                Token::Mark(b'{' | b',') => (),
                Token::Mark(_) => return None,
            }
        }
    }
}

/// A piece of JSON.
enum Token<'a> {
    /// A string.
    Text(&'a [u8]),
    /// A brace, bracket, colon or comma.
    Mark(u8),
}

/// The pieces of JSON that show its structure.
struct Scanner<'a>(&'a [u8]);

impl<'a> Scanner<'a> {
    fn next(&mut self) -> Option<Token<'a>> {
        let shows = |byte: &u8| matches!(byte, b'"' | b'{' | b'}' | b'[' | b']' | b':' | b',');
        let at = self.0.iter().position(shows)?;
        let (mark, rest) = self.0.get(at..)?.split_first()?;
        self.0 = rest;
        if *mark != b'"' {
            return Some(Token::Mark(*mark));
        }
        let mut is_escaped = false;
        let end = rest.iter().position(|byte| {
            let ends = *byte == b'"' && !is_escaped;
            is_escaped = *byte == b'\\' && !is_escaped;
            ends
        })?;
        let (text, rest) = rest.split_at_checked(end)?;
        self.0 = rest.get(1..)?;
        Some(Token::Text(text))
    }

    /// Passes over the value that comes next, and gives it where it is a string.
    fn value(&mut self) -> &'a [u8] {
        let is_string = self.0.trim_ascii_start().starts_with(b"\"");
        let mut depth = 0_usize;
        loop {
            let before = self.0;
            match self.next() {
                Some(Token::Text(text)) if depth == 0 && is_string => return text,
                Some(Token::Mark(b'{' | b'[')) => depth += 1,
                Some(Token::Mark(b'}' | b']' | b',')) if depth == 0 => {
                    self.0 = before;
                    return &[];
                }
                Some(Token::Mark(b'}' | b']')) => depth -= 1,
                Some(_) => (),
                None => return &[],
            }
        }
    }
}
