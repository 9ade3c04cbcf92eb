//! Metrics of the luminance Y = 0.2126 R + 0.7152 G + 0.0722 B of the values as they are (Rec. 709); an image of one
//! channel is its own.

use super::ssim::Plane;
use super::{Field, Viewing, ms_ssim, ssim};
use crate::render::Film;

pub(super) fn structure(test: &[Film], reference: &[Film], viewing: &Viewing) -> Option<Field> {
    ssim::of_plane(&luminance(test)?, &luminance(reference)?, viewing.range(reference))
}

pub(super) fn structure_at_scales(
    test: &[Film],
    reference: &[Film],
    viewing: &Viewing,
) -> Option<f64> {
    ms_ssim::of_plane(luminance(test)?, luminance(reference)?, viewing.range(reference))
}

/// The luminance; `None` of other than one or three channels.
fn luminance(image: &[Film]) -> Option<Plane> {
    match image {
        [only] => Some(Plane::of(only)),
        [r, g, b] => {
            let rgb = r.pixels().iter().zip(g.pixels()).zip(b.pixels());
            let y = rgb.map(|((r, g), b)| {
                let [r, g, b] = [r, g, b].map(|x| f64::from(*x));
                0.2126 * r + 0.7152 * g + 0.0722 * b
            });
            Some(Plane { width: r.width(), height: r.height(), values: y.collect() })
        }
        _ => None,
    }
}
