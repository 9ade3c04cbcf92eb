//! The rows that take little time, made; the others are there.

use super::PAPER;
use crate::evidence::{Exhibit, Task, Verdict};
use crate::method::Silent;
use crate::parameter::Values;

fn made(name: &str) -> Exhibit {
    let row = PAPER.rows.iter().find(|row| row.name == name).unwrap();
    let values = Values::defaults(row.parameters);
    let task = Task { values: &values, seed: 1, parts: &[], progress: &Silent };
    (row.make)(&task).unwrap()
}

#[test]
fn every_figure_and_number_of_the_paper_has_a_row() {
    for row in ["f1", "f2", "f4", "f5", "f6", "f7", "n", "s"] {
        let name = format!("olano-{row}");
        assert!(PAPER.rows.iter().any(|row| row.name == name), "{name}");
    }
}

#[test]
fn what_is_a_theorem_is_reproduced() {
    for row in ["olano-f4", "olano-f6", "olano-f7"] {
        let exhibit = made(row);
        assert_eq!(exhibit.verdict(), Verdict::Reproduced, "{row} {:#?}", exhibit.claims);
        assert!(!exhibit.figures.is_empty() && !exhibit.tables.is_empty());
    }
}
