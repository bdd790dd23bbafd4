//! Reading the files of an import.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use formats::SceneDescription;

use super::model::Model;
use crate::failure::Failure;
use crate::terminal;

/// Reads all files; `srid` overrules what they say.
pub fn read(files: &[PathBuf], srid: Option<i32>) -> Result<Model, Failure> {
    let bar = terminal::bar(files.len(), "reading");
    let mut model = Model::default();
    let mut frame: Option<(i32, &Path)> = None;
    let mut origins: HashMap<String, &Path> = HashMap::new();
    for path in files {
        let file = read_file(path)?;
        if srid.is_none() {
            frame = same_frame(frame, &file, path)?;
        }
        for feature in &file.features {
            if let Some(other) = origins.insert(feature.name.clone(), path) {
                return Err(Failure::Input(format!(
                    "{}, object {:?}: \"{}\" holds an object of that name as well",
                    path.display(),
                    feature.name,
                    other.display()
                )));
            }
        }
        model.add(file);
        bar.inc(1);
    }
    bar.finish_and_clear();
    model.srid = srid.or(frame.map(|(srid, _)| srid)).unwrap_or(0);
    Ok(model)
}

/// Reads one file, whatever its format.
fn read_file(path: &Path) -> Result<SceneDescription, Failure> {
    let bytes = std::fs::read(path).map_err(|error| Failure::unreadable(path, &error))?;
    formats::read_city_json(&path.display().to_string(), &bytes)
        .map_err(|error| Failure::Input(error.to_string()))
}

/// The frame of the files so far, `file` among them; a file that names none goes with any.
fn same_frame<'a>(
    frame: Option<(i32, &'a Path)>,
    file: &SceneDescription,
    path: &'a Path,
) -> Result<Option<(i32, &'a Path)>, Failure> {
    match (frame, file.srid) {
        (Some((known, other)), Some(srid)) if known != srid => Err(Failure::Input(format!(
            "{} is in EPSG:{srid}, but {} is in EPSG:{known}\n  hint: --srid N takes both as EPSG:N",
            path.display(),
            other.display()
        ))),
        (None, Some(srid)) => Ok(Some((srid, path))),
        _ => Ok(frame),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(srid: Option<i32>) -> SceneDescription {
        SceneDescription {
            srid,
            ..SceneDescription::default()
        }
    }

    #[test]
    fn files_share_a_frame() {
        let [a, b] = [Path::new("a.json"), Path::new("b.json")];
        let frame = same_frame(None, &file(None), a).unwrap();
        let frame = same_frame(frame, &file(Some(7415)), a).unwrap();
        let frame = same_frame(frame, &file(None), b).unwrap();
        assert_eq!(
            same_frame(frame, &file(Some(7415)), b).unwrap(),
            Some((7415, a))
        );
        let refused = same_frame(frame, &file(Some(28992)), b)
            .unwrap_err()
            .to_string();
        assert!(
            refused.starts_with("b.json is in EPSG:28992, but a.json is in EPSG:7415"),
            "{refused}"
        );
    }

    #[test]
    fn files_that_are_not_there_are_named() {
        let refused = read(&["no/such/file.json".into()], None)
            .unwrap_err()
            .to_string();
        assert!(
            refused.starts_with("cannot read \"no/such/file.json\": "),
            "{refused}"
        );
    }
}
