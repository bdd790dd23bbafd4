//! Features from rows: footprints with heights, or surfaces.

mod row;
mod solid;
mod write;

use crate::scene::{self, Workers, quoted};
use pgrx::prelude::*;
use pgrx::spi::SpiClient;
use rayon::prelude::*;
use row::Source;
use solid::Solid;
use write::Writer;

/// Rows read, computed and written together.
const BATCH: i64 = 1000;

/// Imports the rows of a query, whose columns are those of [`Source`]; returns how many became
/// features.
#[pg_extern(volatile, strict)]
fn import_rows(scene: &str, source: &str, query: &str) -> i64 {
    scene::require(scene);
    let workers = Workers::start();
    let first = next_feature(scene);
    let made = Spi::connect_mut(|client| {
        let cursor = client.open_cursor(query, &[]).detach_into_name();
        let writer = Writer::new(client, scene, source)?;
        let mut made = 0;
        loop {
            let sources = fetch(client, &cursor)?;
            if sources.is_empty() {
                return Ok::<_, pgrx::spi::Error>(made);
            }
            let solids: Vec<Result<Solid, String>> =
                workers.run(|_| sources.par_iter().map(Solid::of).collect());
            made += writer.write(client, &sources, &solids)?;
        }
    });
    let made = made.unwrap_or_else(|error| scene::failed(&error));
    if made > 0 {
        scene::settle(scene, first);
    }
    made
}

/// A number that is below those of all features that are yet to come.
fn next_feature(scene: &str) -> i64 {
    let query = "SELECT pg_catalog.nextval(pg_catalog.pg_get_serial_sequence($1, 'id'))";
    let table = format!("{}.feature", quoted(scene));
    let next = Spi::get_one_with_args::<i64>(query, &[table.into()]);
    next.unwrap_or_else(|error| scene::failed(&error))
        .unwrap_or_default()
}

fn fetch(client: &SpiClient<'_>, cursor: &str) -> Result<Vec<Source>, pgrx::spi::Error> {
    let mut found = client.find_cursor(cursor)?;
    let rows = found.fetch(BATCH)?.map(|row| Source::of(&row)).collect();
    found.detach_into_name();
    rows
}
