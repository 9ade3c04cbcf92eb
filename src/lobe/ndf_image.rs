//! Normal distribution functions as images on the hemispherical (x, y) map (Kautz et al. 2001 §4, figure 2).

mod spread;
#[cfg(test)]
mod tests;

use super::vector::Sym2;
use super::{BaseLobe, MultipleSurface};

/// Slopes count as 4 (76°) where z is below a quarter: a normal at the horizon has none, and a tail as GGX's would have
/// no variance.
const LEAST_COSINE: f64 = 0.25;

/// A distribution of normals as a square image over [−1, 1]², whose axes are the x and y of unit normals in tangent
/// space: "directly using the x- and y-component of the normals" (§4).
///
/// A pixel holds D, the density of a lobe (see [`crate::lobe`]). As dx dy = cosθ dω, D is also the density of
/// normals over the map: ∫ D dx dy = ∫ D cosθ dω = 1. Pixels whose centre lies off the unit disc are 0.
#[derive(Clone, Debug, PartialEq)]
pub struct NdfImage {
    side: usize,
    /// Row by row from y = −1.
    density: Vec<f32>,
}

/// What the values of an image that is read as an NDF are densities of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Measure {
    /// Normals over the (x, y) map: D itself.
    #[default]
    Map,
    /// Normals over solid angle: D is such a value over cosθ.
    SolidAngle,
}

/// Why numbers are no distribution of normals.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NdfError {
    /// It is not square, or too small or large.
    #[error(
        "an NDF is a square image of {least} to {most} pixels a side, not {width} by {height}: scale or crop it"
    )]
    Size {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
        /// The least side.
        least: usize,
        /// The most.
        most: usize,
    },
    /// A value is negative, NaN or infinite.
    #[error(
        "the value {value} at pixel ({x}, {y}) from the top left is no density: all must be finite and at least 0"
    )]
    Value {
        /// Pixels from the left.
        x: usize,
        /// Pixels from the top.
        y: usize,
        /// The value.
        value: f32,
    },
    /// All values are 0.
    #[error("all of it is 0: no normal has any density")]
    Empty,
    /// There are normals longer than 1.
    #[error(
        "{percent:.1} % of its sum lies outside of the unit disc, first at pixel ({x}, {y}) from the top left: no unit \
         normal has such x and y; paint black what is outside of the circle that touches all four sides"
    )]
    Outside {
        /// Pixels from the left.
        x: usize,
        /// Pixels from the top.
        y: usize,
        /// How much, in percent.
        percent: f64,
    },
}

/// The least and most pixels a side.
pub const SIDES: [usize; 2] = [8, 2048];

impl NdfImage {
    /// An image of `side`² densities by a function of (x, y), averaged over a few points of each pixel and brought to
    /// sum 1.
    ///
    /// # Errors
    /// [`NdfError::Empty`] if there is no density.
    ///
    /// # Panics
    /// If `side` is not within [`SIDES`]: a programming error.
    pub fn from_fn(side: usize, density: impl Fn([f32; 2]) -> f32) -> Result<Self, NdfError> {
        assert!((SIDES[0]..=SIDES[1]).contains(&side), "side of an NDF");
        const WITHIN: usize = 3;
        let mut values = vec![0.0f32; side * side];
        for (k, value) in values.iter_mut().enumerate() {
            if off_disc(centre(side, k)) {
                continue;
            }
            let mut sum = 0.0;
            for part in 0..WITHIN * WITHIN {
                let at = |cell: usize, part: usize| {
                    let within = (part as f64 + 0.5) / WITHIN as f64;
                    2.0 * (cell as f64 + within) / side as f64 - 1.0
                };
                let [x, y] = [at(k % side, part % WITHIN), at(k / side, part / WITHIN)];
                if x * x + y * y < 1.0 {
                    sum += density([x as f32, y as f32]);
                }
            }
            *value = sum / (WITHIN * WITHIN) as f32;
        }
        Self { side, density: values }.normalised()
    }

    /// The distribution of a multiple surface: analytic NDFs, isotropic, anisotropic, or of several lobes.
    ///
    /// # Errors
    /// [`NdfError::Empty`] if it has no density.
    pub fn of_surface(surface: &MultipleSurface, side: usize) -> Result<Self, NdfError> {
        Self::from_fn(side, |[x, y]| {
            let z = (1.0 - x * x - y * y).max(0.0).sqrt();
            surface.density([x, y, z])
        })
    }

    /// The distribution measured from the texels of a normal map, [x, y, z, weight]: normals by their weights, counted
    /// in pixels (each shared by the four around it). With `base`, each is spread by that lobe: what the map looks like
    /// from afar.
    ///
    /// # Errors
    /// [`NdfError::Empty`] if no normal has weight or points up.
    pub fn of_normals(
        texels: &[[f32; 4]],
        base: Option<&BaseLobe>,
        side: usize,
    ) -> Result<Self, NdfError> {
        let mut counted = vec![0.0f64; side * side];
        for &[x, y, z, weight] in texels {
            if z <= 0.0 {
                continue;
            }
            // A normal near the rim must not fall off the disc.
            let inside = 1.0f32.min((1.0 - 1.5 / side as f32) / (x * x + y * y).sqrt().max(1e-9));
            share(side, [x * inside, y * inside], |k, part| counted[k] += f64::from(part * weight));
        }
        let counts = Self { side, density: counted.iter().map(|c| *c as f32).collect() };
        match base {
            None => counts.cut().normalised(),
            Some(base) => counts.cut().normalised()?.spread_by(base),
        }
    }

    /// An image that was read, `values` row by row from the top.
    ///
    /// # Errors
    /// [`NdfError`] for whatever is no distribution.
    pub fn of_image(
        (width, height): (usize, usize),
        values: &[f32],
        measure: Measure,
    ) -> Result<Self, NdfError> {
        let [least, most] = SIDES;
        if width != height || !(least..=most).contains(&width) || values.len() != width * height {
            return Err(NdfError::Size { width, height, least, most });
        }
        let side = width;
        let place = |k: usize| (k % side, k / side);
        if let Some(k) = values.iter().position(|v| !(v.is_finite() && *v >= 0.0)) {
            let (x, y) = place(k);
            return Err(NdfError::Value { x, y, value: values[k] });
        }
        // Rims are painted with soft brushes: as much as a rounding of 8 bits, a pixel wide, is cut without a word.
        let outside = |k: &usize| {
            let [x, y] = centre(side, *k);
            let rim = 1.0 + 3.0 / side as f64;
            x * x + y * y > rim * rim
        };
        let all: f64 = values.iter().map(|v| f64::from(*v)).sum();
        let off: f64 = (0..values.len()).filter(outside).map(|k| f64::from(values[k])).sum();
        if off > 1e-3 * all {
            let first = (0..values.len()).filter(outside).find(|k| values[*k] > 0.0);
            let (x, y) = place(first.unwrap_or(0));
            return Err(NdfError::Outside { x, y, percent: 100.0 * off / all });
        }
        let rows = values.chunks(side).rev();
        let image = Self { side, density: rows.flatten().copied().collect() };
        let per_cosine = |k: usize, value: f32| {
            let [x, y] = centre(side, k);
            let square = (1.0 - x * x - y * y).max(0.5 / side as f64);
            value / square.sqrt() as f32
        };
        match measure {
            Measure::Map => image.cut().normalised(),
            Measure::SolidAngle => {
                let density = image.density.iter().enumerate().map(|(k, v)| per_cosine(k, *v));
                Self { side, density: density.collect() }.cut().normalised()
            }
        }
    }

    /// The same with a share of a cosine distribution, which is even over the map, mixed in: then every normal has
    /// some density, and can return from its indices.
    pub fn with_floor(&self, share: f32) -> Self {
        let inside = (0..self.density.len()).filter(|k| !off_disc(centre(self.side, *k))).count();
        let even = (self.side * self.side) as f32 / (4.0 * inside as f32);
        let mix = |(k, d): (usize, &f32)| {
            if off_disc(centre(self.side, k)) { 0.0 } else { (1.0 - share) * d + share * even }
        };
        Self { side: self.side, density: self.density.iter().enumerate().map(mix).collect() }
    }

    /// Several distributions of one side together, each by its share of all normals; shares are brought to sum 1.
    ///
    /// # Errors
    /// [`NdfError::Empty`] if no share is above 0.
    ///
    /// # Panics
    /// If there is none, or sides differ: a programming error.
    pub fn mixed(all: &[(f64, &Self)]) -> Result<Self, NdfError> {
        let side = all[0].1.side;
        assert!(all.iter().all(|(_, ndf)| ndf.side == side), "sides of NDFs that are mixed");
        let sum = |k: usize| all.iter().map(|(part, ndf)| part * f64::from(ndf.density[k])).sum();
        let density = (0..side * side)
            .map(|k| {
                let sum: f64 = sum(k);
                sum as f32
            })
            .collect();
        Self { side, density }.normalised()
    }

    /// Pixels a side.
    pub fn side(&self) -> usize {
        self.side
    }

    /// All densities, row by row from y = −1.
    pub fn values(&self) -> &[f32] {
        &self.density
    }

    /// Memory, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.density.as_slice())
    }

    /// D at the x and y of a unit normal that points up, bilinear between pixel centres.
    #[inline(always)]
    pub fn at(&self, x: f32, y: f32) -> f32 {
        let (n, last) = (self.side as f32, self.side - 1);
        let place = |c: f32| {
            let c = ((0.5 * c + 0.5) * n - 0.5).clamp(0.0, last as f32);
            let low = (c as usize).min(last - 1);
            (low, c - low as f32)
        };
        let ((i, fx), (j, fy)) = (place(x), place(y));
        let k = j * self.side + i;
        let lerp = |k: usize| self.density[k] + fx * (self.density[k + 1] - self.density[k]);
        let low = lerp(k);
        low + fy * (lerp(k + self.side) - low)
    }

    /// Covariance of the slopes (x/z, y/z) of its normals about z, steep ones held to about 4, as
    /// [xx, xy, yy].
    pub fn slope_covariance(&self) -> Sym2 {
        let mut sums = [0.0f64; 6];
        for (k, &density) in self.density.iter().enumerate() {
            let [x, y] = centre(self.side, k);
            let z = (1.0 - x * x - y * y).max(0.0).sqrt().max(LEAST_COSINE);
            let (x, y) = (x / z, y / z);
            let parts = [1.0, x, y, x * x, x * y, y * y];
            sums.iter_mut().zip(parts).for_each(|(sum, part)| *sum += f64::from(density) * part);
        }
        let [_, x, y, xx, xy, yy] = sums.map(|sum| sum / sums[0]);
        [xx - x * x, xy - x * y, yy - y * y].map(|c| c as f32)
    }

    /// The mean normal ∫ D n dx dy: the vector moment of a lobe of this density.
    pub fn mean_normal(&self) -> [f64; 3] {
        let mut sums = [0.0f64; 4];
        for (k, &density) in self.density.iter().enumerate() {
            let [x, y] = centre(self.side, k);
            let z = (1.0 - x * x - y * y).max(0.0).sqrt();
            let parts = [1.0, x, y, z];
            sums.iter_mut().zip(parts).for_each(|(sum, part)| *sum += f64::from(density) * part);
        }
        [1, 2, 3].map(|c| sums[c] / sums[0])
    }

    /// The same, with nothing off the disc.
    fn cut(mut self) -> Self {
        for (k, value) in self.density.iter_mut().enumerate() {
            if off_disc(centre(self.side, k)) {
                *value = 0.0;
            }
        }
        self
    }

    /// The same of sum 1.
    fn normalised(mut self) -> Result<Self, NdfError> {
        let sum: f64 = self.density.iter().map(|d| f64::from(*d)).sum();
        if !(sum > 0.0 && sum.is_finite()) {
            return Err(NdfError::Empty);
        }
        let per_pixel = (self.side * self.side) as f64 / (4.0 * sum);
        self.density.iter_mut().for_each(|d| *d = (f64::from(*d) * per_pixel) as f32);
        Ok(self)
    }
}

/// Where the centre of pixel `k` lies.
#[inline(always)]
fn centre(side: usize, k: usize) -> [f64; 2] {
    [k % side, k / side].map(|cell| (2 * cell + 1) as f64 / side as f64 - 1.0)
}

/// Whether no unit normal has these x and y.
fn off_disc([x, y]: [f64; 2]) -> bool {
    x * x + y * y >= 1.0
}

/// Shares a point among the four pixels around it: their indices, and parts that sum to 1.
fn share(side: usize, at: [f32; 2], mut give: impl FnMut(usize, f32)) {
    let last = (side - 1) as f32;
    let [(i, fx), (j, fy)] = at.map(|c| {
        let c = ((0.5 * c + 0.5) * side as f32 - 0.5).clamp(0.0, last);
        let low = (c as usize).min(side - 2);
        (low, c - low as f32)
    });
    for (row, wy) in [(j, 1.0 - fy), (j + 1, fy)] {
        for (column, wx) in [(i, 1.0 - fx), (i + 1, fx)] {
            give(row * side + column, wx * wy);
        }
    }
}
