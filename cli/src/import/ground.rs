//! Which solids stand on the ground, once all of them are known.

use engine::{Box3d, LocalGround};
use postgres::Transaction;

use crate::database::quoted;
use crate::failure::Failure;
use crate::sql_types;

/// A feature whose solids stand on its own foot, if that is on the ground.
#[derive(Clone, Debug)]
pub struct Standing {
    /// Its number.
    pub id: i64,
    /// Its class.
    pub class: String,
    /// Its outer envelope.
    pub envelope: Box3d,
    /// Height of its foot, metres.
    pub foot: f64,
    /// Whether its bottom had to be added: then it is solid only on the ground.
    pub closed: bool,
}

/// What turned out not to stand on the ground.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hanging {
    /// Features that are solid, but not down to any depth.
    pub aloft: Vec<i64>,
    /// Features that are not even solid, since an eye below could look into them.
    pub open: Vec<i64>,
}

/// Corrects what was written of features that turn out to hang in the air: the ground shows only
/// in the feet of all features of the scene. Only buildings stand on solid ground.
pub fn settle(
    transaction: &mut Transaction<'_>,
    scene: &str,
    standing: &[Standing],
) -> Result<Hanging, Failure> {
    let schema = quoted(scene);
    let rows = transaction.query(&format!("SELECT envelope FROM {schema}.feature"), &[])?;
    let envelopes: Vec<Box3d> = rows
        .iter()
        .map(|row| row.get::<_, sql_types::Box3d>(0).into())
        .collect();
    let hanging = hanging(standing, &LocalGround::new(&envelopes));
    if !hanging.aloft.is_empty() {
        for table in ["inner_envelope", "solid_column"] {
            let statement = format!(
                "UPDATE {schema}.{table} SET grounded = false WHERE grounded AND feature = ANY ($1)"
            );
            transaction.execute(&statement, &[&hanging.aloft])?;
        }
    }
    if !hanging.open.is_empty() {
        for table in ["inner_envelope", "solid_column"] {
            let statement = format!("DELETE FROM {schema}.{table} WHERE feature = ANY ($1)");
            transaction.execute(&statement, &[&hanging.open])?;
        }
        let statement = format!(
            "UPDATE {schema}.mesh SET defect = 'open: no bottom, and not on the ground' \
             WHERE feature = ANY ($1)"
        );
        transaction.execute(&statement, &[&hanging.open])?;
    }
    Ok(hanging)
}

fn hanging(standing: &[Standing], ground: &LocalGround) -> Hanging {
    let mut hanging = Hanging::default();
    for solid in standing {
        let on_ground =
            solid.class.starts_with("Building") && ground.holds(&solid.envelope, solid.foot);
        match (on_ground, solid.closed) {
            (true, _) => {}
            (false, true) => hanging.open.push(solid.id),
            (false, false) => hanging.aloft.push(solid.id),
        }
    }
    hanging
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn only_buildings_on_the_ground_stand() {
        let solid = |id: i64, class: &str, x: f64, foot: f64, closed: bool| {
            let min = DVec3::new(x, 0.0, foot);
            Standing {
                id,
                class: class.to_owned(),
                envelope: Box3d::new(min, min + 10.0),
                foot,
                closed,
            }
        };
        let all = [
            solid(1, "Building", 0.0, 0.0, false),
            solid(2, "BuildingPart", 20.0, 0.5, true),
            solid(3, "Bridge", 40.0, 0.0, false),
            solid(4, "Building", 60.0, 6.0, false),
            solid(5, "Building", 80.0, 6.0, true),
            solid(6, "Building", 100.0, 0.0, true),
        ];
        let envelopes: Vec<Box3d> = all.iter().map(|solid| solid.envelope).collect();
        let hanging = hanging(&all, &LocalGround::new(&envelopes));
        assert_eq!((hanging.aloft, hanging.open), (vec![3, 4], vec![5]));
    }
}
