//! Averaged bumps (Blinn 1978 §5).

use std::sync::Arc;

use super::one_lobe::{OneLobe, OneLobeMap};
use super::{Card, Entry, Method, PrefilterError, Prefiltered, Progress, Refusal};
use crate::lobe::{BaseLobe, EllipticLobe};
use crate::texture::{Bend, MIN_COSINE, Moments, NormalMap, Texel};

/// The base lobe about the normal of the averaged bump function.
///
/// Filtering the bump function F before it is used averages its derivatives, so the mean slope is what
/// is left of the bumps: N′ ∝ (−F̄ᵤ, −F̄ᵥ, 1). "If the bump texture is averaged the effect will be to
/// smooth out the bumps rather than average the intensities", as Blinn says: the roughness is lost.
///
/// Channels: [w, w·bₓ, w·b_y], b = n_xy / n_z.
#[derive(Clone, Copy, Debug, Default)]
pub struct Averaged;

const CARD: Card = Card {
    name: "averaged",
    source: "Blinn 1978, Simulation of Wrinkled Surfaces, §5",
    summary: "Averages the slopes over the footprint and shades the smooth surface left.",
    formula: "one base lobe about the normal of the mean slope",
    limits: "the roughness of the bumps it averages away is lost: highlights stay sharp",
    normalised: true,
    keeps_roughness: false,
    fractal: false,
    precision: 1e-3,
};

/// The registry's line.
pub(super) fn entry() -> Entry {
    Entry { card: CARD, parameters: &[], build: |_| Box::new(Averaged) }
}

impl Method for Averaged {
    fn card(&self) -> Card {
        CARD
    }

    fn base_error(&self, _base: &BaseLobe) -> Result<f64, Refusal> {
        Ok(0.0)
    }

    fn bends(&self) -> bool {
        true
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        _progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        Ok(Box::new(OneLobeMap::build(map, base, MeanSlope { base: *base })))
    }
}

struct MeanSlope {
    base: BaseLobe,
}

impl Moments<3> for MeanSlope {
    #[inline(always)]
    fn encode(&self, [x, y, z, w]: Texel) -> [f32; 3] {
        let per_z = w / z.max(MIN_COSINE);
        [w, x * per_z, y * per_z]
    }
}

impl OneLobe<3> for MeanSlope {
    type Lobe = EllipticLobe;

    #[inline(always)]
    fn lobe(&self, [w, x, y]: [f32; 3]) -> EllipticLobe {
        // (x/w, y/w, 1) without the division: only the direction matters.
        self.base.about([x, y, w], w)
    }

    /// Averages of slopes are stretched as slopes are.
    #[inline(always)]
    fn bent(&self, [w, x, y]: [f32; 3], bend: &Bend) -> [f32; 3] {
        let [x, y, _] = bend.turn([x, y, w]);
        [w, x, y]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lobe::Shading;
    use crate::method::{BATCH, Batch, Bends, Silent, build, shade_by_lobes};
    use crate::texture::{Interpolation, Wrap};

    const BASE: BaseLobe = BaseLobe::BlinnPhong { exponent: 30.0 };

    fn bumpy() -> NormalMap {
        let wave = |u: f64, v: f64| [(12.6 * u).sin(), (12.6 * (v + u)).cos(), 4.0, 1.0];
        NormalMap::from_fn(32, 16, Wrap::Repeat, wave).with_interpolation(Interpolation::Table)
    }

    /// Points all over the map, from magnified to many texels wide.
    fn batch(matrix: [f32; 4], keeps_angle: bool) -> Batch {
        let matrix = matrix.map(|m| [m; BATCH]);
        let bends = Some(Bends { matrix, keeps_angle });
        let mut batch = Batch { len: BATCH, bends, ..Batch::default() };
        for i in 0..BATCH {
            let part = (i as f32 + 0.5) / BATCH as f32;
            (batch.u[i], batch.v[i]) = (part, (17.0 * part).fract());
            (batch.jacobian[0][i], batch.jacobian[3][i]) = (0.2 * part, 0.3 * part);
            (batch.half[0][i], batch.half[1][i]) = (0.3 * part, 0.2 * (5.0 * part).fract());
            batch.irradiance[i] = 1.5;
        }
        batch
    }

    fn near(got: &[f32; BATCH], want: &[f32; BATCH], what: &str) {
        for (got, want) in got.iter().zip(want) {
            assert!((got - want).abs() <= 2e-4 * (1.0 + want.abs()), "{what}: {got} {want}");
        }
    }

    #[test]
    fn bent_slopes_are_slopes_of_the_bent_map() {
        for name in ["unfiltered", "averaged"] {
            let method = build(name).unwrap();
            assert!(method.bends());
            let of = |map: NormalMap| method.prefilter(&Arc::new(map), &BASE, &Silent).unwrap();
            let (plain, steep) = (of(bumpy()), of(bumpy().scaled(2.0)));
            let (mut got, mut want) = ([0.0; BATCH], [0.0; BATCH]);
            plain.shade(&batch([2.0, 0.0, 0.0, 2.0], false), Shading::Ndf, &mut got);
            steep.shade(&Batch { bends: None, ..batch([0.0; 4], false) }, Shading::Ndf, &mut want);
            near(&got, &want, name);
            for keeps_angle in [false, true] {
                let batch = batch([0.7, 0.4, -0.3, 1.6], keeps_angle);
                plain.shade(&batch, Shading::Ndf, &mut got);
                shade_by_lobes(plain.as_ref(), &batch, Shading::Ndf, &mut want);
                near(&got, &want, name);
            }
        }
    }
}
