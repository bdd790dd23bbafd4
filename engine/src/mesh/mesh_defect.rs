//! [`MeshDefect`], why a mesh hides nothing.

use thiserror::Error;

/// Why a mesh has no inner envelope, worded for the import report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Error)]
pub enum MeshDefect {
    /// There is not a single triangle.
    #[error("no faces")]
    NoFaces,
    /// A coordinate is NaN or infinite.
    #[error("not finite: a coordinate is NaN or infinite")]
    NotFinite,
    /// Some faces have no faithful triangulation, so the surface is not known.
    #[error("{faces} untriangulable face(s)")]
    UntriangulableFaces {
        /// How many.
        faces: usize,
    },
    /// Directed edges are left without an opposite: the surface bounds no solid.
    #[error("open: {edges} unpaired edge(s)")]
    Open {
        /// How many directed edges lack an opposite.
        edges: usize,
    },
    /// The surface is closed but its normals point inward.
    #[error("inside out")]
    InsideOut,
    /// The surface is closed and holds nothing.
    #[error("zero volume")]
    ZeroVolume,
    /// The solid is there, but no box was found in it: it is too thin for the finest search grid.
    #[error("too thin for an inner box")]
    TooThin,
    /// Seen from above, the surface has more corners, crossings or layers than are looked through.
    #[error("too intricate: more than {limit} corners or layers in plan")]
    TooIntricate {
        /// How many are looked through.
        limit: usize,
    },
}
