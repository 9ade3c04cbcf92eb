//! Writes the README's picture and what stands under it: `cargo run --release --example readme`.
//!
//! It runs `denim-ball.toml` afresh, writes docs/images/, and puts its findings between the README's
//! marks. tests/readme.rs does the same and holds the files to it.

use std::fmt::Write;
use std::path::Path;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use wrinkle::experiment::results::{Results, SceneResult};
use wrinkle::experiment::runner::{Outcome, run, unwatched};
use wrinkle::experiment::spec::Spec;
use wrinkle::render::{Film, heat, percentile, srgb};
use wrinkle::scene::Halt;

type Error = Box<dyn std::error::Error>;

const BEGIN: &str = "<!-- found: begin -->\n";
const END: &str = "<!-- found: end -->";
/// Pixels between an image and its error.
const GAP: usize = 4;

/// The run, with its records in `scratch`.
pub fn results(root: &Path, scratch: &Path) -> Result<Results, Error> {
    let spec = Spec::load(&root.join("examples/readme/denim-ball.toml"))?;
    match run(&spec, scratch, &Halt::default(), &unwatched())? {
        Outcome::Finished(found) => Ok(found.0),
        Outcome::Halted => Err("halted".into()),
    }
}

/// The films of a scene in the README's order, by name, and what to say of their error.
fn columns(scene: &SceneResult) -> Vec<(&str, &Film, String)> {
    let trials = scene.trials.iter().filter(|trial| trial.spp == 1);
    let mut all: Vec<_> = trials
        .map(|t| {
            let error = t.score("rmse").map_or(String::new(), |e| format!("RMSE {e:.3}"));
            (t.method.as_str(), t.film.as_ref(), error)
        })
        .collect();
    let truth = &scene.reference;
    let error = format!("{} samples, ± {:.3}", truth.spp, truth.rmse);
    all.push(("reference", truth.film.as_ref(), error));
    all
}

/// The README's pictures: a name in docs/images/ and the bytes of a PNG file, image above error.
pub fn pictures(results: &Results) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let scene = results.scenes.first().ok_or("a run without a scene")?;
    let truth = &scene.reference.film;
    let exposure = 1.0 / truth.white();
    let errors = |film: &Film| -> Vec<f32> {
        film.pixels().iter().zip(truth.pixels()).map(|(a, b)| (a - b).abs()).collect()
    };
    // One scale for all: what the best of the filters has at most.
    let largest = |film: &Film| percentile(errors(film).into_iter());
    let filtered = columns(scene).into_iter().filter(|(name, ..)| *name != "reference");
    let full = filtered.map(|(_, film, _)| largest(film)).fold(f64::INFINITY, f64::min);
    columns(scene)
        .into_iter()
        .map(|(name, film, _)| {
            let (width, height) = (film.width(), film.height());
            let grey = film.pixels().iter().flat_map(|p| [srgb(f64::from(*p) * exposure); 3]);
            let white = std::iter::repeat_n(255, 3 * width * GAP);
            let error = errors(film);
            let colours = error.iter().flat_map(|e| heat(f64::from(*e) / full));
            let bytes: Vec<u8> = grey.chain(white).chain(colours).collect();
            let image = image::RgbImage::from_raw(width as u32, (2 * height + GAP) as u32, bytes)
                .ok_or("the shape of a picture")?;
            let mut png = Vec::new();
            let (best, adaptive) = (CompressionType::Best, FilterType::Adaptive);
            image.write_with_encoder(PngEncoder::new_with_quality(&mut png, best, adaptive))?;
            Ok((format!("{name}.png"), png))
        })
        .collect()
}

/// What stands between the README's marks.
pub fn found(results: &Results) -> Result<String, Error> {
    let scene = results.scenes.first().ok_or("a run without a scene")?;
    let columns = columns(scene);
    let mut text = String::new();
    let mut row = |cell: &dyn Fn(&(&str, &Film, String)) -> String| {
        let cells: Vec<String> = columns.iter().map(cell).collect();
        writeln!(text, "| {} |", cells.join(" | "))
    };
    row(&|(name, ..)| (*name).to_owned())?;
    row(&|_| ":-:".to_owned())?;
    row(&|(name, ..)| format!("![{name}](docs/images/{name}.png)"))?;
    row(&|(.., error)| error.clone())?;
    text.push('\n');
    text += &sentences(scene)?;
    text.push('\n');
    Ok(text)
}

/// Which filter came closest, and how plain shading fares with more samples.
fn sentences(scene: &SceneResult) -> Result<String, Error> {
    let rmse = |method: &str, spp| {
        let trial = scene.trials.iter().find(|t| t.method == method && t.spp == spp)?;
        trial.score("rmse")
    };
    let one_sample = scene
        .trials
        .iter()
        .filter(|t| t.spp == 1)
        .filter_map(|t| Some((t.method.as_str(), rmse(&t.method, 1)?)));
    let (best, error) = one_sample.min_by(|a, b| a.1.total_cmp(&b.1)).ok_or("no scores")?;
    let plain = rmse("unfiltered", 1).ok_or("no unfiltered image")?;
    let more: Vec<String> = scene
        .trials
        .iter()
        .filter(|t| t.method == "unfiltered" && t.spp > 1)
        .filter_map(|t| Some(format!("{:.3} at {}", rmse("unfiltered", t.spp)?, t.spp)))
        .collect();
    Ok(format!(
        "Here `{best}` comes closest: its error is {:.1} times smaller than that of plain shading at \
         the same one sample a pixel. Plain shading with more has RMSE {}.\n",
        plain / error,
        more.join(", "),
    ))
}

/// The README with `found` between its marks.
pub fn filled(readme: &str, found: &str) -> Result<String, Error> {
    let (before, rest) = readme.split_once(BEGIN).ok_or("the README has lost its first mark")?;
    let (_, after) = rest.split_once(END).ok_or("the README has lost its last mark")?;
    Ok(format!("{before}{BEGIN}{found}{END}{after}"))
}

#[allow(dead_code, reason = "tests include this file")]
fn main() -> Result<(), Error> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let scratch = tempfile::tempdir()?;
    let results = results(root, scratch.path())?;
    let images = root.join("docs/images");
    std::fs::create_dir_all(&images)?;
    for (name, png) in pictures(&results)? {
        std::fs::write(images.join(name), png)?;
    }
    let path = root.join("README.md");
    let readme = std::fs::read_to_string(&path)?;
    std::fs::write(&path, filled(&readme, &found(&results)?)?)?;
    println!("{}", path.display());
    Ok(())
}
