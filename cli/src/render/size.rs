//! [`Size`], the size of a picture.

use std::str::FromStr;

/// Pixels across and down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Across.
    pub width: u32,
    /// Down.
    pub height: u32,
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('x').and_then(|(width, height)| {
            let side = |text: &str| text.parse().ok().filter(|&pixels: &u32| pixels > 0);
            Some((side(width)?, side(height)?))
        });
        let (width, height) =
            numbers.ok_or("expected pixels across and down, such as 1600x1000")?;
        Ok(Self { width, height })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_two_sides() {
        assert_eq!(
            "640x480".parse(),
            Ok(Size {
                width: 640,
                height: 480
            })
        );
        for wrong in ["", "640", "x", "0x480", "640x-1", "640x480x2"] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }
}
