//! Finding experiments by name.

use std::path::{Path, PathBuf};

use crate::evidence;
use crate::experiment::spec::{Draft, Experiment, Spec, SpecErrors, no_such};

/// The experiment that is meant where none is named.
pub const DEFAULT: &str = "highlight";

/// Where experiments are looked for by name, from the working folder.
pub const FOLDER: &str = "experiments";

/// Why there is no experiment of a name.
#[derive(Debug, thiserror::Error)]
pub enum FindError {
    /// The file that a path means is not there.
    #[error("there is no experiment file {}", .0.display())]
    NoFile(PathBuf),
    /// No experiment in the working folder has the name, nor any other.
    #[error("there is no experiment `{0}`: no folder {FOLDER}/ with experiments is here")]
    NoFolder(String),
    /// There is nothing of this name; a sentence that names the nearest, or all there are.
    #[error("{0}")]
    NoSuch(String),
    /// The experiment is a single sweep.
    #[error("experiment `{0}` has no parts")]
    NoParts(String),
    /// The experiment is several sweeps.
    #[error(
        "experiment `{name}` gathers evidence: name one of its parts, as {name}/PART (known: {})",
        parts.join(", ")
    )]
    WhichPart {
        /// Its name.
        name: String,
        /// Its parts.
        parts: Vec<String>,
    },
    /// Its file is wrong.
    #[error(transparent)]
    Spec(#[from] SpecErrors),
}

/// The spec file that a name or path means.
///
/// # Errors
/// If there is none.
pub fn locate(name: &str) -> Result<PathBuf, FindError> {
    let path = Path::new(name);
    if path.extension().is_some_and(|e| e == "toml") || name.contains(std::path::MAIN_SEPARATOR) {
        return if path.is_file() {
            Ok(path.to_owned())
        } else {
            Err(FindError::NoFile(path.to_owned()))
        };
    }
    let file = Path::new(FOLDER).join(format!("{name}.toml"));
    if file.is_file() {
        return Ok(file);
    }
    let known = names();
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    Err(if known.is_empty() {
        FindError::NoFolder(name.to_owned())
    } else {
        FindError::NoSuch(no_such("experiment", name, &known))
    })
}

/// Whether a path is that of an image file, by its ending.
pub fn is_image(path: &Path) -> bool {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    let known = ["png", "tif", "tiff", "webp", "exr", "hdr"];
    ending.is_some_and(|ending| known.contains(&ending.as_str()))
}

/// Names of the experiments in the working folder, in alphabetical order.
pub fn names() -> Vec<String> {
    names_in(Path::new(FOLDER))
}

/// Names of the experiments whose files are in `folder`, in alphabetical order; none if it cannot be read.
pub fn names_in(folder: &Path) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
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
///
/// # Errors
/// If there is none, or its file is wrong.
pub fn load(name: &str) -> Result<Experiment, FindError> {
    Ok(Experiment::load(&locate(name)?, &evidence::keys())?)
}

/// Loads a sweep by name or path: of a paper's experiment, a part, as `NAME/PART`.
///
/// # Errors
/// If there is none, or its file is wrong.
pub fn load_sweep(name: &str) -> Result<Spec, FindError> {
    let (whole, part) = match name.rsplit_once('/') {
        Some((whole, part)) if locate(name).is_err() => (whole, Some(part)),
        _ => (name, None),
    };
    let paper = match load(whole)? {
        Experiment::Sweep(spec) if part.is_none() => return Ok(*spec),
        Experiment::Sweep(_) => return Err(FindError::NoParts(whole.to_owned())),
        Experiment::Paper(paper) => paper,
    };
    let Some(part) = part else {
        let parts = paper.parts.iter().map(|part| part.name.clone()).collect();
        return Err(FindError::WhichPart { name: whole.to_owned(), parts });
    };
    let known: Vec<&str> = paper.parts.iter().map(|part| part.name.as_str()).collect();
    let found = paper.parts.iter().find(|spec| spec.name == part).cloned();
    found.ok_or_else(|| FindError::NoSuch(no_such("part", part, &known)))
}

/// The spec of a sweep by name or path, as [`load_sweep`] finds it, to be changed before it is read.
///
/// # Errors
/// Those of [`load_sweep`].
pub fn draft(name: &str) -> Result<Draft, FindError> {
    let spec = load_sweep(name)?;
    let whole = name.strip_suffix(&format!("/{}", spec.name)).unwrap_or(name);
    let (path, part) = match locate(name) {
        Ok(path) => (path, None),
        Err(_) => (locate(whole)?, Some(spec.name.as_str())),
    };
    Draft::of_text(&spec.text, part, &path).map_err(FindError::NoSuch)
}
