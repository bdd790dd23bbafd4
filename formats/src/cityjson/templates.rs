//! Geometry templates: shapes stored once, in their own frame, and placed many times.

use serde_json::value::RawValue;

use super::boundaries::{GeometryType, IndexSurface, index_surfaces, surfaces_from};
use super::geometry::level_of_detail;
use super::json::{Members, array, invalid};
use super::vertices::{Transform, Vertices, check_position, numbers};
use crate::error::Problem;
use crate::limits::Budget;
use crate::scene::Surface;

/// The member `geometry-templates`.
#[derive(Debug, Default)]
pub(super) struct Templates {
    templates: Vec<Template>,
    vertices: Vertices,
}

/// One template.
#[derive(Debug)]
pub(super) struct Template {
    pub(super) level_of_detail: f64,
    surfaces: Vec<IndexSurface>,
    /// Vertices and rings: what placing it once costs.
    size: usize,
}

impl Templates {
    /// Reads the templates and their vertices; these are metres, no transform applies.
    pub(super) fn parse(raw: &RawValue, budget: &mut Budget) -> Result<Self, Problem> {
        let members = Members::of("geometry-templates", raw)?;
        let list = members.require("vertices-templates", "vertices-templates")?;
        let vertices = Vertices::parse("template vertex", list, Transform::IDENTITY)?;
        budget.vertices(vertices.len())?;
        let templates = array("templates", members.require("templates", "templates")?)?;
        let templates = templates
            .into_iter()
            .map(|template| Template::parse(template, vertices.len()))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            templates,
            vertices,
        })
    }

    /// The template that an instance selects.
    pub(super) fn get(&self, index: u64) -> Result<&Template, Problem> {
        let template = usize::try_from(index)
            .ok()
            .and_then(|i| self.templates.get(i));
        template.ok_or(Problem::IndexOutOfRange {
            what: "template",
            index,
            count: self.templates.len(),
        })
    }

    /// A template's surfaces, placed.
    pub(super) fn place(
        &self,
        index: u64,
        placement: &Placement,
        budget: &mut Budget,
        degenerate_rings: &mut usize,
    ) -> Result<Vec<Surface>, Problem> {
        let template = self.get(index)?;
        budget.surfaces(template.surfaces.len())?;
        budget.instance_vertices(template.size)?;
        let place = |ring: &Vec<u64>| {
            let mut ring: Vec<_> = ring
                .iter()
                .map(|i| placement.apply(self.vertices.position(*i as usize)))
                .collect();
            if placement.mirrors() {
                ring.reverse();
            }
            ring
        };
        let surfaces = surfaces_from(&template.surfaces, place, degenerate_rings);
        for position in surfaces.iter().flat_map(|surface| &surface.rings).flatten() {
            check_position("instance of template", index as usize, *position)?;
        }
        Ok(surfaces)
    }
}

impl Template {
    fn parse(raw: &RawValue, vertex_count: usize) -> Result<Self, Problem> {
        let members = Members::of("template", raw)?;
        let kind = members.require("type", "geometry type")?;
        let kind = match GeometryType::parse(kind)? {
            GeometryType::Instance => {
                return Err(invalid(
                    "template type",
                    kind,
                    "a geometry that is not an instance",
                ));
            }
            other => other,
        };
        let boundaries = members.require("boundaries", "boundaries")?;
        let surfaces = index_surfaces(kind, boundaries, vertex_count)?;
        let size = |surface: &IndexSurface| 1 + surface.iter().map(|r| 1 + r.len()).sum::<usize>();
        Ok(Self {
            level_of_detail: level_of_detail(&members)?,
            size: surfaces.iter().map(size).sum(),
            surfaces,
        })
    }
}

/// Where a template goes: an affine map, then a move to the anchor.
#[derive(Debug)]
pub(super) struct Placement {
    rows: [[f64; 4]; 3],
    anchor: [f64; 3],
}

impl Placement {
    /// Reads the member `transformationMatrix`, 4 x 4 row by row.
    pub(super) fn parse(raw: &RawValue, anchor: [f64; 3]) -> Result<Self, Problem> {
        const WHAT: &str = "transformationMatrix";
        let m: [f64; 16] = numbers(WHAT, "16 numbers", raw)?;
        if m[12..] != [0.0, 0.0, 0.0, 1.0] {
            return Err(invalid(WHAT, raw, "a last row of 0, 0, 0, 1"));
        }
        let rows = std::array::from_fn(|i| std::array::from_fn(|j| m[4 * i + j]));
        Ok(Self { rows, anchor })
    }

    fn apply(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| {
            let [a, b, c, move_by] = self.rows[i];
            (a * x + b * y + c * z + move_by) + self.anchor[i] + 0.0
        })
    }

    /// Whether the map turns shapes inside out, so that rings have to be reversed.
    fn mirrors(&self) -> bool {
        let [[a, b, c, _], [d, e, f, _], [g, h, i, _]] = self.rows;
        a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn raw(text: &str) -> &RawValue {
        serde_json::from_str(text).unwrap()
    }

    #[test]
    fn placement_is_the_matrix_by_rows_then_the_anchor() {
        let matrix = raw("[0,-2,0,1, 2,0,0,0, 0,0,1,0.5, 0,0,0,1]");
        let placement = Placement::parse(matrix, [100.0, 200.0, 300.0]).unwrap();
        assert_eq!(placement.apply([1.0, 2.0, 3.0]), [97.0, 202.0, 303.5]);
        assert!(!placement.mirrors());
        let mirror = raw("[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]");
        assert!(Placement::parse(mirror, [0.0; 3]).unwrap().mirrors());
    }

    #[test]
    fn placements_that_are_not_affine_are_refused() {
        let message = |text| {
            Placement::parse(raw(text), [0.0; 3])
                .unwrap_err()
                .to_string()
        };
        assert_eq!(
            message("[1,0]"),
            "transformationMatrix is [1,0], expected 16 numbers"
        );
        let by_columns = "[1,0,0,0,0,1,0,0,0,0,1,0,5,5,5,1]";
        assert_eq!(
            message(by_columns),
            format!("transformationMatrix is {by_columns}, expected a last row of 0, 0, 0, 1")
        );
    }
}
