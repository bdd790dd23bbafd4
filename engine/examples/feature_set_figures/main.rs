//! What a set of features takes, in bytes and in time: `FeatureSet` against other forms, on sets of
//! a generated city of streets.
//!
//!     cargo run --release -p engine --example feature_set_figures [-- FEATURES]

mod rivals;
mod sets;

use std::hint::black_box;
use std::time::Instant;

use rivals::{Codec, DeltaVarint, EliasFano, Ours, PackedBlocks, Plain, Rice, Roaring, Runs, Tree};

/// Each figure of time is the best of so many runs over all sets.
const RUNS: usize = 15;

fn main() {
    let features = std::env::args()
        .nth(1)
        .map_or(100_000, |text| text.parse().expect("a number of features"));
    let codecs: [&dyn Codec; 10] = [
        &Plain,
        &DeltaVarint,
        &Runs,
        &PackedBlocks,
        &Rice,
        &EliasFano,
        &Tree,
        &Roaring { runs: false },
        &Roaring { runs: true },
        &Ours,
    ];
    for family in sets::families(features) {
        let numbers: usize = family.sets.iter().map(Vec::len).sum();
        println!(
            "\n{}: {} sets, {:.0} numbers on average",
            family.name,
            family.sets.len(),
            numbers as f64 / family.sets.len() as f64
        );
        for codec in codecs {
            report(codec, &family.sets, numbers);
        }
    }
}

fn report(codec: &dyn Codec, sets: &[Vec<u32>], numbers: usize) {
    let begin = Instant::now();
    let encoded: Vec<Vec<u8>> = sets.iter().map(|set| codec.encode(set)).collect();
    let encoding = begin.elapsed();
    for (set, bytes) in sets.iter().zip(&encoded) {
        let sum: u64 = set.iter().map(|&n| u64::from(n)).sum();
        assert_eq!(codec.sum(bytes), sum, "{}", codec.name());
    }
    let decoding = (0..RUNS)
        .map(|_| {
            let begin = Instant::now();
            for bytes in &encoded {
                black_box(codec.sum(black_box(bytes)));
            }
            begin.elapsed()
        })
        .min()
        .expect("it ran");
    let bytes: usize = encoded.iter().map(Vec::len).sum();
    println!(
        "  {:24} {:7.0} bytes a set, {:5.2} bits a number, decode {:5.2} ns, encode {:6.2} ns a number",
        codec.name(),
        bytes as f64 / sets.len() as f64,
        bytes as f64 * 8.0 / numbers as f64,
        decoding.as_secs_f64() * 1e9 / numbers as f64,
        encoding.as_secs_f64() * 1e9 / numbers as f64,
    );
}
