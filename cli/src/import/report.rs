//! [`Report`], what an import says at its end.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

use engine::{Box3d, MeshDefect};

use super::model::Model;
use super::solid::Solid;
use crate::terminal::{FAINT, GOOD, grouped};

/// Most names given as examples of a reason.
const NAMES: usize = 5;

/// What came of an import.
pub struct Report<'a> {
    /// Name of the scene.
    pub scene: &'a str,
    /// What was read.
    pub model: &'a Model,
    /// What the features are made of.
    pub solids: &'a [Solid],
    /// Streets made from roads.
    pub streets: usize,
    /// Streets made from open space, if they were.
    pub open_space: Option<usize>,
    /// How long it took.
    pub seconds: f64,
}

impl Display for Report<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let count = grouped(self.model.features.len());
        writeln!(
            f,
            "{GOOD}imported{GOOD:#} {count} features into {} in {:.1} s",
            self.scene, self.seconds
        )?;
        self.write_classes(f)?;
        self.write_solids(f)?;
        self.write_left_out(f)?;
        match self.open_space {
            Some(pieces) => line(
                f,
                "streets",
                &format!("none: open space in {pieces} pieces"),
            )?,
            None => line(
                f,
                "streets",
                &format!("{} pieces of roads", grouped(self.streets)),
            )?,
        }
        if let Some(extent) = self
            .solids
            .iter()
            .map(|solid| solid.envelope)
            .reduce(|a, b| a.union(&b))
        {
            line(f, "extent", &extent_text(&extent))?;
        }
        match self.model.srid {
            0 => line(f, "srid", "unknown")?,
            srid => line(f, "srid", &srid.to_string())?,
        }
        for attribution in &self.model.attributions {
            line(f, "credit", attribution)?;
        }
        Ok(())
    }
}

impl Report<'_> {
    fn write_classes(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mut classes: BTreeMap<&str, usize> = BTreeMap::new();
        for feature in &self.model.features {
            *classes.entry(&feature.class).or_default() += 1;
        }
        classes
            .iter()
            .try_for_each(|(class, count)| line(f, class, &grouped(*count)))
    }

    fn write_solids(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let inner = || {
            self.solids
                .iter()
                .filter_map(|solid| solid.inner.as_ref().ok())
        };
        let grounded = inner().filter(|inner| inner.grounded).count();
        let text = format!(
            "{}, {} of them on solid ground",
            grouped(inner().count()),
            grouped(grounded)
        );
        line(f, "solid", &text)?;
        let named = self.model.features.iter().zip(self.solids);
        let defects = named.filter_map(|(feature, solid)| {
            Some((kind(solid.inner.as_ref().err()?), feature.name.as_str()))
        });
        write_groups(f, "not solid", defects)
    }

    fn write_left_out(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let reason = |s: &formats::Skipped| format!("{}: {}", s.class, s.why);
        let reasons: Vec<String> = self.model.skipped.iter().map(reason).collect();
        let names = self
            .model
            .skipped
            .iter()
            .map(|skipped| skipped.name.as_str());
        write_groups(f, "skipped", reasons.iter().map(String::as_str).zip(names))?;
        match self.model.degenerate_rings {
            0 => Ok(()),
            count => line(
                f,
                "dropped",
                &format!("{} rings without area", grouped(count)),
            ),
        }
    }
}

fn line(f: &mut Formatter<'_>, label: &str, text: &str) -> fmt::Result {
    writeln!(f, "  {label:<22} {text}")
}

/// Names grouped by reason, the most frequent reason first.
fn write_groups<'a>(
    f: &mut Formatter<'_>,
    label: &str,
    named: impl Iterator<Item = (&'a str, &'a str)>,
) -> fmt::Result {
    let mut groups: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (reason, name) in named {
        groups.entry(reason).or_default().push(name);
    }
    let mut groups: Vec<_> = groups.into_iter().collect();
    groups.sort_by_key(|(_, names)| std::cmp::Reverse(names.len()));
    let total: usize = groups.iter().map(|(_, names)| names.len()).sum();
    if total > 0 {
        line(f, label, &grouped(total))?;
    }
    for (reason, names) in groups {
        let examples: Vec<String> = names
            .iter()
            .take(NAMES)
            .map(|name| name.escape_debug().to_string())
            .collect();
        let more = if names.len() > NAMES { ", …" } else { "" };
        let text = format!(
            "{} {FAINT}{}{more}{FAINT:#}",
            grouped(names.len()),
            examples.join(", ")
        );
        line(f, &format!("  {reason}"), &text)?;
    }
    Ok(())
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

fn extent_text(extent: &Box3d) -> String {
    let (min, max) = (extent.min, extent.max);
    format!(
        "x {:.1} to {:.1}, y {:.1} to {:.1}, z {:.1} to {:.1}",
        min.x, max.x, min.y, max.y, min.z, max.z
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_are_counted_and_named() {
        struct Groups(Vec<(&'static str, &'static str)>);
        impl Display for Groups {
            fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
                write_groups(f, "not solid", self.0.iter().copied())
            }
        }
        let open = ["a", "b", "c", "d", "e", "f"].map(|name| ("open", name));
        let text = Groups([&[("too thin", "x")][..], &open].concat()).to_string();
        let plain = anstream::adapter::strip_str(&text).to_string();
        assert_eq!(
            plain,
            "  not solid              7\n    open                 6 a, b, c, d, e, …\n    too thin             1 x\n"
        );
        assert_eq!(Groups(Vec::new()).to_string(), "");
    }
}
