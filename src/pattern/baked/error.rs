//! What can go wrong with baking.

use std::path::{Path, PathBuf};

use super::MOST_TEXELS;
use crate::lobe::{NdfError, SurfaceFileError};
use crate::texture::image_file::ImageError;

/// Why nothing was baked. Every message names the file or the word and says what to do.
#[derive(Debug, thiserror::Error)]
pub enum BakeError {
    /// An image file was not read.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// A file holds no multiple surface.
    #[error(transparent)]
    Surface(#[from] SurfaceFileError),
    /// What was read is no distribution.
    #[error("{of}: {error}")]
    Ndf {
        /// The file, or what else it was made of.
        of: String,
        /// Why.
        error: NdfError,
    },
    /// The map would be too large.
    #[error("{width}x{height} texels are more than the {MOST_TEXELS} that maps may have")]
    TooMany {
        /// Texels along u.
        width: usize,
        /// Texels along v.
        height: usize,
    },
    /// The map would have fewer texels than the one it is laid onto.
    #[error(
        "{}: it has {}x{} texels, and {}x{} would pass some of them over: ask for at least its own size, or scale it down \
         first", path.display(), own[0], own[1], asked[0], asked[1]
    )]
    Smaller {
        /// The file.
        path: PathBuf,
        /// Its texels along u and v.
        own: [usize; 2],
        /// Those asked for.
        asked: [usize; 2],
    },
}

impl BakeError {
    /// What was read is no distribution.
    pub(super) fn ndf(of: impl Into<String>, error: NdfError) -> Self {
        Self::Ndf { of: of.into(), error }
    }

    /// The same of a file.
    pub(super) fn of_file(path: &Path, error: NdfError) -> Self {
        Self::ndf(path.display().to_string(), error)
    }
}
