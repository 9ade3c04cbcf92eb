//! The rows that take no time, made; the others are there.

use super::PAPER;
use crate::evidence::{Drawing, Exhibit, Task, Verdict};
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
    let rows = ["f2", "f3", "n1", "t0", "t1", "f9", "f10", "f11", "f12", "f13", "f14"];
    let images = ["f4", "f5", "f6", "f7", "f8"];
    for row in rows.into_iter().chain(images) {
        let name = format!("fournier-{row}");
        assert!(PAPER.rows.iter().any(|row| row.name == name), "{name}");
    }
}

#[test]
fn averaging_mirrored_normals_fails_as_the_paper_says() {
    let exhibit = made("fournier-f2");
    assert_eq!(exhibit.verdict(), Verdict::Reproduced, "{:?}", exhibit.claims);
    assert!(matches!(exhibit.figures[0].drawing, Drawing::Chart(_)));
}

#[test]
fn multiple_surfaces_look_as_the_paper_says() {
    for row in ["fournier-f9", "fournier-f10"] {
        let exhibit = made(row);
        assert_eq!(exhibit.verdict(), Verdict::Reproduced, "{row} {:?}", exhibit.claims);
        assert!(exhibit.films().count() == 2);
    }
}

#[test]
fn horizons_fit_into_four_bytes_and_shadow_the_grooves() {
    for row in ["fournier-f12", "fournier-f14"] {
        let exhibit = made(row);
        assert_eq!(exhibit.verdict(), Verdict::Reproduced, "{row} {:?}", exhibit.claims);
    }
}
