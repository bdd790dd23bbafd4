//! What the end-to-end tests share: the built command line, scenes on a real cluster that vanish
//! with their test, and small cities made on the spot. `DATABASE_URL` names a database with the
//! extension; without it every test fails.
#![forbid(unsafe_code)]

mod city;
mod database;
mod program;
mod scene;

pub use city::City;
pub use database::TestDatabase;
pub use program::{Run, occlusion, occlusion_with_embree, shell, start};
pub use scene::{TestScene, client, database_url};

use std::path::{Path, PathBuf};

/// A file of the folder of real cities, if it is there.
#[must_use]
pub fn real_file(name: &str) -> Option<PathBuf> {
    let beside_workspace = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("PG_OCCLUSION_DATA").map_or_else(beside_workspace, PathBuf::from);
    let path = folder.join(name);
    path.exists().then_some(path)
}
