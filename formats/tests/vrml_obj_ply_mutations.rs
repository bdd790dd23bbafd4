//! Mutated files of VRML97, OBJ and PLY: whatever happens to the bytes, the readers give a scene
//! that is well-formed, or an error with its place.

use std::io;

use formats::{FormatError, ReadOptions, SceneDescription, read_bytes};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Files, and pieces that a mutation puts into them.
struct Corpus {
    name: &'static str,
    seeds: &'static [&'static [u8]],
    pieces: &'static [&'static str],
}

const VRML: Corpus = Corpus {
    name: "a.wrl",
    seeds: &[
        b"#VRML V2.0 utf8\nWorldInfo { info [ \"srid 28992\" ] }\n\
          DEF A Transform { translation 1 2 3 rotation 0 1 0 .5 scale 2 2 2 children [\n\
          WorldInfo { info [ \"class Building\" \"attributes {}\" \"level_of_detail 2.2\" ] }\n\
          DEF S Shape { appearance Appearance { material DEF M Material { diffuseColor 1 0 0 } }\n\
          geometry IndexedFaceSet { coord DEF C Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 0 1 ] }\n\
          coordIndex [ 0 1 2 -1 0, 2, 3 ] } } ] }\n\
          DEF B Group { children [ USE S Transform { scale -1 1 1 children USE S } ] }",
        b"#VRML V2.0 utf8\nGroup { children [ Switch { whichChoice 0 choice Shape { geometry Box { } } }\n\
          LOD { level [ Shape { geometry Sphere { } } Shape { geometry Cone { } } Shape {\n\
          geometry Cylinder { radius 2 } } ] range [ 1 2 ] }\n\
          Shape { geometry ElevationGrid { xDimension 2 zDimension 2 height [ 0 1 2 5 ] } }\n\
          Shape { geometry Extrusion { spine [ 0 0 0, 0 1 0, 1 2 0, 0 0 0 ] scale [ 1 1, 2 2 ]\n\
          orientation [ 0 1 0 1 ] crossSection [ 0 0, 1 0, 0 1, 0 0 ] } } ] ROUTE A.b TO C.d }\n\
          DEF X Script { field MFNode a [ Group { } ] eventIn SFBool b } PixelTexture { image 1 1 1 0xFF }",
    ],
    pieces: &[
        "-1", "0.5", "1e308", "1e999", "0xFFFFFFFF", "99999999999", "NULL", "TRUE", "USE A", "USE S",
        "DEF S", "{", "}", "[", "]", "\"", "#", ".", "Group {", "children [", "PROTO", "Shape {",
        "geometry Sphere { }", "\r", "\u{feff}", "e\u{301}", "scale 0 0 0", "whichChoice 7",
    ],
};

const OBJ: Corpus = Corpus {
    name: "a.obj",
    seeds: &[
        b"# a\nmtllib a.mtl b.mtl\no a\nv 0 0 0\nv 1 0 0\nv 1 1 \\\n 0\nv 0 1 2 1 0 0\nvt 0 0\n\
          usemtl red\nf 1/1 2/1 3/1\nf -4//1 -3 -2 -1\no b\nf 1 2 4\nl 1 2\no a\nf 2 3 4\n",
        b"g x y\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng\nf 3 2 1\ns off\np 1\ncurv 1\n",
    ],
    pieces: &[
        "-1",
        "0",
        "1e308",
        "nan",
        "inf",
        "9223372036854775807",
        "-9223372036854775808",
        "/",
        "//",
        "\\\n",
        "\n",
        "o ",
        "g ",
        "f 1 2 3",
        "v 1 1 1",
        "#",
        "usemtl ",
        "mtllib a.mtl",
        "\r",
        "\0",
    ],
};

const PLY: Corpus = Corpus {
    name: "a.ply",
    seeds: &[
        b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
          property float z\nelement face 2\nproperty list uchar int vertex_indices\n\
          property int object\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 5\n3 2 1 0 6\n",
        b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\n\
          property uchar z\nelement face 2\nproperty list uchar uchar vertex_index\nend_header\n\
          \x00\x00\x00\x01\x00\x00\x00\x01\x00\x03\x00\x01\x02\x03\x02\x01\x00",
        b"ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty short x\nproperty char y\n\
          property double z\nelement edge 1\nproperty list int float a\nelement face 0\n\
          property list uint ushort vertex_index\nend_header\n\x00\x00\x00",
    ],
    pieces: &[
        "-1", "0", "1e308", "nan", "18446744073709551615", "16000000", "end_header\n", "list ", "int",
        "double", "element a 9999999\n", "property float b\n", "\n", "\r", "\0\0\0\0",
        "element vertex 1\n", "comment\n",
    ],
};

/// One change to a file; positions are taken modulo its length.
#[derive(Clone, Debug)]
enum Mutation {
    Flip(usize, u8),
    Truncate(usize),
    Remove(usize, usize),
    Repeat(usize, usize),
    Insert(usize, usize),
    /// Puts a piece in place of the n-th word.
    Word(usize, usize),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let at = any::<usize>;
    prop_oneof![
        2 => (at(), 1u8..).prop_map(|(i, bits)| Mutation::Flip(i, bits)),
        1 => at().prop_map(Mutation::Truncate),
        2 => (at(), 1usize..40).prop_map(|(i, length)| Mutation::Remove(i, length)),
        2 => (at(), 1usize..200).prop_map(|(i, length)| Mutation::Repeat(i, length)),
        4 => (at(), at()).prop_map(|(i, piece)| Mutation::Insert(i, piece)),
        6 => (at(), at()).prop_map(|(i, piece)| Mutation::Word(i, piece)),
    ]
}

fn mutate(bytes: &mut Vec<u8>, mutation: &Mutation, pieces: &[&str]) {
    if bytes.is_empty() {
        return;
    }
    let length = bytes.len();
    let range = |i: usize, count: usize| i % length..(i % length + count).min(length);
    let piece = |i: usize| pieces[i % pieces.len()].bytes();
    match *mutation {
        Mutation::Flip(i, bits) => bytes[i % length] ^= bits,
        Mutation::Truncate(i) => bytes.truncate(i % length),
        Mutation::Remove(i, count) => drop(bytes.drain(range(i, count))),
        Mutation::Repeat(i, count) => {
            let copy = bytes[range(i, count)].to_vec();
            bytes.splice(i % length..i % length, copy);
        }
        Mutation::Insert(i, with) => drop(bytes.splice(i % length..i % length, piece(with))),
        Mutation::Word(i, with) => {
            let ends = |from: usize| bytes[from..].iter().position(u8::is_ascii_whitespace);
            let start = ends(i % length).map_or(0, |end| i % length + end + 1);
            let end = ends(start.min(length)).map_or(length, |end| start + end);
            bytes.splice(start.min(end)..end, piece(with));
        }
    }
}

fn read(corpus: &Corpus, bytes: &[u8]) -> Result<SceneDescription, FormatError> {
    let companion = |name: &str| match name {
        "a.mtl" => Ok(b"newmtl red\nKd 1 0 0\n".to_vec()),
        _ => Err(io::ErrorKind::NotFound.into()),
    };
    let options = ReadOptions {
        companion: &companion,
        ..ReadOptions::default()
    };
    read_bytes(corpus.name, bytes, &options)
}

/// Whether a scene keeps what its description promises.
fn check(scene: &SceneDescription) -> Result<(), TestCaseError> {
    for feature in &scene.features {
        prop_assert!(!feature.geometries.is_empty() && feature.attributes.is_object());
        for geometry in &feature.geometries {
            let (shape, surfaces) = (&geometry.shape, geometry.surfaces());
            prop_assert!(!surfaces.is_empty());
            for surface in surfaces.iter() {
                let known = surface
                    .material
                    .is_none_or(|i| (i as usize) < shape.materials.len());
                prop_assert!(known);
                for ring in &surface.rings {
                    let next = ring.iter().cycle().skip(1);
                    prop_assert!(ring.len() > 2 && ring.iter().zip(next).all(|(a, b)| a != b));
                    prop_assert!(ring.iter().flatten().all(|c| c.abs() <= 1e9));
                }
            }
        }
    }
    Ok(())
}

fn survives(corpus: &Corpus, seed: usize, mutations: &[Mutation]) -> Result<(), TestCaseError> {
    let mut bytes = corpus.seeds[seed % corpus.seeds.len()].to_vec();
    for mutation in mutations {
        mutate(&mut bytes, mutation, corpus.pieces);
    }
    match read(corpus, &bytes) {
        Ok(scene) => check(&scene),
        Err(error) => {
            prop_assert!(error.to_string().starts_with(corpus.name), "{}", error);
            Ok(())
        }
    }
}

/// The same cases in every run.
fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 2000,
        rng_seed: RngSeed::Fixed(97),
        ..ProptestConfig::default()
    }
}

#[test]
fn seeds_are_right_as_they_are() {
    for corpus in [VRML, OBJ, PLY] {
        for (i, seed) in corpus.seeds.iter().enumerate().take(2) {
            let scene = read(&corpus, seed).expect("a seed is right");
            assert!(!scene.features.is_empty(), "{} {i}", corpus.name);
        }
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn vrml_survives(seed in any::<usize>(), mutations in prop::collection::vec(mutation(), 1..8)) {
        survives(&VRML, seed, &mutations)?;
    }

    #[test]
    fn obj_survives(seed in any::<usize>(), mutations in prop::collection::vec(mutation(), 1..8)) {
        survives(&OBJ, seed, &mutations)?;
    }

    #[test]
    fn ply_survives(seed in any::<usize>(), mutations in prop::collection::vec(mutation(), 1..8)) {
        survives(&PLY, seed, &mutations)?;
    }
}
