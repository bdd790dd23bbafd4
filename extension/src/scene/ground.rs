//! Which solids stand on the ground: that shows only in the feet of all features of a scene, new ones and old ones.

use super::{count, failed, quoted, require, run};
use crate::types::Box3d;
use engine::{LocalGround, is_building};
use pgrx::Spi;
use pgrx::iter::TableIterator;
use pgrx::{name, pg_extern};
use std::collections::HashSet;

/// A feature whose solids stand on its own foot.
struct Standing {
    id: i64,
    class: String,
    envelope: engine::Box3d,
    foot: f64,
    /// Whether its bottom had to be added: then it is solid only on the ground.
    repaired: bool,
}

/// Corrects what is stored of new features that turn out to hang in the air.
#[pg_extern(volatile, strict)]
fn settle_ground(
    scene: &str,
    features: Vec<Option<i64>>,
) -> TableIterator<'static, (name!(aloft, i64), name!(opened, i64))> {
    require(scene);
    let features: Vec<i64> = features.into_iter().flatten().collect();
    TableIterator::once(settle(scene, &features))
}

/// Of some new features, makes the solids of those that are not buildings on the ground ungrounded, and
/// removes them where a bottom was added. Returns how many there are of each. So it does with other buildings that, now that
/// the new ones are there, turn out not to stand on the ground; what else was made grounded stays so.
pub fn settle(scene: &str, features: &[i64]) -> (i64, i64) {
    let scene = quoted(scene);
    let new: HashSet<i64> = features.iter().copied().collect();
    let ground = LocalGround::new(&envelopes(&scene));
    let hangs = |solid: &&Standing| match is_building(&solid.class) {
        true => !ground.holds(&solid.envelope, solid.foot),
        false => new.contains(&solid.id),
    };
    let standing = standing(&scene);
    let (open, aloft): (Vec<&Standing>, Vec<&Standing>) = standing
        .iter()
        .filter(hangs)
        .partition(|solid| solid.repaired);
    let ids = |solids: &[&Standing]| -> Vec<i64> { solids.iter().map(|solid| solid.id).collect() };
    let theirs = "feature OPERATOR(pg_catalog.=) ANY ($1)";
    for table in ["inner_envelope", "solid_column"] {
        run(
            &format!("UPDATE {scene}.{table} SET grounded = false WHERE grounded AND {theirs}"),
            &[ids(&aloft).into()],
        );
        run(
            &format!("DELETE FROM {scene}.{table} WHERE {theirs}"),
            &[ids(&open).into()],
        );
    }
    run(
        &format!(
            "UPDATE {scene}.mesh SET defect = 'open: no bottom, and not on the ground', \
             triangles = triangles[:pg_catalog.cardinality(triangles) \
                 OPERATOR(pg_catalog.-) (3 OPERATOR(pg_catalog.*) repair_triangles)], \
             repair = NULL, repair_triangles = 0 WHERE {theirs}"
        ),
        &[ids(&open).into()],
    );
    let of_new = |solids: &[&Standing]| {
        count(
            solids
                .iter()
                .filter(|solid| new.contains(&solid.id))
                .count(),
        )
    };
    (of_new(&aloft), of_new(&open))
}

fn envelopes(scene: &str) -> Vec<engine::Box3d> {
    let envelopes = Spi::connect(|client| {
        client
            .select(&format!("SELECT envelope FROM {scene}.feature"), None, &[])?
            .map(|row| row.get::<Box3d>(1))
            .collect::<Result<Vec<_>, _>>()
    });
    let envelopes = envelopes.unwrap_or_else(|error| failed(&error));
    envelopes
        .into_iter()
        .flatten()
        .map(|bounds| bounds.0)
        .collect()
}

/// All features that have a grounded solid, or a bottom that was added.
fn standing(scene: &str) -> Vec<Standing> {
    let query = format!(
        "SELECT f.id, f.class, f.envelope, least(s.foot, occlusion.z(occlusion.lower(i.box))), \
                m.repair IS NOT NULL \
         FROM {scene}.feature AS f \
         LEFT JOIN (SELECT c.feature, min(c.bottom) AS foot, bool_or(c.grounded) AS grounded \
                    FROM {scene}.solid_column AS c GROUP BY c.feature) AS s \
                ON s.feature OPERATOR(pg_catalog.=) f.id \
         LEFT JOIN {scene}.inner_envelope AS i ON i.feature OPERATOR(pg_catalog.=) f.id \
         LEFT JOIN {scene}.mesh AS m ON m.feature OPERATOR(pg_catalog.=) f.id \
         WHERE s.grounded OR i.grounded \
            OR m.repair IS NOT NULL AND (s.feature IS NOT NULL OR i.feature IS NOT NULL)"
    );
    let standing = Spi::connect(|client| {
        client
            .select(&query, None, &[])?
            .map(|row| {
                Ok((
                    row.get::<i64>(1)?,
                    row.get::<String>(2)?,
                    row.get::<Box3d>(3)?,
                    row.get::<f64>(4)?,
                    row.get::<bool>(5)?,
                ))
            })
            .collect::<Result<Vec<_>, pgrx::spi::Error>>()
    });
    standing
        .unwrap_or_else(|error| failed(&error))
        .into_iter()
        .filter_map(|(id, class, envelope, foot, repaired)| {
            Some(Standing {
                id: id?,
                class: class?,
                envelope: envelope?.0,
                foot: foot?,
                repaired: repaired?,
            })
        })
        .collect()
}
