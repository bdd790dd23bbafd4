//! Formats by content, whatever a file is called.

mod common;

use formats::{Format, ReadOptions, read_bytes};

fn message(bytes: &[u8]) -> String {
    read_bytes("file", bytes, &ReadOptions::default())
        .unwrap_err()
        .to_string()
}

#[test]
fn every_format_is_known_by_its_first_bytes() {
    let cases: [(Format, &[u8]); 26] = [
        (Format::CityJson, br#"{"type":"CityJSON","version":"2.0"}"#),
        (
            Format::CityJson,
            b"\xef\xbb\xbf\n {\"version\":\"2.0\", \"type\" : \"CityJSON\"}",
        ),
        (
            Format::CityJson,
            br#"{"metadata":{"type":"Feature"},"CityObjects":{"#,
        ),
        (
            Format::CityJson,
            br#"{"extensions":["\"}",{"features":[]}],"type":"CityJSON""#,
        ),
        (
            Format::GeoJson,
            br#"{"type":"FeatureCollection","features":[]}"#,
        ),
        (
            Format::GeoJson,
            br#"{"name":"a","crs":{"type":"name","properties":{}},"features":[{"#,
        ),
        (Format::GeoJson, br#"{"bbox":[0,0,1,1],"ty"#),
        (
            Format::GeoJson,
            br#"{"properties":{"CityObjects":1},"type":"Feature"}"#,
        ),
        (
            Format::GeoJson,
            br#"{"type":"MultiPolygon","coordinates":[]}"#,
        ),
        (Format::Gltf, br#"{"asset":{"version":"2.0"}}"#),
        (
            Format::Gltf,
            br#"{"scenes":[{"nodes":[0]}],"type":"CityJSON"}"#,
        ),
        (Format::Gltf, br#"{"accessors":[{"type":"VEC3"}"#),
        (Format::Gltf, b"glTF\x02\x00\x00\x00"),
        (Format::Vrml97, b"#VRML V2.0 utf8\nShape {}"),
        (Format::Ply, b"ply\nformat ascii 1.0\n"),
        (Format::Ply, b"ply\r\nformat binary_little_endian 1.0\r\n"),
        (Format::Obj, b"v 0 0 0\n"),
        (Format::Obj, b"# a comment\r\n\r\n  mtllib a.mtl\r\n"),
        (Format::Obj, b"usemtl red\n"),
        (Format::Obj, b"o house\nv 1 2 3"),
        (Format::Obj, b"# nothing but a long comment"),
        (Format::Obj, b"vn 0 0 1\n"),
        (Format::Obj, b"g\nf 1 2 3\n"),
        (Format::OsmPbf, b"\x00\x00\x00\x0d\x0a\x09OSMHeader\x18\x7c"),
        // Its own reader says what these lack.
        (Format::CityJson, b"{}"),
        (Format::CityJson, br#"{"type":"Unknown"}"#),
    ];
    for (format, start) in cases {
        let shown = String::from_utf8_lossy(start);
        assert_eq!(Format::recognise(start), Some(format), "{shown}");
    }
}

#[test]
fn formats_that_are_not_read_are_named_with_what_to_do() {
    let cases: [(&[u8], &str); 20] = [
        (b"#VRML V1.0 ascii\n", "vrml 1.0 (convert it to vrml97)"),
        (b"#X3D V3.3 utf8\n", "x3d (convert it to vrml97 or gltf)"),
        (
            b"PK\x03\x04\x14",
            "a zip archive, such as kmz (unpack it first)",
        ),
        (b"\x1f\x8b\x08", "gzip (unpack it first)"),
        (b"BZh91AY", "bzip2 (unpack it first)"),
        (b"\x28\xb5\x2f\xfd\x04", "zstandard (unpack it first)"),
        (b"\xfd7zXZ\x00", "xz (unpack it first)"),
        (b"\xff\xfe{\x00", "utf-16 text (save it as utf-8)"),
        (b"ISO-10303-21;", "ifc (convert it to cityjson or gltf)"),
        (
            b"SQLite format 3\x00",
            "a database, such as geopackage (convert it to geojson)",
        ),
        (b"solid cube\nfacet", "stl (convert it to obj or ply)"),
        (b"Kaydara FBX Binary", "fbx (convert it to gltf)"),
        (
            b"<?xml version=\"1.0\"?>\n<!-- a -->\n<core:CityModel xmlns=\"a\">",
            "citygml (convert it to cityjson)",
        ),
        (b"<X3D version='3.0'>", "x3d (convert it to vrml97 or gltf)"),
        (
            b"<osm version=\"0.6\">",
            "openstreetmap xml (convert it to openstreetmap pbf)",
        ),
        (b"<kml xmlns=\"a\"/>", "kml (convert it to geojson)"),
        (b"<COLLADA>", "collada (convert it to gltf)"),
        (
            b"<wfs:FeatureCollection>",
            "gml (convert it to geojson or cityjson)",
        ),
        (b"<html>", "xml (convert it to cityjson or geojson)"),
        (
            br#"{"type":"Topology","arcs":[]}"#,
            "topojson (convert it to geojson)",
        ),
    ];
    for (start, what) in cases {
        assert_eq!(Format::recognise(start), None);
        assert_eq!(message(start), format!("file: {what} is not supported"));
    }
}

#[test]
fn what_is_empty_or_unknown_is_refused() {
    for empty in [&b""[..], b" \n\t", b"\xef\xbb\xbf\n"] {
        assert_eq!(message(empty), "file: the file is empty");
    }
    let unknown: [&[u8]; 6] = [
        b"[1]",
        b"#!/bin/sh\nexit",
        b"x",
        b"plywood",
        b"\0\0\0\0",
        b"very",
    ];
    for start in unknown {
        assert_eq!(message(start), "file: the format is not known");
    }
}

#[test]
fn the_end_of_what_is_seen_may_fall_anywhere() {
    let documents: [&[u8]; 4] = [
        br#"{"a":"\"","b":[{"type":"Feature"}],"type":"CityJSON","CityObjects":{}}"#,
        b"<?xml version=\"1.0\"?><a:CityModel>",
        b"# comment\nv 0 0 0\n",
        b"\x00\x00\x00\x0d\x0a\x09OSMHeader",
    ];
    for document in documents {
        for end in 0..=document.len() {
            // Any answer will do; none may be a panic.
            let _ = Format::recognise(&document[..end]);
        }
    }
}

#[test]
fn real_files_are_recognised() {
    let otherwise = || common::sequence_of_buildings(1);
    for name in [
        "DH_01_subs.city.json",
        "delft.city.jsonl",
        "delft_1b.json",
        "delft_lod1_with_roads.json",
        "geom_temp.city.jsonl",
        "noise_extension.city.jsonl",
        "rotterdam_subset.json",
        "small.city.jsonl",
    ] {
        let bytes = common::real_file(name).unwrap_or_else(otherwise);
        let start = &bytes[..bytes.len().min(500)];
        assert_eq!(Format::recognise(start), Some(Format::CityJson), "{name}");
    }
}
