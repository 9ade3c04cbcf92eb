//! The density times a normalisation factor of each cell.

use super::integral::moment;
use super::moments::{Gaussian3, NineNumbers};
use super::printed::per_root_determinant;
use crate::lobe::{Cut, Generator, RestrictedLobe};
use crate::method::one_lobe::OneLobe;
use crate::texture::{Moments, Texel};

/// Channels: the nine numbers, and F of w |u| F g(q)/√det S. F varies slowly from cell to cell where √det S
/// does not: for narrow lobes it is √S_rr/2π.
pub struct Factors {
    nine: NineNumbers,
    generator: Generator,
    /// F of a single normal.
    single: f32,
}

impl Factors {
    pub fn new(nine: NineNumbers, generator: Generator) -> Self {
        let v = nine.variance;
        let cut = Cut {
            axis: [0.0, 0.0, 1.0],
            length: 1.0,
            radial: v,
            lean: [0.0; 2],
            across: [v, 0.0, v],
        };
        let single = factor(&cut, generator);
        Self { nine, generator, single }
    }
}

/// 1 / ∫ g(q)/√det S (n·h) dω; 0 where that is not a finite number above 0.
fn factor(cut: &Cut, generator: Generator) -> f32 {
    let per_root = f64::from(per_root_determinant(cut.across)) / f64::from(cut.radial).sqrt();
    let factor = (1.0 / (per_root * moment(cut, generator))) as f32;
    if factor.is_finite() { factor.max(0.0) } else { 0.0 }
}

/// How far below 1 the square of a mean's length may be for its normals to count as one: rounding, and a
/// part of the variance that changes its factor by less.
const ROUNDING: f32 = 4e-6;
const PART: f32 = 1e-4;

impl Moments<10> for Factors {
    #[inline(always)]
    fn encode(&self, texel: Texel) -> [f32; 10] {
        let [x, y, z, xx, xy, xz, yy, yz, zz] = self.nine.encode(texel);
        [x, y, z, xx, xy, xz, yy, yz, zz, 0.0]
    }

    fn store(&self, [x, y, z, xx, xy, xz, yy, yz, zz, _]: [f32; 10]) -> [f32; 10] {
        let nine = [x, y, z, xx, xy, xz, yy, yz, zz];
        // Normals that are one have the factor of one: all of level 0.
        let v = self.nine.variance;
        let weight = (xx + yy + zz) / (1.0 + 3.0 * v);
        let apart = 1.0 - (x * x + y * y + z * z) / (weight * weight).max(f32::MIN_POSITIVE);
        let written = self.nine.round(nine);
        let factor = if apart <= ROUNDING + PART * v {
            self.single
        } else {
            factor(&self.nine.gaussian(written).cut, self.generator)
        };
        let [x, y, z, xx, xy, xz, yy, yz, zz] = written;
        [x, y, z, xx, xy, xz, yy, yz, zz, factor]
    }
}

impl OneLobe<10> for Factors {
    type Lobe = RestrictedLobe;

    #[inline(always)]
    fn lobe(&self, [x, y, z, xx, xy, xz, yy, yz, zz, factor]: [f32; 10]) -> RestrictedLobe {
        let Gaussian3 { weight, cut } = self.nine.gaussian([x, y, z, xx, xy, xz, yy, yz, zz]);
        let per_root = per_root_determinant(cut.across) / cut.radial.sqrt();
        let amplitude = weight * cut.length * factor * per_root;
        RestrictedLobe::new(cut, amplitude, self.generator)
    }
}
