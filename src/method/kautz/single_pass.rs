//! The graphics hardware's form: a mipmapped texture of indices (Kautz et al. 2001 §5.2.2).

use std::sync::Arc;

use super::super::{Batch, Lane, Prefiltered};
use super::OwnNdf;
use crate::lobe::vector::dot;
use crate::lobe::{MultipleSurface, NdfImage, Shading};
use crate::synthesis::{Bits, IndexTexture, MicroFrame, Synthesis};
use crate::texture::Footprint;

/// An isotropic NDF as a one-dimensional texture over n·h: "we store the isotropic NDF p_i(n_m · h_m) in a 1D texture".
#[derive(Clone, Debug, PartialEq)]
pub struct RadialNdf {
    values: Vec<f32>,
}

impl RadialNdf {
    /// The NDF along +x, with so many entries (at least 2) from n·h = 0 to 1.
    pub fn of(ndf: &NdfImage, entries: usize) -> Self {
        let last = entries.max(2) - 1;
        let at = |k: usize| {
            let cosine = k as f32 / last as f32;
            ndf.at((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0)
        };
        Self { values: (0..=last).map(at).collect() }
    }

    /// p_i at a cosine, linear between entries; 0 below the horizon.
    #[inline(always)]
    pub fn at(&self, cosine: f32) -> f32 {
        let last = self.values.len() - 1;
        let place = cosine.clamp(0.0, 1.0) * last as f32;
        let low = (place as usize).min(last - 1);
        let found =
            self.values[low] + (place - low as f32) * (self.values[low + 1] - self.values[low]);
        if cosine > 0.0 { found } else { 0.0 }
    }
}

/// Indices from a mipmapped texture of noise, then the table, then the NDF. "The indices (r₁, r₂) are filtered and the
/// filtered indices are used for the lookup to get a normal" (§6).
#[derive(Clone, Debug)]
pub struct SinglePass {
    synthesis: Arc<Synthesis>,
    ndf: OwnNdf,
    texture: IndexTexture,
    bits: Bits,
    radial: Option<RadialNdf>,
}

impl SinglePass {
    /// A texture of `side` texels whose finest level has so many octaves, stored in these bits. Filtered indices have
    /// as many again, as between the stages of such hardware, and look up the nearest entry of the table; unrounded
    /// ones interpolate it. With `radial`, the NDF is looked up by n·h in that many entries, which suits isotropic NDFs.
    pub fn new(
        synthesis: Arc<Synthesis>,
        side: usize,
        octaves: f64,
        bits: Bits,
        radial: Option<usize>,
    ) -> Self {
        let ndf = OwnNdf::new(Arc::clone(&synthesis.ndf));
        let texture = IndexTexture::of_noise(&synthesis, [side; 2], octaves, bits);
        let radial = radial.map(|entries| RadialNdf::of(&synthesis.ndf, entries));
        Self { synthesis, ndf, texture, bits, radial }
    }

    fn microfacet(&self, at: &Footprint) -> MicroFrame {
        let r = self.texture.fetch(at).map(|r| self.bits.rounded(r));
        match self.bits {
            Bits::Eight => *self.synthesis.table.nearest(r),
            Bits::Sixteen | Bits::Float => self.synthesis.table.smooth(r),
        }
    }
}

impl Prefiltered for SinglePass {
    fn bytes(&self) -> usize {
        self.texture.bytes() + self.synthesis.table.bytes() + self.synthesis.ndf.bytes()
    }

    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        self.ndf.about(self.microfacet(at), 1.0)
    }

    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        let microfacet = |i: usize| self.microfacet(&batch.footprint(i));
        match (&self.radial, shading) {
            (Some(radial), Shading::Ndf) => {
                for (i, out) in radiance.iter_mut().enumerate().take(batch.len) {
                    let half = batch.half(i);
                    let [_, _, normal] = microfacet(i);
                    let cosine = dot(half, normal) / dot(half, half).sqrt().max(f32::MIN_POSITIVE);
                    *out = batch.irradiance[i] * radial.at(cosine);
                }
            }
            _ => self.ndf.shade(batch, shading, radiance, |i| (microfacet(i), 1.0)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::{BaseLobe, Lobe, Spread};
    use crate::synthesis::Noise;

    fn isotropic() -> Arc<Synthesis> {
        let lobe = BaseLobe::BlinnPhong { exponent: 25.0 }.about([0.0, 0.0, 1.0], 1.0);
        let ndf = NdfImage::of_surface(&[lobe].into_iter().collect(), 256).unwrap();
        Arc::new(Synthesis::new(ndf, Noise { cells: [8; 2], ..Noise::default() }))
    }

    #[test]
    fn for_an_isotropic_ndf_one_dimension_is_enough() {
        let synthesis = isotropic();
        let radial = RadialNdf::of(&synthesis.ndf, 1024);
        let pass = SinglePass::new(Arc::clone(&synthesis), 64, 3.0, Bits::Float, None);
        let at = Footprint { u: 0.3, v: 0.6, ..Footprint::default() };
        let surface = pass.lobes_at(&at);
        let [lobe @ Lobe::Sampled(_)] = surface.lobes() else { panic!("{surface:?}") };
        let normal = lobe.axis();
        for h in [[0.0, 0.0, 1.0], [0.3, -0.2, 0.9], [-0.1, 0.5, 0.8]] {
            let h = crate::lobe::vector::unit(h);
            let (want, got) = (lobe.density(h), radial.at(dot(normal, h)));
            // Pixels of the image are 1/128 of the radius wide.
            assert!((want - got).abs() < 0.02 * radial.at(1.0), "{want} {got}");
        }
    }

    #[test]
    fn eight_bits_leave_steps_and_sixteen_none_to_speak_of() {
        let synthesis = isotropic();
        let [eight, sixteen, float] = [Bits::Eight, Bits::Sixteen, Bits::Float]
            .map(|bits| SinglePass::new(Arc::clone(&synthesis), 64, 3.0, bits, None));
        let normal = |pass: &SinglePass, u: f32| {
            pass.microfacet(&Footprint { u, v: 0.4, ..Footprint::default() })[2]
        };
        let (mut coarse, mut fine) = (0.0f32, 0.0f32);
        for k in 0..500 {
            let u = k as f32 / 500.0;
            let want = normal(&float, u);
            let apart = |n: [f32; 3]| (0..3).map(|c| (n[c] - want[c]).abs()).fold(0.0, f32::max);
            coarse = coarse.max(apart(normal(&eight, u)));
            fine = fine.max(apart(normal(&sixteen, u)));
        }
        assert!(coarse > 3e-3 && fine < 1e-3, "{coarse} {fine}");
    }
}
