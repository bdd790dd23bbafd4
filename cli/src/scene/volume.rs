//! [`Volume`], a stored occlusion volume.

use postgres::fallible_iterator::FallibleIterator;
use postgres::{GenericClient, Row};

use crate::database::quoted;
use crate::failure::Failure;
use crate::sql_types::Box3d;

/// Volumes handed over together: enough for all cores, and small beside the millions of a city.
const CHUNK: usize = 1 << 16;

/// From everywhere in the box, the occluder alone hides all of the occludee.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Volume {
    /// Number of the feature that hides.
    pub occluder: i64,
    /// Number of the feature that is hidden.
    pub occludee: i64,
    /// Where eyes are.
    pub bounds: Box3d,
}

/// How many volumes a scene has.
pub fn count_volumes(client: &mut impl GenericClient, scene: &str) -> Result<usize, Failure> {
    let statement = format!("SELECT count(*) FROM {}.occlusion_volume", quoted(scene));
    let count: i64 = client.query_one(&statement, &[])?.get(0);
    Ok(usize::try_from(count).unwrap_or_default())
}

/// Hands over all volumes of a scene, chunk by chunk, in no order.
pub fn stream_volumes(
    client: &mut impl GenericClient,
    scene: &str,
    mut heed: impl FnMut(&[Volume]),
) -> Result<(), Failure> {
    let statement = format!(
        "SELECT occluder, occludee, box FROM {}.occlusion_volume",
        quoted(scene)
    );
    let mut rows = client.query_raw(&statement, std::iter::empty::<&i64>())?;
    let mut chunk = Vec::with_capacity(CHUNK);
    while let Some(row) = rows.next()? {
        chunk.push(volume(&row));
        if chunk.len() == CHUNK {
            heed(&chunk);
            chunk.clear();
        }
    }
    heed(&chunk);
    Ok(())
}

fn volume(row: &Row) -> Volume {
    Volume {
        occluder: row.get(0),
        occludee: row.get(1),
        bounds: row.get(2),
    }
}
