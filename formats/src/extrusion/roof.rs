//! [`Roof`], as the Simple 3D Buildings rules describe it.

use super::extruded::RoofSurfaces;
use super::fold::{Profile, fold};
use super::frame::{Frame, dot, left};
use super::{Footprint, LEVEL_HEIGHT, Plan, fan};

/// How far a given direction may be off a side of the building and still mean that side, as the
/// cosine of 20°: directions are often rounded to one of eight or sixteen.
const SAME_DIRECTION: f64 = 0.94;

/// Facets of half a dome, and of a vault.
const FACETS: usize = 8;

/// A roof that is not flat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Roof {
    /// Its form.
    pub(crate) shape: RoofShape,
    /// How high it is.
    pub(crate) rise: Rise,
    /// Whether the ridge runs across the building instead of along it.
    pub(crate) across: bool,
    /// Unit vector that the roof slopes down to, where that is given.
    pub(crate) direction: Option<Plan>,
}

/// How high a roof is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Rise {
    /// From the eaves to the ridge, metres.
    Metres(f64),
    /// By its slope, the tangent of the angle.
    Slope(f64),
    /// Not said: a storey, half the width for a dome or a vault, at most half of the building.
    Unsaid,
}

/// The forms that are built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RoofShape {
    /// One plane that slopes.
    Skillion,
    /// Two planes and a ridge.
    Gabled,
    /// Two planes, the ridge off the middle.
    Saltbox,
    /// A ridge with two slopes on either side.
    Gambrel,
    /// A vault.
    Round,
    /// A ridge with slopes on all four sides.
    Hipped,
    /// A plane for each side, up to a point.
    Pyramidal,
    /// Half a ball.
    Dome,
}

impl RoofShape {
    /// The form for the value of `roof:shape`: none for a flat one. A form that is not built gives
    /// the nearest that is, and its name.
    pub(crate) fn named(name: &str) -> (Option<Self>, Option<&'static str>) {
        match name {
            "flat" => (None, None),
            "skillion" | "lean_to" => (Some(Self::Skillion), None),
            "gabled" => (Some(Self::Gabled), None),
            "saltbox" => (Some(Self::Saltbox), None),
            "gambrel" => (Some(Self::Gambrel), None),
            "round" => (Some(Self::Round), None),
            "hipped" => (Some(Self::Hipped), None),
            "pyramidal" => (Some(Self::Pyramidal), None),
            "dome" => (Some(Self::Dome), None),
            "half-hipped" | "half_hipped" | "side_half-hipped" | "mansard" => {
                (Some(Self::Hipped), Some("hipped"))
            }
            "onion" => (Some(Self::Dome), Some("a dome")),
            "cone" => (Some(Self::Pyramidal), Some("pyramidal")),
            "side_hipped" | "hipped-and-gabled" => (Some(Self::Gabled), Some("gabled")),
            _ => (None, Some("flat")),
        }
    }

    /// Where the slope of a ridged roof changes: from one side to the other, each at its share of
    /// the width from −1 to 1, with its share of the rise.
    fn folds(self) -> Vec<[f64; 2]> {
        match self {
            Self::Skillion => vec![[-1.0, 1.0], [1.0, 0.0]],
            Self::Saltbox => vec![[-1.0, 0.0], [-1.0 / 3.0, 1.0], [1.0, 0.0]],
            Self::Gambrel => {
                vec![
                    [-1.0, 0.0],
                    [-0.6, 0.65],
                    [0.0, 1.0],
                    [0.6, 0.65],
                    [1.0, 0.0],
                ]
            }
            Self::Round => {
                let angle = |i: usize| std::f64::consts::PI * i as f64 / FACETS as f64;
                let fold = |i| [-angle(i).cos(), angle(i).sin()];
                let inner = (1..FACETS).map(fold);
                std::iter::once([-1.0, 0.0])
                    .chain(inner)
                    .chain([[1.0, 0.0]])
                    .collect()
            }
            _ => vec![[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]],
        }
    }
}

impl Roof {
    /// How high the roof is over this footprint, if no more is said of the building.
    pub(super) fn rise(&self, frame: &Frame) -> f64 {
        let width = self.run(frame);
        match (self.rise, self.shape) {
            (Rise::Metres(metres), _) => metres,
            (Rise::Slope(slope), RoofShape::Skillion) => width * slope,
            (Rise::Slope(slope), _) => width / 2.0 * slope,
            (Rise::Unsaid, RoofShape::Dome | RoofShape::Round) => width / 2.0,
            (Rise::Unsaid, _) => LEVEL_HEIGHT,
        }
    }

    /// The roof's surfaces from the height of the eaves up by `rise`; none where the footprint does
    /// not fit the form.
    pub(super) fn surfaces(
        &self,
        footprint: &Footprint,
        frame: &Frame,
        eaves: f64,
        rise: f64,
    ) -> Option<RoofSurfaces> {
        match self.shape {
            RoofShape::Hipped => fan::hipped(footprint, self.across, eaves, rise),
            RoofShape::Pyramidal => fan::dome(footprint, &[[0.0, 1.0]], eaves, rise),
            RoofShape::Dome => {
                let angle = |i: usize| std::f64::consts::FRAC_PI_2 * i as f64 / (FACETS / 2) as f64;
                let rings = (1..=FACETS / 2).map(|i| [angle(i).cos(), angle(i).sin()]);
                fan::dome(footprint, &rings.collect::<Vec<_>>(), eaves, rise)
            }
            shape => {
                let profile = Profile {
                    origin: frame.origin,
                    down: self.down(frame),
                    folds: shape.folds(),
                };
                fold(footprint, &profile, eaves, rise)
            }
        }
    }

    /// The horizontal direction of the slope: across the ridge.
    fn down(&self, frame: &Frame) -> Plan {
        let sides = [frame.along, left(frame.along)];
        if let Some(direction) = self.direction {
            let both_ways = sides.into_iter().flat_map(|[x, y]| [[x, y], [-x, -y]]);
            let same = |side: &Plan| dot(*side, direction) >= SAME_DIRECTION;
            return both_ways.into_iter().find(same).unwrap_or(direction);
        }
        sides[usize::from(!self.across)]
    }

    /// How far the roof reaches across its ridge.
    fn run(&self, frame: &Frame) -> f64 {
        let down = self.down(frame);
        let [along, across] = [dot(down, frame.along), dot(down, left(frame.along))];
        match self.shape {
            RoofShape::Hipped | RoofShape::Pyramidal | RoofShape::Dome => frame.sides[1],
            _ => along.abs() * frame.sides[0] + across.abs() * frame.sides[1],
        }
    }
}
