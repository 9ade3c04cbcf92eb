//! From linear radiance to pictures: exposure, sRGB, and signed errors.

use super::colour;
use crate::experiment::results::Picture;
use crate::render::{Film, percentile, srgb};

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
        assert_eq!(ramp.white(), 995.0);
        assert_eq!(Film::new(2, 1, vec![0.0; 2]).white(), 1.0);
        assert_eq!(Film::new(0, 0, vec![]).white(), 1.0);
    }

    #[test]
    fn an_equal_film_has_a_white_error() {
        let film = Film::new(1, 1, vec![0.3]);
        assert_eq!(error_picture(&film, &film, 0.1).rgb, [[255; 3]]);
        assert_eq!(error_size(&film, &film), 0.0);
    }
}
