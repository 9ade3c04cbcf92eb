//! Experiments that gather a paper's evidence: ordinary sweeps, its *parts*, and rows made of them.
//!
//! What is written beside `[part.NAME]` tables holds for every part; a part's own keys come before it,
//! table by table.

use std::collections::BTreeSet;
use std::path::Path;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::catalogue::Catalogue;
use super::log::Log;
use super::reader::Reader;
use super::suggest::{all_of, nearest};
use super::values::read_values;
use super::{Spec, SpecErrors, read_spec};
use crate::parameter::{Parameter, Values};

/// What a paper's rows may be told in a spec.
#[derive(Clone, Debug)]
pub struct PaperKeys {
    /// The paper's name in specs.
    pub name: &'static str,
    /// Its rows, in the paper's order.
    pub rows: Vec<RowKeys>,
}

/// What a row may be told in a spec.
#[derive(Clone, Copy, Debug)]
pub struct RowKeys {
    /// The row's name.
    pub name: &'static str,
    /// Its options.
    pub parameters: &'static [Parameter],
    /// The parts it cannot do without.
    pub parts: &'static [&'static str],
}

/// An experiment that gathers a paper's evidence.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperSpec {
    /// Its name: the file's stem.
    pub name: String,
    /// Its title, a line; the name if the file has none.
    pub title: String,
    /// The question it answers; may be empty.
    pub question: String,
    /// The seed of every random choice.
    pub seed: u64,
    /// The paper's name.
    pub paper: &'static str,
    /// Its rows, in the paper's order.
    pub rows: Vec<RowSpec>,
    /// The sweeps that rows draw on, in the order of the file.
    pub parts: Vec<Spec>,
    /// The file as written.
    pub text: String,
}

/// A row to be made.
#[derive(Clone, Debug, PartialEq)]
pub struct RowSpec {
    /// The row's name.
    pub row: &'static str,
    /// Its options.
    pub values: Values,
}

/// An experiment of either kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Experiment {
    /// A sweep.
    Sweep(Box<Spec>),
    /// A paper's evidence.
    Paper(Box<PaperSpec>),
}

impl Experiment {
    /// Reads the experiment in a file, which may gather the evidence of one of `papers`.
    ///
    /// # Errors
    /// [`SpecErrors::Unreadable`], or all that is wrong with it.
    pub fn load(path: &Path, papers: &[PaperKeys]) -> Result<Self, SpecErrors> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| SpecErrors::Unreadable { path: path.to_owned(), source })?;
        Self::parse(&text, path, papers)
    }

    /// Reads an experiment from `text`, which came from the file `path`.
    ///
    /// # Errors
    /// All that is wrong with it.
    pub fn parse(text: &str, path: &Path, papers: &[PaperKeys]) -> Result<Self, SpecErrors> {
        let (document, _) = DeTable::parse_recoverable(text);
        if !document.get_ref().contains_key("paper") {
            return Spec::parse(text, path).map(|spec| Self::Sweep(Box::new(spec)));
        }
        let log = Log::new(path, text);
        let document = Spec::document(&log, text)?;
        let spec = read_paper(&log, document.get_ref(), text, papers);
        log.check()?;
        // Nothing was logged, so there is one.
        spec.map(|spec| Self::Paper(Box::new(spec))).ok_or(SpecErrors::Invalid(Vec::new()))
    }

    /// Its name.
    pub fn name(&self) -> &str {
        match self {
            Self::Sweep(spec) => &spec.name,
            Self::Paper(spec) => &spec.name,
        }
    }

    /// Its file as written.
    pub fn text(&self) -> &str {
        match self {
            Self::Sweep(spec) => &spec.text,
            Self::Paper(spec) => &spec.text,
        }
    }

    /// Its title.
    pub fn title(&self) -> &str {
        match self {
            Self::Sweep(spec) => &spec.title,
            Self::Paper(spec) => &spec.title,
        }
    }

    /// The question it answers; may be empty.
    pub fn question(&self) -> &str {
        match self {
            Self::Sweep(spec) => &spec.question,
            Self::Paper(spec) => &spec.question,
        }
    }
}

/// Keys of the whole, which parts do not inherit.
pub(super) const OWN: [&str; 5] = ["paper", "title", "question", "part", "row"];

fn read_paper(
    log: &Log,
    document: &DeTable,
    text: &str,
    papers: &[PaperKeys],
) -> Option<PaperSpec> {
    let title = ("the experiment".to_owned(), "Gathering a paper's evidence");
    Reader::read(log, title, log.end(), Some(document), |root| {
        let name = log.path().file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let text_at = |key| root.item(key).and_then(|item| item.text()).map(str::to_owned);
        let title = text_at("title").unwrap_or_else(|| name.clone());
        let question = text_at("question").unwrap_or_default();
        let seed = root.whole("seed", 1, 0, i64::MAX as u64);
        let choices: Vec<_> = papers.iter().map(|p| (p.name, p)).collect();
        let Some(paper) = root.item("paper").and_then(|item| item.choice(&choices)) else {
            // What else it may hold is not known.
            root.forgive();
            return None;
        };
        let rows = read_rows(root, paper);
        let parts = read_parts(root, document, text, log);
        if !parts.is_empty() {
            // All other keys are the parts', which tell of those that nobody knows.
            root.forgive();
        }
        need_parts(root, paper, &parts);
        let (text, paper) = (text.to_owned(), paper.name);
        Some(PaperSpec { name, title, question, seed, paper, rows, parts, text })
    })
}

/// Every row of the paper, with what the spec tells it.
fn read_rows(root: &Reader, paper: &PaperKeys) -> Vec<RowSpec> {
    let told: Vec<Option<RowSpec>> = root.each_table("row", "[row.NAME]", |name, reader| {
        let Some(row) = paper.rows.iter().find(|row| row.name == name) else {
            let names: Vec<&str> = paper.rows.iter().map(|row| row.name).collect();
            let help = match nearest(name, &names) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("its rows are {}", all_of(&quoted(&names))),
            };
            reader.error(format!("{} has no row `{name}`", paper.name), Some(help));
            reader.forgive();
            return None;
        };
        Some(RowSpec { row: row.name, values: read_values(reader, row.parameters) })
    });
    let of = |row: &RowKeys| {
        let told = told.iter().flatten().find(|told| told.row == row.name).cloned();
        told.unwrap_or_else(|| RowSpec { row: row.name, values: Values::defaults(row.parameters) })
    };
    paper.rows.iter().map(of).collect()
}

fn quoted(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| format!("`{name}`")).collect()
}

/// The sweeps under `[part]`, each over what is common to all, in the order of the file.
fn read_parts(root: &Reader, document: &DeTable, text: &str, log: &Log) -> Vec<Spec> {
    let mut common = document.clone();
    for key in OWN {
        common.remove(key);
    }
    let tables = root.item("part").and_then(|item| item.table()).into_iter().flatten();
    let mut parts: Vec<(usize, Spec)> = Vec::new();
    for (name, value) in tables {
        let DeValue::Table(own) = value.get_ref() else {
            let message = format!("`part.{}` must be a table", name.get_ref());
            log.error(value.span(), message, None);
            continue;
        };
        let whole = laid_over(&common, own);
        let title = (format!("part `{}`", name.get_ref()), "The experiment");
        let spec = Reader::read(log, title, value.span(), Some(&whole), |reader| {
            read_spec(reader, &Catalogue::all(), name.get_ref(), text)
        });
        parts.push((name.span().start, spec));
    }
    parts.sort_by_key(|(place, _)| *place);
    parts.into_iter().map(|(_, spec)| spec).collect()
}

/// `own` with what it does not say taken from `common`, table by table.
fn laid_over<'a>(common: &DeTable<'a>, own: &DeTable<'a>) -> DeTable<'a> {
    let mut whole = common.clone();
    for (key, value) in own {
        let both = match (whole.get(key), value.get_ref()) {
            (Some(below), DeValue::Table(above)) => match below.get_ref() {
                DeValue::Table(below) => Some(laid_over(below, above)),
                _ => None,
            },
            _ => None,
        };
        let value = match both {
            Some(table) => Spanned::new(value.span(), DeValue::Table(table)),
            None => value.clone(),
        };
        whole.insert(key.clone(), value);
    }
    whole
}

/// Logs the parts that rows need and the spec has not, each once.
fn need_parts(root: &Reader, paper: &PaperKeys, parts: &[Spec]) {
    let needed: BTreeSet<&str> =
        paper.rows.iter().flat_map(|row| row.parts.iter().copied()).collect();
    for part in needed {
        if parts.iter().any(|spec| spec.name == part) {
            continue;
        }
        let rows = paper.rows.iter().filter(|row| row.parts.contains(&part));
        let rows: Vec<&str> = rows.map(|row| row.name).collect();
        let (word, verb) = if rows.len() == 1 { ("row", "needs") } else { ("rows", "need") };
        let message =
            format!("{word} {} {verb} a sweep under [part.{part}]", all_of(&quoted(&rows)));
        root.log().error(root.log().end(), message, None);
    }
}
