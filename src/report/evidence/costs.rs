//! What varies from run to run: times, and claims about them.

use super::data::exact;
use super::page::{shown, table as set};
use crate::evidence::{Evidence, Exhibit};
use crate::report::tables::Table;
use crate::report::tidy::{round_trip, table};
use crate::report::{page, phrase};

const COLUMNS: [&str; 5] = ["row", "kind", "what", "measure", "value"];

/// `costs.csv`: seconds by row, then timed claims and tables, one line a value.
pub fn csv(evidence: &Evidence, row_secs: &[(String, f64)]) -> Vec<u8> {
    let line = |cells: [&str; 4], value: String| {
        let [row, kind, what, measure] = cells.map(str::to_owned);
        [row, kind, what, measure, value]
    };
    let secs =
        row_secs.iter().map(|(row, secs)| line([row, "row", "", "seconds"], round_trip(*secs)));
    let mut lines: Vec<_> = secs.collect();
    for exhibit in &evidence.exhibits {
        let row = exhibit.row.as_str();
        for claim in &exhibit.timed.claims {
            let cells = |measure| [row, "claim", claim.what.as_str(), measure];
            lines.push(line(cells("paper"), exact(&claim.paper)));
            lines.push(line(cells("here"), exact(&claim.here)));
            lines.push(line(cells("verdict"), claim.verdict.text().into()));
        }
        for table in &exhibit.timed.tables {
            for cells in &table.rows {
                let what =
                    format!("{}: {}", table.name, cells.first().map_or_else(String::new, exact));
                for (head, cell) in table.head.iter().zip(cells).skip(1) {
                    lines.push(line([row, "table", &what, head], exact(cell)));
                }
            }
        }
    }
    table(COLUMNS, lines.into_iter())
}

/// `costs.md`: the same for a reader.
pub fn markdown(evidence: &Evidence, row_secs: &[(String, f64)]) -> String {
    let total: f64 = row_secs.iter().map(|(_, secs)| secs).sum();
    let intro = format!(
        "The rows took {} s. These figures vary from run to run and machine to machine; everything else in this \
         folder does not.",
        phrase::number(total)
    );
    let seconds = Table {
        title: "Seconds by row".into(),
        head: ["Row", "Seconds"].map(str::to_owned).into(),
        rows: row_secs
            .iter()
            .map(|(row, secs)| vec![row.as_str().into(), phrase::number(*secs).into()])
            .collect(),
        notes: Vec::new(),
    };
    let timed = evidence.exhibits.iter().flat_map(timed);
    page::costs(
        &format!("{}: costs", evidence.title),
        &intro,
        None,
        &std::iter::once(seconds).chain(timed).collect::<Vec<_>>(),
    )
}

fn timed(exhibit: &Exhibit) -> Vec<Table> {
    let mut tables: Vec<Table> = exhibit.timed.tables.iter().map(set).collect();
    for table in &mut tables {
        table.title = format!("{}: {}", exhibit.row, table.title);
    }
    if !exhibit.timed.claims.is_empty() {
        let head = ["Claim", "Paper", "Here", "Verdict", "Rule"].map(str::to_owned).into();
        let rows = exhibit.timed.claims.iter().map(|claim| {
            vec![
                claim.what.as_str().into(),
                shown(&claim.paper).into(),
                shown(&claim.here).into(),
                claim.verdict.text().into(),
                claim.rule.as_str().into(),
            ]
        });
        let because = |c: &&crate::evidence::Claim| !c.because.is_empty();
        let reasons = exhibit.timed.claims.iter().filter(because);
        tables.insert(
            0,
            Table {
                title: format!("{}: claims about time", exhibit.row),
                head,
                rows: rows.collect(),
                notes: reasons.map(|c| format!("{}: {}", c.what, c.because)).collect(),
            },
        );
    }
    tables
}
