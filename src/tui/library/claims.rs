//! What was found about a paper, row by row.

use std::path::{Path, PathBuf};

use super::images::{exr_files, files};
use super::rows::table;
use crate::evidence::{self, Verdict};

/// A claim of a paper beside what was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// What is stated.
    pub what: String,
    /// What the paper has.
    pub paper: String,
    /// What was measured; may be empty.
    pub here: String,
    /// Whether it holds.
    pub verdict: Verdict,
    /// How the verdict was reached, or why there is none.
    pub rule: String,
    /// Why it differs, as far as that is known.
    pub because: String,
}

/// A row of a paper: a figure, table or number of it.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperRow {
    /// Its name, such as `blinn-f7`.
    pub name: String,
    /// What it shows; empty of a row that this program does not know.
    pub title: String,
    /// What the paper claims there.
    pub claims: Vec<Claim>,
    /// Its plots: PNG files with what stands after the row's name in theirs.
    pub plots: Vec<(String, PathBuf)>,
    /// Its images: EXR files with the names of their panels.
    pub images: Vec<(String, PathBuf)>,
}

impl PaperRow {
    /// Differs if any of its claims does; reproduced if one is and none differs.
    pub fn verdict(&self) -> Verdict {
        let all = self.claims.iter().map(|claim| claim.verdict);
        all.max().unwrap_or(Verdict::NotApplicable)
    }
}

/// The verdicts in words, as files have them.
fn verdict(text: &str) -> Option<Verdict> {
    let all = [Verdict::Reproduced, Verdict::Differs, Verdict::NotApplicable];
    all.into_iter().find(|verdict| verdict.text() == text)
}

/// The rows of `evidence.csv` in its order, with their pictures. Rows that claim nothing but have pictures come
/// where the program has them, else last.
pub(super) fn rows(folder: &Path, problems: &mut Vec<String>) -> Vec<PaperRow> {
    const COLUMNS: [&str; 7] = ["row", "claim", "paper", "here", "verdict", "rule", "because"];
    let mut found: Vec<PaperRow> = Vec::new();
    for cells in table(folder, "evidence.csv", &COLUMNS, problems) {
        let Ok([row, what, paper, here, word, rule, because]) = <[String; 7]>::try_from(cells)
        else {
            continue;
        };
        let Some(verdict) = verdict(&word) else {
            problems.push(format!("evidence.csv has a verdict `{word}` for {row}: left out"));
            continue;
        };
        let claim = Claim { what, paper, here, verdict, rule, because };
        entry(&mut found, &row).claims.push(claim);
    }
    let known: Vec<_> = evidence::papers().iter().flat_map(|paper| paper.rows).collect();
    let pictured: Vec<_> = files(&folder.join("plots"), "png");
    // Rows of whatever paper this is that only have pictures.
    for row in &known {
        if pictured.iter().any(|(name, _)| after(name, row.name).is_some()) {
            entry(&mut found, row.name);
        }
    }
    let place = |row: &PaperRow| known.iter().position(|of| of.name == row.name);
    if found.iter().all(|row| place(row).is_some()) {
        found.sort_by_key(place);
    }
    let names: Vec<String> = found.iter().map(|row| row.name.clone()).collect();
    for row in &mut found {
        row.title = known.iter().find(|of| of.name == row.name).map_or("", |of| of.title).into();
        // A row's name may begin another's: the longest that fits has the file.
        let mine = |name: &str| {
            let of = names.iter().filter(|row| after(name, row).is_some());
            of.max_by_key(|row| row.len()).filter(|longest| **longest == row.name)?;
            after(name, &row.name).map(str::to_owned)
        };
        let plots = pictured.iter();
        row.plots = plots.filter_map(|(name, path)| Some((mine(name)?, path.clone()))).collect();
        row.images = exr_files(&folder.join("images").join(&row.name));
    }
    found
}

fn entry<'a>(rows: &'a mut Vec<PaperRow>, name: &str) -> &'a mut PaperRow {
    let place = rows.iter().position(|row| row.name == name).unwrap_or_else(|| {
        rows.push(PaperRow {
            name: name.to_owned(),
            title: String::new(),
            claims: Vec::new(),
            plots: Vec::new(),
            images: Vec::new(),
        });
        rows.len() - 1
    });
    &mut rows[place]
}

/// What follows `row-` in a file's name.
fn after<'a>(name: &'a str, row: &str) -> Option<&'a str> {
    name.strip_prefix(row)?.strip_prefix('-')
}
