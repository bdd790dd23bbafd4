//! Reading in batches: their sum is the whole, and a reader stops when it is told to.

mod common;

use std::io::{self, BufRead, Cursor, Read, Seek, SeekFrom};
use std::ops::ControlFlow;

use common::{building, document, sequence_of_buildings};
use formats::{ReadOptions, SceneDescription, read, read_bytes};

fn batches(bytes: &[u8], batch_bytes: usize, most: usize) -> Vec<SceneDescription> {
    let options = ReadOptions {
        batch_bytes,
        ..ReadOptions::default()
    };
    let mut batches = Vec::new();
    let result = read("a", &mut Cursor::new(bytes), &options, &mut |batch| {
        batches.push(batch);
        match batches.len() < most {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        }
    });
    result.unwrap_or_else(|error| panic!("{error}"));
    batches
}

fn a_document_and_a_sequence() -> [Vec<u8>; 2] {
    let buildings: Vec<_> = (0..20).map(|i| building(&i.to_string())).collect();
    [
        document(&buildings.join(",")).into_bytes(),
        sequence_of_buildings(20),
    ]
}

#[test]
fn the_sum_of_small_batches_is_the_whole() {
    for bytes in a_document_and_a_sequence() {
        let whole = read_bytes("a", &bytes, &ReadOptions::default()).unwrap();
        for (batch_bytes, least) in [(0, 20), (1, 20), (10_000, 2), (usize::MAX, 1)] {
            let batches = batches(&bytes, batch_bytes, usize::MAX);
            assert!(
                batches.len() >= least,
                "{} of {batch_bytes} bytes",
                batches.len()
            );
            let mut sum = SceneDescription::default();
            for batch in batches {
                assert_eq!((batch.srid, &batch.title), (whole.srid, &whole.title));
                assert!(!batch.features.is_empty());
                sum.add(batch);
            }
            assert_eq!(sum, whole);
        }
    }
}

#[test]
fn a_file_without_objects_gives_one_batch() {
    let text = document("").replace("\"version\"", r#""metadata":{"title":"t"},"version""#);
    let batches = batches(text.as_bytes(), 0, usize::MAX);
    assert_eq!(batches.len(), 1);
    assert_eq!(batches[0].title.as_deref(), Some("t"));
}

#[test]
fn nothing_is_read_after_a_break() {
    for mut bytes in a_document_and_a_sequence() {
        if bytes.contains(&b'\n') {
            bytes.extend(b"\nno json at all");
        }
        assert_eq!(batches(&bytes, 0, 3).len(), 3);
    }
}

/// A sequence whose lines are made as they are read, so that no one can hold it.
struct Endless {
    line: Cursor<Vec<u8>>,
    number: usize,
}

impl Endless {
    fn refill(&mut self) {
        if self.line.position() < self.line.get_ref().len() as u64 {
            return;
        }
        self.number += 1;
        let id = self.number.to_string();
        let line = format!(
            r#"{{"type":"CityJSONFeature","id":"{id}","CityObjects":{{{}}},"vertices":[{}]}}"#,
            building(&id),
            common::BOX_VERTICES
        );
        self.line = Cursor::new((line + "\n").into_bytes());
    }
}

impl Read for Endless {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.refill();
        self.line.read(buffer)
    }
}

impl BufRead for Endless {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.refill();
        self.line.fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        self.line.consume(amount);
    }
}

impl Seek for Endless {
    fn seek(&mut self, _: SeekFrom) -> io::Result<u64> {
        Err(io::ErrorKind::Unsupported.into())
    }
}

#[test]
fn a_sequence_without_end_is_read_as_far_as_asked() {
    let header = [sequence_of_buildings(0), b"\n".to_vec()].concat();
    let mut input = Endless {
        line: Cursor::new(header),
        number: 0,
    };
    let options = ReadOptions {
        batch_bytes: 100_000,
        ..ReadOptions::default()
    };
    let (mut features, mut largest) = (0, 0);
    read("endless", &mut input, &options, &mut |batch| {
        features += batch.features.len();
        largest = largest.max(batch.features.len());
        match features < 5000 {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        }
    })
    .unwrap();
    assert!(
        (5000..6000).contains(&features) && largest < 200,
        "{features}, {largest}"
    );
}
