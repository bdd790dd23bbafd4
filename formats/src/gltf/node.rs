//! Nodes: where they are, and what they say of themselves.

use std::borrow::Cow;

use serde::Deserialize;
use serde_json::value::RawValue;

use super::document::Document;
use super::frame::placement_in_scene;
use super::weight::Weight;
use crate::error::Problem;
use crate::placement::Placement;
use crate::scene::Geometry;

/// A node as it is read.
#[derive(Deserialize)]
pub(super) struct Node<'a> {
    #[serde(borrow)]
    pub(super) name: Option<Cow<'a, str>>,
    pub(super) mesh: Option<u64>,
    pub(super) skin: Option<u64>,
    #[serde(borrow)]
    pub(super) children: Option<&'a RawValue>,
    #[serde(borrow)]
    pub(super) extras: Option<&'a RawValue>,
    matrix: Option<[f64; 16]>,
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
    extensions: Option<Extensions>,
}

#[derive(Deserialize)]
struct Extensions {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    instancing: Option<Instancing>,
}

#[derive(Deserialize)]
struct Instancing {
    attributes: InstanceAttributes,
}

/// Accessors of the parts of each instance's transformation.
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
struct InstanceAttributes {
    translation: Option<u64>,
    rotation: Option<u64>,
    scale: Option<u64>,
}

impl Node<'_> {
    /// The node's transformation, in the frame of the scene.
    pub(super) fn placement(&self) -> Result<Placement, Problem> {
        let placement = match &self.matrix {
            Some(matrix) => from_columns(matrix)?,
            None => composed(self.translation, self.rotation, self.scale),
        };
        Ok(placement_in_scene(&placement))
    }

    /// Where the node's mesh goes within the node: once, unless the node lists instances. Their
    /// geometries are added to the weight.
    pub(super) fn instances(
        &self,
        document: &Document<'_>,
        weight: &mut Weight,
    ) -> Result<impl Iterator<Item = Placement> + use<>, Problem> {
        let instancing = self.extensions.as_ref().and_then(|e| e.instancing.as_ref());
        let listed = instancing.map(|instancing| &instancing.attributes);
        let InstanceAttributes {
            translation,
            rotation,
            scale,
        } = listed.copied().unwrap_or_default();
        let mut count = usize::from(instancing.is_none());
        for accessor in [translation, rotation, scale].into_iter().flatten() {
            count = count.max(document.count(accessor)?);
        }
        weight.add(count.saturating_mul(size_of::<Geometry>()))?;
        let translations = vectors::<3>(document, translation)?;
        let rotations = vectors::<4>(document, rotation)?;
        let scales = vectors::<3>(document, scale)?;
        Ok((0..count).map(move |i| {
            let (translation, scale) = (translations.get(i).copied(), scales.get(i).copied());
            placement_in_scene(&composed(translation, rotations.get(i).copied(), scale))
        }))
    }
}

fn vectors<const N: usize>(
    document: &Document<'_>,
    accessor: Option<u64>,
) -> Result<Vec<[f64; N]>, Problem> {
    accessor.map_or(Ok(Vec::new()), |accessor| document.vectors(accessor))
}

fn from_columns(m: &[f64; 16]) -> Result<Placement, Problem> {
    let [
        a,
        b,
        c,
        last_a,
        d,
        e,
        f,
        last_b,
        g,
        h,
        i,
        last_c,
        x,
        y,
        z,
        last_d,
    ] = *m;
    if [last_a, last_b, last_c, last_d] != [0.0, 0.0, 0.0, 1.0] {
        return Err(Problem::Invalid {
            what: "the last row of a matrix".to_owned(),
            found: format!("{:?}", [last_a, last_b, last_c, last_d]),
            expected: "0, 0, 0, 1",
        });
    }
    let rows = [[a, d, g, x], [b, e, h, y], [c, f, i, z]];
    Ok(Placement { rows })
}

/// Scale, then rotation by a quaternion of any length, then translation.
fn composed(
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
) -> Placement {
    let mut placement = Placement::moved_by(translation.unwrap_or_default());
    if let Some([x, y, z, w]) = rotation {
        let double = 2.0 / (x * x + y * y + z * z + w * w);
        let turned = [
            [
                1.0 - double * (y * y + z * z),
                double * (x * y - w * z),
                double * (x * z + w * y),
            ],
            [
                double * (x * y + w * z),
                1.0 - double * (x * x + z * z),
                double * (y * z - w * x),
            ],
            [
                double * (x * z - w * y),
                double * (y * z + w * x),
                1.0 - double * (x * x + y * y),
            ],
        ];
        for (row, [a, b, c]) in placement.rows.iter_mut().zip(turned) {
            *row = [a, b, c, row[3]];
        }
    }
    let [x, y, z] = scale.unwrap_or([1.0; 3]);
    placement.rows = placement
        .rows
        .map(|[a, b, c, by]| [a * x, b * y, c * z, by]);
    placement
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placement(json: &str) -> Result<Placement, Problem> {
        serde_json::from_str::<Node<'_>>(json).unwrap().placement()
    }

    #[test]
    fn scale_then_rotation_then_translation() {
        // A quarter turn about the upright axis takes east to north.
        let json = r#"{"translation":[10,20,30],"rotation":[0,3,0,3],"scale":[2,1,1]}"#;
        let placed = placement(json).unwrap();
        let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(
            near(placed.apply([1.0, 0.0, 0.0]), [10.0, -28.0, 20.0]),
            "{placed:?}"
        );
        assert!(
            near(placed.apply([0.0, 1.0, 1.0]), [9.0, -30.0, 21.0]),
            "{placed:?}"
        );
    }

    #[test]
    fn matrices_are_by_columns() {
        let json = r#"{"matrix":[1,0,0,0, 0,2,0,0, 0,0,3,0, 4,5,6,1]}"#;
        assert_eq!(placement(json).unwrap().apply([1.0; 3]), [5.0, -3.0, 7.0]);
        let json = r#"{"matrix":[1,0,0,4, 0,2,0,5, 0,0,3,6, 0,0,0,1]}"#;
        assert_eq!(
            placement(json).unwrap_err().to_string(),
            "the last row of a matrix is [4.0, 5.0, 6.0, 1.0], expected 0, 0, 0, 1"
        );
    }
}
