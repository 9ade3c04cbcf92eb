//! The counts of §2.3: how many cells of the pyramids need a fit, and how many of those seven peaks.

use crate::method::fournier::{Fournier, LevelCounts, count_fits};
use crate::parameter::{Domain, Parameter, Value};
use crate::texture::NormalMap;

use super::super::{Claim, Exhibit, Halted, Quantity, Row, Table, Task};
use super::f3::EXPONENT;
use super::textures::Subject;

/// The row.
pub const ROW: Row = Row {
    name: "fournier-n1",
    title: "How many cells need a fit, and how many of those seven peaks: sphere and denim",
    parts: &[],
    parameters: &[
        EXPONENT,
        Parameter {
            name: "readings",
            meaning: "which readings of the paper to count under: all, or its own alone",
            domain: Domain::Choice { words: &["all", "own"] },
        },
    ],
    secs: 30.0,
    make,
};

/// A pyramid's counts, all levels together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Counts {
    fits: usize,
    at_most: usize,
    unmet: usize,
    failures: usize,
}

fn counts(map: &NormalMap, exponent: f64, task: &Task) -> Result<Counts, Halted> {
    let levels = count_fits(&Fournier::default(), map, exponent, task.progress);
    let total = |sum: Counts, level: &LevelCounts| Counts {
        fits: sum.fits + level.fits,
        at_most: sum.at_most + level.at_most_peaks,
        unmet: sum.unmet + level.unmet,
        failures: sum.failures + level.failures,
    };
    Ok(levels.map_err(|_| Halted)?.iter().fold(Counts::default(), total))
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let exponent = task.values.number("exponent");
    let all = task.values.word("readings") == "all";
    let mut exhibit = ROW.exhibit();
    let sphere = counts(&Subject::Sphere.map(), exponent, task)?;
    let denim = counts(&Subject::Denim.map(), exponent, task)?;
    exhibit.claims = vec![
        Claim::count("sphere 32 × 32: cells that need a fit", 73, sphere.fits),
        Claim::count("sphere 32 × 32: fits that reach seven peaks", 5, sphere.at_most),
        Claim::count("denim 64 × 64: cells that need a fit", 85, denim.fits),
        Claim::count("denim 64 × 64: fits that reach seven peaks", 63, denim.at_most).because(
            "the paper's weave and exponent are lost, and the count moves with both: see the table of weaves",
        ),
    ];
    if all {
        exhibit.tables.push(spheres(exponent, task)?);
        let weaves = weaves(exponent, task)?;
        exhibit.remarks.push(spread(&weaves));
        exhibit.tables.push(weaves);
    }
    exhibit.remarks.push(
        "“At seven peaks” and “5 % not met” are different counts: a fit may meet the rule with its seventh peak. \
         Both are shown."
            .into(),
    );
    Ok(exhibit)
}

const HEAD: [&str; 5] = ["reading", "fits", "at seven peaks", "5 % not met", "failed steps"];

fn row(reading: impl Into<Quantity>, counts: Counts) -> Vec<Quantity> {
    let Counts { fits, at_most, unmet, failures } = counts;
    vec![reading.into(), fits.into(), at_most.into(), unmet.into(), failures.into()]
}

/// The sphere's counts under other readings of the weights, the background and the exponent.
fn spheres(exponent: f64, task: &Task) -> Result<Table, Halted> {
    let mut table = Table::new(
        "spheres",
        format!(
            "The sphere's counts (paper: 73 and 5) under other readings, base exponent {exponent} unless said."
        ),
        &HEAD,
    );
    let readings: [(&str, &[(&str, Value)]); 4] = [
        ("weight 1/n_z, nothing beside the sphere", &[]),
        ("equal weights", &[("weight", Value::Word("equal"))]),
        ("flat ground beside the sphere", &[("background", Value::Word("flat"))]),
        (
            "equal weights, flat ground",
            &[("weight", Value::Word("equal")), ("background", Value::Word("flat"))],
        ),
    ];
    for (reading, values) in readings {
        table.push(row(reading, counts(&Subject::Sphere.read_as(values), exponent, task)?));
    }
    for other in [10.0, 20.0, 30.0, 40.0, 65.0, 80.0, 100.0] {
        let reading = format!("base exponent {other}");
        table.push(row(reading, counts(&Subject::Sphere.map(), other, task)?));
    }
    Ok(table)
}

/// The denim's counts under other weaves, and of one weave under other exponents.
fn weaves(exponent: f64, task: &Task) -> Result<Table, Halted> {
    let mut table = Table::new(
        "weaves",
        format!(
            "The denim's counts (paper: 85 and 63) under other weaves, base exponent {exponent} unless said."
        ),
        &HEAD,
    );
    let weaves = [1, 2, 3]
        .into_iter()
        .flat_map(|over| [4, 8, 16].into_iter().map(move |pitch| (over, pitch)))
        .flat_map(|(over, pitch)| (0..=over).map(move |phase| (over, pitch, phase, exponent)));
    let exponents = [10.0, 20.0, 30.0, 40.0, 65.0, 80.0]
        .into_iter()
        .flat_map(|exponent| (0..3).map(move |phase| (2, 8, phase, exponent)));
    let tried: Vec<(u32, u32, u32, f64)> = weaves.chain(exponents).collect();
    for (done, &(over, pitch, phase, of)) in tried.iter().enumerate() {
        task.go_on()?;
        let number = |n: u32| Value::Number(f64::from(n));
        let values = [("over", number(over)), ("pitch", number(pitch)), ("phase", number(phase))];
        let mut reading = format!("{over}/1 weave, threads of {pitch} texels, phase {phase}");
        if of != exponent {
            reading += &format!(", base exponent {of}");
        }
        table.push(row(reading, counts(&Subject::Denim.read_as(&values), of, task)?));
        task.progress.advance(done + 1, tried.len());
    }
    Ok(table)
}

/// Where the paper's 63 stands in the spread of the weaves that give its 85.
fn spread(weaves: &Table) -> String {
    let count = |cell: &Quantity| match cell {
        Quantity::Count(n) => *n,
        _ => 0,
    };
    let mut found: Vec<u64> =
        weaves.rows.iter().filter(|row| count(&row[1]) == 85).map(|row| count(&row[2])).collect();
    found.sort_unstable();
    let exact = found.iter().filter(|&&n| n == 63).count();
    match (found.first(), found.get(found.len() / 2), found.last()) {
        (Some(least), Some(middle), Some(most)) => format!(
            "Of {} readings tried, {} give 85 fits; of those, the fits at seven peaks run from {least} to {most} with \
             median {middle}, and {exact} give the paper's 63.",
            weaves.rows.len(),
            found.len(),
        ),
        _ => format!("None of {} readings tried gives 85 fits.", weaves.rows.len()),
    }
}
