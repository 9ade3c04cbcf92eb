//! Finding experiments by name.

use std::path::{Path, PathBuf};

use super::exit::Failure;
use crate::experiment::spec::{Spec, no_such};

/// Where experiments are looked for by name, from the working folder.
pub(super) const FOLDER: &str = "experiments";

/// The spec file that a name or path means.
pub(super) fn locate(name: &str) -> Result<PathBuf, Failure> {
    let path = Path::new(name);
    if path.extension().is_some_and(|e| e == "toml") || name.contains(std::path::MAIN_SEPARATOR) {
        return if path.is_file() {
            Ok(path.to_owned())
        } else {
            Err(Failure::wrong(format!("there is no experiment file {}", path.display())))
        };
    }
    let file = Path::new(FOLDER).join(format!("{name}.toml"));
    if file.is_file() {
        return Ok(file);
    }
    let known = names();
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    Err(Failure::wrong(if known.is_empty() {
        format!("there is no experiment `{name}`: no folder {FOLDER}/ with experiments is here")
    } else {
        no_such("experiment", name, &known)
    }))
}

/// Names of the experiments in the working folder, in alphabetical order.
pub(super) fn names() -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(FOLDER) else { return Vec::new() };
    let mut names: Vec<String> = entries
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()))
        .collect();
    names.sort();
    names
}

/// Loads an experiment by name or path.
pub(super) fn load(name: &str) -> Result<Spec, Failure> {
    Spec::load(&locate(name)?).map_err(Failure::wrong)
}
