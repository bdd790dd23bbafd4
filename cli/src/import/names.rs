//! [`Names`], the identifiers of an import, each one's own.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use formats::Feature;
use postgres::Transaction;

use crate::database::quoted;
use crate::failure::Failure;

/// Which file each name came from.
#[derive(Debug, Default)]
pub struct Names {
    files: Vec<PathBuf>,
    origins: HashMap<String, usize>,
}

impl Names {
    /// Takes the names of a batch; refuses one that is taken, here or in the scene.
    pub fn take(
        &mut self,
        transaction: &mut Transaction<'_>,
        scene: &str,
        path: &Path,
        features: &[Feature],
    ) -> Result<(), Failure> {
        if self.files.last().is_none_or(|last| last != path) {
            self.files.push(path.to_owned());
        }
        let file = self.files.len() - 1;
        for feature in features {
            if let Some(other) = self.origins.insert(feature.name.clone(), file) {
                return Err(Failure::Input(format!(
                    "{}, object {:?}: \"{}\" holds an object of that name as well",
                    path.display(),
                    feature.name,
                    self.files[other].display()
                )));
            }
        }
        refuse_known(transaction, scene, features)
    }
}

fn refuse_known(
    transaction: &mut Transaction<'_>,
    scene: &str,
    features: &[Feature],
) -> Result<(), Failure> {
    let names: Vec<&str> = features
        .iter()
        .map(|feature| feature.name.as_str())
        .collect();
    let statement = format!(
        "SELECT min(name), count(*) FROM {}.feature WHERE name = ANY ($1)",
        quoted(scene)
    );
    let row = transaction.query_one(&statement, &[&names])?;
    match row.get::<_, Option<&str>>(0) {
        None => Ok(()),
        Some(name) => Err(Failure::Input(format!(
            "scene \"{scene}\" holds {} of these features already, such as \"{name}\"\n  \
             hint: --replace drops the scene first",
            row.get::<_, i64>(1)
        ))),
    }
}
