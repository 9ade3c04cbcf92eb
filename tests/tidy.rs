//! The house in order: files of a size to be read in one sitting, experiments that are told of.

use std::fs;
use std::path::{Path, PathBuf};

/// The files of this ending under a folder of the repository, in order.
fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == ending) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

#[test]
fn a_file_can_be_read_in_one_sitting() {
    for path in files("src", "rs") {
        let lines = fs::read_to_string(&path).unwrap().lines().count();
        assert!(lines <= 500, "{}: {lines} lines; divide it", path.display());
    }
}

#[test]
fn every_experiment_is_told_of() {
    let mut pages = files("docs", "md");
    pages.push(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md"));
    let told: String = pages.iter().map(|page| fs::read_to_string(page).unwrap()).collect();
    for path in files("experiments", "toml") {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        assert!(told.contains(&format!("experiments/{name}`")), "no page tells of {name}");
    }
}
