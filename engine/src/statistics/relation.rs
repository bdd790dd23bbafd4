//! [`Relation`], how a box of a column stands to a query.

/// What an operator asks of a box and a query, the box first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// They share a point.
    Overlaps,
    /// The box holds the query.
    Contains,
    /// The query holds the box.
    ContainedBy,
}

impl Relation {
    /// What is asked of the query and the box, the other way round.
    #[must_use]
    pub fn commuted(self) -> Self {
        match self {
            Self::Overlaps => Self::Overlaps,
            Self::Contains => Self::ContainedBy,
            Self::ContainedBy => Self::Contains,
        }
    }
}
