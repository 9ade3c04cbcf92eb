//! Olano and North's lobe: a 3D Gaussian restricted to the sphere, by its Pearson II stand-in.

use super::vector::{V3, tangents, unit};
use super::{Facet, Spread};

/// amplitude · (1 − q/2m)ᵐ for q < 2m, else 0, with q = (h − u) S⁻¹ (h − u)ᵀ and h a unit vector
/// (Olano and North 1997 §6). They use m = 8 for its cheapness; the print shows 2ᵐ where 2m is meant.
///
/// It is not normalised over the sphere: as the paper says, its pictures divide by √det S alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PearsonLobe {
    mean: V3,
    /// S⁻¹ as [xx, xy, xz, yy, yz, zz].
    inverse: [f32; 6],
    amplitude: f32,
    axis: V3,
    alpha_squared: f32,
}

/// Pearson II's constant m, as the paper chose it.
const M: i32 = 8;

impl PearsonLobe {
    /// The lobe with mean `mean` and inverse covariance `inverse` ([xx, xy, xz, yy, yz, zz]).
    /// `variance` is a representative variance across the mean direction, for shadowing alone.
    #[inline(always)]
    pub fn new(mean: V3, inverse: [f32; 6], amplitude: f32, variance: f32) -> Self {
        Self { mean, inverse, amplitude, axis: unit(mean), alpha_squared: 2.0 * variance }
    }

    /// The same lobe with its density multiplied by `factor`.
    pub fn faded(self, factor: f32) -> Self {
        Self { amplitude: self.amplitude * factor, ..self }
    }
}

impl Spread for PearsonLobe {
    #[inline(always)]
    fn density(&self, h: V3) -> f32 {
        let h = unit(h);
        let [x, y, z] = [h[0] - self.mean[0], h[1] - self.mean[1], h[2] - self.mean[2]];
        let [xx, xy, xz, yy, yz, zz] = self.inverse;
        let q = x * (xx * x + 2.0 * (xy * y + xz * z)) + y * (yy * y + 2.0 * yz * z) + zz * z * z;
        let base = (1.0 - q / (2 * M) as f32).clamp(0.0, 1.0);
        let square = base * base;
        let fourth = square * square;
        self.amplitude * fourth * fourth
    }

    #[inline(always)]
    fn facet(&self) -> Facet {
        let (tangent, bitangent) = tangents(self.axis);
        let alpha_squared = [self.alpha_squared, 0.0, self.alpha_squared];
        Facet { axis: self.axis, tangent, bitangent, alpha_squared, ggx: false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::vector::dot;

    #[test]
    fn near_a_gaussian_and_compact() {
        let v = 0.02_f32;
        let lobe =
            PearsonLobe::new([0.0, 0.0, 1.0], [1.0 / v, 0.0, 0.0, 1.0 / v, 0.0, 1.0 / v], 1.0, v);
        for tilt in [0.0_f32, 0.05, 0.1, 0.2] {
            let h = [tilt.sin(), 0.0, tilt.cos()];
            let d = [h[0], 0.0, h[2] - 1.0];
            let gauss = (-0.5 * dot(d, d) / v).exp();
            // The largest gap of (1 − t/16)⁸ to e^(−t/2) is 0.035.
            assert!((lobe.density(h) - gauss).abs() < 0.036, "{tilt}");
        }
        assert_eq!(lobe.density([1.0, 0.0, 0.0]), 0.0);
        assert_eq!(lobe.density([0.0, 0.0, -1.0]), 0.0);
    }
}
