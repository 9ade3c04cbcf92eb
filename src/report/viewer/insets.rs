//! Insets: the parts of a scene in which its images differ most, as papers show them magnified.

use serde::Serialize;

use crate::render::Film;

/// A rectangle of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Inset {
    /// Pixels from the left.
    pub x: usize,
    /// Pixels from the top.
    pub y: usize,
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
}

impl Inset {
    fn meets(&self, other: &Self) -> bool {
        self.x < other.x + other.width
            && other.x < self.x + self.width
            && self.y < other.y + other.height
            && other.y < self.y + self.height
    }
}

/// An inset is this part of the image's shorter side.
const PART: usize = 5;
/// The smallest one, pixels a side.
const LEAST: usize = 6;

/// At most `count` rectangles that do not meet, in which the variance of the images, seen with `white` as white and
/// summed over their frames, is largest. An image is its frames; all have as many, and all films are of one size.
/// Nothing of films without pixels.
pub fn insets(images: &[&[&Film]], white: f64, count: usize) -> Vec<Inset> {
    let Some(first) = images.first().and_then(|frames| frames.first()) else { return Vec::new() };
    let (width, height) = (first.width(), first.height());
    let side = (width.min(height) / PART).max(LEAST);
    if side > width || side > height {
        return Vec::new();
    }
    let sums = table(&variances(images, white), width);
    let step = (side / 4).max(1);
    let rows = (0..=height - side).step_by(step);
    let places = rows.flat_map(|y| (0..=width - side).step_by(step).map(move |x| (x, y)));
    let mut ranked: Vec<(f64, Inset)> = places
        .map(|(x, y)| Inset { x, y, width: side, height: side })
        .map(|inset| (inside(&sums, width, &inset), inset))
        .collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut chosen: Vec<Inset> = Vec::with_capacity(count);
    for (_, inset) in ranked {
        if chosen.len() < count && !chosen.iter().any(|other| other.meets(&inset)) {
            chosen.push(inset);
        }
    }
    chosen
}

/// Each pixel's variance over the images, summed over frames, radiances held between 0 and white.
fn variances(images: &[&[&Film]], white: f64) -> Vec<f64> {
    let seen = |film: &Film, i: usize| {
        let value = f64::from(film.pixels()[i]) / white;
        if value.is_finite() { value.clamp(0.0, 1.0) } else { 1.0 }
    };
    let count = images.len() as f64;
    let variance = |frame: usize, i: usize| {
        let mean = images.iter().map(|films| seen(films[frame], i)).sum::<f64>() / count;
        let gaps = images.iter().map(|films| seen(films[frame], i) - mean);
        gaps.map(|gap| gap * gap).sum::<f64>() / count
    };
    let over_time = |i: usize| (0..images[0].len()).map(|frame| variance(frame, i)).sum();
    (0..images[0][0].pixels().len()).map(over_time).collect()
}

/// A summed-area table (Crow 1984) with a row and a column of zeros before the first.
fn table(values: &[f64], width: usize) -> Vec<f64> {
    let across = width + 1;
    let mut sums = vec![0.0; across * (values.len() / width.max(1) + 1)];
    for (y, row) in values.chunks(width.max(1)).enumerate() {
        let mut along = 0.0;
        for (x, value) in row.iter().enumerate() {
            along += value;
            sums[(y + 1) * across + x + 1] = sums[y * across + x + 1] + along;
        }
    }
    sums
}

fn inside(sums: &[f64], width: usize, inset: &Inset) -> f64 {
    let at = |x: usize, y: usize| sums[y * (width + 1) + x];
    let (right, bottom) = (inset.x + inset.width, inset.y + inset.height);
    at(right, bottom) - at(inset.x, bottom) - at(right, inset.y) + at(inset.x, inset.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn insets_lie_where_images_differ_and_keep_apart() {
        let (width, height) = (60, 40);
        let film = |spots: &[(usize, usize, f32)]| {
            let mut pixels = vec![0.2; width * height];
            spots.iter().for_each(|(x, y, value)| pixels[y * width + x] = *value);
            Film::new(width, height, pixels)
        };
        let (flat, spotted) = (film(&[]), film(&[(50, 30, 1.0), (51, 31, 1.0), (10, 5, 0.9)]));
        let found = insets(&[&[&flat], &[&spotted]], 1.0, 2);
        let holds = |i: &Inset, x, y| {
            (i.x..i.x + i.width).contains(&x) && (i.y..i.y + i.height).contains(&y)
        };
        assert!(holds(&found[0], 50, 30) && holds(&found[0], 51, 31), "{found:?}");
        assert!(holds(&found[1], 10, 5), "{found:?}");
        assert!(!found[0].meets(&found[1]));
    }

    #[test]
    fn what_moves_alike_in_all_images_is_not_where_they_differ() {
        let film = |x: usize, value: f32| {
            let mut pixels = vec![0.2; 600];
            pixels[10 * 30 + x] = value;
            Film::new(30, 20, pixels)
        };
        // A spot goes from the left to the right in both images; in one it is darker there.
        let [a, b, c, d] = [film(3, 1.0), film(22, 1.0), film(3, 1.0), film(22, 0.5)];
        let found = insets(&[&[&a, &b], &[&c, &d]], 1.0, 1);
        assert!((found[0].x..found[0].x + found[0].width).contains(&22), "{found:?}");
    }

    #[test]
    fn small_and_missing_images_have_few_insets_or_none() {
        assert!(insets(&[], 1.0, 2).is_empty());
        let film = |w: usize, h: usize| Film::new(w, h, vec![f32::NAN; w * h]);
        assert!(insets(&[&[&film(4, 4)]], 1.0, 2).is_empty());
        assert!(insets(&[&[&film(0, 0)]], 1.0, 2).is_empty());
        let found = insets(&[&[&film(7, 7)]], 1.0, 3);
        assert_eq!(found.len(), 1);
    }
}
