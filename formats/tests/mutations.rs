//! Mutated documents: whatever happens to the bytes, the reader gives a scene or an error.

mod common;

use common::{building, document, object, read_all, sequence_of_buildings};
use formats::{Feature, Model, pack, unpack, write_city_json_seq};
use proptest::prelude::*;

/// Numbers and pieces that a mutation puts in.
const PIECES: [&str; 16] = [
    "-1",
    "0.5",
    "1e999",
    "99999999999",
    "NaN",
    "null",
    "\"\"",
    "[]",
    "{}",
    "[",
    "}",
    ",",
    "8",
    "-1e308",
    "\n",
    "\u{feff}",
];

/// One change to a document; positions are taken modulo its length.
#[derive(Clone, Debug)]
enum Mutation {
    Flip(usize, u8),
    Truncate(usize),
    Remove(usize, usize),
    Repeat(usize, usize),
    /// Puts a piece in place of the n-th number.
    Number(usize, usize),
    Insert(usize, usize),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let at = any::<usize>;
    prop_oneof![
        (at(), 1u8..).prop_map(|(i, bits)| Mutation::Flip(i, bits)),
        at().prop_map(Mutation::Truncate),
        (at(), 1usize..40).prop_map(|(i, length)| Mutation::Remove(i, length)),
        (at(), 1usize..200).prop_map(|(i, length)| Mutation::Repeat(i, length)),
        (at(), at()).prop_map(|(i, piece)| Mutation::Number(i, piece)),
        (at(), at()).prop_map(|(i, piece)| Mutation::Insert(i, piece)),
    ]
}

fn mutate(bytes: &mut Vec<u8>, mutation: &Mutation) {
    if bytes.is_empty() {
        return;
    }
    let length = bytes.len();
    let range = |i: usize, count: usize| i % length..(i % length + count).min(length);
    let piece = |piece: usize| PIECES[piece % PIECES.len()].bytes();
    match *mutation {
        Mutation::Flip(i, bits) => bytes[i % length] ^= bits,
        Mutation::Truncate(i) => bytes.truncate(i % length),
        Mutation::Remove(i, count) => drop(bytes.drain(range(i, count))),
        Mutation::Repeat(i, count) => {
            let copy = bytes[range(i, count)].to_vec();
            bytes.splice(i % length..i % length, copy);
        }
        Mutation::Number(i, with) => {
            let numbers = number_ranges(bytes);
            if !numbers.is_empty() {
                bytes.splice(numbers[i % numbers.len()].clone(), piece(with));
            }
        }
        Mutation::Insert(i, with) => drop(bytes.splice(i % length..i % length, piece(with))),
    }
}

/// Where the runs of digits are.
fn number_ranges(bytes: &[u8]) -> Vec<std::ops::Range<usize>> {
    let mut start = 0;
    let mut ranges = Vec::new();
    for run in bytes.chunk_by(|a, b| a.is_ascii_digit() == b.is_ascii_digit()) {
        if run[0].is_ascii_digit() {
            ranges.push(start..start + run.len());
        }
        start += run.len();
    }
    ranges
}

/// What holds of every feature: finite positions, and numbers that select something.
fn assert_sound(feature: &Feature) {
    let is_part = |name: &String| feature.parts.iter().any(|part| part.name == *name);
    for geometry in &feature.geometries {
        assert!(geometry.part.as_ref().is_none_or(is_part));
        let shape = &geometry.shape;
        let selects =
            |number: Option<u32>, count: usize| number.is_none_or(|n| (n as usize) < count);
        for surface in geometry.surfaces().iter() {
            assert!(selects(surface.material, shape.materials.len()));
            assert!(selects(surface.semantic, shape.semantics.len()));
            let mut coordinates = surface.rings.iter().flatten().flatten();
            assert!(coordinates.all(|coordinate| coordinate.abs() <= 1e9));
        }
    }
}

fn seeds() -> Vec<Vec<u8>> {
    let road = object("r", "Road", "MultiSurface", "[[[0,1,2,3],[4,5,6]]]");
    let part = object("p", "BuildingPart", "MultiSurface", "[[[0,1,2]]]").replacen(
        '{',
        r#"{"parents":["a"],"#,
        1,
    );
    vec![
        document(&[building("a"), part, road].join(",")).into_bytes(),
        sequence_of_buildings(2),
        include_bytes!("data/trees.city.jsonl").to_vec(),
        include_bytes!("data/painted.city.json").to_vec(),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..Default::default() })]

    #[test]
    fn what_is_read_of_a_mutation_can_be_packed_and_written(
        seed in 0usize..4,
        mutation in mutation(),
    ) {
        let mut bytes = seeds().swap_remove(seed);
        mutate(&mut bytes, &mutation);
        for feature in read_all("mutated", &bytes).map_or(Vec::new(), |scene| scene.features) {
            let packed = pack(&feature.geometries, &feature.parts).unwrap();
            let (parts, geometries) = unpack(&packed).unwrap();
            prop_assert_eq!((&parts, &geometries), (&feature.parts, &feature.geometries));
            let written = write_city_json_seq(&[Model { id: 1, feature }], None);
            let again = read_all("written", written.as_bytes());
            prop_assert!(again.is_ok(), "{:?} of {}", again, written);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..Default::default() })]

    #[test]
    fn no_mutation_makes_the_reader_panic(
        seed in 0usize..4,
        mutations in prop::collection::vec(mutation(), 1..6),
    ) {
        let mut bytes = seeds().swap_remove(seed);
        mutations.iter().for_each(|mutation| mutate(&mut bytes, mutation));
        match read_all("mutated", &bytes) {
            Err(error) => prop_assert!(error.to_string().starts_with("mutated")),
            Ok(scene) => for feature in &scene.features {
                assert_sound(feature);
            },
        }
    }

    #[test]
    fn random_indices_are_read_or_refused_by_range(
        rings in prop::collection::vec(prop::collection::vec(0u64..10, 0..6), 1..6),
    ) {
        let text = document(&object("a", "Building", "MultiSurface", &format!("[{rings:?}]")));
        let wrong = rings.iter().flatten().find(|index| **index > 7);
        match (read_all("a", text.as_bytes()), wrong) {
            (Err(error), Some(index)) => {
                let expected = format!("vertex index {index} is out of range, there are 8");
                prop_assert!(error.to_string().ends_with(&expected), "{}", error);
            }
            (Ok(scene), None) => {
                let mut distinct = rings[0].clone();
                distinct.dedup();
                while distinct.len() > 1 && distinct.first() == distinct.last() {
                    distinct.pop();
                }
                prop_assert_eq!(scene.features.len(), usize::from(distinct.len() >= 3));
            }
            (result, _) => prop_assert!(false, "{:?} for {:?}", result, rings),
        }
    }
}
