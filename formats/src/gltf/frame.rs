//! Between the frame of glTF (y up, x east, z south) and that of the scene (z up, y north).

use crate::placement::Placement;

/// From glTF to the scene.
const Z_UP: Placement = Placement {
    rows: [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, -1.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
    ],
};

/// From the scene to glTF.
const Y_UP: Placement = Placement {
    rows: [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0, 0.0],
    ],
};

/// A position of glTF in the scene.
pub(super) fn position_in_scene(position: [f64; 3]) -> [f64; 3] {
    Z_UP.apply(position)
}

/// A node's transformation as one of shapes that have been brought into the scene's frame. Only
/// swaps and changes signs, so no bit is lost.
pub(super) fn placement_in_scene(placement: &Placement) -> Placement {
    Z_UP.after(&placement.after(&Y_UP))
}

/// The reverse of [`placement_in_scene`].
pub(super) fn placement_in_gltf(placement: &Placement) -> Placement {
    Y_UP.after(&placement.after(&Z_UP))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn y_up_and_south_become_z_up_and_north() {
        assert_eq!(position_in_scene([1.0, 2.0, 3.0]), [1.0, -3.0, 2.0]);
        assert_eq!(Y_UP.apply([1.0, -3.0, 2.0]), [1.0, 2.0, 3.0]);
    }

    #[test]
    fn placements_change_frames_without_rounding() {
        let rows = [
            [0.1, 0.2, 0.3, 85_000.1],
            [0.4, 0.5, -0.6, 447_000.2],
            [0.7, 0.8, 0.9, 0.3],
        ];
        let placement = Placement { rows };
        let in_gltf = placement_in_gltf(&placement);
        assert_eq!(in_gltf.rows[1], [0.7, 0.9, -0.8, 0.3]);
        assert_eq!(placement_in_scene(&in_gltf), placement);
    }
}
