//! `wrinkle render`: one image, of an experiment, of a map of the user's own, or of a multiple surface.

use std::io::Write;
use std::path::Path;

use super::Exit;
use super::args::RenderArgs;
use super::exit::Failure;
use super::output;
use super::progress::Spinner;
use super::surface::{self, Wanted};
use crate::experiment::preview::{self, Wish};
use crate::experiment::spec::{Spec, no_such};
use crate::job;
use crate::method;
use crate::render::{Film, Portrait};

/// Renders the image asked for and writes it.
pub(super) fn render(args: &RenderArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    let png = output::ending(&args.out, &["png", "exr"])? == "png";
    let film = match surface::wanted(&args.file)? {
        Some(wanted) => portrait(args, &wanted)?,
        None => of_map(args)?,
    };
    let exposure = args.exposure.unwrap_or_else(|| 1.0 / film.white());
    let written = if png { film.write_png(exposure, &args.out) } else { film.write_exr(&args.out) };
    written.map_err(Failure::failed)?;
    writeln!(out, "{}", args.out.display())?;
    Ok(Exit::Done)
}

/// A multiple surface without a map, on a sphere or a plane.
fn portrait(args: &RenderArgs, wanted: &Wanted) -> Result<Film, Failure> {
    let unused = [
        (args.method != "unfiltered", "--method"),
        (args.texture.is_some(), "--texture"),
        (args.texels_per_pixel.is_some(), "--texels-per-pixel"),
    ];
    if let Some((_, option)) = unused.iter().find(|(given, _)| *given) {
        let message =
            format!("{} is a multiple surface without a map: leave out {option}", args.file);
        return Err(Failure::wrong(message));
    }
    let (width, height) = args.size.unwrap_or((640, 480));
    let usual = match args.shape.as_deref() {
        Some("plane") => Portrait::plane(width, height),
        _ => Portrait::sphere(width, height),
    };
    Ok(Portrait { spp: args.spp.unwrap_or(usual.spp), ..usual }.of(wanted.surface()))
}

/// A map, or a texture of an experiment, through a filter.
fn of_map(args: &RenderArgs) -> Result<Film, Failure> {
    if args.shape.is_some() {
        let message =
            "--shape is for a multiple surface; an experiment says its own under [surface]";
        return Err(Failure::wrong(message));
    }
    let method = method::build(&args.method).ok_or_else(|| {
        let known: Vec<&str> = method::entries().iter().map(|e| e.card.name).collect();
        Failure::wrong(no_such("method", &args.method, &known))
    })?;
    let spec = spec(args)?;
    let wish = Wish {
        texture: args.texture.as_deref(),
        texels_per_pixel: args.texels_per_pixel,
        spp: args.spp.unwrap_or(1),
    };
    let spinner = Spinner::new(&args.method);
    preview::render_one(&spec, method.as_ref(), &wish, &spinner).map_err(Failure::wrong)
}

/// The experiment, or one made about the image file.
fn spec(args: &RenderArgs) -> Result<Spec, Failure> {
    let path = Path::new(&args.file);
    let is_toml = path.extension().is_some_and(|e| e == "toml");
    let mut spec = if job::is_image(path) || (path.is_file() && !is_toml) {
        if !path.is_file() {
            return Err(Failure::wrong(format!("there is no file {}", path.display())));
        }
        Spec::parse(&about_image(args), Path::new("render.toml")).map_err(Failure::wrong)?
    } else {
        job::load_sweep(&args.file).map_err(Failure::wrong)?
    };
    if let Some((width, height)) = args.size {
        (spec.image.width, spec.image.height) = (width, height);
    }
    Ok(spec)
}

/// A spec with the image as its one texture and the defaults for all else.
fn about_image(args: &RenderArgs) -> String {
    let mut texture = toml::Table::new();
    texture.insert("file".into(), args.file.clone().into());
    texture.insert("kind".into(), args.kind.clone().into());
    if args.kind == "height" {
        texture.insert("height_scale".into(), args.height_scale.into());
    } else {
        texture.insert("green".into(), args.green.clone().into());
    }
    let list = |word: &str| toml::Value::Array(vec![word.into()]);
    let mut spec = toml::toml! {
        [image]
        width = 640
        height = 480
        [sweep]
        texels_per_pixel = [4.0]
    };
    if let Some(toml::Value::Table(sweep)) = spec.get_mut("sweep") {
        sweep.insert("texture".into(), list("map"));
        sweep.insert("method".into(), list("unfiltered"));
        sweep.insert("spp".into(), toml::Value::Array(vec![1.into()]));
    }
    let mut textures = toml::Table::new();
    textures.insert("map".into(), texture.into());
    spec.insert("texture".into(), textures.into());
    spec.to_string()
}
