//! What a finished run tells on standard output.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value as Json, json};

use crate::evidence::{Evidence, Verdict};
use crate::experiment::results::Results;
use crate::job::{Done, Found};
use crate::report;

/// A finished experiment in a few lines.
pub(super) struct Summary {
    name: String,
    /// What was done, such as `4 trials of 2 scenes`.
    done: String,
    /// What was found.
    answer: Vec<String>,
    folder: PathBuf,
    files: Vec<PathBuf>,
    secs: f64,
    /// What only experiments of its kind have.
    more: Vec<(&'static str, Json)>,
}

impl Summary {
    /// Of a finished job, with its results in `folder`.
    pub fn of(done: Done, folder: &Path) -> Self {
        let Done { found, secs, files } = done;
        match found {
            Found::Sweep(results) => Self::of_sweep(&results, secs, folder, files),
            Found::Paper(evidence) => Self::of_evidence(&evidence, secs, folder, files),
        }
    }

    fn of_sweep(results: &Results, secs: f64, folder: &Path, files: Vec<PathBuf>) -> Self {
        let scenes = results.scenes.len();
        let trials = results.scenes.iter().map(|scene| scene.trials.len()).sum();
        Self {
            name: results.name.clone(),
            done: format!("{} of {}", counted(trials, "trial"), counted(scenes, "scene")),
            answer: report::lead(results),
            folder: folder.to_owned(),
            files,
            secs,
            more: vec![("scenes", json!(scenes)), ("trials", json!(trials))],
        }
    }

    fn of_evidence(evidence: &Evidence, secs: f64, folder: &Path, files: Vec<PathBuf>) -> Self {
        let [reproduced, differ, not_applicable] = evidence.tally();
        let tally = format!(
            "{reproduced} reproduced, {differ} differ, {not_applicable} cannot be held against anything."
        );
        let verdict = |row: &crate::evidence::Exhibit| (row.row.clone(), row.verdict());
        let differing = evidence.exhibits.iter().map(|row| (row, row.verdict()));
        let told =
            differing.filter(|(_, verdict)| *verdict == Verdict::Differs).flat_map(|(row, _)| {
                let claims = row.claims.iter().filter(|claim| claim.verdict == Verdict::Differs);
                claims.map(|claim| format!("{} differs: {}.", row.row, claim.what))
            });
        let rows: serde_json::Map<String, Json> = evidence
            .exhibits
            .iter()
            .map(verdict)
            .map(|(row, verdict)| (row, json!(verdict)))
            .collect();
        Self {
            name: evidence.name.clone(),
            done: counted(evidence.exhibits.len(), "row"),
            answer: std::iter::once(tally).chain(told).collect(),
            folder: folder.to_owned(),
            files,
            secs,
            more: vec![("verdicts", Json::Object(rows))],
        }
    }

    /// Prints it for a reader.
    pub fn print(&self, out: &mut dyn Write) -> std::io::Result<()> {
        let bold = anstyle::Style::new().bold();
        writeln!(out, "{bold}{}{bold:#}: {} in {:.1} s", self.name, self.done, self.secs)?;
        for sentence in &self.answer {
            writeln!(out, "  {sentence}")?;
        }
        let report = self.files.iter().find(|file| file.ends_with("report.html"));
        writeln!(out, "Report: {}", report.unwrap_or(&self.folder).display())
    }

    /// It for a script.
    pub fn json(&self) -> Json {
        let mut all = json!({
            "name": self.name,
            "answer": self.answer,
            "folder": self.folder,
            "files": self.files,
            "seconds": self.secs,
        });
        for (key, value) in &self.more {
            all[*key] = value.clone();
        }
        all
    }
}

/// "1 scene", "2 scenes".
pub(super) fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}
