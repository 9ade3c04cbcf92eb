//! `wrinkle lobes`: what a multiple surface reflects.

use std::io::Write;

use serde_json::json;

use super::Exit;
use super::args::LobesArgs;
use super::exit::Failure;
use super::output;
use super::surface::{Wanted, wanted};
use crate::evidence::{Disc, LobePlot, Reflection};
use crate::experiment::spec::no_such;
use crate::file::write_whole;
use crate::geometry::HemisphereGrid;
use crate::lobe::{Shading, named, reflection};
use crate::report::lobe_sheet;

/// Most directions of incidence: as many as there are colours.
const INCIDENCES: usize = 7;
/// Most planes of incidence.
const PLANES: usize = 16;

/// Draws the surface asked for, or prints it.
pub(super) fn lobes(args: &LobesArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    for (what, count, most) in [
        ("--incidence", args.incidence.len(), INCIDENCES),
        ("--azimuth", args.azimuth.len(), PLANES),
    ] {
        if count > most {
            return Err(Failure::wrong(format!("{what} has {count} angles: give at most {most}")));
        }
    }
    if let Some(path) = &args.out {
        output::ending(path, &["png"])?;
    }
    let found = wanted(&args.surface)?.ok_or_else(|| {
        let known: Vec<&str> = named().iter().map(|surface| surface.name).collect();
        Failure::wrong(format!(
            "{}; a file of peaks ends in .json",
            no_such("multiple surface", &args.surface, &known)
        ))
    })?;
    let shading = match args.shading.as_str() {
        "microfacet" => Shading::Microfacet,
        _ => Shading::Ndf,
    };
    let plots: Vec<LobePlot> =
        args.azimuth.iter().map(|a| plot(&found, shading, *a, args)).collect();
    if let Some(path) = &args.out {
        let failed = |error| Failure::failed(format!("cannot write {}: {error}", path.display()));
        write_whole(path, &lobe_sheet(&distribution(&found), &plots)).map_err(failed)?;
    }
    if args.json {
        writeln!(out, "{:#}", as_json(&found, shading, &plots))?;
    } else if let Some(path) = &args.out {
        writeln!(out, "{}", path.display())?;
    }
    Ok(Exit::Done)
}

fn plot(found: &Wanted, shading: Shading, azimuth: f64, args: &LobesArgs) -> LobePlot {
    let surface = found.surface();
    let of = |&incidence: &f64| Reflection {
        incidence,
        exits: reflection(&surface, shading, incidence, azimuth),
    };
    let reflections = args.incidence.iter().map(of).collect();
    LobePlot { label: found.label.clone(), azimuth, reflections }
}

fn distribution(found: &Wanted) -> Disc {
    let surface = found.surface();
    let toward = |w: crate::geometry::Vec3| surface.density([w.x as f32, w.y as f32, w.z as f32]);
    let grid = HemisphereGrid::fournier();
    let count = found.peaks.len();
    Disc {
        label: "normals".into(),
        remark: format!("{count} {}", if count == 1 { "peak" } else { "peaks" }),
        density: grid.samples().iter().map(|s| f64::from(toward(s.direction))).collect(),
        peaks: found.peaks.iter().map(|peak| peak.direction.map(f64::from)).collect(),
        own_scale: false,
    }
}

fn as_json(found: &Wanted, shading: Shading, plots: &[LobePlot]) -> serde_json::Value {
    let peak = |p: &crate::lobe::PhongPeak| {
        json!({
            "amplitude": p.amplitude, "direction": p.direction, "exponent": p.exponent,
        })
    };
    json!({
        "surface": found.label,
        "shading": shading,
        "peaks": found.peaks.iter().map(peak).collect::<Vec<_>>(),
        "plots": plots,
    })
}
