//! One page over all reports of a folder: what each asks, what it found, and a picture.

use std::path::{Path, PathBuf};

use minijinja::context;
use minijinja::value::Serde;
use serde::Serialize;

use super::figure::data_uri;
use super::files::{Folder, ReportError};
use super::template::render;

/// Pictures larger than this stay in their report.
const ROOM: usize = 300 << 10;

/// A report as the index shows it.
#[derive(Debug, PartialEq, Eq, Serialize)]
struct Entry {
    folder: String,
    title: String,
    question: String,
    answer: String,
    /// Its first picture: the file, relative to the index, and as a data URI.
    picture: Option<(String, String)>,
}

/// Writes `index.html` and `index.md` over the reports that stand in the folders of `reports`, by name, and names the
/// files. Of two runs that end at once, the one that writes last sees the reports of both.
///
/// # Errors
/// [`ReportError`] naming the file that could not be written.
pub fn write_index(reports: &Path) -> Result<Vec<PathBuf>, ReportError> {
    loop {
        let found = entries(reports);
        let page = context! {
            title => "Reports",
            question => "What was asked of the filters, and what was found.",
            entries => Serde(&found),
        };
        let mut folder = Folder::create(reports)?;
        folder.put("index.md", render("index.md", context! { page => page.clone() }).as_bytes())?;
        folder.put("index.html", render("index.html", context! { page }).as_bytes())?;
        if entries(reports) == found {
            return Ok(folder.written());
        }
    }
}

/// The reports of a folder, sorted by name; what cannot be read is left out.
fn entries(reports: &Path) -> Vec<Entry> {
    let found = std::fs::read_dir(reports).into_iter().flatten().flatten();
    let mut names: Vec<String> =
        found.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    let entry = |name: String| {
        let folder = reports.join(&name);
        if !folder.join("report.html").is_file() {
            return None;
        }
        let text = std::fs::read_to_string(folder.join("report.md")).ok()?;
        read(&folder, name, &text)
    };
    names.into_iter().filter_map(entry).collect()
}

/// What a Markdown report says of itself: its title, its question in italics, the first paragraph under the first
/// heading, the first picture.
fn read(folder: &Path, name: String, text: &str) -> Option<Entry> {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let title = lines.find_map(|line| line.strip_prefix("# "))?;
    let plain = |text: &str| text.replace('\\', "").replace("&lt;", "<").replace("&amp;", "&");
    let italic = |line: &str| line.strip_prefix('*')?.strip_suffix('*').map(str::to_owned);
    let question = text.lines().find_map(italic).unwrap_or_default();
    let answer = text.lines().skip_while(|line| !line.starts_with("## ")).skip(1);
    let answer =
        answer.map(str::trim).find(|line| !line.is_empty() && !line.starts_with(['|', '#', '!']));
    let picture = text.lines().find(|line| line.starts_with("![")).and_then(|line| {
        let file = line.rsplit_once("](")?.1.strip_suffix(')')?;
        let bytes = std::fs::read(folder.join(file)).ok().filter(|bytes| bytes.len() <= ROOM)?;
        Some((format!("{name}/{file}"), data_uri(&bytes)))
    });
    Some(Entry {
        folder: name,
        title: plain(title),
        question: plain(&question),
        answer: plain(answer.unwrap_or_default()),
        picture,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{fixture, write};

    #[test]
    fn every_report_is_found_and_nothing_else() {
        let root = tempfile::tempdir().unwrap();
        let (results, moving, costs) = (fixture::results(), fixture::moving(), fixture::costs());
        write(&results, &costs, &root.path().join("still")).unwrap();
        write(&moving, &costs, &root.path().join("moving")).unwrap();
        std::fs::create_dir(root.path().join("empty")).unwrap();
        let found = entries(root.path());
        let names: Vec<&str> = found.iter().map(|entry| entry.folder.as_str()).collect();
        assert_eq!(names, ["moving", "still"]);
        assert_eq!((&found[1].title, &found[1].question), (&results.title, &results.question));
        assert_eq!(found[1].answer, crate::report::lead(&results)[0]);
        assert_eq!(found[1].picture.as_ref().unwrap().0, "still/plots/samples.png");
        let once = write_index(root.path()).unwrap();
        let bytes: Vec<_> = once.iter().map(|file| std::fs::read(file).unwrap()).collect();
        let again = write_index(root.path()).unwrap();
        assert_eq!(bytes, again.iter().map(|f| std::fs::read(f).unwrap()).collect::<Vec<_>>());
        let page = String::from_utf8(bytes[1].clone()).unwrap();
        assert!(page.contains("still&#x2f;report.html") || page.contains("still/report.html"));
    }

    #[test]
    fn a_folder_without_reports_has_an_index_that_says_so() {
        let root = tempfile::tempdir().unwrap();
        let files = write_index(root.path()).unwrap();
        assert!(std::fs::read_to_string(&files[0]).unwrap().contains("No report"));
    }
}
