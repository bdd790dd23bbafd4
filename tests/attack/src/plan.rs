//! [`Column`] and [`Feature`], what random scenes are made of.

/// A point in plan.
pub type Place = [f64; 2];

/// A solid column.
#[derive(Clone, Debug)]
pub struct Column {
    /// Outer ring anticlockwise, then holes clockwise.
    pub rings: Vec<Vec<Place>>,
    pub bottom: f64,
    pub top: f64,
    pub grounded: bool,
}

/// A feature.
#[derive(Clone, Debug)]
pub struct Feature {
    pub min: [f64; 3],
    pub max: [f64; 3],
    /// Corners of the outer prism, anticlockwise; none where there is no prism.
    pub outline: Vec<Place>,
    pub columns: Vec<Column>,
}

impl Feature {
    /// The feature of some columns, with the hull of their corners for an outline.
    pub fn of(columns: Vec<Column>) -> Self {
        let places: Vec<Place> = columns
            .iter()
            .flat_map(|column| column.rings.concat())
            .collect();
        let heights = columns
            .iter()
            .flat_map(|column| [column.bottom, column.top]);
        let (bottom, top) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| {
            (low.min(z), high.max(z))
        });
        let mut feature = Self::around(&places, bottom, top);
        feature.columns = columns;
        feature
    }

    /// A feature that hides nothing, around some places.
    pub fn around(places: &[Place], bottom: f64, top: f64) -> Self {
        let bound = |axis: usize, pick: fn(f64, f64) -> f64| {
            places
                .iter()
                .map(|place| place[axis])
                .reduce(pick)
                .expect("a feature has a place")
        };
        let points = places.iter().map(|&[x, y]| glam::DVec3::new(x, y, bottom));
        let outline = engine::OuterPrism::around(points).expect("places are finite");
        Self {
            min: [bound(0, f64::min), bound(1, f64::min), bottom],
            max: [bound(0, f64::max), bound(1, f64::max), top],
            outline: outline
                .hull
                .iter()
                .map(|corner| corner.to_array())
                .collect(),
            columns: Vec::new(),
        }
    }

    /// As the solver takes it.
    pub fn for_solver(&self, id: i64) -> engine::TileFeature {
        let ring = |ring: &Vec<Place>| geo::LineString::from(ring.clone());
        let column = |column: &Column| engine::SolidColumn {
            footprint: geo::Polygon::new(
                ring(&column.rings[0]),
                column.rings[1..].iter().map(ring).collect(),
            ),
            bottom: column.bottom,
            top: column.top,
            grounded: column.grounded,
        };
        engine::TileFeature {
            id,
            envelope: engine::Box3d::new(self.min.into(), self.max.into()),
            outline: self.outline.iter().map(|&corner| corner.into()).collect(),
            roof: None,
            columns: self.columns.iter().map(column).collect(),
        }
    }

    /// As the judge takes it; `None` where a column has no proper shape.
    pub fn for_judge(&self) -> Option<oracle::JudgedFeature> {
        let columns = self.columns.iter().map(|column| {
            oracle::Column::new(&column.rings, column.bottom, column.top, column.grounded).ok()
        });
        Some(oracle::JudgedFeature {
            bounds: oracle::Aabb::new(self.min, self.max),
            outline: self.outline.clone(),
            columns: columns.collect::<Option<_>>()?,
        })
    }
}

/// The four corners of a rectangle, anticlockwise.
pub fn rectangle(west: f64, south: f64, east: f64, north: f64) -> Vec<Place> {
    vec![[west, south], [east, south], [east, north], [west, north]]
}
