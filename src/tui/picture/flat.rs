//! A finished picture, scaled: areas averaged when it shrinks, pixels repeated when it grows.

use std::sync::{Arc, LazyLock};

use super::{Paint, SURROUND, fitted};
use crate::experiment::results::Picture;
use crate::geometry::elementary::pow64;

/// A picture of any kind, its pixels square.
#[derive(Clone, Debug)]
pub struct Flat(pub Arc<Picture>);

impl Paint for Flat {
    fn paint(&self, size: [usize; 2], aspect: f64) -> Picture {
        let source = [self.0.width, self.0.height];
        let (corner, fit) = fitted(source, size, aspect);
        let mut rgb = vec![SURROUND; size[0] * size[1]];
        if self.0.rgb.is_empty() || rgb.is_empty() {
            return Picture { width: size[0], height: size[1], rgb };
        }
        let scaled = scaled(&self.0, fit);
        let rows = rgb.chunks_exact_mut(size[0]).skip(corner[1]);
        for (row, from) in rows.zip(scaled.chunks_exact(fit[0])) {
            row[corner[0]..][..fit[0]].copy_from_slice(from);
        }
        Picture { width: size[0], height: size[1], rgb }
    }
}

/// The picture at exactly this size, row by row; sides are at least 1.
fn scaled(picture: &Picture, [width, height]: [usize; 2]) -> Vec<[u8; 3]> {
    let across = shares(picture.width, width);
    let down = shares(picture.height, height);
    if width >= picture.width && height >= picture.height {
        let row = |y: &Share| &picture.rgb[y.first * picture.width..][..picture.width];
        let pixels = |row: &[[u8; 3]]| across.iter().map(|x| row[x.first]).collect::<Vec<_>>();
        return down.iter().flat_map(|y| pixels(row(y))).collect();
    }
    let mut result = Vec::with_capacity(width * height);
    for y in &down {
        let rows = y.weighted().map(|(row, w)| (&picture.rgb[row * picture.width..], w));
        let mut sums = vec![[0.0_f32; 3]; picture.width];
        for (row, weight) in rows {
            for (sum, rgb) in sums.iter_mut().zip(row) {
                (0..3).for_each(|c| sum[c] += weight * LINEAR[usize::from(rgb[c])]);
            }
        }
        result.extend(across.iter().map(|x| mean(x, &sums)));
    }
    result
}

/// The mean of a row's linear values over a share of it, as codes.
fn mean(share: &Share, row: &[[f32; 3]]) -> [u8; 3] {
    let mut sum = [0.0_f32; 3];
    for (x, weight) in share.weighted() {
        (0..3).for_each(|c| sum[c] += weight * row[x][c]);
    }
    sum.map(code)
}

/// The source's pixels under one of the result's: from `first` on, each with its part; the parts add up to 1.
struct Share {
    first: usize,
    parts: Vec<f32>,
}

impl Share {
    fn weighted(&self) -> impl Iterator<Item = (usize, f32)> {
        self.parts.iter().enumerate().map(|(i, part)| (self.first + i, *part))
    }
}

/// How `from` pixels are shared out among `to`: by area when there are fewer, the one at the centre when there are more.
fn shares(from: usize, to: usize) -> Vec<Share> {
    if to >= from {
        let centre = |i: usize| (2 * i + 1) * from / (2 * to);
        return (0..to).map(|i| Share { first: centre(i), parts: vec![1.0] }).collect();
    }
    // In units of 1/to of a source pixel all edges are whole numbers.
    let share = |i: usize| {
        let (begin, end) = (i * from, (i + 1) * from);
        let first = begin / to;
        let covered = |x: usize| end.min((x + 1) * to) - begin.max(x * to);
        let parts = (first..end.div_ceil(to)).map(|x| covered(x) as f32 / from as f32);
        Share { first, parts: parts.collect() }
    };
    (0..to).map(share).collect()
}

/// The linear value of an sRGB code over 255 (IEC 61966-2-1).
fn linear(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { pow64((encoded + 0.055) / 1.055, 2.4) }
}

/// The linear value of each code.
static LINEAR: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|code| linear(code as f64 / 255.0) as f32));

/// The least linear value that rounds to each code from 1 on.
static EDGES: LazyLock<[f32; 255]> =
    LazyLock::new(|| std::array::from_fn(|code| linear((code as f64 + 0.5) / 255.0) as f32));

/// The code of a linear value, rounded.
fn code(linear: f32) -> u8 {
    EDGES.partition_point(|edge| *edge <= linear) as u8
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::render::srgb;

    fn picture(width: usize, height: usize, at: impl Fn(usize, usize) -> [u8; 3]) -> Flat {
        let rgb = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Flat(Arc::new(Picture { width, height, rgb: rgb.map(|(x, y)| at(x, y)).collect() }))
    }

    #[test]
    fn codes_come_back() {
        for c in 0..=255_u8 {
            assert_eq!(code(LINEAR[usize::from(c)]), c);
            assert_eq!(srgb(f64::from(LINEAR[usize::from(c)])), c, "the same curve as films");
        }
    }

    #[test]
    fn its_own_size_is_itself() {
        let one = picture(3, 2, |x, y| [x as u8 * 80, y as u8 * 99, 7]);
        assert_eq!(one.paint([3, 2], 1.0), *one.0);
    }

    #[test]
    fn grown_pixels_are_repeated() {
        let one = picture(2, 1, |x, _| [x as u8 * 200; 3]);
        let grown = one.paint([4, 2], 1.0);
        assert_eq!(grown.rgb[..4], [[0; 3], [0; 3], [200; 3], [200; 3]]);
    }

    #[test]
    fn shrunk_pixels_are_mean_radiance() {
        // Half of the light: code 188, not 128.
        let board = picture(64, 64, |x, y| [((x + y) % 2 * 255) as u8; 3]);
        assert!(board.paint([8, 8], 1.0).rgb.iter().all(|rgb| *rgb == [188; 3]));
    }

    #[test]
    fn the_surround_is_even() {
        let white = picture(10, 10, |_, _| [255; 3]);
        let wide = white.paint([30, 10], 1.0);
        let row: Vec<bool> = wide.rgb[..30].iter().map(|rgb| *rgb == [255; 3]).collect();
        assert!(row[10..20].iter().all(|lit| *lit) && !row[9] && !row[20]);
    }

    #[test]
    fn nothing_is_painted_without_trouble() {
        let none = picture(0, 0, |_, _| [0; 3]);
        assert_eq!(none.paint([2, 2], 1.0).rgb.len(), 4);
        assert!(picture(2, 2, |_, _| [1; 3]).paint([0, 5], 1.0).rgb.is_empty());
    }

    proptest! {
        #[test]
        fn shares_cover_everything_once(from in 1..200_usize, to in 1..200_usize) {
            let shares = shares(from, to);
            prop_assert_eq!(shares.len(), to);
            let mut covered = vec![0.0_f32; from];
            for share in &shares {
                prop_assert!((share.parts.iter().sum::<f32>() - 1.0).abs() < 1e-5);
                share.weighted().for_each(|(x, part)| covered[x] += part);
            }
            if to < from {
                // Each pixel of the source goes wholly into the result.
                prop_assert!(covered.iter().all(|c| (c * from as f32 / to as f32 - 1.0).abs() < 1e-4));
            }
        }

        #[test]
        fn any_size_is_met(width in 1..40_usize, height in 1..40_usize, size in prop::array::uniform2(0..50_usize), aspect in 0.3..3.0) {
            let painted = picture(width, height, |x, y| [(x * y) as u8; 3]).paint(size, aspect);
            prop_assert_eq!((painted.width, painted.height), (size[0], size[1]));
            prop_assert_eq!(painted.rgb.len(), size[0] * size[1]);
        }
    }
}
