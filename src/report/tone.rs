//! From linear radiance to pictures: exposure, sRGB, and signed errors.

use super::colour;
use crate::experiment::results::Picture;
use crate::geometry::elementary::pow64;
use crate::render::Film;

/// The share of the reference's pixels that stay below white.
const BELOW_WHITE: f64 = 0.995;

/// The radiance shown as white: what 99.5 % of the film's pixels do not exceed; 1 for a black film.
pub fn white(film: &Film) -> f64 {
    let found = percentile(film.pixels().iter().copied());
    if found > 0.0 { found } else { 1.0 }
}

/// The value that 99.5 % of the finite values do not exceed; 0 if there are none.
fn percentile(values: impl Iterator<Item = f32>) -> f64 {
    let mut sorted: Vec<f32> = values.filter(|v| v.is_finite()).collect();
    sorted.sort_by(f32::total_cmp);
    let last = sorted.len().saturating_sub(1);
    let index = (BELOW_WHITE * last as f64).ceil() as usize;
    sorted.get(index.min(last)).map_or(0.0, |v| f64::from(*v))
}

/// A film as a grey picture with `white` shown as white, sRGB encoded (IEC 61966-2-1).
pub fn picture(film: &Film, white: f64) -> Picture {
    painted(film, |_, radiance| [srgb(f64::from(radiance) / white); 3])
}

/// Film minus reference as colours: blue too dark, red too bright, full at ± `scale`.
pub fn error_picture(film: &Film, reference: &Film, scale: f64) -> Picture {
    let error = |i: usize, value: f32| reference.pixels().get(i).map(|r| f64::from(value - r));
    painted(film, |i, value| colour::signed(error(i, value).unwrap_or(0.0) / scale))
}

/// The size of error that 99.5 % of a film's pixels do not exceed.
pub fn error_size(film: &Film, reference: &Film) -> f64 {
    percentile(film.pixels().iter().zip(reference.pixels()).map(|(a, b)| (a - b).abs()))
}

fn painted(film: &Film, colour: impl Fn(usize, f32) -> [u8; 3]) -> Picture {
    let pixels = film.pixels().iter().enumerate();
    let rgb = pixels.map(|(i, value)| colour(i, *value)).collect();
    Picture { width: film.width(), height: film.height(), rgb }
}

/// Linear 0…1 as an sRGB byte.
fn srgb(linear: f64) -> u8 {
    let value = linear.clamp(0.0, 1.0);
    let encoded =
        if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * pow64(value, 1.0 / 2.4) - 0.055 };
    (255.0 * encoded + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_has_its_known_values() {
        assert_eq!([0.0, 1.0, 9.0, 0.5, 0.215_861].map(srgb), [0, 255, 255, 188, 128]);
        assert_eq!(srgb(f64::NAN), 0);
    }

    #[test]
    fn white_is_a_percentile_of_the_reference() {
        let ramp = Film::new(1000, 1, (0..1000).map(|i| i as f32).collect());
        assert_eq!(white(&ramp), 995.0);
        assert_eq!(white(&Film::new(2, 1, vec![0.0; 2])), 1.0);
        assert_eq!(white(&Film::new(0, 0, vec![])), 1.0);
    }

    #[test]
    fn an_equal_film_has_a_white_error() {
        let film = Film::new(1, 1, vec![0.3]);
        assert_eq!(error_picture(&film, &film, 0.1).rgb, [[255; 3]]);
        assert_eq!(error_size(&film, &film), 0.0);
    }
}
