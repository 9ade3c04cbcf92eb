//! The rows that need no sweep, made; the others are there.

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
    for row in ["f2-f4", "f5", "f6", "f7", "f8", "f9", "f10", "f11", "t", "interp"] {
        let name = format!("blinn-{row}");
        assert!(PAPER.rows.iter().any(|row| row.name == name), "{name}");
    }
}

#[test]
fn what_the_paper_says_of_normals_and_tables_holds() {
    for row in ["f2-f4", "interp", "f5", "f6", "f7", "f9"] {
        let exhibit = made(&format!("blinn-{row}"));
        assert_eq!(exhibit.verdict(), Verdict::Reproduced, "{row} {:#?}", exhibit.claims);
    }
}
