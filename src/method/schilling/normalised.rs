//! The normalised forms: the covariance in the base lobe's own profile.

use super::roughness::{
    Codes, carried, central_moments, covariance, divided, factor, multiplied, raw_moments, widest,
};
use crate::lobe::{BaseLobe, EllipticLobe};
use crate::method::one_lobe::OneLobe;
use crate::texture::{MIN_COSINE, Moments, Texel};

/// Channels: p = w·n_z, p·b, and K, all in the surface's tangent frame. With codes the isotropic form's K is
/// σ₁² I in the frame of the cell's own mean normal.
pub struct Normalised {
    pub base: BaseLobe,
    pub anisotropic: bool,
    pub codes: Option<Codes>,
}

impl Normalised {
    /// What is written of averaged moments: [p, b̄, d₁, d₂, d₃], or [p, b̄, σ₁, 0, 0].
    #[inline(always)]
    pub fn written(&self, moments: [f32; 6]) -> [f32; 6] {
        let [p, x, y, a, b, c] = divided(central_moments(moments));
        let [d1, d2, d3] = if self.anisotropic {
            factor([a, b, c])
        } else {
            [widest(carried([a, b, c], x, y))[0].max(0.0).sqrt(), 0.0, 0.0]
        };
        [p, x, y, d1, d2, d3]
    }
}

impl Moments<6> for Normalised {
    #[inline(always)]
    fn encode(&self, [x, y, z, w]: Texel) -> [f32; 6] {
        let z = z.max(MIN_COSINE);
        raw_moments(w * z, x / z, y / z)
    }

    #[inline(always)]
    fn store(&self, moments: [f32; 6]) -> [f32; 6] {
        let Some(codes) = &self.codes else { return central_moments(moments) };
        let [p, x, y, d1, d2, d3] = codes.round(self.written(moments));
        let [a, b, c] =
            if self.anisotropic { covariance(d1, d2, d3) } else { [d1 * d1, 0.0, d1 * d1] };
        multiplied([p, x, y, a, b, c])
    }
}

impl OneLobe<6> for Normalised {
    type Lobe = EllipticLobe;

    #[inline(always)]
    fn lobe(&self, [p, px, py, kxx, kxy, kyy]: [f32; 6]) -> EllipticLobe {
        let per = 1.0 / p.max(f32::MIN_POSITIVE);
        let (x, y) = (px * per, py * per);
        let stored = [kxx, kxy, kyy];
        let about_mean = carried(stored, x, y);
        let round = if self.codes.is_some() { stored } else { widest(about_mean) };
        let k = if self.anisotropic { about_mean } else { round };
        // GGX has no variance; bumps add to its α² as they add to Beckmann's, which is twice K.
        let share = if matches!(self.base, BaseLobe::Ggx { .. }) { 2.0 } else { 1.0 };
        let spread = self.base.spread() as f32;
        let widened = [share * k[0] + spread, share * k[1], share * k[2] + spread];
        let amplitude = (p * p + px * px + py * py).sqrt();
        EllipticLobe::new([px, py, p], widened, amplitude, self.base.profile())
    }
}
