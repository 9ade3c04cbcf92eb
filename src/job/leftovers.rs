//! Files of the report before, which the report that was just written does not have.

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

use crate::experiment::STATE;
use crate::file::write_whole;

/// The list of a report's files, in the folder of the run's own.
const LIST: &str = "files.json";

/// Removes, of the report in `folder`, the files of the report that stood there before which are not among the
/// `written` ones, and notes what was written for the next time. What fails is left: it harms nobody.
pub(super) fn clear(folder: &Path, written: &[PathBuf]) {
    let list = folder.join(STATE).join(LIST);
    let within = |path: &PathBuf| path.strip_prefix(folder).ok().map(Path::to_owned);
    let now: BTreeSet<PathBuf> = written.iter().filter_map(within).collect();
    let before = std::fs::read(&list).ok();
    let before: BTreeSet<PathBuf> =
        before.and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default();
    for old in before.difference(&now).filter(|old| is_within(old)) {
        let path = folder.join(old);
        let _ = std::fs::remove_file(&path);
        // A folder that holds something else stays.
        path.parent().map(std::fs::remove_dir);
    }
    if let Ok(text) = serde_json::to_vec_pretty(&now) {
        let _ = write_whole(&list, &text);
    }
}

/// Whether a path leads to a place within the folder it starts from.
fn is_within(path: &Path) -> bool {
    path.components().all(|part| matches!(part, Component::Normal(_)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_a_report_wrote_and_wrote_no_more_goes() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("report");
        for within in ["plots", "images", ".state"] {
            std::fs::create_dir_all(folder.join(within)).unwrap();
        }
        let file = |name: &str| {
            let path = folder.join(name);
            std::fs::write(&path, b"").unwrap();
            path
        };
        let (page, plot, mine) = (file("report.md"), file("plots/a.png"), file("images/mine.png"));
        let old = file("images/old.png");
        clear(&folder, &[page.clone(), plot.clone(), old.clone()]);
        assert!(old.exists());
        clear(&folder, std::slice::from_ref(&page));
        assert!(page.exists() && mine.exists());
        assert!(!plot.exists() && !old.exists() && !folder.join("plots").exists());
        // A list that leads elsewhere.
        let outside = root.path().join("outside");
        std::fs::write(&outside, b"").unwrap();
        std::fs::write(folder.join(".state/files.json"), r#"["../outside", "report.md"]"#).unwrap();
        clear(&folder, &[]);
        assert!(outside.exists() && !page.exists());
    }
}
