//! [`Memory`], how much an import may use.

use std::str::FromStr;

/// Bytes of memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Memory(u64);

/// A batch as read takes about this part of the memory that its meshes, columns and packed models
/// take with it.
const BATCHES: u64 = 8;

impl Memory {
    /// How large a batch of features may be.
    pub fn batch_bytes(self) -> usize {
        usize::try_from(self.0 / BATCHES).unwrap_or(usize::MAX)
    }
}

impl FromStr for Memory {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
        let unit = match text[digits.len()..].to_ascii_lowercase().as_str() {
            "" | "b" => 1,
            "kb" | "k" => 1 << 10,
            "mb" | "m" => 1 << 20,
            "gb" | "g" => 1 << 30,
            _ => return Err("its unit is none of kB, MB and GB".to_owned()),
        };
        let number: u64 = digits.parse().map_err(|_| "it is no whole number")?;
        let bytes = number.checked_mul(unit).filter(|&bytes| bytes >= 1 << 20);
        bytes
            .map(Self)
            .ok_or_else(|| "it is not between 1 MB and 16 EB".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_units() {
        assert_eq!("500MB".parse(), Ok(Memory(500 << 20)));
        assert_eq!("2g".parse(), Ok(Memory(2 << 30)));
        assert_eq!("1048576".parse(), Ok(Memory(1 << 20)));
        assert_eq!(Memory(8 << 20).batch_bytes(), 1 << 20);
        for wrong in [
            "",
            "GB",
            "1.5GB",
            "12TB",
            "1kB",
            "99999999999999999999GB",
            "-1GB",
        ] {
            assert!(wrong.parse::<Memory>().is_err(), "{wrong}");
        }
    }
}
