//! A distribution of normals on the hemisphere, seen from above.

use std::hash::{Hash, Hasher};

use super::{Held, Under};
use crate::experiment::results::Picture;
use crate::report::{cell_of_normal, magnitude};
use crate::tui::picture::{Paint, SURROUND, fitted};

/// The hemisphere in the (x, y) of its normals, x to the right and y up: densities as colours on a scale of square
/// roots, lobes' axes as dots.
#[derive(Clone, Debug)]
pub struct Disc {
    /// Densities on the 1297 directions of Fournier's grid.
    density: Vec<f32>,
    /// The density of the last colour.
    scale: f32,
    /// Axes of lobes, tangent space.
    axes: Vec<[f32; 3]>,
}

/// A lobe's axis.
const AXIS: [u8; 3] = [255, 255, 255];
/// The disc where there is no density.
const EMPTY: [u8; 3] = [40, 40, 40];

impl Disc {
    /// The true distribution, on its own scale.
    pub fn truth(under: &Under) -> Self {
        Self { density: under.truth.clone(), scale: greatest(under), axes: Vec::new() }
    }

    /// A method's, on the scale of the true one.
    pub fn held(under: &Under, held: &Held) -> Self {
        let scale = greatest(under);
        Self { density: held.density.clone(), scale, axes: held.axes.clone() }
    }

    /// Tells pictures apart.
    pub fn stamp(&self) -> u64 {
        let mut hasher = std::hash::DefaultHasher::new();
        self.density.iter().for_each(|density| density.to_bits().hash(&mut hasher));
        self.axes.iter().flatten().for_each(|c| c.to_bits().hash(&mut hasher));
        hasher.finish()
    }
}

fn greatest(under: &Under) -> f32 {
    let most = under.truth.iter().copied().filter(|d| d.is_finite()).fold(0.0, f32::max);
    if most > 0.0 { most } else { 1.0 }
}

impl Paint for Disc {
    fn paint(&self, size: [usize; 2], aspect: f64) -> Picture {
        let [width, height] = size;
        let mut rgb = vec![SURROUND; width * height];
        let (corner, across) = fitted([1, 1], size, aspect);
        let middle = |i: usize, from: usize, side: usize| {
            (i as f64 - from as f64 + 0.5) / side as f64 * 2.0 - 1.0
        };
        for (i, colour) in rgb.iter_mut().enumerate() {
            let x = middle(i % width, corner[0], across[0]);
            let y = -middle(i / width, corner[1], across[1]);
            let Some(cell) = cell_of_normal(x, y) else { continue };
            let density = self.density.get(usize::from(cell)).copied();
            *colour =
                density.map_or(EMPTY, |d| magnitude(f64::from(d.max(0.0) / self.scale).sqrt()));
        }
        for axis in &self.axes {
            let place = |c: f32, from: usize, side: usize| {
                let at = (0.5 + 0.5 * f64::from(c).clamp(-1.0, 1.0)) * side as f64;
                from + (at as usize).min(side.saturating_sub(1))
            };
            if axis.iter().all(|c| c.is_finite()) {
                let x = place(axis[0], corner[0], across[0]);
                let y = place(-axis[1], corner[1], across[1]);
                if x < width && y < height {
                    rgb[y * width + x] = AXIS;
                }
            }
        }
        Picture { width, height, rgb }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn under(truth: Vec<f32>) -> Under {
        Under { pixel: [0, 0], texels_across: Some(1.0), truth, methods: Vec::new() }
    }

    #[test]
    fn an_axis_stands_where_its_normal_is() {
        let held = Held {
            method: 0,
            density: vec![0.0; 1297],
            axes: vec![[0.6, 0.0, 0.8]],
            distance: 0.0,
        };
        let picture = Disc::held(&under(vec![1.0; 1297]), &held).paint([40, 40], 1.0);
        let found = picture.rgb.iter().position(|c| *c == AXIS).unwrap();
        assert_eq!([found % 40, found / 40], [32, 20]);
    }

    #[test]
    fn it_is_round_whatever_the_pixels() {
        let disc = Disc::truth(&under(vec![1.0; 1297]));
        let picture = disc.paint([40, 10], 0.5);
        let row = |y: usize| (0..40).filter(|x| picture.rgb[y * 40 + x] != SURROUND).count();
        assert_eq!((row(5), row(0) < 14), (20, true));
    }

    #[test]
    fn nothing_is_drawn_without_trouble() {
        let disc = Disc::truth(&under(Vec::new()));
        for size in [[0, 0], [1, 1], [7, 3]] {
            assert_eq!(disc.paint(size, 0.5).rgb.len(), size[0] * size[1]);
        }
    }
}
