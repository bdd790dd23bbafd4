//! [`ViewCell`], a stored view cell, and [`Witness`], what it says is proven.

use std::collections::HashSet;

use postgres::fallible_iterator::FallibleIterator;
use postgres::{GenericClient, Row};

use crate::database::quoted;
use crate::failure::Failure;
use crate::sql_types::{Box3d, Point3d};

/// What can be seen from anywhere in a box.
#[derive(Clone, Debug)]
pub struct ViewCell {
    /// Its number.
    pub id: i64,
    /// Where eyes are.
    pub bounds: Box3d,
    /// How far they see, metres.
    pub range: f64,
    /// Numbers of the features that may be seen.
    pub visible: HashSet<i64>,
}

/// A line that proves that a feature can be seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Witness {
    /// Number of the feature.
    pub feature: i64,
    /// Where it is seen from, and where the line ends; `None` where the database has no such line.
    pub line: Option<[[f64; 3]; 2]>,
}

/// The view cells of a scene that are in use.
pub fn view_cells(client: &mut impl GenericClient, scene: &str) -> Result<Vec<ViewCell>, Failure> {
    let statement = format!(
        "SELECT c.id, c.box, v.range, occlusion.feature_ids($1, c.visible) \
         FROM occlusion.view_cells($1) AS v JOIN {}.view_cell AS c ON c.id = v.cell ORDER BY c.id",
        quoted(scene)
    );
    let rows = client.query_raw(&statement, [scene])?;
    let cell = |row: Row| {
        let visible: Vec<i64> = row.get(3);
        Ok(ViewCell {
            id: row.get(0),
            bounds: row.get(1),
            range: row.get(2),
            visible: visible.into_iter().collect(),
        })
    };
    Ok(rows.map(cell).collect()?)
}

/// The failure of what needs view cells where there are none.
pub fn no_view_cells(scene: &str) -> Failure {
    Failure::Unready(format!(
        "scene \"{scene}\" has no view cells\n  hint: occlusion generate {scene} --cells computes them"
    ))
}

/// The witnesses of a view cell.
pub fn witnesses(
    client: &mut impl GenericClient,
    scene: &str,
    cell: i64,
) -> Result<Vec<Witness>, Failure> {
    let statement = "SELECT feature_id, eye, target FROM occlusion.witnesses($1, $2)";
    let rows = client.query(statement, &[&scene, &cell])?;
    let witness = |row: &Row| {
        let [eye, target]: [Option<Point3d>; 2] = [row.get(1), row.get(2)];
        Witness {
            feature: row.get(0),
            line: eye.zip(target).map(|(eye, target)| [eye.0, target.0]),
        }
    };
    Ok(rows.iter().map(witness).collect())
}
