//! Hostile OpenStreetMap PBF: refused by name, never a panic, a hang or a flood.

mod osm_writer;

use formats::{FormatError, ReadOptions, SceneDescription, read_bytes};
use osm_writer::{OsmFile, blob, bytes, header, number, raw, zlib};
use proptest::prelude::*;

fn read(bytes: &[u8]) -> Result<SceneDescription, FormatError> {
    read_bytes("bad.osm.pbf", bytes, &ReadOptions::default())
}

fn message(bytes: &[u8]) -> String {
    read(bytes).unwrap_err().to_string()
}

fn file_header() -> Vec<u8> {
    blob("OSMHeader", &raw(&header(&["OsmSchema-V0.6"])))
}

/// The message for a file with this block after its header.
fn block_message(block: &[u8]) -> String {
    message(&[file_header(), blob("OSMData", &raw(block))].concat())
}

/// A block with one element of a kind, and one string.
fn block_with(kind: u32, element: &[u8]) -> Vec<u8> {
    let (mut group, mut table, mut block) = (Vec::new(), Vec::new(), Vec::new());
    bytes(&mut group, kind, element);
    bytes(&mut table, 1, b"type");
    bytes(&mut block, 1, &table);
    bytes(&mut block, 2, &group);
    block
}

fn seed() -> OsmFile {
    let mut file = OsmFile::new();
    let gabled = [
        ("building", "yes"),
        ("height", "12"),
        ("roof:shape", "gabled"),
    ];
    let nodes = file.rectangle(1, [0.0, 0.0], [20.0, 10.0], &gabled);
    file.rectangle(
        2,
        [1.0, 1.0],
        [8.0, 8.0],
        &[("building:part", "yes"), ("roof:shape", "dome")],
    );
    file.rectangle(3, [40.0, 0.0], [9.0, 9.0], &[]);
    file.rectangle(4, [42.0, 2.0], [3.0, 3.0], &[]);
    let members = [(1, 3, "outer"), (1, 4, "inner")];
    file.relation(
        5,
        &members,
        &[("type", "multipolygon"), ("building", "yes")],
    );
    file.relation(
        6,
        &[(1, 1, "outline"), (1, 2, "part")],
        &[("type", "building")],
    );
    file.way(
        7,
        &nodes[..3],
        &[("highway", "residential"), ("lanes", "2")],
    );
    file.way(8, &nodes, &[("barrier", "wall"), ("width", "0.4")]);
    file.rectangle(9, [0.0, 30.0], [9.0, 9.0], &[("man_made", "bridge")]);
    file
}

#[test]
fn broken_containers_are_refused() {
    let good = seed().raw();
    assert_eq!(read(&good).unwrap().features.len(), 4);
    let start = "bad.osm.pbf: ";
    let cut = message(&good[..good.len() - 1]);
    assert!(
        cut.starts_with(&format!("{start}the blob at byte ")),
        "{cut}"
    );
    assert!(
        cut.ends_with("is malformed: the file ends within it"),
        "{cut}"
    );
    let unknown = blob("OSMHeader", &raw(&header(&["HistoricalInformation"])));
    let expected = "the required feature \"HistoricalInformation\" is not supported";
    assert_eq!(message(&unknown), format!("{start}{expected}"));
    let mut lz4 = Vec::new();
    bytes(&mut lz4, 6, b"x");
    let lz4 = [file_header(), blob("OSMData", &lz4)].concat();
    assert_eq!(
        message(&lz4),
        format!("{start}lz4 compression is not supported")
    );
    let mut corrupt = Vec::new();
    bytes(&mut corrupt, 3, b"no zlib");
    let corrupt = message(&[file_header(), blob("OSMData", &corrupt)].concat());
    assert!(
        corrupt.ends_with("is malformed: its zlib data is corrupt"),
        "{corrupt}"
    );
    assert_eq!(
        read(&file_header()).unwrap(),
        SceneDescription {
            attribution: read(&good).unwrap().attribution,
            ..SceneDescription::default()
        }
    );
}

#[test]
fn lengths_beyond_the_format_are_refused_before_they_are_read() {
    let mut long = Vec::new();
    bytes(&mut long, 1, b"OSMData");
    number(&mut long, 3, u64::MAX);
    let length = (long.len() as u32).to_be_bytes();
    let found = message(&[file_header(), length.to_vec(), long].concat());
    assert!(
        found.ends_with("18446744073709551615 bytes of a blob exceed the limit of 33554432"),
        "{found}"
    );
    let header = message(&[file_header(), vec![0xff; 4]].concat());
    assert!(
        header.ends_with("4294967295 bytes of a blob's header exceed the limit of 65536"),
        "{header}"
    );
    let bomb = zlib(&vec![0; 40 << 20]);
    let found = message(&[file_header(), blob("OSMData", &bomb)].concat());
    assert!(
        found.ends_with("33554433 bytes of an unpacked blob exceed the limit of 33554432"),
        "{found}"
    );
}

#[test]
fn broken_blocks_are_refused() {
    let mut way = Vec::new();
    number(&mut way, 1, 1);
    bytes(&mut way, 2, &[7]);
    bytes(&mut way, 3, &[0]);
    let mut keyless = Vec::new();
    number(&mut keyless, 1, 1);
    bytes(&mut keyless, 2, &[0]);
    let mut far = Vec::new();
    number(&mut far, 1, 2);
    number(&mut far, 8, u64::MAX);
    number(&mut far, 9, 0);
    let mut dense = Vec::new();
    bytes(&mut dense, 1, &[2, 2]);
    bytes(&mut dense, 8, &[2, 2]);
    bytes(&mut dense, 9, &[2]);
    let mut jumps = Vec::new();
    let most = [0xfe, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01];
    bytes(&mut jumps, 1, &[most, most].concat());
    bytes(&mut jumps, 8, &[0, 0]);
    bytes(&mut jumps, 9, &[0, 0]);
    for (kind, element, problem) in [
        (3, way, "the index of a string is out of range"),
        (4, keyless, "a key has no value"),
        (3, vec![], "a way or relation lacks its number"),
        (3, vec![0x12, 9], "a field is longer than its message"),
        (3, vec![0x08, 0x80], "a number does not end"),
        (3, vec![0x0b], "a field is a group"),
        (1, vec![0x08, 2], "a node lacks number or position"),
        (1, far, "a position is out of range"),
        (2, dense, "a node has no position"),
        (2, jumps, "a number is out of range"),
    ] {
        let found = block_message(&block_with(kind, &element));
        let expected = format!("is malformed: {problem}");
        assert!(
            found.starts_with("bad.osm.pbf: the block at byte "),
            "{found}"
        );
        assert!(found.ends_with(&expected), "{found}, expected {problem}");
    }
}

#[test]
fn tags_are_limited_though_a_block_can_repeat_them_for_nothing() {
    let long = "x".repeat(1 << 19);
    let mut file = OsmFile::new();
    for i in 0..600 {
        file.way(i, &[], &[("building", &long)]);
    }
    let found = message(&file.zlib());
    assert!(
        found.contains("bytes of tags exceed the limit of 268435456"),
        "{found}"
    );
}

#[test]
fn outlines_that_are_no_solid_are_skipped() {
    let mut file = OsmFile::new();
    let [a, b, c, d] =
        [[0.0, 0.0], [9.0, 9.0], [9.0, 0.0], [0.0, 5.0]].map(|[x, y]| file.node(x, y));
    let building = [("building", "yes"), ("roof:shape", "hipped")];
    file.way(1, &[a, b, c, d, a], &building);
    file.way(2, &[a, b, a, b, a], &building);
    file.way(3, &[a, b, c], &building);
    file.way(4, &[], &building);
    file.way(5, &[a, a, a, a], &[("barrier", "wall")]);
    let scene = read(&file.raw()).unwrap();
    let whys: Vec<_> = scene.skipped.iter().map(|s| s.why.as_str()).collect();
    let expected = [
        "the outline crosses itself",
        "the outline has no area",
        "the way is not closed",
        "the way is not closed",
        "the line has no length",
    ];
    assert_eq!((scene.features.len(), whys), (0, expected.to_vec()));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 5000, failure_persistence: None, ..Default::default() })]

    #[test]
    fn no_mutation_makes_the_reader_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4_u8), 1..5),
        packed: bool,
    ) {
        let seed = seed();
        let mut file = if packed { seed.zlib() } else { seed.raw() };
        for (at, byte, how) in changes {
            if file.is_empty() {
                break;
            }
            let at = at.index(file.len());
            match how {
                0 => file[at] ^= byte,
                1 => file.truncate(at),
                2 => drop(file.drain(at..(at + usize::from(byte)).min(file.len()))),
                _ => file.insert(at, byte),
            }
        }
        match read(&file) {
            // A changed first byte can make another format of it, whose errors name lines too.
            Err(error) => prop_assert_eq!(error.file(), "bad.osm.pbf"),
            Ok(scene) => {
                let shapes = scene.features.iter().flat_map(|f| &f.geometries).map(|g| &g.shape);
                let mut numbers = shapes.flat_map(|s| &s.surfaces).flat_map(|s| &s.rings).flatten().flatten();
                prop_assert!(numbers.all(|number| number.is_finite()));
            }
        }
    }

    #[test]
    fn values_of_any_kind_are_read_or_told(
        key in prop::sample::select(vec![
            "height", "min_height", "building:levels", "building:min_level", "roof:height",
            "roof:levels", "roof:angle", "roof:direction", "roof:shape", "building:colour", "width",
        ]),
        value in "([0-9.,'\"mft -]{0,8}|NaN|-?inf|1e400|[a-zA-Z_#]{0,9}|\\PC{0,5})",
        shape in prop::sample::select(vec!["gabled", "hipped", "dome", "round", "skillion"]),
    ) {
        let mut file = OsmFile::new();
        file.rectangle(1, [0.0, 0.0], [20.0, 10.0], &[("building", "yes"), (key, &value), ("roof:shape", shape)]);
        file.rectangle(2, [0.0, 0.0], [20.0, 10.0], &[("barrier", "wall"), (key, &value)]);
        let scene = read(&file.raw()).unwrap();
        prop_assert_eq!(scene.features.len() + scene.skipped.len(), 2);
    }
}
