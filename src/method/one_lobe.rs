//! What all one-lobe methods share: a pyramid of moments, looked up trilinearly, turned into a lobe.

use std::sync::Arc;

use super::{BATCH, Batch, Lane, Prefiltered};
use crate::lobe::{BaseLobe, Lobe, MultipleSurface, Shading, Spread};
use crate::texture::{Footprint, Moments, NormalMap, Pyramid};

/// A one-lobe method's two formulas: texel → channels ([`Moments::encode`]), and averaged channels →
/// lobe.
pub(super) trait OneLobe<const C: usize>: Moments<C> {
    /// The kind of lobe.
    type Lobe: Spread + Into<Lobe> + Copy;

    /// The lobe of averaged channels.
    fn lobe(&self, channels: [f32; C]) -> Self::Lobe;
}

/// A normal map with a pyramid of moments beside it.
pub(super) struct OneLobeMap<M, const C: usize> {
    map: Arc<NormalMap>,
    base: BaseLobe,
    pyramid: Pyramid<M, C>,
}

impl<M: OneLobe<C>, const C: usize> OneLobeMap<M, C> {
    pub(super) fn build(map: &Arc<NormalMap>, base: &BaseLobe, moments: M) -> Self {
        Self { map: Arc::clone(map), base: *base, pyramid: Pyramid::build(map, moments) }
    }

    /// The lobe of the pyramid at a footprint, and how much of it counts: all from level 0 up, none
    /// from level −1 down, where the unfiltered map takes over (one texel covers two pixels).
    fn fetch(&self, at: &Footprint, level: f32) -> [f32; C] {
        self.pyramid.trilinear(&self.map, at.u, at.v, level)
    }
}

/// Share of the filtered surface at a level: 1 from level 0 up, falling to 0 at level −1, where the map
/// is magnified and the unfiltered lobe takes over.
#[inline(always)]
pub(super) fn filtered_share(level: f32) -> f32 {
    (1.0 + level).clamp(0.0, 1.0)
}

/// The unfiltered lobe at a point: the base lobe about the interpolated normal.
#[inline(always)]
pub(super) fn unfiltered_lobe(
    map: &NormalMap,
    base: &BaseLobe,
    u: f32,
    v: f32,
) -> crate::lobe::EllipticLobe {
    let [x, y, z, weight] = map.sample(u, v);
    base.about([x, y, z], weight)
}

impl<M: OneLobe<C>, const C: usize> Prefiltered for OneLobeMap<M, C> {
    fn bytes(&self) -> usize {
        self.pyramid.bytes()
    }

    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        let level = at.level(self.map.width(), self.map.height());
        let share = filtered_share(level);
        let mut surface = MultipleSurface::new();
        if share > 0.0 {
            surface.add(self.pyramid.moments().lobe(self.fetch(at, level)), share);
        }
        surface.add(unfiltered_lobe(&self.map, &self.base, at.u, at.v), 1.0 - share);
        surface
    }

    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        let mut channels = [[0.0; BATCH]; C];
        let mut share = [1.0; BATCH];
        for i in 0..batch.len {
            let at = batch.footprint(i);
            let level = at.level(self.map.width(), self.map.height());
            share[i] = filtered_share(level);
            let fetched = self.fetch(&at, level);
            for c in 0..C {
                channels[c][i] = fetched[c];
            }
        }
        // One loop over lanes without branches: the compiler makes it vector code.
        for i in 0..batch.len {
            let lobe = self.pyramid.moments().lobe(std::array::from_fn(|c| channels[c][i]));
            let [half, light, view] = [&batch.half, &batch.light, &batch.view]
                .map(|axis| [axis[0][i], axis[1][i], axis[2][i]]);
            radiance[i] = batch.irradiance[i] * lobe.radiance(shading, half, light, view);
        }
        for i in 0..batch.len {
            if share[i] < 1.0 {
                let lobe = unfiltered_lobe(&self.map, &self.base, batch.u[i], batch.v[i]);
                let [half, light, view] = [&batch.half, &batch.light, &batch.view]
                    .map(|axis| [axis[0][i], axis[1][i], axis[2][i]]);
                let bare = batch.irradiance[i] * lobe.radiance(shading, half, light, view);
                radiance[i] = share[i] * radiance[i] + (1.0 - share[i]) * bare;
            }
        }
    }
}
