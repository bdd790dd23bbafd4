//! Longitude and latitude in metres: [`Projection`].

mod bounds;
mod utm;

pub(crate) use bounds::Bounds;

use proj4rs::errors::Error;
use proj4rs::proj::Proj;
use proj4rs::transform::{Transform, TransformClosure, transform};

use crate::error::Problem;
use crate::limits::MAX_COORDINATE;

/// The frame of GPS, OpenStreetMap and GeoJSON.
const WGS_84: &str = "+proj=longlat +datum=WGS84 +no_defs";

/// Brings WGS 84 into a projected frame in metres, east and north.
pub(crate) struct Projection {
    srid: i32,
    from: Proj,
    to: Proj,
}

impl Projection {
    /// Into the frame with this EPSG code.
    pub(crate) fn to_srid(srid: i32) -> Result<Self, Problem> {
        let refused = |what: String| Problem::Unsupported {
            what: format!("srid {srid}, {what},"),
        };
        let definition = u16::try_from(srid)
            .ok()
            .and_then(crs_definitions::from_code)
            .ok_or_else(|| refused("which is not known".into()))?;
        let unusable = |error: Error| refused(format!("whose definition says {error}"));
        let to = Proj::from_proj_string(definition.proj4).map_err(unusable)?;
        if to.is_latlong() || to.is_geocent() {
            return Err(refused("which is not projected".into()));
        }
        if to.to_meter() != 1.0 {
            return Err(refused("which is not in metres".into()));
        }
        if !to.is_normalized_axis() {
            return Err(refused("whose axes are not east and north".into()));
        }
        let from = Proj::from_proj_string(WGS_84).map_err(unusable)?;
        Ok(Self { srid, from, to })
    }

    /// Into the frame that was asked for, or the zone of UTM around a longitude and latitude.
    pub(crate) fn to_srid_or_zone(srid: Option<i32>, centre: [f64; 2]) -> Result<Self, Problem> {
        match srid.or_else(|| utm::zone(centre)) {
            Some(srid) => Self::to_srid(srid),
            None => Err(Problem::Invalid {
                what: "centre of the data".into(),
                found: format!("{} {}", centre[0], centre[1]),
                expected: "a longitude and a latitude where utm has zones, or a srid",
            }),
        }
    }

    /// The EPSG code of the projected frame.
    pub(crate) fn srid(&self) -> i32 {
        self.srid
    }

    /// East and north of a longitude and latitude in degrees; none where the projection ends.
    pub(crate) fn project(&self, [longitude, latitude]: [f64; 2]) -> Option<[f64; 2]> {
        if !is_geographic([longitude, latitude]) {
            return None;
        }
        let mut position = Position([longitude.to_radians(), latitude.to_radians()]);
        transform(&self.from, &self.to, &mut position).ok()?;
        let usable = |value: f64| value.abs() <= MAX_COORDINATE;
        let Position([x, y]) = position;
        (usable(x) && usable(y)).then_some([x + 0.0, y + 0.0])
    }
}

/// Whether two numbers can be a longitude and a latitude in degrees.
pub(crate) fn is_geographic([longitude, latitude]: [f64; 2]) -> bool {
    longitude.abs() <= 180.0 && latitude.abs() <= 90.0
}

/// A position at ellipsoidal height zero: maps of plan positions ignore heights.
struct Position([f64; 2]);

impl Transform for Position {
    fn transform_coordinates<F: TransformClosure>(
        &mut self,
        f: &mut F,
    ) -> proj4rs::errors::Result<()> {
        let (x, y, _) = f(self.0[0], self.0[1], 0.0)?;
        self.0 = [x, y];
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(srid: i32, from: [f64; 2], expected: [f64; 2], within: f64) {
        let found = Projection::to_srid(srid).unwrap().project(from).unwrap();
        let off = (found[0] - expected[0]).hypot(found[1] - expected[1]);
        assert!(
            off <= within,
            "{srid}: {found:?} is {off} m off {expected:?}"
        );
    }

    fn refusal(srid: i32) -> String {
        Projection::to_srid(srid).err().unwrap().to_string()
    }

    #[test]
    fn srids_that_are_no_metres_on_a_plane_are_refused() {
        assert_eq!(
            refusal(4326),
            "srid 4326, which is not projected, is not supported"
        );
        assert_eq!(
            refusal(4978),
            "srid 4978, which is not projected, is not supported"
        );
        assert_eq!(
            refusal(2263),
            "srid 2263, which is not in metres, is not supported"
        );
        for unknown in [-1, 0, 31, 65_535, 70_000, i32::MAX] {
            let expected = format!("srid {unknown}, which is not known, is not supported");
            assert_eq!(refusal(unknown), expected);
        }
    }

    /// The origin of UTM zone 35 and points on its central meridian, where the length of the
    /// meridian arc is known in closed form: the quarter meridian of WGS 84 is 10,001,965.7293 m.
    #[test]
    fn utm_agrees_with_the_meridian_arc() {
        assert_near(32635, [27.0, 0.0], [500_000.0, 0.0], 1e-6);
        let pole = 10_001_965.729_3 * 0.9996;
        assert_near(32635, [27.0, 89.999_999_999], [500_000.0, pole], 1e-3);
        assert_near(32735, [27.0, 0.0], [500_000.0, 10_000_000.0], 1e-6);
    }

    /// Values of Krüger's series of sixth order, computed apart from the library.
    #[test]
    fn utm_agrees_with_the_series_off_the_meridian() {
        for (from, expected) in [
            ([24.9384, 60.1699], [385_611.316_69, 6_672_118.380_33]),
            ([24.0, 60.0], [332_705.178_88, 6_655_205.483_63]),
            ([30.0, 45.0], [736_446.026_10, 4_987_329.504_70]),
        ] {
            assert_near(32635, from, expected, 1e-4);
        }
    }

    /// Points that the Dutch cadastre publishes to validate transformations. The seven parameters
    /// of the definition, without a grid of corrections, are within 0.25 m of them.
    #[test]
    fn the_dutch_grid_agrees_with_published_points() {
        for (from, expected) in [
            ([5.387_203_657, 52.155_172_897], [155_000.0, 463_000.0]),
            ([4.824_761_912, 53.160_753_042], [117_380.12, 575_040.34]),
            ([6.776_726_674, 53.419_482_050], [247_380.56, 604_580.78]),
            ([3.397_588_595, 51.368_607_152], [16_460.91, 377_380.23]),
            ([5.773_795_548, 50.792_584_916], [182_260.45, 311_480.67]),
        ] {
            assert_near(28992, from, expected, 0.25);
            assert_near(7415, from, expected, 0.25);
        }
    }

    #[test]
    fn what_lies_outside_has_no_position() {
        let projection = Projection::to_srid_or_zone(None, [24.94, 60.17]).unwrap();
        assert_eq!(projection.srid(), 32635);
        for outside in [[181.0, 0.0], [0.0, 90.1], [f64::NAN, 0.0], [1e308, 1e308]] {
            assert_eq!(projection.project(outside), None);
        }
        assert!(Projection::to_srid_or_zone(None, [0.0, 89.0]).is_err());
    }
}
