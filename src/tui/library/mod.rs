//! What is on disk: experiments, and the reports of earlier runs. Plain functions that return data, for a worker
//! thread to call; what is wrong with a file is a sentence beside what could be read, never an error that hides the
//! rest. All text is fit to be drawn: it holds no control characters.

mod claims;
mod images;
mod listed;
mod opened;
mod reports;
mod rows;
mod text;

#[cfg(test)]
mod tests;

pub use claims::{Claim, PaperRow};
pub use images::{ImageFile, SceneImages};
pub use listed::{Kind, Listed, experiments, listed};
pub use opened::{Opened, open, parts};
pub use reports::{Report, reports};
pub use rows::Row;

use std::path::Path;

/// Files larger than this are not read, bytes: no run writes such, and reading would take all memory.
const MOST: u64 = 1 << 28;

/// A file's bytes; `None`, with a sentence among `problems`, if it cannot be had. What is not there is a problem as well.
fn bytes_of(path: &Path, problems: &mut Vec<String>) -> Option<Vec<u8>> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let found = std::fs::metadata(path).and_then(|about| {
        if about.len() > MOST {
            return Err(std::io::Error::other(format!("it has more than {} MB", MOST >> 20)));
        }
        std::fs::read(path)
    });
    match found {
        Ok(bytes) => Some(bytes),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            problems.push(format!("{name} is missing"));
            None
        }
        Err(error) => {
            problems.push(format!("{name} cannot be read: {error}"));
            None
        }
    }
}
