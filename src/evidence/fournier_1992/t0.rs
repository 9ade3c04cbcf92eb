//! The times of §2.3: building the pyramids.

use std::sync::Arc;
use std::time::Instant;

use crate::lobe::BaseLobe;
use crate::method::{Method, fournier::Fournier};

use super::super::{Claim, Exhibit, Halted, Row, Table, Task};
use super::f3::EXPONENT;
use super::textures::Subject;

/// The row.
pub const ROW: Row = Row {
    name: "fournier-t0",
    title: "How long the pyramids take to build, then and now",
    parts: &[],
    parameters: &[EXPONENT],
    secs: 1.0,
    make,
};

/// The paper's real time on a Personal Iris, seconds (§2.3).
fn in_1992(subject: Subject) -> f64 {
    match subject {
        Subject::Sphere => 80.0 * 60.0,
        Subject::Cylinder => 60.0 * 60.0,
        Subject::Denim => 300.0 * 60.0,
    }
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let base = BaseLobe::BlinnPhong { exponent: task.values.number("exponent") };
    let mut exhibit = ROW.exhibit();
    exhibit.claims.push(Claim::not_applicable(
        "hours to build the pyramids of sphere, cylinder and denim",
        "about 1:20, 1:00 and almost 5:00 on a Personal Iris",
        "times belong to a machine: today's, and the ratio to the paper's, are in costs.md",
    ));
    let mut table = Table::new(
        "times",
        "Time to build a pyramid, wall clock; the paper's is of one processor of 1992 and includes shadowing for \
         the cylinder.",
        &["map", "1992, s", "today, s", "times as fast"],
    );
    let mut times = Vec::new();
    for subject in Subject::ALL {
        let map = Arc::new(subject.map());
        let start = Instant::now();
        Fournier::default().prefilter(&map, &base, task.progress).map_err(|_| Halted)?;
        let secs = start.elapsed().as_secs_f64();
        let ratio = in_1992(subject) / secs;
        table.push(vec![
            format!("{} {side} × {side}", subject.name(), side = subject.side()).into(),
            in_1992(subject).into(),
            secs.into(),
            ratio.into(),
        ]);
        times.push(secs);
    }
    let longest = times[2] > times[0] && times[2] > times[1];
    exhibit.timed.claims.push(Claim::shown(
        "which of the three pyramids takes longest",
        "denim",
        if longest { "denim" } else { "not denim" },
        "equal",
        longest,
    ).because(
        "cells with identical normals merged are cheap here, and the paper's weave, which may have needed seven \
         peaks in more cells, is lost",
    ));
    exhibit.timed.tables.push(table);
    Ok(exhibit)
}
