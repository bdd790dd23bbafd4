//! Whether contenders find the same.

use postgres::Client;

use super::contender::{CUBE, Contender, GENEROUS, Kind};
use crate::failure::Failure;

/// Searches whose answers are compared.
const COMPARED: usize = 100;

/// Which differences from ours matter.
#[derive(Clone, Copy)]
struct Matters {
    missing: bool,
    surplus: bool,
}

/// What a contender finds otherwise than ours, in words, for kinds of search that mean the same to
/// both.
pub fn difference(
    client: &mut Client,
    ours: &Contender,
    contender: &Contender,
    kind: Kind,
) -> Result<Option<String>, Failure> {
    let most = match contender.single_precision {
        true => &GENEROUS,
        false => ours,
    };
    let pairs = [ours, contender, most].map(|who| who.pairs(kind, COMPARED));
    let (Some(matters), [Some(ours), Some(theirs), Some(most)]) = (matters(contender, kind), pairs)
    else {
        return Ok(None);
    };
    let mut count = |these: &str, those: &str| -> Result<i64, Failure> {
        let statement = format!("SELECT count(*) FROM ({these} EXCEPT {those}) AS d");
        Ok(client.query_one(&statement, &[])?.get(0))
    };
    let missing = if matters.missing {
        count(&ours, &theirs)?
    } else {
        0
    };
    let surplus = if matters.surplus {
        count(&theirs, &most)?
    } else {
        0
    };
    Ok((missing + surplus > 0).then(|| {
        format!(
            "{}, {}: {missing} rows are missing and {surplus} are too many in the first {COMPARED} searches",
            contender.name,
            kind.name()
        )
    }))
}

/// Of equally near boxes any may come, and nobody else has cones. The sectors of PostGIS are
/// polygons around them, those of cube approximate.
fn matters(contender: &Contender, kind: Kind) -> Option<Matters> {
    let (missing, surplus) = match kind {
        Kind::Overlap | Kind::Point => (true, true),
        Kind::Sector | Kind::Cone if !contender.is_rival() => (true, true),
        Kind::Sector if contender.name != CUBE => (true, false),
        Kind::Sector | Kind::Cone | Kind::Nearest => return None,
    };
    Some(Matters { missing, surplus })
}
