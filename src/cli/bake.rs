//! `wrinkle bake`: a normal map synthesised from a distribution of normals, or laid onto one that is there.

use std::io::Write;
use std::path::Path;

use super::Exit;
use super::args::BakeArgs;
use super::exit::{Failure, tell};
use super::output;
use crate::lobe::{Measure, NdfImage};
use crate::pattern::baked::{Baked, Ground, MapFile, NdfSource, OntoMap, Recipe};
use crate::pattern::file::Reading;
use crate::synthesis::Agreement;
use crate::texture::Wrap;
use crate::texture::image_file::{
    Codes, Green, HeightReading, NormalReading, write_normal_map_exr, write_normal_map_png,
    write_values_exr, write_values_png,
};

/// Texels of a map if nothing else is said.
const SIZE: [usize; 2] = [1024; 2];
/// Squares a side in which baked normals are held against their NDF.
const SQUARES: usize = 32;

/// Bakes the map asked for and writes it.
pub(super) fn bake(args: &BakeArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    for path in args.out.iter().chain(&args.ndf_out) {
        output::ending(path, &["png", "exr"])?;
    }
    match &args.out {
        Some(path) => {
            let baked = recipe(args)?.bake().map_err(Failure::wrong)?;
            baked.notes.iter().for_each(|note| tell(format_args!("note: {note}")));
            write(args, path, &baked)?;
            write_ndf(args, &baked.ndf)?;
            tell_of(args, path, &baked, out)?;
        }
        None => write_ndf(args, &distribution(args)?)?,
    }
    if let (false, Some(path)) = (args.json, &args.ndf_out) {
        writeln!(out, "{}: the distribution", path.display())?;
    }
    Ok(Exit::Done)
}

/// What was asked for.
fn recipe(args: &BakeArgs) -> Result<Recipe, Failure> {
    let ndf = source(args)?;
    let size = args.size.map(|(width, height)| [width, height]);
    let ground = match (&args.onto, ndf) {
        (Some(path), ndf) => Ground::Onto {
            map: map_file(path, args),
            ndf,
            amount: args.amount,
            floor: args.floor,
            size,
        },
        (None, Some(ndf)) => Ground::Bare { ndf, size: size.unwrap_or(SIZE) },
        (None, None) => {
            return Err(Failure::wrong(
                "say which distribution: a lobe, an image of one, or --like a map; or --onto which map",
            ));
        }
    };
    let (cells, octaves) = (args.cells, args.octaves);
    Ok(Recipe { ground, cells, octaves, gain: args.gain, seed: args.seed })
}

/// The distribution that was told of, if any.
fn source(args: &BakeArgs) -> Result<Option<NdfSource>, Failure> {
    let measure = if args.measure == "solid-angle" { Measure::SolidAngle } else { Measure::Map };
    match (&args.ndf, &args.like) {
        (Some(word), _) => {
            NdfSource::parse(word, Path::new(""), measure).map(Some).map_err(Failure::wrong)
        }
        (None, Some(like)) => Ok(Some(NdfSource::Map(map_file(like, args)))),
        (None, None) => Ok(None),
    }
}

/// The distribution alone, where no map is to be written.
fn distribution(args: &BakeArgs) -> Result<NdfImage, Failure> {
    let own = args.onto.as_ref().map(|path| NdfSource::Map(map_file(path, args)));
    match source(args)?.or(own) {
        Some(source) => source.read().map_err(Failure::wrong),
        None => Err(Failure::wrong("say which distribution")),
    }
}

/// A map of the user's, read as was told.
fn map_file(path: &Path, args: &BakeArgs) -> MapFile {
    let wrap = if args.wrap == "clamp" { Wrap::Clamp } else { Wrap::Repeat };
    let green = green(&args.map_green);
    let reading = match args.kind.as_str() {
        "height" => Reading::Heights(HeightReading { height_scale: args.height_scale, wrap }),
        _ => Reading::Normals(NormalReading { green, wrap, ..NormalReading::default() }),
    };
    MapFile { path: path.to_owned(), reading }
}

fn green(word: &str) -> Green {
    if word == "down" { Green::Down } else { Green::Up }
}

fn write(args: &BakeArgs, path: &Path, baked: &Baked) -> Result<(), Failure> {
    let codes = if args.bits == "8" { Codes::Eight } else { Codes::Sixteen };
    let written = match is_png(path) {
        true => write_normal_map_png(path, &baked.normals, codes, green(&args.green)),
        false => write_normal_map_exr(path, &baked.normals, green(&args.green)),
    };
    written.map_err(Failure::failed)
}

/// The distribution as a picture that `bake` reads back.
fn write_ndf(args: &BakeArgs, ndf: &NdfImage) -> Result<(), Failure> {
    let Some(path) = &args.ndf_out else { return Ok(()) };
    let rows = ndf.values().chunks(ndf.side()).rev();
    let values: Vec<f32> = rows.flatten().copied().collect();
    let size = (ndf.side(), ndf.side());
    let written = match is_png(path) {
        true => write_values_png(path, size, &values),
        false => write_values_exr(path, size, &values),
    };
    written.map_err(Failure::failed)
}

fn is_png(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"))
}

/// Says what was written, how well it follows the distribution, and what it did to the map it is laid onto.
fn tell_of(
    args: &BakeArgs,
    path: &Path,
    baked: &Baked,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let Baked { normals, ndf, cells, octaves, onto, .. } = baked;
    let directions = normals.texels().iter().map(|t| [t[0], t[1], t[2]]);
    let apart = Agreement::of(ndf, directions, SQUARES).total_variation;
    let (width, height) = (normals.width(), normals.height());
    if args.json {
        let mut told = serde_json::json!({
            "out": path, "width": width, "height": height, "cells": cells, "octaves": octaves,
            "seed": args.seed, "total_variation": apart,
        });
        if let Some(OntoMap { size, tilt, missed }) = onto {
            told["onto"] = serde_json::json!({
                "map": args.onto, "width": size[0], "height": size[1], "amount": args.amount,
                "rms_tilt_degrees": tilt[0], "rms_tilt_with_detail_degrees": tilt[1],
                "rms_missed_degrees": missed.rms, "most_missed_degrees": missed.most,
            });
        }
        writeln!(out, "{told:#}")?;
        return Ok(());
    }
    let s = if *octaves == 1.0 { "" } else { "s" };
    let what = format!("{}: {width}x{height}, {octaves} octave{s}", path.display());
    let map = args.onto.as_deref().unwrap_or(Path::new("")).display();
    match onto {
        None => writeln!(
            out,
            "{what}; {:.1} % of its normals lie where the distribution has others",
            100.0 * apart
        )?,
        Some(OntoMap { size, tilt, missed }) => writeln!(
            out,
            "{what} of amount {} onto {map} ({}x{}); RMS tilt {:.2}° before, {:.2}° with detail; without detail normals \
             come back to {:.1e}° (RMS)",
            args.amount, size[0], size[1], tilt[0], tilt[1], missed.rms
        )?,
    }
    Ok(())
}
