//! HDR-FLIP: the greatest FLIP over a range of exposures, tone mapped (Andersson et al. 2021).

use super::Picture;
use crate::metric::Field;

/// The exposures HDR-FLIP looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exposures {
    /// The darkest, in stops.
    pub start: f64,
    /// The brightest, in stops.
    pub stop: f64,
    /// How many, evenly spaced from one to the other: at least 2, and no more than a stop apart.
    pub count: usize,
}

/// Narkowicz's fit of the ACES tone curve, without its exposure of 0.6: (k₀ x² + k₁ x + k₂) / (k₃ x² + k₄ x + k₅).
const ACES: [f64; 6] = [0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14];

/// Where the tone curve bends to white: the greatest luminance of the darkest exposure and the median of the brightest
/// are taken there (2021, §3.2).
const SHOULDER: f64 = 0.85;

/// The most exposures: what is more than so many stops under white is noise.
const MOST: usize = 64;

fn tone(x: f64) -> f64 {
    let [a, b, c, d, e, f] = ACES;
    super::unit((a * x * x + b * x + c) / (d * x * x + e * x + f))
}

/// Where the tone curve is at its shoulder: the greater root of a quadratic.
fn shoulder() -> f64 {
    let [a, b, c] = [0, 1, 2].map(|k| ACES[k] - SHOULDER * ACES[k + 3]);
    let half = -0.5 * b / a;
    half + (half * half - c / a).sqrt()
}

/// The exposures for a reference of these luminances, at least one of them above 0 and all finite; else `None`.
pub fn exposures(luminances: &[f64]) -> Option<Exposures> {
    let mut sorted = luminances.to_vec();
    sorted.sort_by(f64::total_cmp);
    let brightest = *sorted.last()?;
    if !(brightest.is_finite() && brightest > 0.0) {
        return None;
    }
    let median = sorted[sorted.len() / 2].max(f64::from(f32::EPSILON));
    let white = shoulder();
    let [start, stop] = [brightest, median].map(|level| libm::log2(white / level));
    let count = ((stop - start).ceil().max(2.0) as usize).min(MOST);
    Some(Exposures { start, stop, count })
}

/// HDR-FLIP's map; `None` of a black reference.
pub(super) fn difference(test: &Picture, reference: &Picture, ppd: f64) -> Option<Field> {
    let Exposures { start, stop, count } = exposures(&luminances(reference))?;
    let step = (stop - start) / (count - 1) as f64;
    let mut greatest: Option<Field> = None;
    for k in 0..count {
        let exposure = libm::exp2(start + k as f64 * step);
        let [a, r] = [test, reference].map(|picture| exposed(picture, exposure));
        let found = super::difference(&a, &r, ppd)?;
        greatest = Some(match greatest {
            None => found,
            Some(mut most) => {
                most.values.iter_mut().zip(found.values).for_each(|(m, v)| *m = m.max(v));
                most
            }
        });
    }
    greatest
}

fn exposed(picture: &Picture, exposure: f64) -> Picture {
    let channel = |values: &Vec<f64>| values.iter().map(|x| tone(x * exposure)).collect();
    Picture { width: picture.width, channels: picture.channels.iter().map(channel).collect() }
}

fn luminances(picture: &Picture) -> Vec<f64> {
    match picture.channels.as_slice() {
        [r, g, b] => {
            let rgb = r.iter().zip(g).zip(b);
            rgb.map(|((r, g), b)| 0.2126 * r + 0.7152 * g + 0.0722 * b).collect()
        }
        others => others[0].clone(),
    }
}
