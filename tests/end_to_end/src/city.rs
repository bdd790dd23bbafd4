//! [`City`], a CityJSON document made on the spot.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

/// Buildings and roads in millimetres around a corner of the Netherlands: coordinates are metres
/// from (85,000, 447,000, 0).
#[derive(Clone, Debug, Default)]
pub struct City {
    objects: serde_json::Map<String, Value>,
    vertices: Vec<[i64; 3]>,
}

/// A corner in x and z, metres.
type Corner = [f64; 2];

impl City {
    /// 25 blocks of 20 m a side and of many heights, with roads of 12 m between them.
    #[must_use]
    pub fn blocks() -> Self {
        let mut city = Self::default();
        for (i, j) in (0..5).flat_map(|i| (0..5).map(move |j| (i, j))) {
            let (x, y) = (32.0 * f64::from(i), 32.0 * f64::from(j));
            let height = 6.0 + f64::from((3 * i + 5 * j) % 7) * 2.0;
            city = city.block(
                &format!("block {i} {j}"),
                [x, y, 0.0],
                [x + 20.0, y + 20.0, height],
            );
        }
        for lane in 0..4 {
            let at = 20.0 + 32.0 * f64::from(lane);
            city = city.road(&format!("north {lane}"), [at, -20.0], [at + 12.0, 170.0]);
            city = city.road(&format!("east {lane}"), [-20.0, at], [170.0, at + 12.0]);
        }
        city
    }

    /// With a building in the form of a box.
    #[must_use]
    pub fn block(self, name: &str, [x, y, z]: [f64; 3], [right, back, top]: [f64; 3]) -> Self {
        self.prism(
            name,
            &[[x, z], [right, z], [right, top], [x, top]],
            [y, back],
        )
    }

    /// With a building whose cross-section in x and z, anticlockwise seen from the south, is the
    /// same from one y to another.
    #[must_use]
    pub fn prism(mut self, name: &str, section: &[Corner], [front, back]: [f64; 2]) -> Self {
        let first = self.vertices.len();
        for y in [front, back] {
            let vertices = section.iter().map(|&[x, z]| millimetres([x, y, z]));
            self.vertices.extend(vertices);
        }
        let count = section.len();
        let (near, far) = (
            |i: usize| first + i % count,
            |i: usize| first + count + i % count,
        );
        let sides = (0..count).map(|i| json!([[near(i), far(i), far(i + 1), near(i + 1)]]));
        let ends = [
            json!([(0..count).map(near).collect::<Vec<_>>()]),
            json!([(0..count).rev().map(far).collect::<Vec<_>>()]),
        ];
        let shell: Vec<Value> = sides.chain(ends).collect();
        self.add(name, "Building", "Solid", json!([shell]))
    }

    /// With a rectangular road at height 0.
    #[must_use]
    pub fn road(mut self, name: &str, [x, y]: Corner, [right, back]: Corner) -> Self {
        let first = self.vertices.len();
        let corners = [
            [x, y, 0.0],
            [right, y, 0.0],
            [right, back, 0.0],
            [x, back, 0.0],
        ];
        self.vertices.extend(corners.map(millimetres));
        self.add(
            name,
            "Road",
            "MultiSurface",
            json!([[[first, first + 1, first + 2, first + 3]]]),
        )
    }

    fn add(mut self, name: &str, class: &str, kind: &str, boundaries: Value) -> Self {
        let geometry = json!([{"type": kind, "lod": "2", "boundaries": boundaries}]);
        self.objects.insert(
            name.to_owned(),
            json!({"type": class, "geometry": geometry}),
        );
        self
    }

    /// The document.
    #[must_use]
    pub fn text(&self) -> String {
        json!({
            "type": "CityJSON",
            "version": "2.0",
            "transform": {"scale": [0.001, 0.001, 0.001], "translate": [85_000, 447_000, 0]},
            "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/7415"},
            "CityObjects": self.objects,
            "vertices": self.vertices,
        })
        .to_string()
    }

    /// Writes the document into a folder.
    ///
    /// # Panics
    /// When it cannot be written.
    #[must_use]
    pub fn write(&self, folder: &Path) -> PathBuf {
        let path = folder.join("city.json");
        std::fs::write(&path, self.text()).expect("the folder can be written");
        path
    }
}

fn millimetres(point: [f64; 3]) -> [i64; 3] {
    point.map(|coordinate| (coordinate * 1000.0).round() as i64)
}
