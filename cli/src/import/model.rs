//! [`Model`], all files of an import as one.

use formats::{Feature, SceneDescription, Skipped, Street};

/// What all files hold together.
#[derive(Debug, Default)]
pub struct Model {
    /// EPSG code of the coordinates; 0 if no one says.
    pub srid: i32,
    /// Whom to credit, each once.
    pub attributions: Vec<String>,
    /// The features of all files.
    pub features: Vec<Feature>,
    /// The roads of all files.
    pub roads: Vec<Street>,
    /// Objects that are neither.
    pub skipped: Vec<Skipped>,
    /// Rings without area that were dropped.
    pub degenerate_rings: usize,
}

impl Model {
    /// Adds what one file holds.
    pub fn add(&mut self, file: SceneDescription) {
        if let Some(attribution) = file.attribution
            && !self.attributions.contains(&attribution)
        {
            self.attributions.push(attribution);
        }
        self.features.extend(file.features);
        self.roads.extend(file.streets);
        self.skipped.extend(file.skipped);
        self.degenerate_rings += file.degenerate_rings;
    }
}
