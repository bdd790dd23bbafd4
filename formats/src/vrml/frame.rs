//! The frame of VRML97, x east, y up, z south, against that of scenes, x east, y north, z up; and
//! the placements of nodes in it.

use super::faces::{cross, dot};
use super::graph::Node;
use crate::placement::Placement;

/// A position of a file in the frame of scenes. A turn, so nothing is mirrored.
pub(super) fn to_scene([x, y, z]: [f64; 3]) -> [f64; 3] {
    // Adding zero makes a negative zero positive, so that equal positions are equal in bits.
    [x, 0.0 - z, y].map(|c| c + 0.0)
}

/// A position of a scene in the frame of files.
pub(super) fn to_file([x, y, z]: [f64; 3]) -> [f64; 3] {
    [x, z, 0.0 - y].map(|c| c + 0.0)
}

/// A placement in the frame of files as one in that of scenes.
pub(super) fn placement_to_scene(placement: &Placement) -> Placement {
    let [east, up, south] = placement.rows;
    Placement {
        rows: [east, south.map(|factor| -factor), up].map(|[x, y, z, by]| [x, -z, y, by]),
    }
}

/// A placement in the frame of scenes as one in that of files.
pub(super) fn placement_to_file(placement: &Placement) -> Placement {
    let [east, north, up] = placement.rows;
    Placement {
        rows: [east, up, north.map(|factor| -factor)].map(|[x, y, z, by]| [x, z, -y, by]),
    }
}

/// Where a node puts its children, in the frame of files: translation, centre, rotation, scale
/// along the axes of the scale's orientation, and the centre back, as in clause 6.52.
pub(super) fn placement_of(node: &Node<'_>) -> Placement {
    if node.node_type.name != "Transform" {
        return Placement::IDENTITY;
    }
    let center = node.vector("center");
    let [x, y, z, angle] = node.vector("scaleOrientation");
    let steps = [
        Placement::moved_by(center),
        rotation(node.vector("rotation")),
        rotation([x, y, z, angle]),
        scale(node.vector("scale")),
        rotation([x, y, z, -angle]),
        Placement::moved_by(center.map(|c| -c)),
    ];
    let start = Placement::moved_by(node.vector("translation"));
    steps.iter().fold(start, |all, step| all.after(step))
}

/// Whether a placement leaves no volume of anything.
pub(super) fn is_flat(placement: &Placement) -> bool {
    let [a, b, c] = placement.rows.map(|[x, y, z, _]| [x, y, z]);
    dot(cross(a, b), c) == 0.0
}

fn scale([x, y, z]: [f64; 3]) -> Placement {
    Placement {
        rows: [[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0]],
    }
}

/// Turns about an axis through the origin, by Rodrigues' formula. An axis without length turns
/// nothing.
pub(super) fn rotation([x, y, z, angle]: [f64; 4]) -> Placement {
    let length = x.hypot(y).hypot(z);
    if length == 0.0 || angle == 0.0 {
        return Placement::IDENTITY;
    }
    let [x, y, z] = [x, y, z].map(|c| c / length);
    let (sin, cos) = angle.sin_cos();
    let rest = 1.0 - cos;
    Placement {
        rows: [
            [
                cos + x * x * rest,
                x * y * rest - z * sin,
                x * z * rest + y * sin,
                0.0,
            ],
            [
                y * x * rest + z * sin,
                cos + y * y * rest,
                y * z * rest - x * sin,
                0.0,
            ],
            [
                z * x * rest - y * sin,
                z * y * rest + x * sin,
                cos + z * z * rest,
                0.0,
            ],
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::{Budget, Limits};

    #[test]
    fn frames_go_there_and_back() {
        assert_eq!(to_scene([1.0, 2.0, 3.0]), [1.0, -3.0, 2.0]);
        assert_eq!(to_file(to_scene([1.0, 2.0, 3.0])), [1.0, 2.0, 3.0]);
        let turned = rotation([1.0, 2.0, 3.0, 0.7]);
        let placement = Placement::moved_by([4.0, 5.0, 6.0]).after(&turned);
        let scene = placement_to_scene(&placement);
        assert_eq!(placement_to_file(&scene), placement);
        let there = to_scene(placement.apply([7.0, 8.0, 9.0]));
        let other = scene.apply(to_scene([7.0, 8.0, 9.0]));
        assert!((0..3).all(|i| (there[i] - other[i]).abs() < 1e-12));
    }

    fn placed(body: &str, position: [f64; 3]) -> [f64; 3] {
        let mut budget = Budget::new(&Limits::STANDARD, 0).unwrap();
        let text = format!("Transform {{ {body} }}");
        let graph = super::super::parser::parse(&text, &mut budget).unwrap();
        let moved = placement_of(graph.node(graph.roots[0])).apply(position);
        moved.map(|c| (c * 1e9).round() / 1e9 + 0.0)
    }

    #[test]
    fn transforms_scale_then_turn_then_move_about_the_center() {
        let up = [0.0, 1.0, 0.0];
        assert_eq!(placed("", up), up);
        let quarter = "rotation 0 0 5 1.5707963267948966";
        assert_eq!(placed(quarter, up), [-1.0, 0.0, 0.0]);
        let scaled = format!("scale 1 3 1 translation 10 0 0 {quarter}");
        assert_eq!(placed(&scaled, up), [7.0, 0.0, 0.0]);
        let about = format!("center 0 1 0 {quarter}");
        assert_eq!(placed(&about, [0.0, 2.0, 0.0]), [-1.0, 1.0, 0.0]);
        let along = "scale 3 1 1 scaleOrientation 0 0 1 1.5707963267948966";
        assert_eq!(placed(along, up), [0.0, 3.0, 0.0]);
    }
}
