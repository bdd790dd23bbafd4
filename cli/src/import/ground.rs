//! Which solids stand on the ground, once all of them are known.

use postgres::Transaction;

use crate::failure::Failure;

/// How many features turned out not to stand on the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Hanging {
    /// Solid, but not down to any depth.
    pub aloft: usize,
    /// Not even solid: their bottom is missing, and an eye below could look into them.
    pub open: usize,
}

/// Has the database correct what was written of some features.
pub fn settle(
    transaction: &mut Transaction<'_>,
    scene: &str,
    features: &[i64],
) -> Result<Hanging, Failure> {
    let statement = "SELECT aloft, opened FROM occlusion.settle_ground($1, $2)";
    let row = transaction.query_one(statement, &[&scene, &features])?;
    let count = |column| usize::try_from(row.get::<_, i64>(column)).unwrap_or_default();
    Ok(Hanging {
        aloft: count(0),
        open: count(1),
    })
}
