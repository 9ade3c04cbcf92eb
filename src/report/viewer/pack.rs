//! Films as text within a page: half floats, deflated, in Base64.
//!
//! A film's radiances are multiplied by a power of two that its scene's films share, which loses nothing and puts
//! the largest of them where half floats are finest; rounded to half floats (IEEE 754 binary16, 11 significant
//! bits); each taken from the one before it, as 16-bit numbers modulo 2¹⁶; all low bytes written before all high
//! ones; and deflated (zlib, RFC 1950). The frames of an image that moves follow one another as if they were one
//! tall film. `templates/script/films.js` goes the way back.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use half::f16;
use miniz_oxide::deflate::compress_to_vec_zlib;

use crate::render::Film;

/// How hard the encoder looks for repeats, of 10.
const EFFORT: u8 = 7;
/// The largest radiance of a scene is put below 2 to this power; half floats end at 2¹⁶.
const TOP: i32 = 15;

/// The power of two that radiances are multiplied by; 1 if nothing among them has a size.
pub fn scale<'a>(films: impl Iterator<Item = &'a Film>) -> f32 {
    let sizes = films.flat_map(Film::pixels).map(|v| v.abs()).filter(|v| v.is_finite());
    let largest = sizes.fold(0.0, f32::max);
    if largest == 0.0 {
        return 1.0;
    }
    let (_, exponent) = libm::frexpf(largest);
    // Within the exponents of normal floats, so that dividing by it is exact as well.
    libm::ldexpf(1.0, (TOP - exponent).clamp(-126, 126))
}

/// An image as text: its frames, or its only film.
pub fn pack(frames: &[&Film], scale: f32) -> String {
    STANDARD.encode(deflate(&planes(frames, scale)))
}

/// Bytes as text, deflated.
pub fn packed(bytes: &[u8]) -> String {
    STANDARD.encode(deflate(bytes))
}

fn deflate(bytes: &[u8]) -> Vec<u8> {
    compress_to_vec_zlib(bytes, EFFORT)
}

/// The low bytes of all differences, then their high bytes.
fn planes(frames: &[&Film], scale: f32) -> Vec<u8> {
    let mut before = 0u16;
    let radiances = frames.iter().flat_map(|film| film.pixels());
    let halves = radiances.map(|v| f16::from_f32(v * scale).to_bits());
    let steps: Vec<[u8; 2]> = halves
        .map(|bits| bits.wrapping_sub(std::mem::replace(&mut before, bits)).to_le_bytes())
        .collect();
    let plane = |i: usize| steps.iter().map(move |step| step[i]);
    plane(0).chain(plane(1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use miniz_oxide::inflate::decompress_to_vec_zlib;
    use proptest::prelude::*;

    /// What the page's script does.
    fn unpack(text: &str, scale: f32) -> Vec<f32> {
        let bytes = decompress_to_vec_zlib(&STANDARD.decode(text).unwrap()).unwrap();
        let (low, high) = bytes.split_at(bytes.len() / 2);
        let mut bits = 0u16;
        let steps = low.iter().zip(high).map(|(low, high)| u16::from_le_bytes([*low, *high]));
        steps
            .map(|step| {
                bits = bits.wrapping_add(step);
                f16::from_bits(bits).to_f32() / scale
            })
            .collect()
    }

    fn film(pixels: Vec<f32>) -> Film {
        Film::new(pixels.len(), 1, pixels)
    }

    proptest! {
        #[test]
        fn a_film_comes_back_to_half_a_unit_of_its_last_bit(
            pixels in prop::collection::vec(0.0f32..1e7, 1..200), size in -60i32..60
        ) {
            let size = libm::ldexpf(1.0, size);
            let film = film(pixels.iter().map(|v| v * size).collect());
            let scale = scale(std::iter::once(&film));
            let largest = film.pixels().iter().copied().fold(0.0, f32::max);
            for (a, b) in film.pixels().iter().zip(unpack(&pack(&[&film], scale), scale)) {
                // 11 significant bits; below 2⁻²⁹ of the largest, half floats lose bits one by one.
                let bound = (a * libm::ldexpf(1.0, -11)).max(largest * libm::ldexpf(1.0, -39));
                prop_assert!((a - b).abs() <= bound, "{a} {b}");
            }
        }
    }

    #[test]
    fn half_floats_pass_unchanged_and_so_does_what_is_no_number() {
        let halves =
            [0.0, 1.0, 0.333_251_95, 1536.0, 6.1e-5_f32].map(|v| f16::from_f32(v).to_f32());
        let mut pixels = halves.to_vec();
        pixels.extend([f32::NAN, f32::INFINITY]);
        let film = film(pixels.clone());
        let scale = scale(std::iter::once(&film));
        let back = unpack(&pack(&[&film], scale), scale);
        assert_eq!(back[..5], halves);
        assert!(back[5].is_nan() && back[6] == f32::INFINITY);
    }

    #[test]
    fn frames_follow_one_another() {
        let frames = [film(vec![0.5, 1.0]), film(vec![2.0, 0.25])];
        let text = pack(&[&frames[0], &frames[1]], 1.0);
        assert_eq!(unpack(&text, 1.0), [0.5, 1.0, 2.0, 0.25]);
    }

    #[test]
    fn nothing_and_darkness_have_a_scale() {
        assert_eq!(scale(std::iter::empty()), 1.0);
        assert_eq!(scale(std::iter::once(&film(vec![0.0; 3]))), 1.0);
        let faint = film(vec![f32::from_bits(1)]);
        assert!(scale(std::iter::once(&faint)).is_finite());
        assert!(unpack(&pack(&[&film(vec![])], 1.0), 1.0).is_empty());
    }
}
