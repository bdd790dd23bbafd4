//! [`Outcome`], what was measured with one data set.

use super::arena::Built;
use super::contender::{CUBE, Contender, Kind, ND, OURS};
use super::timing::Figures;

/// A rival that finds a smaller share of our rows has answered another question: it is left out of
/// the goals.
const COMPARABLE: f64 = 0.9;

/// What was measured with one data set.
pub struct Outcome {
    /// The data set, in words.
    pub name: String,
    /// How many boxes overlap a point, where that was chosen.
    pub depth: Option<usize>,
    /// The contenders, ours first.
    pub entries: Vec<Entry>,
    /// Contenders that could not take part, and why.
    pub absent: Vec<(&'static str, String)>,
    /// Milliseconds of a round trip that only looks up a search.
    pub floor: f64,
}

/// What was measured of one contender.
pub struct Entry {
    /// Who it is.
    pub contender: Contender,
    /// Its index.
    pub built: Built,
    /// Its searches, kind by kind.
    pub figures: [Option<Figures>; Kind::ALL.len()],
}

/// A goal, and how far it was reached.
pub struct Goal {
    /// What is wanted.
    pub wanted: String,
    /// The least of the ratios, and where it was measured.
    pub worst: Option<(f64, String)>,
    /// How large it is to be.
    pub least: f64,
}

/// Which rivals a goal is about.
#[derive(Clone, Copy)]
enum Against {
    All,
    One(&'static str),
}

impl Outcome {
    /// What ours took.
    pub fn ours(&self) -> &Entry {
        &self.entries[0]
    }

    /// For each kind and each rival the ratio of a figure, theirs to ours.
    fn ratios(
        &self,
        against: Against,
        kinds: &[Kind],
        figure: fn(&Figures) -> Option<f64>,
    ) -> Vec<(f64, String)> {
        let rivals = self.entries.iter().filter(|entry| against.holds(entry));
        let pairs = rivals.flat_map(|rival| kinds.iter().map(move |&kind| (rival, kind)));
        pairs
            .filter_map(|(rival, kind)| {
                let theirs = rival.figures[kind as usize].as_ref()?;
                let ours = self.ours().figures[kind as usize].as_ref()?;
                let place = format!("{}, {}, {}", kind.name(), rival.contender.name, self.name);
                let ratio = figure(theirs)? / figure(ours)?;
                (theirs.rows >= COMPARABLE * ours.rows).then_some((ratio, place))
            })
            .collect()
    }

    fn build_ratio(&self) -> Option<(f64, String)> {
        let rival = self.entries.iter().find(|e| e.contender.name == ND)?;
        let ratio = rival.built.seconds / self.ours().built.seconds;
        Some((ratio, self.name.clone()))
    }
}

impl Against {
    fn holds(self, entry: &Entry) -> bool {
        match self {
            Self::All => entry.contender.is_rival(),
            Self::One(name) => entry.contender.name == name,
        }
    }
}

impl Goal {
    /// Whether it was reached, if it was measured.
    pub fn reached(&self) -> Option<bool> {
        Some(self.worst.as_ref()?.0 >= self.least)
    }
}

/// What the indexes of `box3d` are to reach. All figures are times as much as ours.
pub fn goals(outcomes: &[Outcome]) -> Vec<Goal> {
    let all = |against: Against, figure: fn(&Figures) -> Option<f64>| {
        least(
            outcomes
                .iter()
                .flat_map(|outcome| outcome.ratios(against, &Kind::ALL, figure)),
        )
    };
    let single = |figures: &Figures| Some(figures.median);
    let batch = |figures: &Figures| figures.batch;
    let pages = |figures: &Figures| Some(figures.index_pages);
    let deepest = outcomes.iter().max_by_key(|outcome| outcome.depth);
    let depth = deepest
        .and_then(|outcome| outcome.depth)
        .unwrap_or_default();
    let deep = deepest
        .filter(|outcome| outcome.depth.is_some())
        .map(|outcome| outcome.ratios(Against::One(ND), &[Kind::Point], single))
        .unwrap_or_default();
    let goal = |wanted: String, least: f64, worst| Goal {
        wanted,
        worst,
        least,
    };
    vec![
        goal(
            format!("{OURS} faster than every rival, single searches"),
            1.0,
            all(Against::All, single),
        ),
        goal(
            format!("{OURS} faster than every rival, all searches in one statement"),
            1.0,
            all(Against::All, batch),
        ),
        goal(
            format!("2 times as fast as {ND}, all searches in one statement"),
            2.0,
            all(Against::One(ND), batch),
        ),
        goal(
            format!("1.5 times as fast as {CUBE}, all searches in one statement"),
            1.5,
            all(Against::One(CUBE), batch),
        ),
        goal(
            format!("index pages within 1.2 times those of {ND}"),
            1.0 / 1.2,
            all(Against::One(ND), pages),
        ),
        goal(
            format!("build no slower than {ND}"),
            1.0,
            least(outcomes.iter().filter_map(Outcome::build_ratio)),
        ),
        goal(
            format!("point in box with {depth} boxes over it 2 times as fast as {ND}"),
            2.0,
            least(deep),
        ),
    ]
}

fn least(ratios: impl IntoIterator<Item = (f64, String)>) -> Option<(f64, String)> {
    ratios.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))
}
