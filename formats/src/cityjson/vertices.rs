//! Lists of vertices, and the transform from their stored integers to metres.

use serde_json::value::RawValue;

use super::json::{Members, invalid, list};
use crate::error::Problem;
use crate::limits::MAX_COORDINATE;

/// Stored coordinates to metres: `stored * scale + translate`, each axis on its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transform {
    scale: [f64; 3],
    translate: [f64; 3],
}

impl Transform {
    /// Leaves coordinates as they are, as templates have them.
    pub(super) const IDENTITY: Self = Self {
        scale: [1.0; 3],
        translate: [0.0; 3],
    };

    /// Reads the member `transform`.
    pub(super) fn parse(raw: &RawValue) -> Result<Self, Problem> {
        let members = Members::of("transform", raw)?;
        let axes = |name, what| numbers::<3>(what, "three numbers", members.require(name, what)?);
        Ok(Self {
            scale: axes("scale", "transform.scale")?,
            translate: axes("translate", "transform.translate")?,
        })
    }

    /// The position in metres. A pure function of the stored vertex, so that surfaces that share a
    /// vertex share its bits; zero is always positive.
    fn apply(&self, stored: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| stored[i] * self.scale[i] + self.translate[i] + 0.0)
    }
}

impl Default for Transform {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// A list of vertices, indexed from 0.
#[derive(Debug, Default)]
pub(super) struct Vertices {
    stored: Vec<[f64; 3]>,
    transform: Transform,
}

impl Vertices {
    /// Reads a list of vertices; every position is finite and within bounds.
    pub(super) fn parse(
        what: &'static str,
        raw: &RawValue,
        transform: Transform,
        limit: u64,
    ) -> Result<Self, Problem> {
        let stored = list(what, raw, "vertices", limit).map_err(|problem| match problem {
            Problem::Malformed { .. } => first_wrong_vertex(what, raw, limit),
            other => other,
        })?;
        let vertices = Self { stored, transform };
        for index in 0..vertices.len() {
            check_position(what, index, vertices.position(index))?;
        }
        Ok(vertices)
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.stored.len()
    }

    /// A vertex in metres; the index was checked when its boundary was read.
    pub(super) fn position(&self, index: usize) -> [f64; 3] {
        self.transform.apply(self.stored[index])
    }
}

/// A raw value that has to be an array of exactly N finite numbers.
pub(super) fn numbers<const N: usize>(
    what: &str,
    expected: &'static str,
    raw: &RawValue,
) -> Result<[f64; N], Problem> {
    let wrong = || invalid(what, raw, expected);
    let values: Vec<f64> = list(what, raw, "numbers", N as u64).map_err(|_| wrong())?;
    <[f64; N]>::try_from(values).map_err(|_| wrong())
}

/// Refuses a position that is not finite or lies absurdly far out.
pub(super) fn check_position(
    what: &'static str,
    index: usize,
    position: [f64; 3],
) -> Result<(), Problem> {
    if position
        .iter()
        .all(|coordinate| coordinate.abs() <= MAX_COORDINATE)
    {
        return Ok(());
    }
    Err(Problem::Invalid {
        what: format!("{what} {index}"),
        found: format!("{position:?} in metres"),
        expected: "coordinates within 1e9 of zero",
    })
}

/// Says which vertex of a list that could not be read is at fault.
fn first_wrong_vertex(what: &'static str, raw: &RawValue, limit: u64) -> Problem {
    let elements: Vec<&RawValue> = match list(what, raw, "vertices", limit) {
        Ok(elements) => elements,
        Err(problem) => return problem,
    };
    let wrong = |(index, element): (usize, &RawValue)| {
        numbers::<3>(&format!("{what} {index}"), "three numbers", element).err()
    };
    elements
        .into_iter()
        .enumerate()
        .find_map(wrong)
        .unwrap_or_else(|| Problem::Malformed {
            what: what.to_owned(),
            message: "expected a list of vertices".to_owned(),
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn raw(text: &str) -> &RawValue {
        serde_json::from_str(text).unwrap()
    }

    fn message(list: &str) -> String {
        Vertices::parse("vertex", raw(list), Transform::IDENTITY, 9)
            .unwrap_err()
            .to_string()
    }

    #[test]
    fn position_is_scale_then_translate() {
        let transform = Transform::parse(raw(
            r#"{"scale":[0.001,0.01,1],"translate":[85000,447000,-1]}"#,
        ));
        let vertices =
            Vertices::parse("vertex", raw("[[1234,-5,1]]"), transform.unwrap(), 9).unwrap();
        let expected = [1234.0 * 0.001 + 85000.0, -5.0 * 0.01 + 447000.0, 0.0];
        assert_eq!(
            vertices.position(0).map(f64::to_bits),
            expected.map(f64::to_bits)
        );
    }

    #[test]
    fn wrong_vertices_are_named() {
        let three = "expected three numbers";
        assert_eq!(
            message("[[0,0,0],[1,2]]"),
            format!("vertex 1 is [1,2], {three}")
        );
        assert_eq!(
            message("[[0,0,0,0]]"),
            format!("vertex 0 is [0,0,0,0], {three}")
        );
        assert_eq!(
            message("[[0,0,1e999]]"),
            format!("vertex 0 is [0,0,1e999], {three}")
        );
        assert_eq!(message("[null]"), format!("vertex 0 is null, {three}"));
        assert_eq!(message("7"), "vertex is 7, expected an array");
        assert_eq!(
            message(&format!("[[0,0,0]{}]", ",[0,0,0]".repeat(9))),
            "10 vertices exceed the limit of 9"
        );
        assert_eq!(
            message("[[0,1e12,0]]"),
            "vertex 0 is [0.0, 1000000000000.0, 0.0] in metres, expected coordinates within 1e9 of zero"
        );
    }

    #[test]
    fn transforms_need_three_numbers_twice() {
        let message = |text| Transform::parse(raw(text)).unwrap_err().to_string();
        assert_eq!(message("[]"), "transform is [], expected an object");
        assert_eq!(message("{}"), "transform.scale is missing");
        assert_eq!(
            message(r#"{"scale":[]}"#),
            "transform.scale is [], expected three numbers"
        );
        assert_eq!(
            message(r#"{"scale":[1,1,1],"translate":[0,"0",0]}"#),
            "transform.translate is [0,\"0\",0], expected three numbers"
        );
    }
}
