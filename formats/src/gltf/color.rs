//! Colours: sRGB in a scene, linear in glTF.

/// A component of sRGB, 0 to 1, made linear (IEC 61966-2-1).
pub(super) fn linear(encoded: f64) -> f64 {
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

/// A linear component, 0 to 1, encoded as sRGB.
pub(super) fn encoded(linear: f64) -> f64 {
    if linear <= 0.0031308 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_both_ways() {
        for byte in 0..=255 {
            let component = f64::from(byte) / 255.0;
            assert!(
                (encoded(linear(component)) - component).abs() < 1e-6,
                "{byte}"
            );
        }
        assert_eq!((linear(0.0), linear(1.0)), (0.0, 1.0));
        assert!((linear(0.5) - 0.214_041).abs() < 1e-6);
    }
}
