//! The report on a paper: what each of its rows shows and claims, beside what a run found.

mod costs;
mod data;
mod fields;
mod figures;
mod images;
mod net;
mod page;
mod plot;
mod sketch;

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

use super::ReportError;
use super::files::Folder;
use crate::evidence::Evidence;

/// Writes the report on a paper into the folder `out`, made if missing, and names the files written.
/// `row_secs` are the seconds that each row took.
///
/// Each file appears whole or not at all. The same evidence gives the same bytes in every file but
/// `costs.csv` and `costs.md`, which alone hold what is timed. Links lead to what the run itself writes:
/// `images/ROW/PANEL.exr` for each panel with an image, `PART/report.html` for each part.
///
/// # Errors
/// [`ReportError`] naming the file that could not be written.
pub fn write_evidence(
    evidence: &Evidence,
    row_secs: &[(String, f64)],
    out: &Path,
) -> Result<Vec<PathBuf>, ReportError> {
    let mut folder = Folder::create(out)?;
    folder.put("evidence.json", &data::json(evidence))?;
    folder.put("evidence.csv", &data::csv(evidence))?;
    for (name, csv) in data::tables(evidence) {
        folder.put(&name, &csv)?;
    }
    folder.put("costs.csv", &costs::csv(evidence, row_secs))?;
    folder.put("costs.md", costs::markdown(evidence, row_secs).as_bytes())?;
    let figures = figures::of(evidence);
    for (name, png) in figures.iter().flatten().map(figures::Drawn::file) {
        folder.put(name, png)?;
    }
    let page = page::Page::of(evidence, figures);
    folder.put("report.md", page::markdown(&page).as_bytes())?;
    folder.put("report.html", page::html(&page).as_bytes())?;
    Ok(folder.written())
}

/// The name of a file that holds something of a row: only letters, digits, `-`, `_` and `.`, and not too
/// many of them for a file system.
fn file_name(name: &str) -> String {
    const MOST: usize = 80;
    let plain = |c: char| if c.is_ascii_alphanumeric() || "-_.".contains(c) { c } else { '-' };
    let name: String = name.chars().take(MOST).map(plain).collect();
    // A leading dot would hide the file, or leave the folder.
    if name.starts_with('.') || name.is_empty() { format!("-{name}") } else { name }
}
