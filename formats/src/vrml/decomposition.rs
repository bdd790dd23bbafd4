//! Placements as a rotation and a scale, which is how a `Transform` gives them.

use super::faces::{cross, dot};
use crate::placement::Placement;

/// Cosine of the angle between axes below which they are at right angles: it moves what is 100 m
/// away by a tenth of a micrometre.
const RIGHT_ANGLE: f64 = 1e-9;

/// A rotation, as axis and angle, after a scale along the axes.
#[derive(Debug)]
pub(super) struct Decomposition {
    pub(super) rotation: [f64; 4],
    pub(super) scale: [f64; 3],
}

/// The linear part of a placement, taken apart; `None` where it mirrors, shears or flattens.
pub(super) fn decompose(placement: &Placement) -> Option<Decomposition> {
    let column = |j: usize| placement.rows.map(|row| row[j]);
    let axes = [column(0), column(1), column(2)];
    let scale = axes.map(|axis| dot(axis, axis).sqrt());
    if !scale.iter().all(|s| *s > 0.0 && s.is_finite()) {
        return None;
    }
    let [x, y, z]: [[f64; 3]; 3] = std::array::from_fn(|j| axes[j].map(|c| c / scale[j]));
    let right_angles = [dot(x, y), dot(y, z), dot(z, x)];
    let is_rotation = right_angles
        .iter()
        .all(|cosine| cosine.abs() <= RIGHT_ANGLE);
    let rotation = axis_and_angle(x, y, z);
    (is_rotation && dot(cross(x, y), z) > 0.0).then_some(Decomposition { rotation, scale })
}

/// The rotation that turns the axes to these, by way of the quaternion's largest component.
fn axis_and_angle(x: [f64; 3], y: [f64; 3], z: [f64; 3]) -> [f64; 4] {
    let squares = [
        1.0 + x[0] + y[1] + z[2],
        1.0 + x[0] - y[1] - z[2],
        1.0 - x[0] + y[1] - z[2],
        1.0 - x[0] - y[1] + z[2],
    ];
    let turns = [y[2] - z[1], z[0] - x[2], x[1] - y[0]];
    let sums = [y[2] + z[1], z[0] + x[2], x[1] + y[0]];
    let largest = (0..4).max_by(|i, j| squares[*i].total_cmp(&squares[*j]));
    // Four times the quaternion times its largest component: real part first.
    let [w, axis @ ..] = match largest.unwrap_or(0) {
        0 => [squares[0], turns[0], turns[1], turns[2]],
        1 => [turns[0], squares[1], sums[2], sums[1]],
        2 => [turns[1], sums[2], squares[2], sums[0]],
        _ => [turns[2], sums[1], sums[0], squares[3]],
    };
    let sine = dot(axis, axis).sqrt();
    if sine == 0.0 {
        return [0.0, 0.0, 1.0, 0.0];
    }
    let [x, y, z] = axis.map(|c| c / sine);
    [x, y, z, 2.0 * sine.atan2(w)]
}

#[cfg(test)]
mod tests {
    use super::super::frame::rotation;
    use super::*;

    #[test]
    fn rotations_come_back_at_every_angle() {
        for turn in -40..40 {
            for axis in [
                [0.0, 0.0, 1.0],
                [1.0, -2.0, 0.5],
                [-1.0, 0.0, 0.0],
                [0.3, 2.0, 1.0],
            ] {
                let [x, y, z] = axis;
                let placement = rotation([x, y, z, std::f64::consts::PI * f64::from(turn) / 20.0]);
                let found = decompose(&placement).unwrap();
                let again = rotation(found.rotation);
                for (row, other) in placement.rows.iter().zip(again.rows) {
                    assert!(row.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-12));
                }
                assert!(found.scale.iter().all(|s| (s - 1.0).abs() < 1e-12));
            }
        }
    }

    #[test]
    fn mirrors_shears_and_flat_placements_have_none() {
        let with = |i: usize, j: usize, factor: f64| {
            let mut placement = Placement::IDENTITY;
            placement.rows[i][j] = factor;
            decompose(&placement)
        };
        assert_eq!(with(1, 1, 3.0).unwrap().scale, [1.0, 3.0, 1.0]);
        assert!(
            with(0, 0, -1.0).is_none() && with(0, 1, 0.5).is_none() && with(2, 2, 0.0).is_none()
        );
    }
}
