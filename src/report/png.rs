//! PNG files, small: with a palette where the colours are few.

use std::collections::BTreeMap;

use ::png::{BitDepth, ColorType, DeflateCompression, Filter};

use crate::experiment::results::Picture;

/// Most colours of a palette (PNG specification, third edition, §11.2.2).
const PALETTE: usize = 256;

type Rgb = [u8; 3];

/// A picture as a PNG file, every pixel as it is.
pub fn exact(picture: &Picture) -> Vec<u8> {
    let mut counts = counts(&picture.rgb);
    if counts.len() > PALETTE {
        return encode(picture, ColorType::Rgb, &[], picture.rgb.as_flattened());
    }
    number(&mut counts);
    indexed(picture, &counts)
}

/// A drawing as a PNG file with a palette: its most frequent colours as they are, each other one, of
/// the soft edges between them, as the nearest of these.
pub fn drawing(picture: &Picture) -> Vec<u8> {
    let mut counts = counts(&picture.rgb);
    let mut ranked: Vec<(usize, Rgb)> = counts.iter().map(|(rgb, n)| (*n, *rgb)).collect();
    ranked.sort_unstable_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)));
    let palette: Vec<Rgb> = ranked.into_iter().take(PALETTE).map(|(_, rgb)| rgb).collect();
    for (rgb, index) in &mut counts {
        let near = palette.iter().enumerate().min_by_key(|(_, p)| distance(rgb, p));
        *index = near.map_or(0, |(i, _)| i);
    }
    with_palette(picture, &palette, &counts)
}

/// How often each colour occurs.
fn counts(rgb: &[Rgb]) -> BTreeMap<Rgb, usize> {
    let mut counts = BTreeMap::new();
    // Runs of one colour are counted at once: most of a drawing is paper.
    for run in rgb.chunk_by(|a, b| a == b) {
        *counts.entry(run[0]).or_default() += run.len();
    }
    counts
}

fn number(colours: &mut BTreeMap<Rgb, usize>) {
    colours.values_mut().enumerate().for_each(|(i, index)| *index = i);
}

fn indexed(picture: &Picture, indices: &BTreeMap<Rgb, usize>) -> Vec<u8> {
    let palette: Vec<Rgb> = indices.keys().copied().collect();
    with_palette(picture, &palette, indices)
}

fn with_palette(picture: &Picture, palette: &[Rgb], indices: &BTreeMap<Rgb, usize>) -> Vec<u8> {
    let mut pixels = Vec::with_capacity(picture.rgb.len());
    for run in picture.rgb.chunk_by(|a, b| a == b) {
        pixels.extend(std::iter::repeat_n(indices[&run[0]] as u8, run.len()));
    }
    encode(picture, ColorType::Indexed, palette.as_flattened(), &pixels)
}

fn distance(a: &Rgb, b: &Rgb) -> u32 {
    let part = |c: usize| u32::from(a[c].abs_diff(b[c])).pow(2);
    part(0) + part(1) + part(2)
}

fn encode(picture: &Picture, colour: ColorType, palette: &[u8], pixels: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, picture.width as u32, picture.height as u32);
    encoder.set_color(colour);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_deflate_compression(DeflateCompression::Level(6));
    // Flat areas and palettes compress best as they are.
    encoder.set_filter(Filter::NoFilter);
    if !palette.is_empty() {
        encoder.set_palette(palette);
    }
    let mut writer = encoder.write_header().expect("a picture has a pixel, memory has room");
    writer.write_image_data(pixels).expect("there are as many pixels as the header says");
    writer.finish().expect("writing to memory cannot fail");
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(colours: usize) -> Picture {
        let rgb = (0..colours).map(|i| [(i % 256) as u8, (i / 256) as u8, 7]).collect();
        Picture { width: colours, height: 1, rgb }
    }

    fn read(bytes: &[u8]) -> Vec<u8> {
        image::load_from_memory(bytes).unwrap().into_rgb8().into_raw()
    }

    #[test]
    fn an_exact_picture_reads_back_with_few_colours_and_many() {
        for colours in [1, 2, 256, 257, 700] {
            let picture = ramp(colours);
            assert_eq!(read(&exact(&picture)), picture.rgb.as_flattened(), "{colours}");
        }
    }

    #[test]
    fn a_drawing_keeps_its_frequent_colours_and_nears_the_rest() {
        let frequent = (0..512).map(|i| [(i / 2) as u8; 3]);
        let rare = (0..100).map(|i| [i as u8, i as u8, i as u8 + 1]);
        let rgb: Vec<[u8; 3]> = frequent.chain(rare).collect();
        let picture = Picture { width: rgb.len(), height: 1, rgb };
        let found = read(&drawing(&picture));
        let original = picture.rgb.as_flattened();
        assert_eq!(found[..512 * 3], original[..512 * 3]);
        assert!(found.iter().zip(original).all(|(a, b)| a.abs_diff(*b) <= 1));
    }
}
