//! Finding experiments by name.

use std::path::{Path, PathBuf};

use super::exit::Failure;
use crate::experiment::spec::Spec;

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
    let hint = known
        .iter()
        .map(|known| (strsim::jaro_winkler(known, name), known))
        .filter(|(nearness, _)| *nearness > 0.7)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map_or(String::new(), |(_, near)| format!("; did you mean `{near}`?"));
    let there_are = match known.as_slice() {
        [] => format!("there is no folder {FOLDER}/ with experiments here"),
        known => format!("experiments here: {}", known.join(", ")),
    };
    Err(Failure::wrong(format!("there is no experiment `{name}`{hint} ({there_are})")))
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
