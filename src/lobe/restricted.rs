//! Olano and North's lobe: a 3D distribution with elliptical contours restricted to the sphere.

use super::vector::{self, Sym2, V3, dot, invert, quadratic, tangents, unit};
use super::{Facet, Spread};
use crate::geometry::elementary::exp32;

/// amplitude · g(q) with q = (h − u) S⁻¹ (h − u)ᵀ for a unit vector h (Olano and North 1997 §6).
///
/// S is held as what a cut across the mean direction makes of it ([`Cut`]). The density is not normalised
/// over the sphere: it is the amplitude's business.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestrictedLobe {
    cut: Cut,
    tangent: V3,
    bitangent: V3,
    inverse: Sym2,
    amplitude: f32,
    generator: Generator,
}

/// A 3D Gaussian seen along its mean: mean and covariance in the frame (t, b, n) of the mean direction n, t and
/// b as [`tangents`] gives them. For given r = (h − u)·n, the rest of h − u is normal about r·`lean` with
/// covariance `across`; so S is positive exactly if `radial` and `across` are, and det S is radial · det across.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// n, of unit length.
    pub axis: V3,
    /// |u|.
    pub length: f32,
    /// S_rr, the variance along n.
    pub radial: f32,
    /// S_tr/S_rr.
    pub lean: [f32; 2],
    /// C = S_tt − S_tr S_trᵀ/S_rr.
    pub across: Sym2,
}

/// The density generator g of an elliptically contoured distribution: how density falls with q (Johnson 1987).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Generator {
    /// e^(−q/2).
    Gaussian,
    /// Pearson II: (1 − q/2m)ᵐ for q < 2m, else 0. The paper takes m = 8 for its cheapness; the print shows
    /// 2ᵐ where 2m is meant.
    Pearson {
        /// m, from 1 to [`Generator::MOST`].
        m: u32,
    },
}

impl Generator {
    /// The largest m of Pearson II.
    pub const MOST: u32 = 63;

    /// g(q), q ≥ 0.
    #[inline(always)]
    pub fn at(self, q: f32) -> f32 {
        match self {
            Self::Gaussian => exp32(-0.5 * q),
            Self::Pearson { m } => power((1.0 - q / (2 * m) as f32).clamp(0.0, 1.0), m),
        }
    }
}

/// bᵐ for m ≤ 63, by squaring; the same steps for every m.
#[inline(always)]
fn power(mut b: f32, m: u32) -> f32 {
    let mut product = 1.0;
    for bit in 0..6 {
        product *= if (m >> bit) & 1 == 1 { b } else { 1.0 };
        b *= b;
    }
    product
}

impl RestrictedLobe {
    /// The lobe with this mean and covariance: its value is `amplitude` at q = 0.
    #[inline(always)]
    pub fn new(cut: Cut, amplitude: f32, generator: Generator) -> Self {
        let (tangent, bitangent) = tangents(cut.axis);
        let (inverse, _) = invert(cut.across);
        Self { cut, tangent, bitangent, inverse, amplitude, generator }
    }

    /// The same lobe with its density multiplied by `factor`.
    pub fn faded(self, factor: f32) -> Self {
        Self { amplitude: self.amplitude * factor, ..self }
    }
}

impl Spread for RestrictedLobe {
    #[inline(always)]
    fn density(&self, h: V3) -> f32 {
        let (h, cut) = (unit(h), &self.cut);
        let r = dot(h, cut.axis) - cut.length;
        let x = dot(h, self.tangent) - cut.lean[0] * r;
        let y = dot(h, self.bitangent) - cut.lean[1] * r;
        let q = r * r / cut.radial + quadratic(self.inverse, x, y);
        self.amplitude * self.generator.at(q.max(0.0))
    }

    #[inline(always)]
    fn facet(&self) -> Facet {
        Facet {
            axis: self.cut.axis,
            tangent: self.tangent,
            bitangent: self.bitangent,
            alpha_squared: vector::times(self.cut.across, 2.0),
            ggx: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn round(v: f32, generator: Generator) -> RestrictedLobe {
        let cut = Cut {
            axis: [0.0, 0.0, 1.0],
            length: 1.0,
            radial: v,
            lean: [0.0; 2],
            across: [v, 0.0, v],
        };
        RestrictedLobe::new(cut, 1.0, generator)
    }

    #[test]
    fn pearson_is_near_a_gaussian_and_compact() {
        let v = 0.02_f32;
        let lobe = round(v, Generator::Pearson { m: 8 });
        for tilt in [0.0_f32, 0.05, 0.1, 0.2] {
            let h = [tilt.sin(), 0.0, tilt.cos()];
            let gauss = round(v, Generator::Gaussian).density(h);
            let d = [h[0], 0.0, h[2] - 1.0];
            assert!((gauss - (-0.5 * dot(d, d) / v).exp()).abs() < 1e-6);
            // The largest gap of (1 − t/16)⁸ to e^(−t/2) is 0.035.
            assert!((lobe.density(h) - gauss).abs() < 0.036, "{tilt}");
        }
        assert_eq!(lobe.density([1.0, 0.0, 0.0]), 0.0);
        assert_eq!(lobe.density([0.0, 0.0, -1.0]), 0.0);
    }

    #[test]
    fn powers_are_powers() {
        for m in 1..=Generator::MOST {
            let want = 0.9f64.powi(m as i32);
            assert!((f64::from(power(0.9, m)) / want - 1.0).abs() < 1e-5, "{m}");
        }
        let (far, near) = (Generator::Pearson { m: 63 }, Generator::Gaussian);
        assert!((far.at(1.0) - near.at(1.0)).abs() < 0.003);
    }

    #[test]
    fn a_cut_is_the_whole_covariance() {
        // S = (0.05 0.01 0.004; 0.01 0.03 −0.006; 0.004 −0.006 0.02) in the frame of n = z, |u| = 0.9.
        let (s, lean) = ([0.05, 0.01, 0.004, 0.03, -0.006, 0.02], [0.2, -0.3]);
        let across = [
            s[0] - lean[0] * lean[0] * s[5],
            s[1] - lean[0] * lean[1] * s[5],
            s[3] - lean[1] * lean[1] * s[5],
        ];
        let cut = Cut { axis: [0.0, 0.0, 1.0], length: 0.9, radial: s[5], lean, across };
        let lobe = RestrictedLobe::new(cut, 1.0, Generator::Gaussian);
        let whole = nalgebra::Matrix3::new(s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5]);
        let inverse = whole.try_inverse().unwrap();
        for h in [[0.0, 0.0, 1.0], [0.3, -0.2, 0.8], [-0.5, 0.4, 0.6]] {
            let h = unit(h);
            let d = nalgebra::Vector3::new(h[0], h[1], h[2] - 0.9);
            let want = (-0.5 * d.dot(&(inverse * d))).exp();
            assert!((lobe.density(h) - want).abs() < 1e-5);
        }
    }
}
