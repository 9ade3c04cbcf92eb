//! `evidence.json`, `evidence.csv` and `tables/*.csv`: full precision, nothing timed.

use serde::Serialize;
use serde_json::Value;

use super::file_name;
use crate::evidence::{Claim, Evidence, Quantity, Table};
use crate::report::tidy::{round_trip, table};

/// The columns of `evidence.csv`, in order.
pub const COLUMNS: [&str; 7] = ["row", "claim", "paper", "here", "verdict", "rule", "because"];

/// `evidence.csv`: a line a claim.
pub fn csv(evidence: &Evidence) -> Vec<u8> {
    let lines = evidence.exhibits.iter().flat_map(|exhibit| {
        exhibit.claims.iter().map(|claim| {
            [
                exhibit.row.clone(),
                claim.what.clone(),
                exact(&claim.paper),
                exact(&claim.here),
                claim.verdict.text().to_owned(),
                claim.rule.clone(),
                claim.because.clone(),
            ]
        })
    });
    table(COLUMNS, lines)
}

/// A quantity that reads back as it was; empty if it is not finite.
pub fn exact(quantity: &Quantity) -> String {
    match quantity {
        Quantity::Count(count) => count.to_string(),
        Quantity::Number(number) => round_trip(*number),
        Quantity::Text(text) => text.clone(),
    }
}

/// `tables/ROW-NAME.csv`: each table as it is.
pub fn tables(evidence: &Evidence) -> impl Iterator<Item = (String, Vec<u8>)> {
    evidence.exhibits.iter().flat_map(|exhibit| {
        exhibit.tables.iter().map(|table| {
            let name = file_name(&format!("{}-{}", exhibit.row, table.name));
            (format!("tables/{name}.csv"), cells(table))
        })
    })
}

fn cells(table: &Table) -> Vec<u8> {
    // Lengths may differ in what was read back from a file: then a line is as long as it is.
    let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
    let mut write = |record: csv::StringRecord| {
        writer.write_record(&record).expect("writing to memory cannot fail");
    };
    write(table.head.iter().collect());
    table.rows.iter().for_each(|row| write(row.iter().map(exact).collect()));
    writer.into_inner().expect("flushing to memory cannot fail")
}

/// `evidence.json`: the evidence without films and without what is timed; a number that is not finite is
/// `null`.
pub fn json(evidence: &Evidence) -> Vec<u8> {
    #[derive(Serialize)]
    struct Document<'a> {
        format: u32,
        #[serde(flatten)]
        evidence: &'a Evidence,
    }
    let document = Document { format: crate::report::FORMAT, evidence };
    let mut document = serde_json::to_value(document).expect("the keys are strings");
    let exhibits = document.get_mut("exhibits").and_then(Value::as_array_mut);
    for exhibit in exhibits.into_iter().flatten().filter_map(Value::as_object_mut) {
        exhibit.shift_remove("timed");
    }
    let mut text = String::new();
    write(&document, 0, &mut text);
    text.push('\n');
    text.into_bytes()
}

/// Indented, but for lists of plain values: a line each.
fn write(value: &Value, depth: usize, out: &mut String) {
    let line = |depth: usize, out: &mut String| {
        out.push('\n');
        out.extend(std::iter::repeat_n("  ", depth));
    };
    match value {
        Value::Object(map) if !map.is_empty() => {
            out.push('{');
            for (i, (key, value)) in map.iter().enumerate() {
                out.push_str(if i > 0 { "," } else { "" });
                line(depth + 1, out);
                out.push_str(&Value::from(key.as_str()).to_string());
                out.push_str(": ");
                write(value, depth + 1, out);
            }
            line(depth, out);
            out.push('}');
        }
        Value::Array(list) if list.iter().any(nested) => {
            out.push('[');
            for (i, value) in list.iter().enumerate() {
                out.push_str(if i > 0 { "," } else { "" });
                line(depth + 1, out);
                write(value, depth + 1, out);
            }
            line(depth, out);
            out.push(']');
        }
        plain => out.push_str(&plain.to_string()),
    }
}

/// Whether a value is more than a plain one or a short list of them, such as a point.
fn nested(value: &Value) -> bool {
    match value {
        Value::Object(_) => true,
        Value::Array(list) => list.len() > 4 || list.iter().any(|v| v.is_array() || v.is_object()),
        _ => false,
    }
}

/// How many claims of a list have each verdict: those that hold, and all that can be held against
/// something.
pub fn held(claims: &[Claim]) -> (usize, usize) {
    use crate::evidence::Verdict::{NotApplicable, Reproduced};
    let of = |wanted: &dyn Fn(&Claim) -> bool| claims.iter().filter(|c| wanted(c)).count();
    (of(&|c| c.verdict == Reproduced), of(&|c| c.verdict != NotApplicable))
}
