//! FLIP: how different two pictures look to someone who flips between them (Andersson, Nilsson, Akenine-Möller, Oskarsson,
//! Åström and Fairchild 2020, FLIP: A Difference Evaluator for Alternating Images), and of high dynamic range
//! (Andersson, Nilsson, Shirley and Akenine-Möller 2021, Visualizing Errors in Rendered High Dynamic Range Images).
//!
//! | step | here | 2020 |
//! |---|---|---|
//! | to opponent colours Y, Cx, Cz | `colour.rs` | §4.1.1 |
//! | blurred by the eye's contrast sensitivity | `filters.rs` | §4.1.1, eq. 1 and table 1 |
//! | to L*a*b*, colours fading in the dark (Hunt) | `colour.rs` | §4.1.2, eq. 2 |
//! | distance of colours (HyAB), redistributed | [`colour_difference`] | eq. 3 to 5 |
//! | edges and points | `filters.rs` | §4.2, eq. 6 and 7 |
//! | both together | [`difference`] | eq. 8: ΔE = ΔE_c^(1 − ΔE_f) |
//!
//! Everything is in double precision; NVIDIA's evaluator (1.7) works in single precision, and agrees to what
//! docs/metrics.md tells. A picture of one channel is grey: its colours vanish, so only Y is computed.

mod colour;
mod filters;
mod hdr;

pub use hdr::{Exposures, exposures};

use rayon::prelude::*;

use super::{Field, Values, Viewing};
use crate::geometry::elementary::pow64;
use crate::render::{Film, percentile, srgb_light};
use filters::Filters;

/// Linear light from 0 to 1, one or three channels.
struct Picture {
    width: usize,
    channels: Vec<Vec<f64>>,
}

/// What the eye makes of a picture.
struct Seen {
    /// L*, a*, b* with Hunt's effect, of what is seen through the contrast sensitivity.
    lab: Vec<[f64; 3]>,
    /// Strength of edges and of points.
    features: Vec<[f64; 2]>,
}

/// FLIP's map of two images of one channel or three; `None` of another number, or without pixels. Radiances are shown
/// as `wrinkle` shows them: the reference's white is 1, and what is above is cut.
pub(super) fn flip(test: &[Film], reference: &[Film], viewing: &Viewing) -> Option<Field> {
    let light: Box<dyn Fn(f64) -> f64 + Sync> = match viewing.values {
        Values::Codes => Box::new(srgb_light),
        Values::Light => Box::new(|x| x),
        Values::Radiances => {
            let exposure = 1.0 / white(reference);
            Box::new(move |x| x * exposure)
        }
    };
    let shown = |image: &[Film]| shown(image, |x| unit(light(x)));
    difference(&shown(test)?, &shown(reference)?, viewing.ppd)
}

/// HDR-FLIP's map: of each pixel the greatest FLIP at any exposure. Radiances and light are taken as they are, codes are
/// decoded; values below 0 count as 0. `None` as of [`flip`].
pub(super) fn flip_hdr(test: &[Film], reference: &[Film], viewing: &Viewing) -> Option<Field> {
    let light = match viewing.values {
        Values::Codes => srgb_light,
        Values::Light | Values::Radiances => |x: f64| x.max(0.0),
    };
    let [test, reference] = [shown(test, light)?, shown(reference, light)?];
    hdr::difference(&test, &reference, viewing.ppd)
}

/// The radiance shown as white, of an image of several channels.
fn white(reference: &[Film]) -> f64 {
    if let [only] = reference {
        return only.white();
    }
    let found = percentile(reference.iter().flat_map(Film::pixels).copied());
    if found > 0.0 { found } else { 1.0 }
}

fn shown(image: &[Film], light: impl Fn(f64) -> f64 + Sync) -> Option<Picture> {
    let first = image.first()?;
    let known = matches!(image.len(), 1 | 3) && !first.pixels().is_empty();
    let channel = |film: &Film| film.pixels().iter().map(|x| light(f64::from(*x))).collect();
    known.then(|| Picture { width: first.width(), channels: image.iter().map(channel).collect() })
}

/// Held to [0, 1]; what is not a number becomes 0.
fn unit(x: f64) -> f64 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

/// FLIP's map of two pictures of one size (eq. 8).
fn difference(test: &Picture, reference: &Picture, ppd: f64) -> Option<Field> {
    let filters = Filters::new(ppd);
    let (a, r) = rayon::join(|| seen(test, &filters), || seen(reference, &filters));
    let greatest = greatest_difference();
    let at = |i: usize| {
        let colour = colour_difference(a.lab[i], r.lab[i], greatest);
        let apart = |k: usize| (a.features[i][k] - r.features[i][k]).abs();
        let feature = (std::f64::consts::FRAC_1_SQRT_2 * apart(0).max(apart(1))).sqrt();
        if feature >= 1.0 { 1.0 } else { pow64(colour, 1.0 - feature) }
    };
    let values = (0..a.lab.len()).into_par_iter().with_min_len(4096).map(at).collect();
    Some(Field { width: test.width, values })
}

fn seen(picture: &Picture, filters: &Filters) -> Seen {
    let opponent = colour::opponent(&picture.channels);
    let blurred: Vec<Vec<f64>> = opponent
        .iter()
        .enumerate()
        .map(|(c, plane)| filters.contrast(c, plane, picture.width))
        .collect();
    Seen {
        lab: colour::faded_lab(&blurred),
        features: filters.features(&opponent[0], picture.width),
    }
}

/// q_c: what differences are raised to.
const POWER: f64 = 0.7;
/// p_c: the part of the greatest difference below which differences are spread over [0, p_t].
const KNEE: f64 = 0.4;
/// p_t
const SPREAD: f64 = 0.95;

/// The distance of two colours, from 0 to 1 (eq. 3 to 5), by |ΔL*| + √(Δa*² + Δb*²) (HyAB) to a power; `greatest` is
/// that of green and blue.
fn colour_difference(a: [f64; 3], r: [f64; 3], greatest: f64) -> f64 {
    let apart = pow64(hyab(a, r), POWER);
    let knee = KNEE * greatest;
    if apart < knee {
        SPREAD / knee * apart
    } else {
        SPREAD + (apart - knee) / (greatest - knee) * (1.0 - SPREAD)
    }
}

fn hyab(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [l, x, y] = [0, 1, 2].map(|c| a[c] - b[c]);
    l.abs() + (x * x + y * y).sqrt()
}

/// The power of the distance of pure green and pure blue, the greatest there is.
fn greatest_difference() -> f64 {
    let pure = |rgb: [f64; 3]| colour::faded(colour::lab(rgb));
    pow64(hyab(pure([0.0, 1.0, 0.0]), pure([0.0, 0.0, 1.0])), POWER)
}

#[cfg(test)]
mod tests;
