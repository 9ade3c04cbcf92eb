//! Multiple surfaces on the command line: by name, or from a file.

use std::path::Path;

use super::exit::Failure;
use crate::lobe::{MultipleSurface, PhongPeak, find_named, read_peaks};

/// A multiple surface that was asked for.
pub(super) struct Wanted {
    /// Its name, or its file's stem.
    pub label: String,
    /// Its peaks.
    pub peaks: Vec<PhongPeak>,
}

impl Wanted {
    /// The multiple surface.
    pub fn surface(&self) -> MultipleSurface {
        self.peaks.iter().copied().collect()
    }
}

/// What a word means as a multiple surface: the name of one, or a file whose name ends in `.json`; None if
/// it is neither.
pub(super) fn wanted(word: &str) -> Result<Option<Wanted>, Failure> {
    if let Some(named) = find_named(word) {
        return Ok(Some(Wanted { label: word.to_owned(), peaks: named.peaks() }));
    }
    let path = Path::new(word);
    if path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("json")) {
        return Ok(None);
    }
    let peaks = read_peaks(path).map_err(Failure::wrong)?;
    let label = path.file_stem().map_or(String::new(), |s| s.to_string_lossy().into_owned());
    Ok(Some(Wanted { label, peaks }))
}
