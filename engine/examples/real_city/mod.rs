//! A real city and eyes in its streets, as examples read them.

use engine::{
    Box3d, ColumnOptions, Site, SolidColumn, Street, TriangleMesh, footprint, solid_columns,
};
use formats::Feature;
use geo::{Area, BoundingRect, Contains, Point};
use glam::DVec3;

/// A feature of a city model.
pub struct House {
    /// The best level of detail.
    pub mesh: TriangleMesh,
    /// The corners of all levels of detail.
    pub points: Vec<DVec3>,
}

impl House {
    /// A feature as it is read.
    pub fn of(feature: &Feature) -> Self {
        let points = |geometry: &formats::Geometry| -> Vec<DVec3> {
            let surfaces = geometry.surfaces();
            let rings = surfaces.iter().flat_map(|surface| &surface.rings);
            rings.flatten().map(|&point| DVec3::from(point)).collect()
        };
        let levels = feature.geometries.iter().map(|g| g.level_of_detail);
        let best = levels.fold(0.0, f64::max);
        let polygons = feature
            .geometries
            .iter()
            .filter(|geometry| geometry.level_of_detail == best)
            .flat_map(|geometry| geometry.surfaces().into_owned())
            .map(|surface| -> Vec<Vec<DVec3>> {
                let ring = |ring: Vec<[f64; 3]>| ring.into_iter().map(DVec3::from).collect();
                surface.rings.into_iter().map(ring).collect()
            });
        let mesh = TriangleMesh::from_polygons(polygons);
        let points: Vec<DVec3> = feature.geometries.iter().flat_map(points).collect();
        Self { mesh, points }
    }

    /// Around all levels of detail.
    pub fn envelope(&self) -> Box3d {
        Box3d::around(self.points.iter().copied()).expect("a point")
    }

    /// Where it stands.
    pub fn site(&self) -> Site {
        Site {
            footprint: footprint(&self.mesh),
            foot: self.envelope().min.z,
        }
    }
}

/// The solid columns of a house that stands on the ground or hangs over it.
pub fn columns(house: &House, stands: bool) -> Vec<SolidColumn> {
    let found = solid_columns(&house.mesh, &ColumnOptions::default());
    let grounded = |column: SolidColumn| SolidColumn {
        grounded: column.grounded && stands,
        ..column
    };
    let columns = found.map_or(Vec::new(), |found| found.columns);
    columns.into_iter().map(grounded).collect()
}

/// Places on the streets, from a fixed sequence.
pub fn eyes(streets: &[Street], count: usize) -> Vec<DVec3> {
    let mut before = Vec::with_capacity(streets.len());
    let mut total = 0.0;
    for street in streets {
        total += street.area.unsigned_area();
        before.push(total);
    }
    let unit = |i: usize, base: f64| (i as f64 * base).fract();
    let mut eyes = Vec::new();
    for i in 1.. {
        let place = unit(i, 0.754_877_666_246_693) * total;
        let street = &streets[before
            .partition_point(|&end| end <= place)
            .min(streets.len() - 1)];
        let rect = street.area.bounding_rect().expect("an area");
        let x = rect.min().x + unit(i, 0.569_840_290_998_053) * rect.width();
        let y = rect.min().y + unit(i, 0.362_656_070_415_29) * rect.height();
        if street.area.contains(&Point::new(x, y)) {
            eyes.push(DVec3::new(x, y, (street.eye_low + street.eye_high) / 2.0));
        }
        if eyes.len() == count {
            break;
        }
    }
    eyes
}
