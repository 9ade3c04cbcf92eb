//! Floor 7: reports. From what an experiment found to `reports/NAME/`: words first, then tables,
//! plots, pictures and tidy files. Nothing here renders a scene.
//!
//! | file | holds | the same bytes in every run |
//! |---|---|---|
//! | `report.md`, `report.html` | the answer, tables, figures, method cards | yes |
//! | `metrics.csv`, `metrics.json` | one row a trial and metric | yes |
//! | `budget.csv` | where errors are shared out: one row a scene, method and part | yes |
//! | `flicker.csv` | of things that move: one row a method and figure of flicker | yes |
//! | `plots/*.png`, `images/*.png` | what the reports show | yes |
//! | `animations/*.png`, `frames/*.png` | of things that move: animated PNG files, and one file a frame | yes |
//! | `costs.csv`, `costs.md`, `costs.html`, `costs.png` | times and memory | no |
//!
//! [`write_evidence`] does the same for what was found about a paper; [`write_index`] writes one page over all
//! reports of a folder.

mod answer;
pub(crate) mod axis;
mod bar;
mod budget;
mod canvas;
mod caveats;
mod chart;
mod choice;
pub(crate) mod colour;
mod contest;
mod costs;
mod curves;
mod disc;
mod equal_cost;
mod evidence;
mod figure;
mod figures;
mod files;
mod fit_plot;
mod font;
mod format;
mod grid;
mod index;
mod lobe_sheet;
mod mark;
mod motion;
mod page;
mod pareto;
pub(crate) mod phrase;
mod png;
mod polar;
mod program;
mod ranking;
mod scale;
mod sheet;
mod source;
mod split;
mod tables;
mod template;
mod tidy;
mod tone;
mod viewer;
mod words;

#[cfg(test)]
mod fixture;

use std::path::{Path, PathBuf};

pub use colour::{magnitude, perceived, signed};
pub use disc::cell_of_normal;
pub use evidence::write_evidence;
pub use files::ReportError;
pub use fit_plot::fit_plot;
pub use format::{FORMAT, Newer, check_format};
pub use index::write_index;
pub use lobe_sheet::lobe_sheet;

use crate::experiment::results::{Costs, Results};
use crate::render::Film;

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
    if !results.sequences.is_empty() {
        folder.put("flicker.csv", &motion::csv::csv(results))?;
    }
    if results.scenes.iter().any(|scene| !scene.budgets.is_empty()) {
        folder.put("budget.csv", &budget::csv::csv(results))?;
    }
    folder.put("costs.csv", &costs::csv(costs))?;
    let cost_page = costs::CostPage::of(results, costs);
    folder.put("costs.md", costs::markdown(&cost_page).as_bytes())?;
    folder.put("costs.html", costs::html(&cost_page).as_bytes())?;
    if let Some(plot) = &cost_page.plot {
        folder.put(&plot.file, &plot.png)?;
    }
    if !results.sequences.is_empty() {
        let page = motion::page::Page::of(results);
        for (name, bytes) in page.files() {
            folder.put(&name, bytes)?;
        }
        folder.put("report.md", motion::page::markdown(&page).as_bytes())?;
        folder.put("report.html", motion::page::html(&page).as_bytes())?;
        return Ok(folder.written());
    }
    let figures = figures::Figures::of(results, costs);
    for (name, png) in figures.files() {
        folder.put(name, png)?;
    }
    let page = page::Page::of(results, costs, &figures);
    folder.put("report.md", page::markdown(&page).as_bytes())?;
    folder.put("report.html", page::html(&page).as_bytes())?;
    Ok(folder.written())
}

/// The answer in words, a short paragraph each: what a report opens with.
pub fn lead(results: &Results) -> Vec<String> {
    if results.sequences.is_empty() {
        answer::answer(&contest::Comparison::of(results))
    } else {
        motion::page::lead(results)
    }
}

/// Films of one size as an animated PNG file of 8-bit grey that plays for ever, with the radiance `white` shown as white.
/// At least one film.
pub fn animated(films: &[&Film], white: f64, fps: u32) -> Vec<u8> {
    motion::animation::Codes::of(films, white).animated(fps)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_results_give_the_same_bytes() {
        same_bytes(&fixture::results());
        same_bytes(&fixture::moving());
    }

    fn same_bytes(results: &Results) {
        let costs = fixture::costs();
        let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
        let [one, two] = folders.each_ref().map(|f| write(results, &costs, f.path()).unwrap());
        assert_eq!(one.len(), two.len());
        for (a, b) in one.iter().zip(&two) {
            assert_eq!(a.file_name(), b.file_name());
            assert!(std::fs::read(a).unwrap() == std::fs::read(b).unwrap(), "{}", a.display());
        }
    }

    #[test]
    fn times_stay_out_of_everything_but_the_costs() {
        let results = fixture::results();
        let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
        let mut slower = fixture::costs();
        slower.total_secs *= 2.0;
        slower.trials.iter_mut().for_each(|t| t.ns_per_pixel *= 3.0);
        slower.prefilters.iter_mut().for_each(|p| p.secs *= 5.0);
        let costs = [fixture::costs(), slower];
        let written = [0, 1].map(|i| write(&results, &costs[i], folders[i].path()).unwrap());
        let differ = written[0].iter().zip(&written[1]);
        let differ = differ.filter(|(a, b)| std::fs::read(a).unwrap() != std::fs::read(b).unwrap());
        let names: Vec<_> = differ.map(|(a, _)| a.file_name().unwrap().to_owned()).collect();
        assert_eq!(names, ["costs.csv", "costs.md", "costs.html", "costs.png"]);
    }
}
