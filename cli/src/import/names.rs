//! [`Names`], the identifiers of an import, each one's own.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use formats::Feature;

use crate::failure::Failure;

/// Which file each name came from.
#[derive(Debug, Default)]
pub struct Names {
    files: Vec<PathBuf>,
    origins: HashMap<String, usize>,
}

impl Names {
    /// Takes the names of a batch; refuses one that is taken.
    pub fn take(&mut self, path: &Path, features: &[Feature]) -> Result<(), Failure> {
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
        Ok(())
    }
}
