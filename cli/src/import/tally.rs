//! [`Tally`], what an import counts as it goes.

use std::collections::BTreeMap;

use engine::{Box3d, Hides, MeshDefect};
use formats::SceneDescription;

use super::ground::Hanging;
use super::solid::Solid;
use super::update::Outcome;

/// Most names kept as examples of a group.
pub const EXAMPLES: usize = 5;

/// Objects with something in common.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// How many.
    pub count: usize,
    /// Names of the first few.
    pub examples: Vec<String>,
}

impl Group {
    fn add(&mut self, name: &str) {
        self.count += 1;
        if self.examples.len() < EXAMPLES {
            self.examples.push(name.to_owned());
        }
    }
}

/// What an update has found of the features of its files.
#[derive(Debug, Default, PartialEq)]
pub struct Update {
    /// Features that were not there.
    pub new: usize,
    /// Features that are as they were.
    pub same: usize,
}

/// What an import has written so far.
#[derive(Debug, Default)]
pub struct Tally {
    /// The files, each with its format.
    pub files: Vec<String>,
    /// Whom to credit, each once.
    pub attributions: Vec<String>,
    /// What was there already; `None` if nothing may have been.
    pub update: Option<Update>,
    /// Features that were written, by class.
    pub classes: BTreeMap<String, usize>,
    /// Features that hide others.
    pub solid: usize,
    /// Of these, on solid ground.
    pub grounded: usize,
    /// Of these, closed at their foot.
    pub closed: usize,
    /// Features that hide nothing, by reason.
    pub hollow: BTreeMap<String, Group>,
    /// Solid columns of each feature that has some.
    pub columns: Vec<usize>,
    /// Solid volume, and what of it is inside columns, cubic metres.
    pub volume: [f64; 2],
    /// Objects left out, by reason.
    pub skipped: BTreeMap<String, Group>,
    /// Objects that are not as in their source, by difference.
    pub changed: BTreeMap<String, Group>,
    /// Rings without area that were dropped.
    pub degenerate_rings: usize,
    /// Box around all features.
    pub extent: Option<Box3d>,
}

impl Tally {
    /// Before anything; of an import that updates a scene, or does not.
    pub fn of(updates: bool) -> Self {
        Self {
            update: updates.then(Update::default),
            ..Self::default()
        }
    }

    /// Counts what became of a batch of an update.
    pub fn count(&mut self, outcome: &Outcome) {
        if let Some(update) = &mut self.update {
            update.new += outcome.new;
            update.same += outcome.same.len();
        }
    }

    /// Counts a batch.
    pub fn add(&mut self, batch: &SceneDescription, solids: &[Solid]) {
        if let Some(attribution) = &batch.attribution
            && !self.attributions.contains(attribution)
        {
            self.attributions.push(attribution.clone());
        }
        for (feature, solid) in batch.features.iter().zip(solids) {
            *self.classes.entry(feature.class.clone()).or_default() += 1;
            self.extent = Some(match &self.extent {
                Some(extent) => extent.union(&solid.envelope),
                None => solid.envelope,
            });
            match &solid.solid.hides {
                Ok(hides) => self.add_solid(hides, solid),
                Err(defect) => self
                    .hollow
                    .entry(kind(defect).to_owned())
                    .or_default()
                    .add(&feature.name),
            }
        }
        for skipped in &batch.skipped {
            let reason = format!("{}: {}", skipped.class, skipped.why);
            self.skipped.entry(reason).or_default().add(&skipped.name);
        }
        for changed in &batch.changed {
            let difference = format!("{}: {}", changed.class, changed.how);
            self.changed
                .entry(difference)
                .or_default()
                .add(&changed.name);
        }
        self.degenerate_rings += batch.degenerate_rings;
    }

    fn add_solid(&mut self, hides: &Hides, solid: &Solid) {
        self.solid += 1;
        self.closed += usize::from(solid.solid.repair.is_some());
        let columns = &hides.columns;
        self.grounded += usize::from(hides.is_grounded());
        self.columns.push(columns.columns.len());
        let volume = solid.solid.mesh.signed_volume();
        self.volume[0] += volume;
        self.volume[1] += volume * columns.share;
    }

    /// Takes back what turned out to hang in the air.
    pub fn take_down(&mut self, hanging: &Hanging) {
        let Hanging { aloft, open } = *hanging;
        self.grounded = self.grounded.saturating_sub(aloft + open);
        self.solid = self.solid.saturating_sub(open);
        self.closed = self.closed.saturating_sub(open);
        if open > 0 {
            let group = self.hollow.entry("open, and not on the ground".to_owned());
            group.or_default().count += open;
        }
    }
}

/// A defect without its count.
fn kind(defect: &MeshDefect) -> &'static str {
    match defect {
        MeshDefect::NoFaces => "no faces",
        MeshDefect::NotFinite => "not finite",
        MeshDefect::UntriangulableFaces { .. } => "untriangulable",
        MeshDefect::Open { .. } => "open",
        MeshDefect::InsideOut => "inside out",
        MeshDefect::ZeroVolume => "zero volume",
        MeshDefect::TooThin => "too thin",
        MeshDefect::TooIntricate { .. } => "too intricate",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_keep_the_first_names() {
        let mut group = Group::default();
        (0..9).for_each(|i| group.add(&i.to_string()));
        assert_eq!(
            (group.count, group.examples.join("")),
            (9, "01234".to_owned())
        );
    }
}
