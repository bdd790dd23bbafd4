//! Files of an import.

use std::fs::{self, File};
use std::io::{self, BufReader};
use std::path::{Component, Path, PathBuf};

use formats::{Format, ReadOptions, Sink};
use indicatif::ProgressBar;

use crate::failure::Failure;

/// Bytes of a file that are at hand to recognise its format by.
const START_BYTES: usize = 64 << 10;

/// A file that is open.
#[derive(Debug)]
pub struct OpenFile {
    /// As the user gave it.
    pub path: PathBuf,
    /// Its size.
    pub bytes: u64,
    content: File,
}

/// Opens all files, so that a missing one is found before any work is done.
pub fn open_all(paths: &[PathBuf]) -> Result<Vec<OpenFile>, Failure> {
    paths.iter().map(|path| OpenFile::open(path)).collect()
}

impl OpenFile {
    fn open(path: &Path) -> Result<Self, Failure> {
        let unreadable = |error: io::Error| Failure::unreadable(path, &error);
        let content = File::open(path).map_err(unreadable)?;
        let metadata = content.metadata().map_err(unreadable)?;
        if metadata.is_dir() {
            return Err(unreadable(io::ErrorKind::IsADirectory.into()));
        }
        Ok(Self {
            path: path.to_owned(),
            bytes: metadata.len(),
            content,
        })
    }

    /// Reads it batch by batch, whatever its format.
    pub fn read(
        &mut self,
        bar: &ProgressBar,
        options: &ReadOptions<'_>,
        sink: &mut Sink<'_>,
    ) -> Result<Format, Failure> {
        let mut input = BufReader::with_capacity(START_BYTES, bar.wrap_read(&self.content));
        let name = self.path.display().to_string();
        formats::read(&name, &mut input, options, sink)
            .map_err(|error| Failure::Input(error.to_string()))
    }
}

/// The content of a file that another one names: in the same folder or below it, never elsewhere.
pub fn companion(of: &Path, name: &str) -> io::Result<Vec<u8>> {
    let relative = Path::new(name);
    if !relative
        .components()
        .all(|part| matches!(part, Component::Normal(_)))
    {
        return Err(io::Error::new(
            io::ErrorKind::PermissionDenied,
            "it is not beside the file that names it",
        ));
    }
    fs::read(of.with_file_name("").join(relative))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_are_not_there_are_named() {
        let refused = open_all(&["no/such/file.json".into()])
            .unwrap_err()
            .to_string();
        assert!(
            refused.starts_with("cannot read \"no/such/file.json\": "),
            "{refused}"
        );
        let refused = open_all(&[".".into()]).unwrap_err().to_string();
        assert!(refused.starts_with("cannot read \".\": "), "{refused}");
    }

    #[test]
    fn companions_lie_beside_the_file() {
        let here = Path::new("src/import/file.rs");
        assert!(companion(here, "mod.rs").is_ok());
        for elsewhere in [
            "../main.rs",
            "/etc/hostname",
            "a/../../main.rs",
            "./mod.rs/..",
        ] {
            let refused = companion(here, elsewhere).unwrap_err();
            assert_eq!(
                refused.kind(),
                io::ErrorKind::PermissionDenied,
                "{elsewhere}"
            );
        }
    }
}
