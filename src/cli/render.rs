//! `wrinkle render`: one image, of an experiment or of a map of the user's own.

use std::io::Write;
use std::path::Path;

use super::Exit;
use super::args::RenderArgs;
use super::exit::Failure;
use super::experiments;
use super::progress::Spinner;
use crate::experiment::preview::{self, Wish};
use crate::experiment::spec::{Spec, no_such};
use crate::method;

/// Renders the image asked for and writes it.
pub(super) fn render(args: &RenderArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    let format = args.out.extension().map(|e| e.to_string_lossy().to_lowercase());
    let png = match format.as_deref() {
        Some("png") => true,
        Some("exr") => false,
        _ => {
            let message = format!("cannot write {}: name it .png or .exr", args.out.display());
            return Err(Failure::wrong(message));
        }
    };
    let folder = args.out.parent().filter(|folder| *folder != Path::new(""));
    if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
        let message =
            format!("cannot write {}: there is no folder {}", args.out.display(), folder.display());
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
        spp: args.spp,
    };
    let spinner = Spinner::new(&args.method);
    let film = preview::render_one(&spec, method.as_ref(), &wish, &spinner);
    drop(spinner);
    let film = film.map_err(Failure::wrong)?;
    let exposure = args.exposure.unwrap_or_else(|| 1.0 / film.white());
    let written = if png { film.write_png(exposure, &args.out) } else { film.write_exr(&args.out) };
    written.map_err(Failure::failed)?;
    writeln!(out, "{}", args.out.display())?;
    Ok(Exit::Done)
}

/// The experiment, or one made about the image file.
fn spec(args: &RenderArgs) -> Result<Spec, Failure> {
    let path = Path::new(&args.file);
    let is_toml = path.extension().is_some_and(|e| e == "toml");
    let is_image = path.extension().is_some_and(|e| {
        let e = e.to_string_lossy().to_lowercase();
        ["png", "tif", "tiff", "webp", "exr", "hdr"].contains(&e.as_str())
    });
    let mut spec = if is_image || (path.is_file() && !is_toml) {
        if !path.is_file() {
            return Err(Failure::wrong(format!("there is no file {}", path.display())));
        }
        Spec::parse(&about_image(args), Path::new("render.toml")).map_err(Failure::wrong)?
    } else {
        experiments::load_sweep(&args.file)?
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
