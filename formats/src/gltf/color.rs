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
    settled(if linear <= 0.0031308 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    })
}

/// A component to twelve decimals, so that a short decimal fraction that was converted comes back
/// as it was.
pub(super) fn settled(component: f64) -> f64 {
    (component * 1e12).round() / 1e12
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_both_ways() {
        for byte in 0..=255 {
            let component = f64::from(byte) / 255.0;
            let back = encoded(linear(component));
            assert!((back - component).abs() < 1e-6, "{byte}");
        }
        for percent in 0..=100 {
            let component = f64::from(percent) / 100.0;
            assert_eq!(encoded(linear(component)), component);
        }
        assert_eq!((linear(0.0), linear(1.0)), (0.0, 1.0));
        assert!((linear(0.5) - 0.214_041).abs() < 1e-6);
    }
}
