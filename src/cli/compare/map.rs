//! Error maps: the error of each pixel, the mean of its channels.

use std::path::Path;

use super::Failure;
use crate::cli::exit::tell;
use crate::metric::{self, Viewing};
use crate::render::{Film, percentile, write_colours};
use crate::report::{magnitude, perceived, signed};

/// ε of the relative error: the same as that of the metric `mape`.
const DIM: f64 = 0.1;

/// Writes a map of this kind; says which error the last colour of a PNG stands for.
pub(super) fn write(
    kind: &str,
    test: &[Film],
    reference: &[Film],
    viewing: &Viewing,
    path: &Path,
) -> Result<(), Failure> {
    let errors = errors(kind, test, reference, viewing)?;
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr")) {
        return errors.write_exr(path).map_err(Failure::failed);
    }
    let most = match kind {
        "flip" | "relative" => 1.0,
        _ => brightest(&errors),
    };
    let colour = match kind {
        "signed" => signed,
        "flip" => perceived,
        _ => magnitude,
    };
    let colours: Vec<[u8; 3]> =
        errors.pixels().iter().map(|error| colour(f64::from(*error) / most)).collect();
    write_colours(errors.width(), &colours, path).map_err(Failure::failed)?;
    tell(format_args!("{}: {kind} error, the last colour from {most:.6} on", path.display()));
    Ok(())
}

/// What 99.5 % of the errors do not exceed in size; 1 of equal images.
fn brightest(errors: &Film) -> f64 {
    let found = percentile(errors.pixels().iter().map(|error| error.abs()));
    if found > 0.0 { found } else { 1.0 }
}

/// The error of each pixel.
fn errors(
    kind: &str,
    test: &[Film],
    reference: &[Film],
    viewing: &Viewing,
) -> Result<Film, Failure> {
    let (width, height) = (reference[0].width(), reference[0].height());
    if kind == "flip" {
        let field = metric::find("flip").and_then(|flip| flip.field(test, reference, viewing));
        let field = field.ok_or_else(|| Failure::wrong("FLIP has no map of these images"))?;
        return Ok(Film::new(width, height, field.values.iter().map(|v| *v as f32).collect()));
    }
    let epsilon = DIM * mean(reference);
    let error = |a: f64, r: f64| match kind {
        "signed" => a - r,
        // Of two zeros, 0.
        "relative" if a == r => 0.0,
        "relative" => (a - r).abs() / (r.abs() + epsilon),
        _ => (a - r).abs(),
    };
    let at = |i: usize| {
        let pairs = test.iter().zip(reference);
        let sum: f64 =
            pairs.map(|(a, r)| error(f64::from(a.pixels()[i]), f64::from(r.pixels()[i]))).sum();
        (sum / reference.len() as f64) as f32
    };
    Ok(Film::new(width, height, (0..width * height).map(at).collect()))
}

fn mean(image: &[Film]) -> f64 {
    let count: usize = image.iter().map(|film| film.pixels().len()).sum();
    let sum: f64 = image.iter().flat_map(Film::pixels).map(|p| f64::from(*p)).sum();
    sum / count.max(1) as f64
}
