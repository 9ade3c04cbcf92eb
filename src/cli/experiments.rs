//! Finding experiments by name.

use std::path::{Path, PathBuf};

use super::exit::Failure;
use crate::evidence;
use crate::experiment::spec::{Experiment, Spec, no_such};

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
pub(super) fn load(name: &str) -> Result<Experiment, Failure> {
    Experiment::load(&locate(name)?, &evidence::keys()).map_err(Failure::wrong)
}

/// Loads a sweep by name or path: of a paper's experiment, a part, as `NAME/PART`.
pub(super) fn load_sweep(name: &str) -> Result<Spec, Failure> {
    let (whole, part) = match name.rsplit_once('/') {
        Some((whole, part)) if locate(name).is_err() => (whole, Some(part)),
        _ => (name, None),
    };
    match load(whole)? {
        Experiment::Sweep(spec) if part.is_none() => Ok(*spec),
        Experiment::Sweep(_) => Err(Failure::wrong(format!("experiment `{whole}` has no parts"))),
        Experiment::Paper(paper) => {
            let known: Vec<&str> = paper.parts.iter().map(|part| part.name.as_str()).collect();
            let Some(part) = part else {
                let parts = known.join(", ");
                let message = format!(
                    "experiment `{whole}` gathers evidence: name one of its parts, as {whole}/PART \
                     (known: {parts})"
                );
                return Err(Failure::wrong(message));
            };
            let found = paper.parts.iter().find(|spec| spec.name == part).cloned();
            found.ok_or_else(|| Failure::wrong(no_such("part", part, &known)))
        }
    }
}
