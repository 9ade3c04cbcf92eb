//! `wrinkle fit`: Phong peaks for a measured distribution.

use std::io::{ErrorKind, Read, Write};
use std::path::Path;
use std::sync::atomic::Ordering;

use serde_json::json;

use super::Exit;
use super::args::FitArgs;
use super::exit::{Failure, tell};
use super::run::halt_on_interrupt;
use crate::file::write_whole;
use crate::fit::{self, Fit, GreedyOptions, Peak, Samples, Termination};
use crate::report;

/// The largest file that is read, bytes: some twenty million samples.
const MOST_BYTES: u64 = 1 << 30;

/// Fits the samples and prints the peaks.
pub(super) fn fit(args: &FitArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    if let Some(plot) = &args.plot {
        check_plot(plot)?;
    }
    let samples = Samples::parse(&read(&args.samples)?)
        .map_err(|error| Failure::wrong(format!("{}: {error}", args.samples.display())))?;
    let (asked, most) = (usize::from(args.max_peaks), samples.most_peaks());
    if most < asked {
        let count = samples.count();
        tell(format_args!(
            "{count} samples can tell {most} of {asked} peaks: a peak has four unknowns"
        ));
    }
    let options = GreedyOptions {
        max_peaks: asked.min(most),
        stop: args.stop,
        restarts: usize::from(args.restarts),
    };
    let halt = halt_on_interrupt();
    let halted = || halt.0.load(Ordering::Relaxed);
    let Some(fit) = fit::fit(&samples.distribution, &samples.directions, options, &halted) else {
        tell("interrupted");
        return Ok(Exit::Interrupted);
    };
    let fit = by_weight(fit);
    if let Some(plot) = &args.plot {
        let png = report::fit_plot(&samples.directions, &samples.distribution, &fit);
        let failed = |error| Failure::failed(format!("cannot write {}: {error}", plot.display()));
        write_whole(plot, &png).map_err(failed)?;
    }
    if args.json {
        writeln!(out, "{:#}", as_json(&fit, &samples, &options))?;
    } else {
        print(&fit, &samples, &options, out)?;
    }
    Ok(Exit::Done)
}

/// A plot that could not be written is refused before any work.
fn check_plot(plot: &Path) -> Result<(), Failure> {
    let png = plot.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
    if !png {
        return Err(Failure::wrong(format!("cannot write {}: name it .png", plot.display())));
    }
    let folder = plot.parent().filter(|folder| *folder != Path::new(""));
    match folder.filter(|folder| !folder.is_dir()) {
        None => Ok(()),
        Some(folder) => Err(Failure::wrong(format!(
            "cannot write {}: there is no folder {}",
            plot.display(),
            folder.display()
        ))),
    }
}

fn read(path: &Path) -> Result<String, Failure> {
    let fails = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => Failure::wrong(format!("there is no file {}", path.display())),
        ErrorKind::InvalidData => Failure::wrong(format!("{}: not a text", path.display())),
        _ => Failure::wrong(format!("{}: cannot read: {error}", path.display())),
    };
    let mut text = String::new();
    let file = std::fs::File::open(path).map_err(fails)?;
    let bytes = file.take(MOST_BYTES).read_to_string(&mut text).map_err(fails)?;
    if bytes as u64 == MOST_BYTES {
        return Err(Failure::wrong(format!("{}: larger than a gibibyte", path.display())));
    }
    Ok(text)
}

/// The peaks in order of their weight, 2πa / (n + 2): what they reflect in all.
fn by_weight(mut fit: Fit) -> Fit {
    fit.peaks.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
    fit
}

/// Over 2π, so that it does not overflow.
fn weight(peak: &Peak) -> f64 {
    peak.amplitude / (peak.exponent + 2.0)
}

fn as_json(fit: &Fit, samples: &Samples, options: &GreedyOptions) -> serde_json::Value {
    let peak = |p: &Peak| {
        json!({
            "amplitude": p.amplitude,
            "direction": [p.direction.x, p.direction.y, p.direction.z],
            "exponent": p.exponent,
        })
    };
    json!({
        "peaks": fit.peaks.iter().map(peak).collect::<Vec<_>>(),
        "cost": fit.cost,
        "rms": fit.rms,
        "max": fit.maximum,
        "termination": fit.termination.map(Termination::text),
        "met": fit.within(options.stop),
        "samples": samples.count(),
        "largest": samples.distribution.maximum(),
        "fitted": fit.fitted,
        "failures": fit.failures,
        "iterations": fit.iterations,
    })
}

/// A line a peak, and how good they are.
fn print(
    fit: &Fit,
    samples: &Samples,
    options: &GreedyOptions,
    out: &mut dyn Write,
) -> std::io::Result<()> {
    let bold = anstyle::Style::new().bold();
    writeln!(
        out,
        "{bold}{:>4}  {:>10}  {:>10}  {:>10}  {:>9}  {:>7}  direction{bold:#}",
        "peak", "amplitude", "exponent", "half width", "to normal", "share"
    )?;
    let total: f64 = fit.peaks.iter().map(|p| weight(p) / weight(&fit.peaks[0])).sum();
    for (i, peak) in fit.peaks.iter().enumerate() {
        let d = peak.direction;
        writeln!(
            out,
            "{:>4}  {:>10}  {:>10}  {:>9.2}°  {:>8.2}°  {:>5.1} %  {:.4} {:.4} {:.4}",
            i + 1,
            short(peak.amplitude),
            short(peak.exponent),
            half_width(peak.exponent),
            libm::acos(d.z.clamp(-1.0, 1.0)).to_degrees(),
            100.0 * weight(peak) / weight(&fit.peaks[0]) / total,
            d.x,
            d.y,
            d.z
        )?;
    }
    writeln!(out, "{}", verdict(fit, samples, options))
}

/// The angle, degrees, at which a peak falls to half: cosⁿα = ½.
fn half_width(exponent: f64) -> f64 {
    libm::acos(libm::exp(-std::f64::consts::LN_2 / exponent)).to_degrees()
}

/// Four significant digits.
fn short(value: f64) -> String {
    if !(1e-3..1e6).contains(&value) {
        return format!("{value:.3e}");
    }
    let decimals = 3.0 - libm::floor(libm::log10(value));
    format!("{value:.*}", decimals.max(0.0) as usize)
}

/// How well the stopping rule is met, and why it ended.
fn verdict(fit: &Fit, samples: &Samples, options: &GreedyOptions) -> String {
    let (rms, most, stop) = (100.0 * fit.rms, 100.0 * fit.maximum, 100.0 * options.stop);
    let left = format!(
        "What is left of the {} samples is {rms:.2} % of their rms, and {most:.2} % of the largest at most",
        samples.count()
    );
    let met = if fit.within(options.stop) {
        format!("both below {stop} %")
    } else if fit.failures > 0 {
        format!("not below {stop} %, but a peak more gave nothing better")
    } else if fit.fitted >= options.max_peaks {
        let peaks = if options.max_peaks == 1 { "peak" } else { "peaks" };
        format!("not below {stop} %, and there may be no more than {} {peaks}", options.max_peaks)
    } else {
        format!("not below {stop} %, but nothing sticks out that a peak more could take")
    };
    let nothing = match fit.fitted - fit.peaks.len() {
        0 => String::new(),
        1 => " One peak more came to nothing.".into(),
        more => format!(" {more} peaks more came to nothing."),
    };
    let ended = fit.termination.map_or("there was none", why);
    format!("{left}: {met}.{nothing} The last fit ended because {ended}.")
}

fn why(termination: Termination) -> &'static str {
    match termination {
        Termination::SmallGradient => "no small change of the peaks makes it better",
        Termination::SmallStep => "a further step would not have changed the peaks",
        Termination::SmallCost => "nothing measurable was left",
        Termination::Stalled => "a step made it better by less than 0.01 %",
        Termination::IterationLimit => "it had made as many steps as it may",
        Termination::Cancelled => "it was told to",
        Termination::NotFinite => "its start has no finite cost",
    }
}
