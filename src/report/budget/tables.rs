//! Budgets as a table and as sentences.

use super::super::phrase;
use super::super::tables::{Cell, Table};
use super::Total;
use crate::render::Part;

/// Shares of a setting, method by part.
pub(super) fn table(totals: &[Total]) -> Table {
    let head = ["Method", "RMSE"].into_iter().chain(Part::ALL.map(Part::name)).chain(["noise"]);
    let note = "Shares of the mean squared error, over the setting’s scenes, errors of each over its mean radiance. Beside \
                them: what replacing the part alone takes off. RMSE over the mean radiance, root mean square over \
                scenes. Marked: the greatest share. ";
    let mut notes = vec![note.trim_end().to_owned()];
    notes.extend(dashes(totals));
    Table {
        title: "What of an error each part is answerable for".into(),
        head: head.map(str::to_owned).collect(),
        rows: totals.iter().map(row).collect(),
        notes,
    }
}

fn row(total: &Total) -> Vec<Cell> {
    let balance = &total.balance;
    let shares = balance.shares();
    let greatest = balance.greatest().map(|(part, _)| part);
    let error = (balance.whole / total.scenes.len().max(1) as f64).sqrt();
    let mut cells = vec![total.label.as_str().into(), phrase::percent(error).into()];
    for (entry, share) in balance.entries.iter().zip(&shares) {
        cells.push(if entry.nothing.is_some() {
            Cell::default()
        } else {
            let alone = (balance.whole - entry.alone) / balance.whole;
            let best = greatest == Some(entry.part);
            Cell {
                text: percent(*share),
                aside: format!("alone {}", percent(alone)),
                best,
                ..Cell::default()
            }
        });
    }
    cells.push(shares.last().map_or_else(Cell::default, |noise| percent(*noise).into()));
    cells
}

/// Why there are dashes: each reason with the methods and the part it is of.
fn dashes(totals: &[Total]) -> Vec<String> {
    let mut found: Vec<(Part, &str, Vec<&str>)> = Vec::new();
    for total in totals {
        for entry in &total.balance.entries {
            let Some(why) = entry.nothing.as_deref() else { continue };
            match found.iter_mut().find(|(part, known, _)| (*part, *known) == (entry.part, why)) {
                Some((.., labels)) => labels.push(&total.label),
                None => found.push((entry.part, why, vec![&total.label])),
            }
        }
    }
    let all = |labels: &[&str]| labels.len() == totals.len();
    let say = |(part, why, labels): &(Part, &str, Vec<&str>)| {
        let whose = if all(labels) { "any method".to_owned() } else { phrase::list(labels) };
        format!("A dash at {} of {whose}: {why}.", part.name())
    };
    found.iter().map(say).collect()
}

/// A sentence a method: the parts that matter, from the greatest.
pub(super) fn words(totals: &[Total]) -> Vec<String> {
    totals.iter().map(sentence).collect()
}

/// Shares below this are not worth a word.
const WORTH_A_WORD: f64 = 0.1;

fn sentence(total: &Total) -> String {
    let entries = &total.balance.entries;
    let names = entries.iter().map(|entry| entry.part.name()).chain(["noise"]);
    let mut all: Vec<(&str, f64)> = names.zip(total.balance.shares()).collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    let name = |(part, share): &(&str, f64)| format!("{part} {}", percent(*share));
    let taking = all.iter().filter(|(_, share)| *share >= WORTH_A_WORD).map(name);
    let adding: Vec<String> =
        all.iter().rev().filter(|(_, share)| *share <= -WORTH_A_WORD).map(name).collect();
    let taking: Vec<String> = taking.collect();
    let mut text = format!("{}: {}", total.label, phrase::list(&taking));
    if !adding.is_empty() {
        text.push_str(&format!("; made up for by {}", phrase::list(&adding)));
    }
    text + "."
}

/// A part of a whole that may be negative, in whole percent.
fn percent(part: f64) -> String {
    let percent = (100.0 * part).round();
    // No minus before a zero.
    let percent = if percent == 0.0 { 0.0 } else { percent };
    format!("{percent:.0}\u{a0}%").replace('-', "−")
}
