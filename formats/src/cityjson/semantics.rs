//! What surfaces mean: the member `semantics` of a geometry, and the values that its surfaces and
//! those of materials are given by.

use serde_json::value::RawValue;
use serde_json::{Map, Value};

use super::boundaries::{Boundaries, GeometryType, MAX_BOUNDARY_BYTES};
use super::budget::Budget;
use super::json::{Members, array, check_count, parse};
use crate::error::Problem;
use crate::scene::Semantic;

/// One value a surface, none where it has none.
pub(super) type Values = Vec<Option<u32>>;

/// The meanings that a geometry lists, all of them since they may refer to each other by number,
/// and the one of each surface.
pub(super) fn parse_semantics(
    raw: &RawValue,
    kind: GeometryType,
    boundaries: &Boundaries,
    budget: &mut Budget<'_>,
) -> Result<(Vec<Semantic>, Values), Problem> {
    let members = Members::of("semantics", raw)?;
    let list = members.require("surfaces", "semantics.surfaces")?;
    budget.feature_attributes(list.get().len())?;
    let semantics: Vec<_> = array("semantics.surfaces", list)?
        .into_iter()
        .map(semantic)
        .collect::<Result<_, _>>()?;
    let values = surface_values(members.get("values"), kind, boundaries)?;
    check_values(&values, semantics.len())?;
    Ok((semantics, values))
}

fn semantic(raw: &RawValue) -> Result<Semantic, Problem> {
    let mut attributes: Map<String, Value> = parse("semantic surface", raw)?;
    match attributes.shift_remove("type") {
        Some(Value::String(class)) => Ok(Semantic {
            class,
            attributes: attributes.into(),
        }),
        _ => Err(Problem::Missing {
            what: "type of a semantic surface".to_owned(),
        }),
    }
}

/// Refuses values that point past the end of their list.
pub(super) fn check_values(values: &[Option<u32>], count: usize) -> Result<(), Problem> {
    match values
        .iter()
        .flatten()
        .find(|value| **value as usize >= count)
    {
        Some(&index) => Err(Problem::IndexOutOfRange {
            what: "value of a surface",
            index: index.into(),
            count,
        }),
        None => Ok(()),
    }
}

/// Reads values that are nested as the boundaries are, down to the surface; null at any level
/// stands for all surfaces below it.
pub(super) fn surface_values(
    raw: Option<&RawValue>,
    kind: GeometryType,
    boundaries: &Boundaries,
) -> Result<Values, Problem> {
    const WHAT: &str = "values";
    let shells: Vec<_> = boundaries.shells().collect();
    let by_shell: Vec<Option<Values>> = match raw {
        None => vec![None; shells.len()],
        Some(raw) => {
            check_count(
                "bytes of values",
                raw.get().len() as u64,
                MAX_BOUNDARY_BYTES,
            )?;
            match kind {
                GeometryType::Solids => shell_values(parse(WHAT, raw)?, boundaries)?,
                GeometryType::Solid => parse(WHAT, raw)?,
                _ => vec![Some(parse(WHAT, raw)?)],
            }
        }
    };
    check_shape(by_shell.len() == shells.len())?;
    let mut values = Vec::new();
    for (shell, surfaces) in by_shell.into_iter().zip(shells) {
        match shell {
            None => values.resize(values.len() + surfaces.len(), None),
            Some(shell) => {
                check_shape(shell.len() == surfaces.len())?;
                values.extend(shell);
            }
        }
    }
    Ok(values)
}

/// Values by shell from values by solid.
fn shell_values(
    by_solid: Vec<Option<Vec<Option<Values>>>>,
    boundaries: &Boundaries,
) -> Result<Vec<Option<Values>>, Problem> {
    let solids: Vec<_> = boundaries.solids().collect();
    check_shape(by_solid.len() == solids.len())?;
    let mut by_shell = Vec::new();
    for (solid, shells) in by_solid.into_iter().zip(solids) {
        let solid = solid.unwrap_or_else(|| vec![None; shells.len()]);
        check_shape(solid.len() == shells.len())?;
        by_shell.extend(solid);
    }
    Ok(by_shell)
}

fn check_shape(fits: bool) -> Result<(), Problem> {
    match fits {
        true => Ok(()),
        false => Err(Problem::Malformed {
            what: "values".to_owned(),
            message: "not nested as the boundaries are".to_owned(),
        }),
    }
}
