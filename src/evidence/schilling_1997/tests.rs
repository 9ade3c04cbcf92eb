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

/// The claims that do not hold.
fn differing(exhibit: &Exhibit) -> Vec<&str> {
    let differ = exhibit.claims.iter().filter(|claim| claim.verdict == Verdict::Differs);
    differ.map(|claim| claim.what.as_str()).collect()
}

#[test]
fn every_figure_and_number_of_the_paper_has_a_row() {
    for row in ["f1-f3", "f4-f5", "f6", "k", "f7", "f8-f9", "f10-f11", "f14", "a"] {
        let name = format!("schilling-{row}");
        assert!(PAPER.rows.iter().any(|row| row.name == name), "{name}");
    }
}

#[test]
fn the_recursive_rule_is_the_covariance_and_loses_nothing() {
    for row in ["schilling-k", "schilling-f7"] {
        let exhibit = made(row);
        assert_eq!(exhibit.verdict(), Verdict::Reproduced, "{row} {:?}", exhibit.claims);
    }
}

#[test]
fn the_ellipse_holds_less_than_is_printed() {
    let exhibit = made("schilling-f6");
    // All four statements about the ellipse differ from print, as is told beside them.
    assert_eq!(differing(&exhibit).len(), 4, "{:?}", exhibit.claims);
    assert!(exhibit.claims.iter().all(|claim| !claim.because.is_empty()));
}

#[test]
fn frames_do_what_is_said_but_are_not_continuous_at_the_ends_of_a_main_direction() {
    let exhibit = made("schilling-f4-f5");
    let differing = differing(&exhibit);
    assert_eq!(differing.len(), 1, "{differing:?} {:?}", exhibit.claims);
    assert!(differing[0].contains("ends of a constant main direction"));
}

#[test]
fn outlines_on_a_plane_tell_phong_from_blinn_phong() {
    let exhibit = made("schilling-f14");
    assert_eq!(exhibit.verdict(), Verdict::Reproduced, "{:?}", exhibit.claims);
}
