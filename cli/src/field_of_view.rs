//! [`FieldOfView`], the options that say from where and whereto.

use std::str::FromStr;

use clap::Args;
use postgres::types::ToSql;
use postgres::{GenericClient, Row};

use crate::database::quoted;
use crate::failure::Failure;
use crate::sql_types::Point3d;

/// Where the observer stands and looks.
#[derive(Args, Clone, Debug)]
pub struct FieldOfView {
    /// The eye, in metres of the scene's frame
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub observer: Point3d,
    /// Where to look, degrees clockwise from +y (north); without it all round
    #[arg(
        long,
        value_name = "DEGREES",
        requires = "aperture",
        allow_hyphen_values = true
    )]
    heading: Option<f64>,
    /// Full opening angle of the field of view, degrees
    #[arg(long, value_name = "DEGREES", requires = "heading", group = "aperture")]
    angle: Option<f64>,
    /// Height of a camera's picture, degrees: the pyramid that it sees instead of a circular cone
    #[arg(long, value_name = "DEGREES", requires = "heading", group = "aperture")]
    fov: Option<f64>,
    /// Width of the camera's picture by its height
    #[arg(long, value_name = "RATIO", default_value_t = 1.6, requires = "fov")]
    aspect: f64,
    /// Nothing nearer is in the camera's picture, metres along its direction
    #[arg(long, value_name = "METRES", default_value_t = 0.0, requires = "fov")]
    near: f64,
    /// How far the observer sees, metres
    #[arg(long, value_name = "METRES", default_value_t = 500.0)]
    pub range: f64,
    /// Look up or down, degrees
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = 0.0,
        requires = "heading",
        allow_hyphen_values = true
    )]
    pub pitch: f64,
    /// A horizontal sector of any pitch instead of a circular cone
    #[arg(long, requires = "heading", conflicts_with_all = ["pitch", "fov"])]
    sector: bool,
}

impl FromStr for Point3d {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Option<Vec<f64>> = text
            .split(',')
            .map(|word| {
                word.trim()
                    .parse()
                    .ok()
                    .filter(|number: &f64| number.is_finite())
            })
            .collect();
        let point = numbers.and_then(|numbers| numbers.try_into().ok());
        point
            .map(Self)
            .ok_or_else(|| "expected three numbers, such as 85000,447000,1.7".to_owned())
    }
}

/// A feature in an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Returned {
    /// Its number.
    pub id: i64,
    /// Its class.
    pub class: String,
    /// Metres from the eye to its outer envelope.
    pub distance: f64,
}

impl FieldOfView {
    /// The heading, and how wide the field of view is, or all round.
    pub fn direction(&self) -> Option<(f64, f64)> {
        let width = |fov: f64| {
            let half_height = (fov / 2.0).to_radians().tan();
            2.0 * (half_height * self.aspect).atan().to_degrees()
        };
        self.heading.zip(self.angle.or(self.fov.map(width)))
    }

    /// What the database says can be seen, nearest first.
    pub fn visible(
        &self,
        client: &mut impl GenericClient,
        scene: &str,
    ) -> Result<Vec<Returned>, Failure> {
        let (field, mut parameters) = self.parameters();
        parameters.push(&scene);
        let statement = format!(
            "SELECT feature_id, class, distance FROM occlusion.visible_features(${}, {field})",
            parameters.len()
        );
        select(client, &statement, &parameters)
    }

    /// The features in the field of view, hidden or not, nearest first.
    pub fn within(
        &self,
        client: &mut impl GenericClient,
        scene: &str,
    ) -> Result<Vec<Returned>, Failure> {
        let (field, parameters) = self.parameters();
        let condition = match self.direction() {
            Some(_) => format!("envelope OPERATOR(occlusion.&&) {field}"),
            None => format!("envelope OPERATOR(occlusion.<->) {EYE} <= $2"),
        };
        let statement = format!(
            "SELECT id, class, envelope OPERATOR(occlusion.<->) {EYE} FROM {}.feature WHERE {condition}",
            quoted(scene)
        );
        select(client, &statement, &parameters)
    }

    /// The arguments of `visible_features` after the scene, and what they stand for.
    fn parameters(&self) -> (String, Vec<&(dyn ToSql + Sync)>) {
        let Self {
            observer,
            heading,
            angle,
            range,
            pitch,
            fov,
            aspect,
            near,
            ..
        } = self;
        if self.heading.is_none() {
            (format!("{EYE}, $2"), vec![observer, range])
        } else if fov.is_some() {
            (
                format!("occlusion.frustum({EYE}, $3, $4, 0, $5, $6, $7, $2)"),
                vec![observer, range, heading, pitch, fov, aspect, near],
            )
        } else if self.sector {
            (
                format!("occlusion.view_sector({EYE}, $3, $4, $2)"),
                vec![observer, range, heading, angle],
            )
        } else {
            (
                format!("occlusion.view_cone({EYE}, $3, $4, $2, $5)"),
                vec![observer, range, heading, angle, pitch],
            )
        }
    }
}

/// The eye, as a parameter whose type is not left to be guessed.
const EYE: &str = "$1::occlusion.point3d";

fn select(
    client: &mut impl GenericClient,
    statement: &str,
    parameters: &[&(dyn ToSql + Sync)],
) -> Result<Vec<Returned>, Failure> {
    let returned = |row: &Row| Returned {
        id: row.get(0),
        class: row.get(1),
        distance: row.get(2),
    };
    let mut rows: Vec<Returned> = client
        .query(statement, parameters)?
        .iter()
        .map(returned)
        .collect();
    rows.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.id.cmp(&b.id)));
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eyes_are_three_finite_numbers() {
        assert_eq!("5, 500,1.75".parse(), Ok(Point3d([5.0, 500.0, 1.75])));
        assert_eq!("-5,1e3,-0.5".parse(), Ok(Point3d([-5.0, 1000.0, -0.5])));
        for wrong in ["", "1,2", "1,2,3,4", "1,2,x", "1,2,nan", "1,2,inf"] {
            assert!(wrong.parse::<Point3d>().is_err(), "{wrong}");
        }
    }
}
