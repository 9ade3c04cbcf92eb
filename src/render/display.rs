//! Films for the eye: 8-bit pictures, and errors in false colour.

use std::path::Path;

use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

use super::{Film, FilmError};
use crate::file::write_whole;
use crate::geometry::elementary::pow64;

/// An 8-bit sRGB code of a linear value, rounded; 0 for what is not above 0, 255 from 1 on
/// (IEC 61966-2-1).
pub fn srgb(linear: f64) -> u8 {
    let held = unit(linear);
    let encoded =
        if held <= 0.003_130_8 { 12.92 * held } else { 1.055 * pow64(held, 1.0 / 2.4) - 0.055 };
    (255.0 * encoded + 0.5) as u8
}

/// The light of an sRGB code, both from 0 to 1 (IEC 61966-2-1); 0 for what is not above 0.
pub fn srgb_light(code: f64) -> f64 {
    if code <= 0.04045 { code.max(0.0) / 12.92 } else { pow64((code + 0.055) / 1.055, 2.4) }
}

/// The share of a picture's pixels that stay below white.
const BELOW_WHITE: f64 = 0.995;

/// What 99.5 % of the finite values do not exceed; 0 if there are none.
pub fn percentile(values: impl Iterator<Item = f32>) -> f64 {
    let mut sorted: Vec<f32> = values.filter(|v| v.is_finite()).collect();
    sorted.sort_by(f32::total_cmp);
    let last = sorted.len().saturating_sub(1);
    let index = (BELOW_WHITE * last as f64).ceil() as usize;
    sorted.get(index.min(last)).map_or(0.0, |v| f64::from(*v))
}

impl Film {
    /// The radiance to show as white: what 99.5 % of the pixels do not exceed; 1 for a black film.
    pub fn white(&self) -> f64 {
        *self.white.get_or_init(|| {
            let found = percentile(self.pixels().iter().copied());
            if found > 0.0 { found } else { 1.0 }
        })
    }

    /// Writes the film as a grey 8-bit PNG, its radiances multiplied by `exposure` and encoded as sRGB.
    /// The file appears whole or not at all.
    ///
    /// # Errors
    /// [`FilmError::Write`].
    pub fn write_png(&self, exposure: f64, path: &Path) -> Result<(), FilmError> {
        let grey: Vec<u8> = self.pixels().iter().map(|p| srgb(f64::from(*p) * exposure)).collect();
        put(self, &grey, ExtendedColorType::L8, path)
    }
}

/// Writes |A − R| in false colour ([`heat`]) as an 8-bit PNG; `brightest` is the error of the last
/// colour, and everything from it on.
///
/// # Errors
/// [`FilmError::Write`].
///
/// # Panics
/// If the films differ in size: a programming error.
pub fn write_error_png(
    test: &Film,
    reference: &Film,
    brightest: f64,
    path: &Path,
) -> Result<(), FilmError> {
    let (width, height) = (reference.width(), reference.height());
    assert_eq!((test.width(), test.height()), (width, height), "shape of films");
    let error = |(a, r): (&f32, &f32)| (f64::from(*a) - f64::from(*r)).abs() / brightest;
    let pixels = test.pixels().iter().zip(reference.pixels());
    let colours: Vec<u8> = pixels.flat_map(|pair| heat(error(pair))).collect();
    put(reference, &colours, ExtendedColorType::Rgb8, path)
}

/// Writes colours, rows of `width` of them from the top, as an 8-bit PNG.
///
/// # Errors
/// [`FilmError::Write`].
pub fn write_colours(width: usize, colours: &[[u8; 3]], path: &Path) -> Result<(), FilmError> {
    let size = [width, colours.len() / width.max(1)];
    put_bytes(size, colours.as_flattened(), ExtendedColorType::Rgb8, path)
}

fn put(film: &Film, bytes: &[u8], colour: ExtendedColorType, path: &Path) -> Result<(), FilmError> {
    put_bytes([film.width(), film.height()], bytes, colour, path)
}

fn put_bytes(
    [width, height]: [usize; 2],
    bytes: &[u8],
    colour: ExtendedColorType,
    path: &Path,
) -> Result<(), FilmError> {
    let mut png = Vec::new();
    PngEncoder::new(&mut png)
        .write_image(bytes, width as u32, height as u32, colour)
        .map_err(|error| FilmError::write(path, error))?;
    write_whole(path, &png).map_err(|error| FilmError::write(path, error))
}

/// Held to [0, 1]; what is not a number becomes 0.
fn unit(x: f64) -> f64 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

/// A colour for a number in [0, 1], black over violet and orange to pale yellow; outside it, the ends.
/// Lightness rises evenly, so the map reads in grey and with any colour vision.
///
/// Lightness L* runs in a straight line from 2 to 96 and hue turns evenly in the CIE L*a*b* space
/// (D65), with as much chroma as sRGB can show: computed, then tabulated. Between entries it is linear in
/// the codes.
pub fn heat(x: f64) -> [u8; 3] {
    let position = unit(x) * (HEAT.len() - 1) as f64;
    let below = (position as usize).min(HEAT.len() - 2);
    let blend = position - below as f64;
    let mix = |c: usize| {
        let (from, to) = (f64::from(HEAT[below][c]), f64::from(HEAT[below + 1][c]));
        (from + (to - from) * blend + 0.5) as u8
    };
    [mix(0), mix(1), mix(2)]
}

/// Hue turns from −75° to 105°; chroma is at most 70 in the middle and less towards the ends.
const HEAT: [[u8; 3]; 17] = [
    [0, 6, 31],
    [12, 19, 60],
    [42, 23, 81],
    [75, 21, 96],
    [110, 12, 105],
    [142, 0, 106],
    [171, 0, 103],
    [199, 11, 97],
    [219, 44, 90],
    [234, 73, 82],
    [243, 101, 78],
    [247, 129, 78],
    [248, 156, 87],
    [247, 181, 106],
    [245, 204, 133],
    [245, 226, 169],
    [248, 245, 213],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_has_its_known_values() {
        assert_eq!([0.0, 1.0, 9.0, -1.0, 0.5, 0.215_861].map(srgb), [0, 255, 255, 0, 188, 128]);
        assert_eq!(srgb(f64::NAN), 0);
    }

    /// CIE L* of an sRGB colour.
    fn lightness(rgb: [u8; 3]) -> f64 {
        let linear = rgb.map(|code| {
            let c = f64::from(code) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        });
        let y = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
        if y > 0.008856 { 116.0 * y.cbrt() - 16.0 } else { 903.3 * y }
    }

    #[test]
    fn false_colour_grows_evenly_lighter() {
        for i in 0..=16 {
            let x = f64::from(i) / 16.0;
            let error = lightness(heat(x)) - (2.0 + 94.0 * x);
            assert!(error.abs() < 1.0, "{x}: {error}");
        }
        let steps: Vec<f64> = (0..=200).map(|i| lightness(heat(f64::from(i) / 200.0))).collect();
        assert!(steps.windows(2).all(|pair| pair[1] >= pair[0]));
        assert_eq!((heat(-1.0), heat(f64::NAN), heat(7.0)), (HEAT[0], HEAT[0], HEAT[16]));
    }

    #[test]
    fn pictures_hold_their_pixels() {
        let folder = tempfile::tempdir().unwrap();
        let reference = Film::new(2, 2, vec![0.0, 0.25, 0.5, 1.0]);
        let test = Film::new(2, 2, vec![0.0, 0.5, 0.0, 9.0]);
        let path = folder.path().join("film.png");
        reference.write_png(2.0, &path).unwrap();
        assert_eq!(image::open(&path).unwrap().into_luma8().into_raw(), [0, 188, 255, 255]);
        let path = folder.path().join("error.png");
        write_error_png(&test, &reference, 0.5, &path).unwrap();
        let colours = image::open(&path).unwrap().into_rgb8();
        let colours: Vec<[u8; 3]> = colours.pixels().map(|pixel| pixel.0).collect();
        assert_eq!(colours, [HEAT[0], HEAT[8], HEAT[16], HEAT[16]]);
    }
}
