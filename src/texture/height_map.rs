//! Height maps: Blinn's bump function F(u, v) as a table (Blinn 1978 §3).

use super::Wrap;

/// A table of heights. Entry (i, j) stands at u = (i + ½)/width, v = (j + ½)/height; row 0 is at
/// v = 0, the bottom of the picture. Heights are in units of the side of a texel unless the user of
/// the map scales them.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    width: usize,
    height: usize,
    wrap: Wrap,
    values: Vec<f64>,
}

impl HeightMap {
    /// A table of `width · height` values, row by row from v = 0; what is not finite becomes 0.
    ///
    /// # Panics
    /// If a side is 0 or the number of values is not `width · height`.
    pub fn new(width: usize, height: usize, wrap: Wrap, mut values: Vec<f64>) -> Self {
        assert!(width > 0 && height > 0 && values.len() == width * height, "shape of a height map");
        values.iter_mut().filter(|value| !value.is_finite()).for_each(|value| *value = 0.0);
        Self { width, height, wrap, values }
    }

    /// A table of `f(u, v)` at entry centres.
    pub fn from_fn(
        width: usize,
        height: usize,
        wrap: Wrap,
        mut f: impl FnMut(f64, f64) -> f64,
    ) -> Self {
        let mut values = Vec::with_capacity(width * height);
        for j in 0..height {
            let v = (j as f64 + 0.5) / height as f64;
            values.extend((0..width).map(|i| f((i as f64 + 0.5) / width as f64, v)));
        }
        Self::new(width, height, wrap, values)
    }

    /// Entries along u.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Entries along v.
    pub fn height(&self) -> usize {
        self.height
    }

    /// What lies beyond the edge.
    pub fn wrap(&self) -> Wrap {
        self.wrap
    }

    /// All values, row by row from v = 0.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The height at entry (i, j), which may lie outside.
    pub fn at(&self, i: isize, j: isize) -> f64 {
        let (i, j) = (self.wrap.index(i, self.width), self.wrap.index(j, self.height));
        self.values[j * self.width + i]
    }

    /// The height at entry (i, j), which may lie outside; beyond a clamped edge the table goes on in a straight
    /// line, so that differences there are those at the edge.
    pub fn beyond(&self, i: isize, j: isize) -> f64 {
        if self.wrap == Wrap::Repeat {
            return self.at(i, j);
        }
        let line = |k: isize, size: usize, read: &dyn Fn(isize) -> f64| {
            let last = size as isize - 1;
            let edge = k.clamp(0, last);
            let inner = if k < 0 { 1.min(last) } else { (last - 1).max(0) };
            match k - edge {
                0 => read(k),
                over => read(edge) + (read(edge) - read(inner)) * over.abs() as f64,
            }
        };
        line(j, self.height, &|j| line(i, self.width, &|i| self.at(i, j)))
    }

    /// The table `count` times along each side.
    pub fn replicated(&self, count: usize) -> Self {
        let (width, height) = (self.width * count, self.height * count);
        let entry = |k: usize| (k / width % self.height) * self.width + k % width % self.width;
        let values = (0..width * height).map(|k| self.values[entry(k)]).collect();
        Self { width, height, wrap: self.wrap, values }
    }

    /// The table turned by 90° counter-clockwise about its centre.
    pub fn rotated(&self) -> Self {
        let (width, height) = (self.height, self.width);
        let mut values = vec![0.0; width * height];
        for (k, &value) in self.values.iter().enumerate() {
            let (i, j) = (k % self.width, k / self.width);
            values[i * width + (width - 1 - j)] = value;
        }
        Self { width, height, wrap: self.wrap, values }
    }

    /// The table with all heights multiplied by `factor`.
    pub fn scaled(&self, factor: f64) -> Self {
        let values = self.values.iter().map(|value| value * factor).collect();
        Self::new(self.width, self.height, self.wrap, values)
    }

    /// The least and the greatest value.
    pub fn range(&self) -> [f64; 2] {
        let widen = |[low, high]: [f64; 2], &x: &f64| [low.min(x), high.max(x)];
        self.values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], widen)
    }

    /// [∂F/∂x, ∂F/∂y] at entry (i, j) in height units per texel, by central differences over one
    /// texel either side: (F(i+1) − F(i−1)) / 2 (Blinn 1978 §3 with E = one cell). At a clamped edge
    /// the difference is one-sided, over one texel.
    pub fn gradient(&self, i: isize, j: isize) -> [f64; 2] {
        let along = |k: isize, size: usize, read: &dyn Fn(isize) -> f64| {
            let clamped = self.wrap == Wrap::Clamp;
            let low = if clamped { (k - 1).max(0) } else { k - 1 };
            let high = if clamped { (k + 1).min(size as isize - 1) } else { k + 1 };
            if high == low { 0.0 } else { (read(high) - read(low)) / (high - low) as f64 }
        };
        [along(i, self.width, &|k| self.at(k, j)), along(j, self.height, &|k| self.at(i, k))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::NormalMap;

    #[test]
    fn gradients_of_a_slope() {
        let map = HeightMap::from_fn(8, 4, Wrap::Clamp, |u, v| 3.0 * u * 8.0 - v * 4.0);
        for (i, j) in [(0, 0), (3, 2), (7, 3)] {
            let [x, y] = map.gradient(i, j);
            assert!((x - 3.0).abs() < 1e-12 && (y + 1.0).abs() < 1e-12, "{i},{j}: {x} {y}");
        }
    }

    #[test]
    fn what_is_not_finite_becomes_flat() {
        let bad = vec![f64::NAN, 2.0, f64::INFINITY, -f64::INFINITY];
        let map = HeightMap::new(2, 2, Wrap::Repeat, bad);
        assert_eq!(map.values(), [0.0, 2.0, 0.0, 0.0]);
        assert_eq!(map.range(), [0.0, 2.0]);
    }

    #[test]
    fn turned_heights_are_of_the_turned_normals() {
        let map = HeightMap::from_fn(7, 4, Wrap::Repeat, |u, v| (9.0 * u).sin() + v * v);
        let normals = NormalMap::from_heights(&map, 1.0);
        assert_eq!(NormalMap::from_heights(&map.rotated(), 1.0), normals.rotated());
    }

    #[test]
    fn periodic_gradient_sees_across_the_seam() {
        let map = HeightMap::new(4, 1, Wrap::Repeat, vec![0.0, 1.0, 0.0, -1.0]);
        assert_eq!(map.gradient(0, 0), [1.0, 0.0]);
        let one = HeightMap::new(1, 1, Wrap::Clamp, vec![5.0]);
        assert_eq!(one.gradient(0, 0), [0.0, 0.0]);
    }
}
