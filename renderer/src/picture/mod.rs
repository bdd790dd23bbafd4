//! What people look at: a scene with an answer, in plan and in perspective.

mod cell_map;
mod color_scale;
mod columns;
mod ground;
mod image;
mod legend;
mod palette;
mod perspective;
mod pipeline;
mod plan;
mod shapes;
mod sheet;
mod sun;
mod surface;
mod text;
mod view;

pub use cell_map::{PictureCell, Sight, heat_map, sight_map};
pub use image::Image;
pub use plan::{PlanView, plan};
pub use view::View;

/// What a query said of a feature, and whether it was right.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Status {
    /// Returned, and truly visible. Green.
    Visible,
    /// In the field of view, hidden and left out. Red.
    Hidden,
    /// Returned, although hidden. Blue.
    OverEstimated,
    /// Outside the field of view. Grey.
    Outside,
}

impl Status {
    /// All four, in the order of the legend.
    pub const ALL: [Status; 4] = [
        Status::Visible,
        Status::Hidden,
        Status::OverEstimated,
        Status::Outside,
    ];
}

/// A feature to draw.
#[derive(Debug, Clone, PartialEq)]
pub struct PictureFeature {
    /// Decides its colour.
    pub status: Status,
    /// Its surface, in metres, z up. Triangles with coordinates that are not finite are not drawn.
    pub triangles: Vec<[[f64; 3]; 3]>,
    /// What of it is solid. Drawn by [`crate::Renderer::columns`] only.
    pub columns: Vec<PictureColumn>,
}

/// A footprint raised from a height to another. Not drawn when a coordinate is not finite.
#[derive(Debug, Clone, PartialEq)]
pub struct PictureColumn {
    /// Its outline.
    pub footprint: Area,
    /// Lower height, in metres.
    pub bottom: f64,
    /// Upper height, in metres.
    pub top: f64,
    /// True when the ground under it is solid too.
    pub grounded: bool,
}

/// A polygon on the ground; rings of any orientation, closed or not.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Area {
    /// Outer ring.
    pub exterior: Vec<[f64; 2]>,
    /// Inner rings.
    pub holes: Vec<Vec<[f64; 2]>>,
}

/// Who looks, and where to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observer {
    /// The eye, in metres.
    pub eye: [f64; 3],
    /// Middle of the field of view in degrees: 0 is +y (north), clockwise.
    pub heading: f64,
    /// Full opening angle of the field of view in degrees; 360 or more is all round.
    pub angle: f64,
    /// How far the observer sees, in metres.
    pub range: f64,
}

impl Observer {
    /// True when the field of view is a full circle.
    #[must_use]
    pub fn is_all_round(&self) -> bool {
        self.angle >= 360.0
    }

    /// The field of view on the ground: a sector from the eye, or a circle.
    fn field_of_view(&self) -> Vec<[f64; 2]> {
        let [x, y, _] = self.eye;
        let angle = self.angle.clamp(0.0, 360.0);
        let steps = (angle / ARC_STEP).ceil().max(1.0) as u32;
        let mut ring = if self.is_all_round() {
            Vec::new()
        } else {
            vec![[x, y]]
        };
        ring.extend((0..=steps).map(|step| {
            let turn = self.heading - angle / 2.0 + angle * f64::from(step) / f64::from(steps);
            let (sin, cos) = turn.to_radians().sin_cos();
            [x + self.range * sin, y + self.range * cos]
        }));
        ring
    }
}

/// Degrees between the corners that stand for an arc: at 1, a picture shows no corner.
const ARC_STEP: f64 = 1.0;

/// All that a picture shows.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PictureScene {
    /// First line of the legend.
    pub title: String,
    /// Smaller lines under the title, for example what was asked. May be empty.
    pub subtitle: String,
    /// Whose data it is, for example `3DBAG by tudelft3d and 3DGI, CC BY 4.0`. May be empty.
    pub attribution: String,
    /// Features, each in the colour of its status.
    pub features: Vec<PictureFeature>,
    /// Streets, grey on the ground.
    pub streets: Vec<Area>,
    /// Opposite corners of occlusion volumes or view cells, seen from above. Plan only.
    pub rectangles: Vec<([f64; 2], [f64; 2])>,
    /// The observer, marked with the field of view.
    pub observer: Option<Observer>,
}

impl PictureScene {
    /// How many features have this status.
    #[must_use]
    pub fn count(&self, status: Status) -> usize {
        self.features
            .iter()
            .filter(|feature| feature.status == status)
            .count()
    }

    /// How many columns are grounded, or not.
    fn count_columns(&self, grounded: bool) -> usize {
        let columns = self.features.iter().flat_map(|feature| &feature.columns);
        columns.filter(|column| column.grounded == grounded).count()
    }

    /// Smallest box that holds features and streets; `None` when there are neither.
    fn bounds(&self) -> Option<([f64; 2], [f64; 2])> {
        let corners = self
            .features
            .iter()
            .flat_map(|f| f.triangles.iter().flatten());
        let features = corners.map(|&[x, y, _]| [x, y]);
        let streets = self
            .streets
            .iter()
            .flat_map(|street| street.exterior.iter().copied());
        bounds(features.chain(streets))
    }
}

/// Smallest box around the finite ones of `points`.
fn bounds(points: impl Iterator<Item = [f64; 2]>) -> Option<([f64; 2], [f64; 2])> {
    points
        .filter(|p| p.iter().all(|c| c.is_finite()))
        .fold(None, |bounds, p| {
            let (low, high) = bounds.unwrap_or((p, p));
            let pick = |by: fn(f64, f64) -> f64, a: [f64; 2]| [by(a[0], p[0]), by(a[1], p[1])];
            Some((pick(f64::min, low), pick(f64::max, high)))
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn observer(angle: f64) -> Observer {
        Observer {
            eye: [100.0, 200.0, 1.75],
            heading: 90.0,
            angle,
            range: 50.0,
        }
    }

    #[test]
    fn sectors_start_at_the_eye_and_open_to_the_heading() {
        let ring = observer(60.0).field_of_view();
        assert_eq!((ring[0], ring.len()), ([100.0, 200.0], 62));
        let [x, y] = ring[31];
        assert!(
            (x - 150.0).abs() < 1e-9 && (y - 200.0).abs() < 1e-9,
            "{x} {y}"
        );
        assert!(ring[1][1] > 200.0 && ring[61][1] < 200.0);
    }

    #[test]
    fn all_round_is_a_circle_without_the_eye() {
        let ring = observer(360.0).field_of_view();
        let reach = |p: &[f64; 2]| (p[0] - 100.0).hypot(p[1] - 200.0);
        assert!(ring.iter().all(|p| (reach(p) - 50.0).abs() < 1e-9));
    }

    #[test]
    fn bounds_leave_out_what_is_not_finite() {
        let points = [[1.0, 5.0], [f64::NAN, 9.0], [-2.0, 7.0]];
        assert_eq!(bounds(points.into_iter()), Some(([-2.0, 5.0], [1.0, 7.0])));
        assert_eq!(PictureScene::default().bounds(), None);
    }
}
