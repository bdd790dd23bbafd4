//! What can go wrong between a scene and its picture.

/// Why nothing was drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The machine has neither a GPU with a driver nor a software renderer.
    #[error(
        "no graphics adapter was found (hint: without a GPU, install Mesa's software renderer: \
         apt-get install mesa-vulkan-drivers libvulkan1)"
    )]
    NoAdapter,
    /// Adapters are there, but none of them could be opened.
    #[error("no graphics adapter could be opened: {0}")]
    Device(String),
    /// The driver reported an error while it drew: too little memory, a lost device.
    #[error("the graphics adapter failed: {0}")]
    Gpu(String),
    /// The side of a picture or of a face is 0 or more than the adapter can draw.
    #[error("resolution {asked} is outside the adapter's range of 1 to {limit} pixels")]
    Resolution {
        /// Pixels asked for.
        asked: u32,
        /// The most that the adapter draws.
        limit: u32,
    },
    /// The mesh contradicts itself.
    #[error("invalid mesh: {0}")]
    Mesh(String),
    /// A coordinate of the eye is NaN, infinite or absurdly large.
    #[error("the eye ({}, {}, {}) is no place to look from", .0[0], .0[1], .0[2])]
    Eye([f64; 3]),
    /// A view without a direction, a size or an opening angle, or with one that is not finite.
    #[error("invalid view: {0}")]
    View(String),
    /// The picture could not be encoded.
    #[error("the picture could not be encoded: {0}")]
    Png(#[from] png::EncodingError),
    /// The picture could not be written.
    #[error("the picture could not be written to \"{path}\": {source}")]
    Write {
        /// Where it was to go.
        path: std::path::PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
}

/// Shorthand for this crate's results.
pub(crate) type Result<T> = std::result::Result<T, Error>;
