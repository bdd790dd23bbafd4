//! Geometry templates: shapes stored once, in their own frame, and placed many times.

use std::sync::Arc;

use serde_json::value::RawValue;

use super::appearance::Appearance;
use super::boundaries::{Boundaries, GeometryType};
use super::budget::Budget;
use super::geometry::{Lists, ReadShape, read_shape};
use super::json::{Members, array, invalid, parse};
use super::vertices::{Transform, Vertices, check_position, numbers};
use crate::error::Problem;
use crate::placement::Placement;
use crate::scene::Surface;

/// The member `geometry-templates`.
#[derive(Debug, Default)]
pub(super) struct Templates {
    templates: Vec<Template>,
}

/// One template.
#[derive(Debug)]
struct Template {
    read: ReadShape,
    /// Its two extreme corners: an affine map takes the box between them to its own extremes.
    corners: [[f64; 3]; 2],
}

impl Templates {
    /// Reads the templates and their vertices; these are metres, no transform applies.
    pub(super) fn parse(
        raw: &RawValue,
        appearance: &Appearance,
        budget: &mut Budget<'_>,
    ) -> Result<Self, Problem> {
        let members = Members::of("geometry-templates", raw)?;
        let list = members.require("vertices-templates", "vertices-templates")?;
        let limit = budget.limits.vertices;
        let vertices = Vertices::parse("template vertex", list, Transform::IDENTITY, limit)?;
        let lists = Lists {
            vertices: &vertices,
            appearance,
        };
        let templates = array("templates", members.require("templates", "templates")?)?;
        let template = |raw| Template::parse(raw, &lists, budget);
        Ok(Self {
            templates: templates
                .into_iter()
                .map(template)
                .collect::<Result<_, _>>()?,
        })
    }

    /// Rings that were dropped from all templates, each counted once.
    pub(super) fn degenerate_rings(&self) -> usize {
        let losses = self.templates.iter().map(|template| &template.read.losses);
        losses.map(|losses| losses.degenerate_rings).sum()
    }

    /// Reads an instance: its template, the shape shared, and where it goes.
    pub(super) fn place(
        &self,
        members: &Members<'_>,
        anchors: &Vertices,
        budget: &mut Budget<'_>,
    ) -> Result<(ReadShape, Placement), Problem> {
        let index = parse("template", members.require("template", "template")?)?;
        let template = self.get(index)?;
        let boundaries = members.require("boundaries", "boundaries")?;
        let anchor = anchors.position(anchor_index(boundaries, anchors.len())?);
        let matrix = members.require("transformationMatrix", "transformationMatrix")?;
        let placement = placement(matrix, anchor)?;
        budget.instance_vertices(template.read.size)?;
        budget.feature_geometry()?;
        template.check_reach(index as usize, &placement)?;
        let mut read = template.shared();
        if placement.flattens() {
            read.shape = Arc::default();
            read.losses.flat_instances = true;
        }
        Ok((read, placement))
    }

    /// The template that an instance selects.
    fn get(&self, index: u64) -> Result<&Template, Problem> {
        let template = usize::try_from(index)
            .ok()
            .and_then(|i| self.templates.get(i));
        template.ok_or(Problem::IndexOutOfRange {
            what: "template",
            index,
            count: self.templates.len(),
        })
    }
}

impl Template {
    fn parse(raw: &RawValue, lists: &Lists<'_>, budget: &mut Budget<'_>) -> Result<Self, Problem> {
        let members = Members::of("template", raw)?;
        let kind = members.require("type", "geometry type")?;
        let kind = match GeometryType::parse(kind)? {
            GeometryType::Instance => {
                let expected = "a geometry that is not an instance";
                return Err(invalid("template type", kind, expected));
            }
            other => other,
        };
        let read = read_shape(&members, kind, lists, budget)?;
        let corners = corners(&read.shape.surfaces);
        Ok(Self { read, corners })
    }

    /// What every instance has in common. Rings that were dropped are counted once, with the
    /// template.
    fn shared(&self) -> ReadShape {
        let mut read = self.read.clone();
        read.losses.degenerate_rings = 0;
        read
    }

    /// Refuses to place it where coordinates are too large.
    fn check_reach(&self, index: usize, placement: &Placement) -> Result<(), Problem> {
        (0..8).try_for_each(|corner: usize| {
            let axis = |axis: usize| self.corners[corner >> axis & 1][axis];
            let position = placement.apply([axis(0), axis(1), axis(2)]);
            check_position("instance of template", index, position)
        })
    }
}

/// The extreme corners of surfaces; the origin where there are none.
fn corners(surfaces: &[Surface]) -> [[f64; 3]; 2] {
    let mut positions = surfaces.iter().flat_map(|surface| &surface.rings).flatten();
    let first = positions.next().copied().unwrap_or_default();
    positions.fold([first; 2], |[low, high], position| {
        let axes = [0, 1, 2];
        [
            axes.map(|i| low[i].min(position[i])),
            axes.map(|i| high[i].max(position[i])),
        ]
    })
}

/// Reads the boundaries of an instance: one vertex.
fn anchor_index(raw: &RawValue, vertex_count: usize) -> Result<usize, Problem> {
    match Boundaries::parse(GeometryType::Instance, raw, vertex_count)?.indices() {
        [index] => Ok(*index as usize),
        _ => Err(invalid("boundaries", raw, "one vertex for the instance")),
    }
}

/// Reads the member `transformationMatrix`, 4 x 4 row by row, and moves on to the anchor.
fn placement(raw: &RawValue, anchor: [f64; 3]) -> Result<Placement, Problem> {
    const WHAT: &str = "transformationMatrix";
    let m: [f64; 16] = numbers(WHAT, "16 numbers", raw)?;
    if m[12..] != [0.0, 0.0, 0.0, 1.0] {
        return Err(invalid(WHAT, raw, "a last row of 0, 0, 0, 1"));
    }
    let row = |i: usize| {
        [
            m[4 * i],
            m[4 * i + 1],
            m[4 * i + 2],
            m[4 * i + 3] + anchor[i],
        ]
    };
    Ok(Placement {
        rows: [row(0), row(1), row(2)],
    })
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
        let placement = placement(matrix, [100.0, 200.0, 300.0]).unwrap();
        assert_eq!(placement.apply([1.0, 2.0, 3.0]), [97.0, 202.0, 303.5]);
    }

    #[test]
    fn placements_that_are_not_affine_are_refused() {
        let message = |text| placement(raw(text), [0.0; 3]).unwrap_err().to_string();
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
