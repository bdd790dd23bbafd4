//! [`Fault`], something that is wrong with a scene.

use std::fmt::{self, Display, Formatter};

/// Something that is wrong with a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// What is stored is not what it is claimed to be.
    Stored(String),
    /// A feature that can be seen is missing from an answer.
    FalseOcclusion {
        /// The feature, for people.
        feature: String,
        /// Where it can be seen from.
        eye: [f64; 3],
        /// A point of it that can be seen, or one in that direction.
        target: [f64; 3],
        /// How it was found.
        how: &'static str,
    },
}

impl Fault {
    /// The observer who shows it.
    pub fn eye(&self) -> Option<[f64; 3]> {
        match self {
            Self::Stored(_) => None,
            Self::FalseOcclusion { eye, .. } => Some(*eye),
        }
    }

    /// Whether it is a false occlusion.
    pub fn is_false_occlusion(&self) -> bool {
        matches!(self, Self::FalseOcclusion { .. })
    }
}

impl Display for Fault {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stored(what) => f.write_str(what),
            Self::FalseOcclusion {
                feature,
                eye: [x, y, z],
                how,
                ..
            } => {
                write!(
                    f,
                    "false occlusion: {feature} is visible from ({x}, {y}, {z}), by {how}"
                )
            }
        }
    }
}
