//! Figure 3: distributions at the top of the pyramids and their fits.

use crate::fit::GreedyOptions;
use crate::parameter::{Domain, Parameter};

use super::super::{Claim, Disc, Drawing, Exhibit, Figure, Halted, Quantity, Row, Table, Task};
use super::textures::{Reconstructed, Subject, axes, normals_of, reconstructed, sampled};

/// The exponent of the base lobe, which the paper does not print.
pub const EXPONENT: Parameter = Parameter {
    name: "exponent",
    meaning: "exponent of the base lobe: the paper does not print its own",
    domain: Domain::Real { default: 50.0, min: 1.0, max: 1000.0 },
};

/// The row.
pub const ROW: Row = Row {
    name: "fournier-f3",
    title: "Distributions and fits at the top of the pyramid: hemisphere, cylinder, denim",
    parts: &[],
    parameters: &[EXPONENT],
    secs: 0.5,
    make,
};

/// "A few percent", as a bound: the paper's own stopping rule asks for 5 %.
const FEW: f64 = 0.05;
/// Restarts from first guesses other than the paper's that a reading tries.
const RESTARTS: usize = 8;

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let exponent = task.values.number("exponent");
    let mut exhibit = ROW.exhibit();
    let mut table = Table::new(
        "fits",
        "Residuals of the fits, relative to the distribution's own rms and maximum.",
        &["map", "peaks", "residual rms", "residual maximum", "iterations", "ended by"],
    );
    for subject in Subject::ALL {
        let normals = normals_of(&subject.map(), exponent);
        let found = reconstructed(&normals, GreedyOptions::default(), task)?;
        let Reconstructed { fit, .. } = &found;
        let why = fit.termination.map_or("nothing to fit", |termination| termination.text());
        table.push(vec![
            subject.name().into(),
            fit.peaks.len().into(),
            fit.rms.into(),
            fit.maximum.into(),
            (fit.iterations as usize).into(),
            why.into(),
        ]);
        let of = |what: &str| format!("{}: residual {what}, of the distribution's", subject.name());
        let words = "within a few percent (§2.3)";
        exhibit.claims.push(Claim::at_most(of("rms"), words, FEW, fit.rms).because(
            "the narrower the base lobe, the less seven peaks can follow: see the readings",
        ));
        exhibit.claims.push(Claim::at_most(of("maximum"), words, FEW, fit.maximum).because(
            "the largest residuals stand at the rim of the hemisphere and in narrow ridges, where a round \
             peak cannot follow; see the readings",
        ));
        exhibit.figures.push(drawn(subject, &found));
    }
    exhibit.tables.push(table);
    let readings = readings(exponent, task)?;
    exhibit.remarks.push(within(&readings));
    exhibit.tables.push(readings);
    exhibit.remarks.push(format!(
        "The paper's base exponent is not printed; {exponent} is used here. A residual of 5 % in both rms and \
         maximum is its own rule for stopping before seven peaks."
    ));
    Ok(exhibit)
}

/// The residuals under other base exponents, and with other first guesses than the paper's.
fn readings(exponent: f64, task: &Task) -> Result<Table, Halted> {
    let head = ["reading", "sphere rms", "sphere max", "cylinder rms", "cylinder max", "denim rms"];
    let head: Vec<&str> = head.into_iter().chain(["denim max"]).collect();
    let mut table = Table::new("readings", "The residuals under other readings.", &head);
    let mut push = |reading: String, exponent: f64, options: GreedyOptions| {
        let mut row = vec![Quantity::from(reading)];
        for subject in Subject::ALL {
            let found = reconstructed(&normals_of(&subject.map(), exponent), options, task)?;
            row.extend([found.fit.rms.into(), found.fit.maximum.into()]);
        }
        table.push(row);
        Ok::<(), Halted>(())
    };
    for other in [10.0, 20.0, 30.0, 40.0, 60.0, 100.0] {
        push(format!("base exponent {other}"), other, GreedyOptions::default())?;
    }
    let restarts = GreedyOptions { restarts: RESTARTS, ..GreedyOptions::default() };
    push(format!("{RESTARTS} restarts from other first guesses"), exponent, restarts)?;
    Ok(table)
}

/// Under which readings every residual is within a few percent.
fn within(readings: &Table) -> String {
    let few = |cell: &Quantity| matches!(cell, Quantity::Number(part) if *part <= FEW);
    let holds: Vec<String> = readings
        .rows
        .iter()
        .filter(|row| row[1..].iter().all(few))
        .map(|row| match &row[0] {
            Quantity::Text(reading) => reading.clone(),
            _ => String::new(),
        })
        .collect();
    if holds.is_empty() {
        return "Under no reading tried are all residuals within 5 %.".into();
    }
    format!("All residuals are within 5 % under: {}.", holds.join("; "))
}

fn drawn(subject: Subject, found: &Reconstructed) -> Figure {
    let disc = |label: &str, density: Vec<f64>| Disc {
        label: label.into(),
        remark: String::new(),
        density,
        peaks: vec![],
        own_scale: false,
    };
    let fitted = Disc {
        remark: format!("{} peaks", found.fit.peaks.len()),
        peaks: axes(&found.fit.peaks),
        ..disc("fit", sampled(&found.fit.peaks))
    };
    let residual = Disc {
        own_scale: true,
        ..disc("residual", found.residual.iter().map(|r| r / found.truth.maximum()).collect())
    };
    let truth = disc("distribution", found.truth.values().to_vec());
    let caption = format!(
        "Normals of the {}, their fit, and the residual in units of the distribution's maximum; the hemisphere \
         seen from above.",
        subject.name()
    );
    Figure::new(subject.name(), caption, Drawing::Discs(vec![truth, fitted, residual]))
}
