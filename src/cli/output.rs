//! Files that a command is asked to write: checked before the work begins.

use std::path::Path;

use super::exit::Failure;

/// The ending of a file to be written, in lower case.
///
/// # Errors
/// If it is none of `endings`, or its folder is not there.
pub(super) fn ending(out: &Path, endings: &[&str]) -> Result<String, Failure> {
    let ending = out.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    if !endings.contains(&ending.as_str()) {
        let wanted: Vec<String> = endings.iter().map(|e| format!(".{e}")).collect();
        let message = format!("cannot write {}: name it {}", out.display(), wanted.join(" or "));
        return Err(Failure::wrong(message));
    }
    let folder = out.parent().filter(|folder| *folder != Path::new(""));
    if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
        let message =
            format!("cannot write {}: there is no folder {}", out.display(), folder.display());
        return Err(Failure::wrong(message));
    }
    Ok(ending)
}
