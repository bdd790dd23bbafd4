//! The triangles to draw and the feature that each belongs to.

use crate::error::{Error, Result};

/// Coordinates beyond this many metres are refused: no place on Earth has them in any frame, and
/// eye-relative coordinates stay far from the largest f32.
const LARGEST_COORDINATE: f64 = 1e12;

/// True for a point that can be drawn or looked from: NaN and infinities fail too.
pub(crate) fn is_drawable(point: &[f64; 3]) -> bool {
    point
        .iter()
        .all(|coordinate| coordinate.abs() <= LARGEST_COORDINATE)
}

/// A scene's triangles, each with an id. Metres, z up, f64: large coordinates are welcome.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SceneMesh {
    /// Corners, shared by triangles or not.
    pub positions: Vec<[f64; 3]>,
    /// Three indices into `positions` each. Orientation does not matter: both sides are drawn.
    pub triangles: Vec<[u32; 3]>,
    /// One id a triangle. 0 means nothing: such a triangle hides what is behind it, and is not
    /// itself seen.
    pub ids: Vec<u32>,
}

impl SceneMesh {
    /// Refuses indices out of range, a missing id, and coordinates that are not
    /// finite or absurdly large.
    pub(crate) fn check(&self) -> Result<()> {
        if self.ids.len() != self.triangles.len() {
            let (ids, triangles) = (self.ids.len(), self.triangles.len());
            return Err(Error::Mesh(format!("{ids} ids for {triangles} triangles")));
        }
        if let Some(at) = self.positions.iter().position(|p| !is_drawable(p)) {
            return Err(Error::Mesh(format!(
                "position {at} is {:?}",
                self.positions[at]
            )));
        }
        let count = self.positions.len();
        let stray = |t: &[u32; 3]| t.iter().any(|&corner| corner as usize >= count);
        if let Some(at) = self.triangles.iter().position(stray) {
            let corners = self.triangles[at];
            let message = format!("triangle {at} is {corners:?}, with {count} positions");
            return Err(Error::Mesh(message));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> SceneMesh {
        SceneMesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            ids: vec![7],
        }
    }

    #[test]
    fn accepts_what_fits() {
        assert!(triangle().check().is_ok());
        assert!(SceneMesh::default().check().is_ok());
    }

    #[test]
    fn refuses_what_contradicts_itself() {
        let spoil: [fn(&mut SceneMesh); 4] = [
            |mesh| mesh.triangles[0][1] = 3,
            |mesh| mesh.ids.clear(),
            |mesh| mesh.positions[2][0] = f64::NAN,
            |mesh| mesh.positions[0][2] = f64::INFINITY,
        ];
        for change in spoil {
            let mut mesh = triangle();
            change(&mut mesh);
            assert!(matches!(mesh.check(), Err(Error::Mesh(_))));
        }
    }
}
