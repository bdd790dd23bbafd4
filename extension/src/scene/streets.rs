//! The table `street`.

use super::{failed, polygon, quoted};
use crate::error::Refusal;
use crate::snapshot_read::Moment;
use crate::types::Box3d;
use engine::Street;
use pgrx::datum::DatumWithOid;
use pgrx::spi::SpiTupleTable;
use pgrx::{PgSqlErrorCode, Spi};

/// All streets of a scene.
pub fn read(scene: &str) -> Vec<Street> {
    read_where(scene, Moment::Now, "true", &[])
}

/// The streets of a scene that meet a box in plan.
pub fn near(scene: &str, moment: Moment, area: &engine::Box3d) -> Vec<Street> {
    let upright = Box3d(engine::Box3d {
        min: area.min.with_z(f64::MIN),
        max: area.max.with_z(f64::MAX),
    });
    read_where(
        scene,
        moment,
        "envelope OPERATOR(occlusion.&&) $1",
        &[upright.into()],
    )
}

/// Raises the error that a scene has none.
pub fn refuse_none(scene: &str) -> ! {
    Refusal::new(
        PgSqlErrorCode::ERRCODE_OBJECT_NOT_IN_PREREQUISITE_STATE,
        format!("scene \"{scene}\" has no streets"),
    )
    .hint(format!(
        "Make some from the open space with SELECT occlusion.generate_view_region('{scene}')."
    ))
    .raise()
}

fn read_where(
    scene: &str,
    moment: Moment,
    condition: &str,
    arguments: &[DatumWithOid],
) -> Vec<Street> {
    let query = format!(
        "SELECT area::pg_catalog.text[], eye_low, eye_high FROM {}.street WHERE {condition}",
        quoted(scene)
    );
    let rows = match moment {
        Moment::Query => Spi::connect(|client| columns(client.select(&query, None, arguments)?)),
        // What is only read is seen as it was when the statement around began.
        Moment::Now => Spi::connect_mut(|client| columns(client.update(&query, None, arguments)?)),
    };
    rows.unwrap_or_else(|error| failed(&error))
        .into_iter()
        .map(|(rings, eye_low, eye_high)| {
            match rings
                .into_iter()
                .collect::<Option<Vec<_>>>()
                .and_then(|rings| polygon::area(&rings))
            {
                Some(area) => Street {
                    area,
                    eye_low,
                    eye_high,
                },
                None => Refusal::new(
                    PgSqlErrorCode::ERRCODE_DATA_EXCEPTION,
                    format!("area of a street in scene \"{scene}\" holds a null ring"),
                )
                .raise(),
            }
        })
        .collect()
}

/// A row of the table: rings, lowest and highest eye.
type Columns = (Vec<Option<String>>, f64, f64);

fn columns(rows: SpiTupleTable) -> Result<Vec<Columns>, pgrx::spi::Error> {
    rows.map(|row| {
        Ok((
            row.get::<Vec<Option<String>>>(1)?.unwrap_or_default(),
            row.get::<f64>(2)?.unwrap_or_default(),
            row.get::<f64>(3)?.unwrap_or_default(),
        ))
    })
    .collect()
}

/// Replaces all streets of a scene; returns how many there are now.
pub fn replace(scene: &str, streets: &[Street]) -> i64 {
    let scene = quoted(scene);
    let insert = format!(
        "INSERT INTO {scene}.street (name, area, eye_low, eye_high) VALUES ('open space', $1::pg_catalog.polygon[], $2, $3)"
    );
    let done = Spi::connect_mut(|client| {
        client.update(&format!("DELETE FROM {scene}.street"), None, &[])?;
        for street in streets {
            let area = polygon::area_text(&street.area);
            client.update(
                &insert,
                None,
                &[area.into(), street.eye_low.into(), street.eye_high.into()],
            )?;
        }
        Ok::<_, pgrx::spi::Error>(())
    });
    done.unwrap_or_else(|error| failed(&error));
    super::count(streets.len())
}
