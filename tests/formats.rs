//! Old results stay readable: a folder for each version of the format, read as the terminal runner reads reports.

use std::fs;
use std::path::{Path, PathBuf};

use wrinkle::report::FORMAT;
use wrinkle::tui::library::{Kind, Opened, open};

/// Version 1 did not say its number; its files are cut down from reports that were written then.
fn folder(version: u32, report: &str) -> PathBuf {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/formats");
    data.join(format!("v{version}")).join(report)
}

/// A report of every version there is.
fn every(report: &str) -> impl Iterator<Item = (u32, Opened)> {
    (1..=FORMAT).map(move |version| (version, open(&folder(version, report))))
}

/// What is wrong with a report but for the images, which were cut away.
fn problems(opened: &Opened) -> Vec<&String> {
    opened.problems.iter().filter(|problem| !problem.contains("images are missing")).collect()
}

fn count(opened: &Opened, metric: &str) -> usize {
    opened.rows.iter().filter(|row| row.metric == metric).count()
}

#[test]
fn sweeps_of_every_version_are_read() {
    for (version, sweep) in every("sweep") {
        assert!(problems(&sweep).is_empty(), "version {version}: {:?}", sweep.problems);
        assert_eq!(
            (sweep.kind, sweep.title.as_str()),
            (Kind::Sweep, "A quick look at every filter")
        );
        let labels: Vec<_> = sweep.methods.iter().map(|(label, _)| label.as_str()).collect();
        assert_eq!(labels, ["unfiltered", "averaged"]);
        assert_eq!(sweep.scenes.len(), 1);
        assert!(count(&sweep, "rmse") > 2 && count(&sweep, "ns_per_pixel") > 1);
        let reference = sweep.rows.iter().find(|row| row.method == "reference").unwrap();
        assert_eq!(
            (reference.metric.as_str(), reference.value),
            ("rmse", 0.009_365_863_735_037_451)
        );
    }
}

#[test]
fn figures_of_flicker_of_every_version_are_read() {
    for (version, moving) in every("moving") {
        assert!(problems(&moving).is_empty(), "version {version}: {:?}", moving.problems);
        assert_eq!(moving.scenes.len(), 3);
        assert_eq!(count(&moving, "error_flicker"), 2, "version {version}");
    }
}

#[test]
fn papers_of_every_version_are_read() {
    for (version, paper) in every("paper") {
        assert!(problems(&paper).is_empty(), "version {version}: {:?}", paper.problems);
        assert_eq!(paper.kind, Kind::Paper);
        let claims: Vec<_> = paper.paper.iter().map(|row| row.claims.len()).collect();
        assert_eq!(claims, [7, 10]);
    }
}

#[test]
fn newer_versions_are_named() {
    for (report, file) in [("sweep", "metrics.json"), ("paper", "evidence.json")] {
        let newer = tempfile::tempdir().unwrap();
        for entry in fs::read_dir(folder(FORMAT, report)).unwrap() {
            let path = entry.unwrap().path();
            fs::copy(&path, newer.path().join(path.file_name().unwrap())).unwrap();
        }
        let path = newer.path().join(file);
        let text = fs::read_to_string(&path).unwrap();
        let (now, next) = (format!("\"format\": {FORMAT}"), format!("\"format\": {}", FORMAT + 1));
        assert!(text.contains(&now), "the newest files say their version");
        fs::write(&path, text.replacen(&now, &next, 1)).unwrap();
        let opened = open(newer.path());
        let told = format!(
            "{file}: it was written by a newer wrinkle, format {}; this one reads up to {FORMAT}",
            FORMAT + 1
        );
        assert!(opened.problems.contains(&told), "{:?}", opened.problems);
    }
}
