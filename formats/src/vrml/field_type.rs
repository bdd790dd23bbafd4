//! [`FieldType`], the types of values that fields have.

/// A type of field, named as in ISO/IEC 14772-1, clause 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FieldType {
    SFBool,
    SFColor,
    SFFloat,
    SFImage,
    SFInt32,
    SFNode,
    SFRotation,
    SFString,
    SFTime,
    SFVec2f,
    SFVec3f,
    MFColor,
    MFFloat,
    MFInt32,
    MFNode,
    MFRotation,
    MFString,
    MFTime,
    MFVec2f,
    MFVec3f,
}

/// What one value of a field is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Element {
    Bool,
    Integer,
    /// So many numbers.
    Floats(usize),
    /// Width, height, number of components, then the pixels.
    Image,
    Text,
    Node,
}

const TYPES: [(&str, FieldType); 20] = [
    ("SFBool", FieldType::SFBool),
    ("SFColor", FieldType::SFColor),
    ("SFFloat", FieldType::SFFloat),
    ("SFImage", FieldType::SFImage),
    ("SFInt32", FieldType::SFInt32),
    ("SFNode", FieldType::SFNode),
    ("SFRotation", FieldType::SFRotation),
    ("SFString", FieldType::SFString),
    ("SFTime", FieldType::SFTime),
    ("SFVec2f", FieldType::SFVec2f),
    ("SFVec3f", FieldType::SFVec3f),
    ("MFColor", FieldType::MFColor),
    ("MFFloat", FieldType::MFFloat),
    ("MFInt32", FieldType::MFInt32),
    ("MFNode", FieldType::MFNode),
    ("MFRotation", FieldType::MFRotation),
    ("MFString", FieldType::MFString),
    ("MFTime", FieldType::MFTime),
    ("MFVec2f", FieldType::MFVec2f),
    ("MFVec3f", FieldType::MFVec3f),
];

impl FieldType {
    /// The type of this name.
    pub(super) fn named(name: &str) -> Option<Self> {
        let entry = TYPES.iter().find(|(known, _)| *known == name);
        entry.map(|(_, field_type)| *field_type)
    }

    /// Whether it holds any number of values, in brackets unless it is just one.
    pub(super) fn is_multiple(self) -> bool {
        matches!(
            self,
            Self::MFColor
                | Self::MFFloat
                | Self::MFInt32
                | Self::MFNode
                | Self::MFRotation
                | Self::MFString
                | Self::MFTime
                | Self::MFVec2f
                | Self::MFVec3f
        )
    }

    /// What one value is made of.
    pub(super) fn element(self) -> Element {
        match self {
            Self::SFBool => Element::Bool,
            Self::SFInt32 | Self::MFInt32 => Element::Integer,
            Self::SFFloat | Self::MFFloat | Self::SFTime | Self::MFTime => Element::Floats(1),
            Self::SFVec2f | Self::MFVec2f => Element::Floats(2),
            Self::SFVec3f | Self::MFVec3f | Self::SFColor | Self::MFColor => Element::Floats(3),
            Self::SFRotation | Self::MFRotation => Element::Floats(4),
            Self::SFImage => Element::Image,
            Self::SFString | Self::MFString => Element::Text,
            Self::SFNode | Self::MFNode => Element::Node,
        }
    }
}
