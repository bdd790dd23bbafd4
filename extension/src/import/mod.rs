//! Features from rows: footprints with heights, or surfaces.

mod row;
mod solid;
mod write;

use crate::scene::{self, Workers};
use crate::visibility::pack_if_possible;
use pgrx::prelude::*;
use pgrx::spi::SpiClient;
use rayon::prelude::*;
use row::Source;
use solid::Solid;
use std::sync::atomic::{AtomicBool, Ordering};
use write::Writer;

/// Rows read, computed and written together.
const BATCH: i64 = 1000;

/// Imports the rows of a query, whose columns are those of [`Source`]; returns how many became
/// features.
#[pg_extern(volatile, strict)]
fn import_rows(scene: &str, source: &str, query: &str) -> i64 {
    scene::require(scene);
    let workers = Workers::start();
    let made = Spi::connect_mut(|client| {
        let cursor = client.open_cursor(query, &[]).detach_into_name();
        let writer = Writer::new(client, scene, source)?;
        let mut made = Vec::new();
        loop {
            let sources = fetch(client, &cursor)?;
            if sources.is_empty() {
                return Ok::<_, pgrx::spi::Error>(made);
            }
            let solids = workers.run(|cancelled| solids(&sources, cancelled));
            made.extend(writer.write(client, &sources, &solids)?);
        }
    });
    let made = made.unwrap_or_else(|error| scene::failed(&error));
    scene::settle(scene, &made);
    pack_if_possible(scene);
    scene::count(made.len())
}

/// The solids of rows. A cancelled batch ends soon and is thrown away.
fn solids(sources: &[Source], cancelled: &AtomicBool) -> Vec<Result<Solid, String>> {
    let solid = |source: &Source| match cancelled.load(Ordering::Relaxed) {
        true => Err("cancelled".to_owned()),
        false => Solid::of(source),
    };
    sources.par_iter().map(solid).collect()
}

fn fetch(client: &SpiClient<'_>, cursor: &str) -> Result<Vec<Source>, pgrx::spi::Error> {
    let mut found = client.find_cursor(cursor)?;
    let rows = found.fetch(BATCH)?.map(|row| Source::of(&row)).collect();
    found.detach_into_name();
    rows
}
