//! Which zone of UTM a place is in.

/// The EPSG code of the zone of WGS 84 / UTM around a longitude and latitude in degrees, with the
/// wider zones of Norway and Svalbard; none near the poles, where UTM ends.
pub(super) fn zone([longitude, latitude]: [f64; 2]) -> Option<i32> {
    if !(-180.0..=180.0).contains(&longitude) || !(-80.0..=84.0).contains(&latitude) {
        return None;
    }
    let regular = (((longitude + 180.0) / 6.0) as i32 + 1).min(60);
    let number = match (latitude, longitude) {
        (56.0..64.0, 3.0..12.0) => 32,
        (72.0.., 0.0..9.0) => 31,
        (72.0.., 9.0..21.0) => 33,
        (72.0.., 21.0..33.0) => 35,
        (72.0.., 33.0..42.0) => 37,
        _ => regular,
    };
    Some(if latitude < 0.0 { 32700 } else { 32600 } + number)
}

#[cfg(test)]
mod tests {
    use super::zone;

    #[test]
    fn zones_are_six_degrees_wide_but_in_the_far_north() {
        assert_eq!(zone([24.94, 60.17]), Some(32635));
        assert_eq!(zone([-180.0, 0.0]), Some(32601));
        assert_eq!(zone([180.0, -1.0]), Some(32760));
        assert_eq!(zone([5.3, 60.4]), Some(32632));
        assert_eq!(zone([10.0, 78.0]), Some(32633));
        assert_eq!(zone([0.0, 84.5]), None);
        assert_eq!(zone([f64::NAN, 0.0]), None);
    }
}
