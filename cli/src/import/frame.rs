//! [`Frame`], the reference system of an import.

use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// The reference system that files agree on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// What the user says, whatever the files do.
    asked: Option<i32>,
    /// What is known so far, and who said so first: a file, or the scene.
    known: Option<(i32, Option<PathBuf>)>,
}

impl Frame {
    /// Before any file; `scene` is the system of a scene that is there already.
    pub fn new(asked: Option<i32>, scene: Option<i32>) -> Self {
        let known = scene.filter(|&srid| srid != 0);
        Self {
            asked,
            known: known.map(|srid| (srid, None)),
        }
    }

    /// The EPSG code so far.
    pub fn srid(&self) -> Option<i32> {
        self.asked.or(self.known.as_ref().map(|(srid, _)| *srid))
    }

    /// Takes what a file says; one that says nothing goes with any.
    pub fn agree(&mut self, said: Option<i32>, path: &Path) -> Result<(), Failure> {
        match (&self.known, said) {
            _ if self.asked.is_some() => Ok(()),
            (Some((known, who)), Some(srid)) if *known != srid => {
                let who = who
                    .as_ref()
                    .map_or("the scene".to_owned(), |p| p.display().to_string());
                Err(Failure::Input(format!(
                    "{} is in EPSG:{srid}, but {who} is in EPSG:{known}\n  \
                     hint: --srid N takes both as EPSG:N",
                    path.display()
                )))
            }
            (None, Some(srid)) => {
                self.known = Some((srid, Some(path.to_owned())));
                Ok(())
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_share_a_frame() {
        let [a, b] = [Path::new("a.json"), Path::new("b.json")];
        let mut frame = Frame::new(None, None);
        frame.agree(None, a).unwrap();
        assert_eq!(frame.srid(), None);
        frame.agree(Some(7415), a).unwrap();
        frame.agree(None, b).unwrap();
        frame.agree(Some(7415), b).unwrap();
        assert_eq!(frame.srid(), Some(7415));
        let refused = frame.agree(Some(28992), b).unwrap_err().to_string();
        assert!(
            refused.starts_with("b.json is in EPSG:28992, but a.json is in EPSG:7415"),
            "{refused}"
        );
    }

    #[test]
    fn the_scene_has_a_frame_and_the_user_the_last_word() {
        let file = Path::new("a.json");
        let refused = Frame::new(None, Some(7415))
            .agree(Some(28992), file)
            .unwrap_err();
        assert!(
            refused
                .to_string()
                .contains("but the scene is in EPSG:7415")
        );
        assert_eq!(
            Frame::new(None, Some(0)).agree(Some(28992), file).ok(),
            Some(())
        );
        let mut asked = Frame::new(Some(5), None);
        asked.agree(Some(28992), file).unwrap();
        assert_eq!(asked.srid(), Some(5));
    }
}
