//! `wrinkle compare`: one image scored against another.

use std::io::Write;

use super::Exit;
use super::args::CompareArgs;
use super::exit::{Failure, tell};
use crate::experiment::spec::no_such;
use crate::metric;
use crate::render::{Coding, read_image};

/// Prints every metric of the two images.
pub(super) fn compare(args: &CompareArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    for (name, _) in &args.fail_above {
        if metric::find(name).is_none() {
            let known: Vec<&str> = metric::entries().iter().map(|m| m.name).collect();
            return Err(Failure::wrong(no_such("metric", name, &known)));
        }
    }
    let test = read_image(&args.test).map_err(Failure::wrong)?;
    let reference = read_image(&args.reference).map_err(Failure::wrong)?;
    if test.coding != reference.coding {
        return Err(Failure::wrong(format!(
            "{} holds {} and {} holds {}: compare like with like",
            args.test.display(),
            coding(test.coding),
            args.reference.display(),
            coding(reference.coding)
        )));
    }
    metric::same_shape(&test.channels, &reference.channels).map_err(Failure::wrong)?;
    let scores = metric::channel_scores(&test.channels, &reference.channels);
    if args.json {
        let scores: serde_json::Map<String, serde_json::Value> =
            scores.iter().map(|(name, value)| ((*name).to_owned(), (*value).into())).collect();
        writeln!(out, "{:#}", serde_json::Value::from(scores))?;
    } else {
        print(&scores, out)?;
    }
    let above = |(name, limit): &(String, f64)| {
        scores.iter().any(|(metric, value)| metric == name && value > limit)
    };
    let failed: Vec<&(String, f64)> = args.fail_above.iter().filter(|limit| above(limit)).collect();
    for (name, limit) in &failed {
        tell(format_args!("{name} is above {limit}"));
    }
    Ok(if failed.is_empty() { Exit::Done } else { Exit::Differs })
}

fn coding(coding: Coding) -> &'static str {
    match coding {
        Coding::Linear => "radiances",
        Coding::Display => "codes for a display",
    }
}

/// A line a metric: name, value, what it tells and its formula.
fn print(scores: &[(&str, f64)], out: &mut dyn Write) -> std::io::Result<()> {
    for metric in metric::entries().iter().filter(|m| m.swept) {
        let value = scores.iter().find(|(name, _)| *name == metric.name);
        let value = value.map_or("—".to_owned(), |(_, value)| format!("{value:.6}"));
        writeln!(out, "{:<17} {value:>12}  {}", metric.name, metric.meaning)?;
        let dim = anstyle::Style::new().dimmed();
        writeln!(out, "{dim}{:31} {}{dim:#}", "", metric.formula)?;
    }
    Ok(())
}
