//! The reports there are.

use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::Kind;
use super::images::entries;
use super::opened::parts;
use super::text::{clean, lead};
use crate::experiment::manifest::Manifest;

/// A report as it is listed.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Its name: its folder's, and of a part of a paper's evidence `NAME/PART`.
    pub name: String,
    /// Its folder.
    pub folder: PathBuf,
    /// Its kind.
    pub kind: Kind,
    /// When it was written; `None` if it was not yet.
    pub written: Option<SystemTime>,
    /// The answer, a short paragraph each.
    pub lead: Vec<String>,
    /// What is wrong with it, a sentence each.
    pub problems: Vec<String>,
}

/// The reports in `folder`, in alphabetical order, each followed by those of its parts.
pub fn reports(folder: &Path) -> Vec<Report> {
    let mut all = Vec::new();
    for (name, path) in entries(folder, |path| path.is_dir()) {
        let parts = parts(&path);
        if !Report::is_one(&path) && parts.is_empty() {
            continue;
        }
        all.push(Report::of(name.clone(), path));
        let named = |(part, path)| Report::of(format!("{name}/{part}"), path);
        all.extend(parts.into_iter().map(named));
    }
    all
}

/// A paper's, if it has what only they have; else a sweep's.
pub(super) fn kind_of(folder: &Path) -> Kind {
    let paper = ["evidence.csv", "evidence.json"];
    let is_paper = paper.iter().any(|name| folder.join(name).exists())
        || Manifest::read(folder).is_ok_and(|manifest| manifest.paper);
    if is_paper { Kind::Paper } else { Kind::Sweep }
}

/// The title in `report.md`; empty if there is none.
pub(super) fn title_of(folder: &Path) -> String {
    let text = beginning(&folder.join("report.md")).unwrap_or_default();
    let title = text.lines().find_map(|line| line.strip_prefix("# "));
    clean(&title.unwrap_or_default().replace('\\', ""))
}

impl Report {
    /// Whether a folder is one's, be it only begun.
    pub(super) fn is_one(folder: &Path) -> bool {
        ["report.md", "metrics.json", "metrics.csv", "evidence.csv", "evidence.json", ".state"]
            .iter()
            .any(|name| folder.join(name).exists())
    }

    fn of(name: String, folder: PathBuf) -> Self {
        let page = folder.join("report.md");
        let about = std::fs::metadata(&page).and_then(|about| about.modified());
        let kind = kind_of(&folder);
        let mut problems = Vec::new();
        let text = beginning(&page);
        if let Err(error) = &text {
            problems.push(match error.kind() {
                std::io::ErrorKind::NotFound => {
                    "no report yet: a run was interrupted, or is under way".to_owned()
                }
                _ => format!("report.md cannot be read: {error}"),
            });
        } else {
            let figures = if kind == Kind::Paper { "evidence.json" } else { "metrics.json" };
            problems.extend(broken(&folder, figures));
            if kind == Kind::Sweep && !folder.join("images").is_dir() {
                problems.push("the folder images is missing".to_owned());
            }
        }
        let lead = text.map_or_else(|_| Vec::new(), |text| lead(&text));
        Self { name, folder, kind, written: about.ok(), lead, problems }
    }
}

/// The beginning of a text file: more than any answer takes. What is not UTF-8 becomes replacement characters.
fn beginning(path: &Path) -> std::io::Result<String> {
    const ENOUGH: u64 = 1 << 16;
    let mut bytes = Vec::new();
    std::fs::File::open(path)?.take(ENOUGH).read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// What is wrong with a JSON file, as far as its last byte tells: reading all of many would take long.
fn broken(folder: &Path, name: &str) -> Option<String> {
    let last = std::fs::File::open(folder.join(name)).and_then(|mut file| {
        let end = file.seek(SeekFrom::End(0))?;
        file.seek(SeekFrom::Start(end.saturating_sub(16)))?;
        let mut bytes = Vec::new();
        file.take(16).read_to_end(&mut bytes)?;
        Ok(bytes.trim_ascii_end().last().copied())
    });
    match last {
        Ok(Some(b'}')) => None,
        Ok(_) => Some(format!("{name} breaks off")),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            Some(format!("{name} is missing"))
        }
        Err(error) => Some(format!("{name} cannot be read: {error}")),
    }
}
