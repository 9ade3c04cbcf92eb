//! What the report on a paper shows, in the order it shows it.

use minijinja::context;
use minijinja::value::Serde;
use serde::Serialize;

use super::data::held;
use super::figures::Drawn;
use super::file_name;
use crate::evidence::{Claim, Evidence, Exhibit, Quantity, Verdict};
use crate::report::phrase;
use crate::report::tables::{Cell, Table};
use crate::report::template::render;

/// A report on a paper before it is set.
#[derive(Serialize)]
pub struct Page<'a> {
    title: &'a str,
    question: &'a str,
    paper: &'a str,
    tally: String,
    rows: Vec<Row<'a>>,
    parts: Vec<Part<'a>>,
    spec: &'a str,
    seed: u64,
}

/// A row of the paper.
#[derive(Serialize)]
struct Row<'a> {
    /// Its anchor in the page.
    anchor: String,
    name: &'a str,
    title: &'a str,
    verdict: Badge,
    gist: String,
    claims: Vec<ClaimLine<'a>>,
    figures: Vec<Drawn>,
    tables: Vec<TableFile>,
    remarks: &'a [String],
    parts: Vec<Part<'a>>,
}

/// A verdict as it is shown.
#[derive(Serialize)]
struct Badge {
    class: &'static str,
    sign: &'static str,
    text: &'static str,
}

/// A claim as it is shown.
#[derive(Serialize)]
struct ClaimLine<'a> {
    what: &'a str,
    paper: String,
    here: String,
    verdict: Badge,
    rule: &'a str,
    because: &'a str,
}

/// A table and the file that holds it in full.
#[derive(Serialize)]
struct TableFile {
    table: Table,
    file: String,
}

/// A report that a row draws on.
#[derive(Serialize)]
struct Part<'a> {
    folder: String,
    title: &'a str,
}

impl<'a> Part<'a> {
    fn of(name: &'a str, title: &'a str) -> Self {
        Self { folder: file_name(name), title: if title.is_empty() { name } else { title } }
    }
}

impl<'a> Page<'a> {
    /// The report on this evidence with its figures, row by row.
    pub fn of(evidence: &'a Evidence, figures: Vec<Vec<Drawn>>) -> Self {
        let rows = evidence.exhibits.iter().zip(figures);
        Self {
            title: &evidence.title,
            question: &evidence.question,
            paper: &evidence.paper,
            tally: tally(evidence),
            rows: rows.map(|(exhibit, drawn)| Row::of(evidence, exhibit, drawn)).collect(),
            parts: evidence.parts.iter().map(|(name, title)| Part::of(name, title)).collect(),
            spec: &evidence.spec,
            seed: evidence.seed,
        }
    }
}

impl<'a> Row<'a> {
    fn of(evidence: &'a Evidence, exhibit: &'a Exhibit, figures: Vec<Drawn>) -> Self {
        let title = |name: &str| evidence.parts.iter().find(|(part, _)| part == name);
        let part = |name: &'a String| Part::of(name, title(name).map_or("", |(_, t)| t));
        let tables = exhibit.tables.iter().map(|t| TableFile {
            table: table(t),
            file: format!("tables/{}.csv", file_name(&format!("{}-{}", exhibit.row, t.name))),
        });
        Self {
            anchor: file_name(&exhibit.row),
            name: &exhibit.row,
            title: &exhibit.title,
            verdict: badge(exhibit.verdict()),
            gist: gist(exhibit),
            claims: exhibit.claims.iter().map(claim).collect(),
            figures,
            tables: tables.collect(),
            remarks: &exhibit.remarks,
            parts: exhibit.parts.iter().map(part).collect(),
        }
    }
}

fn badge(verdict: Verdict) -> Badge {
    let (class, sign) = match verdict {
        Verdict::Reproduced => ("reproduced", "✓"),
        Verdict::Differs => ("differs", "≠"),
        Verdict::NotApplicable => ("none", "–"),
    };
    Badge { class, sign, text: verdict.text() }
}

fn claim(claim: &Claim) -> ClaimLine<'_> {
    ClaimLine {
        what: &claim.what,
        paper: shown(&claim.paper),
        here: shown(&claim.here),
        verdict: badge(claim.verdict),
        rule: &claim.rule,
        because: &claim.because,
    }
}

/// A quantity as a reader wants it.
pub fn shown(quantity: &Quantity) -> String {
    match quantity {
        Quantity::Count(count) => count.to_string(),
        Quantity::Number(number) if number.is_nan() => "not a number".into(),
        Quantity::Number(number) => phrase::signed_scale(*number),
        Quantity::Text(text) => text.clone(),
    }
}

/// A table as a reader wants it; shorter lines are filled up.
pub fn table(table: &crate::evidence::Table) -> Table {
    let cell = |cell: &Quantity| -> Cell {
        match cell {
            Quantity::Number(number) if number.is_nan() => Cell::default(),
            Quantity::Number(number) => phrase::number(*number).replace('-', "−").into(),
            other => shown(other).into(),
        }
    };
    let row = |row: &Vec<Quantity>| {
        let mut cells: Vec<Cell> = row.iter().map(cell).collect();
        cells.resize(table.head.len(), Cell::default());
        cells
    };
    Table {
        title: table.caption.clone(),
        head: table.head.clone(),
        rows: table.rows.iter().map(row).collect(),
        notes: Vec::new(),
    }
}

/// All verdicts in a sentence.
fn tally(evidence: &Evidence) -> String {
    let [reproduced, differs, none] = evidence.tally();
    let verb = |n: usize, one: &str, many: &str| {
        (n > 0).then(|| format!("{n} {}", if n == 1 { one } else { many }))
    };
    let parts = [
        verb(reproduced, "is reproduced", "are reproduced"),
        verb(differs, "differs", "differ"),
        verb(none, "cannot be held against anything", "cannot be held against anything"),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    match evidence.exhibits.len() {
        0 => "Nothing of the paper was looked at.".into(),
        all => format!("{} of the paper: {}.", phrase::count(all, "row"), phrase::list(&parts)),
    }
}

/// A row's claims in a line: those that do not hold, else the first that does.
fn gist(exhibit: &Exhibit) -> String {
    let of = |verdict| exhibit.claims.iter().filter(move |c| c.verdict == verdict);
    let both =
        |c: &Claim| format!("{}: paper {}, here {}", c.what, shown(&c.paper), shown(&c.here));
    let (hold, all) = held(&exhibit.claims);
    if let Some(worst) = of(Verdict::Differs).next() {
        let count = if all > 1 { format!("{hold} of {all} claims hold; ") } else { String::new() };
        return count + &both(worst);
    }
    match (of(Verdict::Reproduced).next(), of(Verdict::NotApplicable).next()) {
        (Some(first), _) if all > 1 => format!("all {all} claims hold; {}", both(first)),
        (Some(first), _) => both(first),
        (None, Some(first)) => format!("{}: {}", first.what, first.rule),
        (None, None) => "no claim".into(),
    }
}

/// `report.md`.
pub fn markdown(page: &Page) -> String {
    render("evidence.md", context! { page => Serde(page) })
}

/// `report.html`.
pub fn html(page: &Page) -> String {
    render("evidence.html", context! { page => Serde(page) })
}
