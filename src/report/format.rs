//! The version of the files that other programs read.

/// The version of `metrics.json` and `evidence.json`, which they say as `format`, and of the tables beside them. It
/// grows when something that a reader may rely on changes or goes; what is only added does not change it. Version 1
/// did not say it.
pub const FORMAT: u32 = 2;

/// A file of a version that this program does not know.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("it was written by a newer wrinkle, format {0}; this one reads up to {FORMAT}")]
pub struct Newer(pub u32);

/// Whether a file of this version can be read.
///
/// # Errors
/// [`Newer`], if it cannot.
pub fn check_format(format: u32) -> Result<(), Newer> {
    if format > FORMAT { Err(Newer(format)) } else { Ok(()) }
}
