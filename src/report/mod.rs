//! Floor 7: reports. From what an experiment found to `reports/NAME/`: words first, then tables,
//! plots, pictures and tidy files. Nothing here renders a scene.
//!
//! | file | holds | the same bytes in every run |
//! |---|---|---|
//! | `report.md`, `report.html` | the answer, tables, figures, method cards | yes |
//! | `metrics.csv`, `metrics.json` | one row a trial and metric | yes |
//! | `plots/*.png`, `images/*.png` | what the reports show | yes |
//! | `costs.csv`, `costs.md` | times and memory | no |

mod answer;
mod contest;
mod costs;
mod equivalent;
mod files;
mod page;
mod phrase;
mod tables;
mod tidy;
mod words;

#[cfg(test)]
mod fixture;

use std::path::{Path, PathBuf};

pub use equivalent::{Equivalent, equivalent_samples};
pub use files::ReportError;

use crate::experiment::results::{Costs, Results};

/// Writes the whole report into the folder `out`, made if missing, and names the files written.
///
/// Each file appears whole or not at all. The same results give the same bytes in every file but
/// those of the costs.
///
/// # Errors
/// [`ReportError`] naming the file that could not be written.
pub fn write(results: &Results, costs: &Costs, out: &Path) -> Result<Vec<PathBuf>, ReportError> {
    let mut folder = files::Folder::create(out)?;
    folder.put("metrics.csv", &tidy::csv(results))?;
    folder.put("metrics.json", &tidy::json(results))?;
    folder.put("costs.csv", &costs::csv(costs))?;
    folder.put("costs.md", costs::markdown(results, costs).as_bytes())?;
    let page = page::Page::of(results);
    folder.put("report.md", page::markdown(&page).as_bytes())?;
    Ok(folder.written())
}
