//! Two folders of results, file by file.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::{image, text};
use crate::experiment::STATE;
use crate::experiment::share::SHARDS;
use crate::file::BESIDE;

/// A file that is not the same in two folders of results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Its path within either.
    pub file: PathBuf,
    /// Where they differ and by how much; first the one recorded.
    pub what: String,
}

/// How many files there are in two folders of results, and those that differ, in order. Left out are costs, which vary
/// from run to run, and what a run keeps for itself.
pub fn differences(recorded: &Path, again: &Path) -> (usize, Vec<Difference>) {
    let [one, two] = [recorded, again].map(|folder| {
        let mut found = BTreeMap::new();
        gather(folder, Path::new(""), &mut found);
        found
    });
    let mut all: Vec<&PathBuf> = one.keys().chain(two.keys()).collect();
    all.sort();
    all.dedup();
    let differ = all.iter().filter_map(|&file| {
        let what = match (one.get(file), two.get(file)) {
            (Some(_), None) => "is not written again".to_owned(),
            (None, _) => "is missing".to_owned(),
            (Some(one), Some(two)) => between(file, one, two)?,
        };
        Some(Difference { file: file.clone(), what })
    });
    (all.len(), differ.collect())
}

/// The files under a folder that must not vary, by their paths in it.
fn gather(root: &Path, within: &Path, found: &mut BTreeMap<PathBuf, PathBuf>) {
    for entry in std::fs::read_dir(root.join(within)).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let shown = name.to_string_lossy();
        let own = shown == STATE || shown == SHARDS;
        if own || shown.starts_with("costs.") || shown.starts_with(BESIDE) {
            continue;
        }
        let within = within.join(&name);
        if entry.path().is_dir() {
            gather(root, &within, found);
        } else {
            found.insert(within, entry.path());
        }
    }
}

/// How two files of this name differ; `None` if they have the same bytes.
fn between(name: &Path, one: &Path, two: &Path) -> Option<String> {
    let [one_bytes, two_bytes] = match (std::fs::read(one), std::fs::read(two)) {
        (Ok(one), Ok(two)) => [one, two],
        (Err(error), _) | (_, Err(error)) => return Some(format!("cannot be read: {error}")),
    };
    if one_bytes == two_bytes {
        return None;
    }
    let kind = name.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    let [a, b] = [one_bytes.as_slice(), two_bytes.as_slice()];
    let told = match kind.as_str() {
        "png" => image::codes(a, b),
        "exr" => image::radiances(one, two),
        "csv" => text::cells(a, b),
        "json" => text::values(a, b),
        _ => text::lines(a, b),
    };
    Some(told.unwrap_or_else(|| bytes(a, b)))
}

/// Where the bytes of two files part.
fn bytes(one: &[u8], two: &[u8]) -> String {
    let first = one.iter().zip(two).take_while(|(a, b)| a == b).count();
    let length = if one.len() == two.len() {
        format!("{} bytes each", one.len())
    } else {
        format!("{} and {} bytes", one.len(), two.len())
    };
    format!("byte {first} is the first that differs; {length}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(files: &[(&str, &[u8])]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (name, bytes) in files {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, bytes).unwrap();
        }
        folder
    }

    #[test]
    fn files_are_missing_surplus_or_other_and_costs_are_left_alone() {
        let one = folder(&[
            ("same.md", b"a"),
            ("costs.csv", b"1"),
            (".state/x", b"1"),
            ("odd.bin", &[1, 2, 0xff]),
            ("images/only.exr", b""),
        ]);
        let two = folder(&[
            ("same.md", b"a"),
            ("costs.csv", b"2"),
            ("odd.bin", &[1, 3, 0xff, 0]),
            ("plots/new.png", b""),
        ]);
        let (files, found) = differences(one.path(), two.path());
        assert_eq!(files, 4);
        let told: Vec<_> =
            found.iter().map(|d| (d.file.to_str().unwrap(), d.what.as_str())).collect();
        assert_eq!(
            told,
            [
                ("images/only.exr", "is not written again"),
                ("odd.bin", "byte 1 is the first that differs; 3 and 4 bytes"),
                ("plots/new.png", "is missing"),
            ]
        );
    }
}
