//! The program run as its users run it, and folders compared byte by byte.

#![allow(dead_code)] // Each test file uses a part.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The program with these arguments, in `folder`, seeing neither a terminal nor NO_COLOR.
pub fn wrinkle(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wrinkle"));
    command.current_dir(folder).args(args).env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
    command
}

/// What the program says and how it ends.
pub fn output(folder: &Path, args: &[&str]) -> Output {
    wrinkle(folder, args).output().expect("the program starts")
}

/// The files of a folder of results that must not vary, by path within it: all but the costs and the
/// run's own records.
pub fn reproducible(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    gather(folder, folder, &mut found);
    found
}

fn gather(root: &Path, folder: &Path, found: &mut BTreeMap<PathBuf, Vec<u8>>) {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    for path in entries.map(|entry| entry.unwrap().path()) {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if name == ".state" || name == ".shards" || name.starts_with("costs.") {
            continue;
        }
        if path.is_dir() {
            gather(root, &path, found);
        } else {
            let within = path.strip_prefix(root).unwrap().to_owned();
            found.insert(within, std::fs::read(&path).unwrap());
        }
    }
}

/// Holds two folders of results to each other, byte by byte.
///
/// # Panics
/// Naming every file that differs or is in one only.
pub fn assert_same(one: &Path, other: &Path) {
    let (a, b) = (reproducible(one), reproducible(other));
    assert!(!a.is_empty(), "{} holds no results", one.display());
    let names: std::collections::BTreeSet<&PathBuf> = a.keys().chain(b.keys()).collect();
    let differ: Vec<_> = names.into_iter().filter(|name| a.get(*name) != b.get(*name)).collect();
    assert!(differ.is_empty(), "{} and {}: {differ:?}", one.display(), other.display());
}

/// The repository.
pub fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files under a folder, in order.
pub fn files_under(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            files.extend(files_under(&path));
        } else {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// The records that a run has kept in its folder, with what each was called when it was kept, such as
/// `SCENE/fournier-4spp`.
pub fn records(results: &Path) -> Vec<(PathBuf, String)> {
    let called = |path: PathBuf| {
        let text = std::fs::read(&path).ok()?;
        let head: serde_json::Value =
            serde_json::from_slice(text.split(|b| *b == b'\n').next()?).ok()?;
        let of = head["of"].as_str()?.to_owned();
        Some((path, of))
    };
    files_under(&results.join(".state/records")).into_iter().filter_map(called).collect()
}

/// How many trials a run has kept.
pub fn trials_kept(results: &Path) -> usize {
    records(results).iter().filter(|(_, of)| of.ends_with("spp")).count()
}

/// When each file under a folder was last written.
pub fn written(folder: &Path) -> Vec<(PathBuf, std::time::SystemTime)> {
    let time = |path: &PathBuf| std::fs::metadata(path).unwrap().modified().unwrap();
    files_under(folder).into_iter().map(|path| (path.clone(), time(&path))).collect()
}
