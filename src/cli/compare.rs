//! `wrinkle compare`: one image scored against another.

mod limits;
mod map;

use std::io::Write;
use std::path::Path;

use super::Exit;
use super::args::CompareArgs;
use super::exit::{Failure, tell};
use super::output::ending;
use crate::experiment::spec::no_such;
use crate::metric::{self, Metric, Values, Viewing};
use crate::render::{Coding, Film, StoredImage, read_image, srgb_light};
use limits::Limit;

/// A metric with its value, if it has one.
type Scored = (&'static Metric, Option<f64>);

/// Prints the metrics of the two images, writes their map, and holds them to their limits.
pub(super) fn compare(args: &CompareArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    let metrics = asked_for(&args.metric)?;
    let limits = Limit::all(&args.fail_above, &args.fail_below)?;
    if let Some(path) = &args.map {
        ending(path, &["png", "exr"])?;
    }
    let mut test = read_image(&args.test).map_err(Failure::wrong)?;
    let mut reference = read_image(&args.reference).map_err(Failure::wrong)?;
    let viewing = Viewing { values: values(args, &mut test, &mut reference)?, ppd: args.ppd };
    metric::same_shape(&test.channels, &reference.channels).map_err(Failure::wrong)?;
    if reference.channels[0].pixels().is_empty() {
        return Err(Failure::wrong(format!(
            "{}: the image has no pixels",
            args.reference.display()
        )));
    }
    for (image, path) in [(&test, &args.test), (&reference, &args.reference)] {
        finite(image, path)?;
        left_out(image, path);
    }
    let score = |metric: &'static Metric| -> Scored {
        (metric, metric.value_seen(&test.channels, &reference.channels, &viewing))
    };
    let scores: Vec<Scored> = metrics.into_iter().map(score).collect();
    if args.json {
        print_json(&scores, out)?;
    } else {
        print(&scores, out)?;
    }
    if let Some(path) = &args.map {
        map::write(&args.map_kind, &test.channels, &reference.channels, &viewing, path)?;
    }
    let broken: Vec<String> = limits.iter().filter_map(|limit| limit.broken(score)).collect();
    broken.iter().for_each(tell);
    Ok(if broken.is_empty() { Exit::Done } else { Exit::Differs })
}

/// The metrics of these names; all if there are none.
fn asked_for(names: &[String]) -> Result<Vec<&'static Metric>, Failure> {
    if names.is_empty() {
        return Ok(metric::entries().iter().collect());
    }
    names.iter().map(|name| named(name)).collect()
}

/// The metric of this name.
fn named(name: &str) -> Result<&'static Metric, Failure> {
    metric::find(name).ok_or_else(|| {
        let known: Vec<&str> = metric::entries().iter().map(|m| m.name).collect();
        Failure::wrong(no_such("metric", name, &known))
    })
}

/// What the numbers of the two images are; decoded, if light is asked for.
fn values(
    args: &CompareArgs,
    test: &mut StoredImage,
    reference: &mut StoredImage,
) -> Result<Values, Failure> {
    let codings = [test.coding, reference.coding];
    if codings == [Coding::Linear; 2] {
        return Ok(Values::Radiances);
    }
    if args.encoding == "linear" {
        decode(test);
        decode(reference);
        return Ok(Values::Light);
    }
    if codings == [Coding::Display; 2] {
        return Ok(Values::Codes);
    }
    Err(Failure::wrong(format!(
        "{} holds {} and {} holds {}: compare like with like, or as light with --encoding linear",
        args.test.display(),
        coding(test.coding),
        args.reference.display(),
        coding(reference.coding)
    )))
}

fn decode(image: &mut StoredImage) {
    if image.coding == Coding::Display {
        for film in &mut image.channels {
            let light = film.pixels().iter().map(|code| srgb_light(f64::from(*code)) as f32);
            *film = Film::new(film.width(), film.height(), light.collect());
        }
    }
}

fn coding(coding: Coding) -> &'static str {
    match coding {
        Coding::Linear => "radiances",
        Coding::Display => "codes for a display",
    }
}

/// That all values are finite: of an image with another one no metric means anything.
fn finite(image: &StoredImage, path: &Path) -> Result<(), Failure> {
    let values = image.channels.iter().enumerate().flat_map(|(c, film)| {
        film.pixels().iter().enumerate().map(move |(i, value)| (c, i, *value))
    });
    let mut bad = values.filter(|(.., value)| !value.is_finite());
    let Some((channel, i, value)) = bad.next() else { return Ok(()) };
    let width = image.channels[0].width();
    let all = image.channels.len() * image.channels[0].pixels().len();
    let name =
        if image.channels.len() == 1 { "the only channel" } else { ["R", "G", "B"][channel] };
    Err(Failure::failed(format!(
        "{}: {} of {all} values are not finite; the first is {value} in column {} and row {} (from 0) of {name}",
        path.display(),
        1 + bad.count(),
        i % width,
        i / width,
    )))
}

/// Says which channels of a file are not compared.
fn left_out(image: &StoredImage, path: &Path) {
    if !image.left_out.is_empty() {
        tell(format_args!("{}: not compared: {}", path.display(), image.left_out.join(", ")));
    }
}

/// JSON: the metrics that have a value.
fn print_json(scores: &[Scored], out: &mut dyn Write) -> std::io::Result<()> {
    let scores: serde_json::Map<String, serde_json::Value> = scores
        .iter()
        .filter_map(|(metric, value)| Some((metric.name.to_owned(), (*value)?.into())))
        .collect();
    writeln!(out, "{:#}", serde_json::Value::from(scores))
}

/// Two lines a metric: name, value and what it tells; its formula.
fn print(scores: &[Scored], out: &mut dyn Write) -> std::io::Result<()> {
    let dim = anstyle::Style::new().dimmed();
    for (metric, value) in scores {
        let value = value.map_or("—".to_owned(), |value| format!("{value:.9}"));
        writeln!(out, "{:<18} {value:>14}  {}", metric.name, metric.meaning)?;
        writeln!(out, "{dim}{:34} {}{dim:#}", "", metric.formula)?;
    }
    Ok(())
}
