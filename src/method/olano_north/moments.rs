//! The nine numbers, how they are written, and the Gaussian they stand for.

use crate::lobe::Cut;
use crate::lobe::vector::{V3, at_least, dot, tangents, unit};
use crate::method::storage::{Code, Storage};
use crate::texture::{NormalMap, Texel};

/// The moments [w u, w E₂] of a Gaussian about a single normal; E₂ as xx, xy, xz, yy, yz, zz.
pub struct NineNumbers {
    /// v, the variance of a single normal.
    pub variance: f32,
    mean: Code,
    second: Code,
}

/// A 3D Gaussian of a footprint.
pub struct Gaussian3 {
    /// Mean weight w.
    pub weight: f32,
    /// u and S.
    pub cut: Cut,
}

impl NineNumbers {
    pub fn new(variance: f64, storage: Storage, map: &NormalMap) -> Self {
        let heaviest = map.texels().iter().fold(0.0, |most: f32, texel| most.max(texel[3]));
        let variance = variance as f32;
        let (mean, second) =
            (storage.signed(heaviest), storage.signed(heaviest * (1.0 + variance)));
        Self { variance, mean, second }
    }

    #[inline(always)]
    pub fn encode(&self, [x, y, z, w]: Texel) -> [f32; 9] {
        let v = self.variance;
        let e2 = [x * x + v, x * y, x * z, y * y + v, y * z, z * z + v];
        let mut moments = [x, y, z, e2[0], e2[1], e2[2], e2[3], e2[4], e2[5]];
        for moment in &mut moments {
            *moment *= w;
        }
        moments
    }

    /// What is read of nine numbers that were written.
    #[inline(always)]
    pub fn round(&self, mut moments: [f32; 9]) -> [f32; 9] {
        for moment in &mut moments[..3] {
            *moment = self.mean.round(*moment);
        }
        for moment in &mut moments[3..] {
            *moment = self.second.round(*moment);
        }
        moments
    }

    /// S = E₂ − uᵀu. The weight needs no tenth number: normals are unit vectors, so the trace of E₂
    /// is w (1 + 3v); and no mean of them is longer than w.
    ///
    /// Averages of rounded numbers can leave S without positivity. So its variance along the mean, and those
    /// across for a given length, are held at half of v, below what an exact S can have; an S of which that is
    /// true is positive, and one that is above it stays as it is.
    #[inline(always)]
    pub fn gaussian(&self, [wx, wy, wz, xx, xy, xz, yy, yz, zz]: [f32; 9]) -> Gaussian3 {
        let sum = [wx, wy, wz];
        let resultant = dot(sum, sum).sqrt();
        let weight = ((xx + yy + zz) / (1.0 + 3.0 * self.variance)).max(resultant);
        let per = 1.0 / weight.max(f32::MIN_POSITIVE);
        let [x, y, z] = [wx * per, wy * per, wz * per];
        let s = [
            xx * per - x * x,
            xy * per - x * y,
            xz * per - x * z,
            yy * per - y * y,
            yz * per - y * z,
            zz * per - z * z,
        ];
        let floor = 0.5 * self.variance;
        let axis = unit(sum);
        let (t, b) = tangents(axis);
        let radial = between(s, axis, axis).max(floor);
        let lean = [between(s, t, axis) / radial, between(s, b, axis) / radial];
        let across = [
            between(s, t, t) - lean[0] * lean[0] * radial,
            between(s, t, b) - lean[0] * lean[1] * radial,
            between(s, b, b) - lean[1] * lean[1] * radial,
        ];
        let across = at_least(across, floor);
        let cut = Cut { axis, length: resultant * per, radial, lean, across };
        Gaussian3 { weight, cut }
    }
}

/// aᵀ S b
#[inline(always)]
fn between([xx, xy, xz, yy, yz, zz]: [f32; 6], a: V3, b: V3) -> f32 {
    let row = [dot([xx, xy, xz], b), dot([xy, yy, yz], b), dot([xz, yz, zz], b)];
    dot(a, row)
}
