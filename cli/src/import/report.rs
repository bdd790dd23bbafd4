//! [`Report`], what an import says at its end.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

use engine::Box3d;

use super::tally::{Group, Tally, Update};
use crate::terminal::{FAINT, GOOD, grouped};

/// What came of an import.
pub struct Report<'a> {
    /// Name of the scene.
    pub scene: &'a str,
    /// EPSG code of its coordinates, if known.
    pub srid: Option<i32>,
    /// What was counted.
    pub tally: Tally,
    /// Streets made from roads; `None` if those that were there stay.
    pub streets: Option<usize>,
    /// Streets made from open space, if they were.
    pub open_space: Option<usize>,
    /// How long it took.
    pub seconds: f64,
}

impl Display for Report<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let tally = &self.tally;
        self.write_outcome(f)?;
        for file in &tally.files {
            line(f, "from", file)?;
        }
        for (class, count) in &tally.classes {
            line(f, class, &grouped(*count))?;
        }
        self.write_solids(f)?;
        write_groups(f, "hide nothing", &tally.hollow)?;
        write_groups(f, "skipped", &tally.skipped)?;
        write_groups(f, "changed", &tally.changed)?;
        if tally.degenerate_rings > 0 {
            let text = format!("{} rings without area", grouped(tally.degenerate_rings));
            line(f, "dropped", &text)?;
        }
        let streets = match (self.open_space, self.streets) {
            (Some(pieces), _) => format!("none: open space in {pieces} pieces"),
            (None, Some(streets)) => format!("{} pieces of roads", grouped(streets)),
            (None, None) => "as they were".to_owned(),
        };
        line(f, "streets", &streets)?;
        if let Some(extent) = &tally.extent {
            line(f, "extent", &extent_text(extent))?;
        }
        match self.srid {
            None | Some(0) => line(f, "srid", "unknown")?,
            Some(srid) => line(f, "srid", &srid.to_string())?,
        }
        for attribution in &tally.attributions {
            line(f, "credit", attribution)?;
        }
        Ok(())
    }
}

impl Report<'_> {
    fn write_outcome(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let written: usize = self.tally.classes.values().sum();
        let (scene, seconds) = (self.scene, self.seconds);
        match &self.tally.update {
            None => writeln!(
                f,
                "{GOOD}imported{GOOD:#} {} features into {scene} in {seconds:.1} s, {} a second",
                grouped(written),
                grouped((written as f64 / seconds.max(1e-3)) as usize)
            ),
            Some(Update { new, same }) => writeln!(
                f,
                "{GOOD}updated{GOOD:#} {scene} in {seconds:.1} s: {} new, {} changed, {} as they were",
                grouped(*new),
                grouped(written - new),
                grouped(*same)
            ),
        }
    }

    fn write_solids(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let tally = &self.tally;
        let mut text = format!(
            "{}, {} of them on solid ground",
            grouped(tally.solid),
            grouped(tally.grounded)
        );
        if tally.closed > 0 {
            text += &format!(", {} closed at their foot", grouped(tally.closed));
        }
        line(f, "solid", &text)?;
        let mut counts = tally.columns.clone();
        counts.sort_unstable();
        let Some(median) = counts.get(counts.len() / 2) else {
            return Ok(());
        };
        let text = format!(
            "{}, {median} a feature in the median, with {:.1} % of the solid volume",
            grouped(counts.iter().sum()),
            100.0 * tally.volume[1] / tally.volume[0]
        );
        line(f, "solid columns", &text)
    }
}

fn line(f: &mut Formatter<'_>, label: &str, text: &str) -> fmt::Result {
    writeln!(f, "  {label:<22} {text}")
}

/// Groups of names, the most frequent reason first.
fn write_groups(
    f: &mut Formatter<'_>,
    label: &str,
    groups: &BTreeMap<String, Group>,
) -> fmt::Result {
    let mut groups: Vec<(&String, &Group)> = groups.iter().collect();
    groups.sort_by_key(|(_, group)| std::cmp::Reverse(group.count));
    let total: usize = groups.iter().map(|(_, group)| group.count).sum();
    if total > 0 {
        line(f, label, &grouped(total))?;
    }
    for (reason, group) in groups {
        let names = group
            .examples
            .iter()
            .map(|name| name.escape_debug().to_string());
        // A group may be known by its number alone.
        let more = !group.examples.is_empty() && group.examples.len() < group.count;
        let names: Vec<String> = names.chain(more.then(|| "…".to_owned())).collect();
        let text = format!(
            "{} {FAINT}{}{FAINT:#}",
            grouped(group.count),
            names.join(", ")
        );
        line(f, &format!("  {reason}"), &text)?;
    }
    Ok(())
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
        struct Groups(BTreeMap<String, Group>);
        impl Display for Groups {
            fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
                write_groups(f, "hide nothing", &self.0)
            }
        }
        let group = |count: usize, names: &[&str]| Group {
            count,
            examples: names.iter().map(|&name| name.to_owned()).collect(),
        };
        let groups = [
            ("too thin".to_owned(), group(1, &["x"])),
            ("open".to_owned(), group(6, &["a", "b", "c", "d", "e"])),
        ];
        let text = Groups(groups.into()).to_string();
        let plain = anstream::adapter::strip_str(&text).to_string();
        assert_eq!(
            plain,
            "  hide nothing           7\n    open                 6 a, b, c, d, e, …\n    too thin             1 x\n"
        );
        assert_eq!(Groups(BTreeMap::new()).to_string(), "");
    }
}
