//! The projected 2D Gaussian.

use super::moments::{Gaussian3, NineNumbers};
use crate::lobe::{Cut, EllipticLobe, Profile};
use crate::method::one_lobe::OneLobe;
use crate::texture::{Moments, Texel};

pub struct Projected {
    pub nine: NineNumbers,
}

impl Moments<9> for Projected {
    #[inline(always)]
    fn encode(&self, texel: Texel) -> [f32; 9] {
        self.nine.encode(texel)
    }

    #[inline(always)]
    fn store(&self, moments: [f32; 9]) -> [f32; 9] {
        self.nine.round(moments)
    }
}

impl OneLobe<9> for Projected {
    type Lobe = EllipticLobe;

    #[inline(always)]
    fn lobe(&self, channels: [f32; 9]) -> EllipticLobe {
        let Gaussian3 { weight, cut } = self.nine.gaussian(channels);
        let Cut { axis, length, lean, across, .. } = cut;
        let reach = 1.0 - length;
        EllipticLobe::new(axis, across, weight * length, Profile::Gaussian)
            .with_mean([lean[0] * reach, lean[1] * reach])
    }
}
