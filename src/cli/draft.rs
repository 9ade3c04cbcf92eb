//! The spec that `render` renders: an experiment's, or one made about a map or a pattern, with the options and settings
//! of the command line laid over it.

use std::path::Path;

use toml::{Table, Value};

use super::args::RenderArgs;
use super::exit::Failure;
use crate::experiment::spec::draft::{absolute, told};
use crate::experiment::spec::{Draft, Setting, Spec};
use crate::{job, pattern};

/// Width and height of images that nothing says the size of.
const SIZE: (usize, usize) = (640, 480);

/// The spec asked for.
pub(super) fn spec(args: &RenderArgs) -> Result<Spec, Failure> {
    let mut draft = draft(args)?;
    let mut settings = Vec::new();
    if let Some(shape) = &args.shape {
        draft.put_on(shape).map_err(Failure::wrong)?;
        settings.extend(option("shape", shape));
    }
    if let Some((width, height)) = args.size {
        draft.set("image", "width", width as i64);
        draft.set("image", "height", height as i64);
    }
    if let Some(kind) = &args.animate {
        move_by(&mut draft, kind.as_deref());
    }
    for setting in &args.set {
        draft.change(setting).map_err(Failure::wrong)?;
    }
    if args.animate.is_some() {
        fill_in(&mut draft);
    }
    if args.shape.as_ref().is_some_and(|shape| shape != "plane") {
        draft.stand_aside();
    }
    settings.extend(args.set.iter().cloned());
    draft.read().map_err(|errors| Failure::wrong(told(&errors, &settings)))
}

/// What an option of the command line says, as a setting, so that messages can name it.
fn option(key: &str, value: &str) -> Option<Setting> {
    format!("{key}={value}").parse().ok()
}

/// An experiment as it is, or the default scene about a map or a pattern.
fn draft(args: &RenderArgs) -> Result<Draft, Failure> {
    let path = Path::new(&args.file);
    let is_toml = path.extension().is_some_and(|e| e == "toml");
    let texture = if job::is_image(path) || (path.is_file() && !is_toml) {
        ("map", map(args)?)
    } else if let Some(entry) = pattern::find(&args.file) {
        (entry.card.name, Table::from_iter([("pattern".to_owned(), entry.card.name.into())]))
    } else {
        return job::draft(&args.file).map_err(Failure::wrong);
    };
    let mut draft = Draft::of_texture(texture.0, texture.1, Path::new("render.toml"));
    draft.set("image", "width", SIZE.0 as i64);
    draft.set("image", "height", SIZE.1 as i64);
    Ok(draft)
}

/// What a spec says of the image file.
fn map(args: &RenderArgs) -> Result<Table, Failure> {
    let file = absolute(Path::new(&args.file)).map_err(Failure::wrong)?;
    let mut texture = Table::new();
    texture.insert("file".into(), file.into());
    texture.insert("kind".into(), args.kind.clone().into());
    if args.kind == "height" {
        texture.insert("height_scale".into(), args.height_scale.into());
    } else {
        texture.insert("green".into(), args.green.clone().into());
    }
    Ok(texture)
}

/// The motion that was asked for: the experiment's own if none was, or if it moves in that way already.
fn move_by(draft: &mut Draft, kind: Option<&str>) {
    let now = draft.table.get("motion").map(|motion| motion.get("kind").and_then(Value::as_str));
    if now.is_some() && (kind.is_none() || now.flatten() == kind) {
        return;
    }
    draft.table.insert("motion".into(), Table::new().into());
    draft.set("motion", "kind", kind.unwrap_or("rotate"));
}

/// How far things move where neither the experiment nor a setting says: once round, one step short of where they
/// began, so that an animation goes on without a halt; or from and to four times as far away as the camera is.
fn fill_in(draft: &mut Draft) {
    let number = |draft: &Draft, table: &str, key: &str| {
        let value = draft.table.get(table)?.get(key)?;
        value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
    };
    let Some(motion) = draft.table.get("motion").and_then(Value::as_table) else { return };
    let said = |key: &str| motion.contains_key(key);
    let mut missing = Vec::new();
    match motion.get("kind").and_then(Value::as_str) {
        Some("rotate" | "light") if !said("degrees") => {
            let frames = number(draft, "motion", "frames").unwrap_or(24.0).max(2.0);
            missing.push(("degrees", 360.0 - 360.0 / frames));
        }
        Some(kind @ ("approach" | "recede")) if !said("to") => {
            let near = number(draft, "camera", "distance").unwrap_or(4.0);
            let [from, to] =
                if kind == "approach" { [4.0 * near, near] } else { [near, 4.0 * near] };
            missing.push(("to", to));
            if !said("from") {
                missing.push(("from", from));
            }
        }
        _ => {}
    }
    for (key, value) in missing {
        draft.set("motion", key, value);
    }
}
