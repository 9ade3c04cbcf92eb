//! `wrinkle render`: one image, or an animation, of an experiment, of a map of the user's own, of a pattern, or of a
//! multiple surface.

use std::io::Write;

use super::args::RenderArgs;
use super::exit::{Failure, tell};
use super::progress::Spinner;
use super::surface::{self, Wanted};
use super::{Exit, draft, output};
use crate::experiment::preview::{self, Frames, Wish};
use crate::experiment::spec::{ImageSpec, no_such};
use crate::render::{Film, Portrait};
use crate::{file, method, report};

/// Most pixels of all frames of an animation.
const MOST: usize = 1 << 28;

/// Renders what is asked for and writes it.
pub(super) fn render(args: &RenderArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    let png = output::ending(&args.out, &["png", "exr"])? == "png";
    match surface::wanted(&args.file)? {
        Some(wanted) => write_image(args, png, &portrait(args, &wanted)?)?,
        None => of_bumps(args, png)?,
    }
    writeln!(out, "{}", args.out.display())?;
    Ok(Exit::Done)
}

fn write_image(args: &RenderArgs, png: bool, film: &Film) -> Result<(), Failure> {
    let exposure = args.exposure.unwrap_or_else(|| 1.0 / film.white());
    let written = if png { film.write_png(exposure, &args.out) } else { film.write_exr(&args.out) };
    written.map_err(Failure::failed)
}

/// All frames on one exposure: that of the brightest.
fn write_animation(args: &RenderArgs, films: &[Film], fps: u32) -> Result<(), Failure> {
    let brightest = films.iter().map(Film::white).fold(0.0, f64::max);
    let white = args.exposure.map_or(brightest, |exposure| 1.0 / exposure);
    let films: Vec<&Film> = films.iter().collect();
    let bytes = report::animated(&films, white, fps);
    file::write_whole(&args.out, &bytes)
        .map_err(|error| Failure::failed(format!("cannot write {}: {error}", args.out.display())))
}

/// A multiple surface without a map, on a sphere or a plane.
fn portrait(args: &RenderArgs, wanted: &Wanted) -> Result<Film, Failure> {
    let unused = [
        (args.method != "unfiltered", "--method"),
        (args.texture.is_some(), "--texture"),
        (args.texels_per_pixel.is_some(), "--texels-per-pixel"),
        (args.animate.is_some(), "--animate"),
        (!args.set.is_empty(), "--set"),
    ];
    if let Some((_, option)) = unused.iter().find(|(given, _)| *given) {
        let message =
            format!("{} is a multiple surface without a map: leave out {option}", args.file);
        return Err(Failure::wrong(message));
    }
    let (width, height) = args.size.unwrap_or((640, 480));
    let usual = match args.shape.as_deref() {
        None | Some("sphere") => Portrait::sphere(width, height),
        Some("plane") => Portrait::plane(width, height),
        Some(other) => {
            let message = format!("a multiple surface covers a sphere or a plane, no {other}");
            return Err(Failure::wrong(message));
        }
    };
    Ok(Portrait { spp: args.spp.unwrap_or(usual.spp), ..usual }.of(wanted.surface()))
}

/// A map, a pattern, or a texture of an experiment, through a filter.
fn of_bumps(args: &RenderArgs, png: bool) -> Result<(), Failure> {
    let method = method::build(&args.method).ok_or_else(|| {
        let known: Vec<&str> = method::entries().iter().map(|e| e.card.name).collect();
        Failure::wrong(no_such("method", &args.method, &known))
    })?;
    let spec = draft::spec(args)?;
    let wish = Wish {
        texture: args.texture.as_deref(),
        texels_per_pixel: args.texels_per_pixel,
        spp: args.spp.unwrap_or(1),
        frame: 0,
    };
    let motion = spec.motion.filter(|_| args.animate.is_some());
    if motion.is_some() && !png {
        return Err(Failure::wrong("an EXR file holds one image: --animate writes PNG"));
    }
    let count = motion.map_or(1, |motion| motion.frames);
    let ImageSpec { width, height } = spec.image;
    if width * height * count as usize > MOST {
        let message = format!(
            "{count} frames of {width}x{height} are more than the {MOST} pixels an animation may have: lower --size or \
             --set motion.frames"
        );
        return Err(Failure::wrong(message));
    }
    let spinner = Spinner::new(&args.method);
    let rendered = |frames| spinner.rendered(frames, count);
    let frames = preview::render_frames(&spec, method.as_ref(), &wish, count, &spinner, &rendered);
    drop(spinner);
    let Frames { films, notes } = frames.map_err(Failure::wrong)?;
    notes.iter().for_each(|note| tell(format_args!("note: {note}")));
    match (motion, films.as_slice()) {
        (Some(motion), films) => write_animation(args, films, motion.fps),
        (None, [film, ..]) => write_image(args, png, film),
        (None, []) => Err(Failure::failed("there is no frame")),
    }
}
