//! What all one-lobe methods share: a pyramid of moments, looked up, turned into a lobe.

use std::sync::Arc;

use super::{BATCH, Batch, Lane, Prefiltered, shade_by_lobes};
use crate::geometry::{Kernel, vectorised};
use crate::lobe::{BaseLobe, EllipticLobe, Lobe, MultipleSurface, Shading, Spread};
use crate::texture::{Bend, Footprint, Lookup, Moments, NormalMap, Pyramid};

/// A one-lobe method's two formulas: texel → channels ([`Moments::encode`]), and averaged channels →
/// lobe.
pub(super) trait OneLobe<const C: usize>: Moments<C> {
    /// The kind of lobe.
    type Lobe: Spread + Into<Lobe> + Copy;

    /// The lobe of averaged channels.
    fn lobe(&self, channels: [f32; C]) -> Self::Lobe;

    /// The channels where the surface bends the map's slopes: of a method that [`Method::bends`].
    ///
    /// [`Method::bends`]: super::Method::bends
    #[inline(always)]
    fn bent(&self, channels: [f32; C], bend: &Bend) -> [f32; C] {
        let _ = bend;
        channels
    }
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
}

/// Share of the filtered surface at a level: 1 from level 0 up, falling to 0 at level −1, where the map
/// is magnified and the unfiltered lobe takes over. An exact lookup finds a single normal there by itself.
#[inline(always)]
pub(super) fn filtered_share(level: f32, lookup: Lookup) -> f32 {
    if lookup == Lookup::Exact { 1.0 } else { (1.0 + level).clamp(0.0, 1.0) }
}

/// The unfiltered lobe at a footprint's centre: the base lobe about the interpolated normal.
#[inline(always)]
pub(super) fn unfiltered_lobe(map: &NormalMap, base: &BaseLobe, at: &Footprint) -> EllipticLobe {
    let [x, y, z, weight] = map.sample(at.u, at.v);
    base.about(at.bend.turn([x, y, z]), weight)
}

impl<M: OneLobe<C>, const C: usize> Prefiltered for OneLobeMap<M, C> {
    fn bytes(&self) -> usize {
        self.pyramid.bytes()
    }

    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        let level = at.level(self.map.width(), self.map.height());
        let share = filtered_share(level, at.lookup);
        let mut surface = MultipleSurface::new();
        if share > 0.0 {
            let moments = self.pyramid.moments();
            let found = moments.bent(self.pyramid.fetch(&self.map, at), &at.bend);
            surface.add(moments.lobe(found), share);
        }
        surface.add(unfiltered_lobe(&self.map, &self.base, at), 1.0 - share);
        surface
    }

    #[allow(clippy::needless_range_loop, reason = "lanes run through several arrays at once")]
    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        if !matches!(shading, Shading::Ndf | Shading::Microfacet) {
            return shade_by_lobes(self, batch, shading, radiance);
        }
        let (mut channels, mut share) = ([[0.0; BATCH]; C], [1.0; BATCH]);
        vectorised(Fetch { of: self, batch, channels: &mut channels, share: &mut share });
        if let Some(bends) = &batch.bends {
            let moments = self.pyramid.moments();
            for i in 0..batch.len {
                let bent = moments.bent(std::array::from_fn(|c| channels[c][i]), &bends.at(i));
                (0..C).for_each(|c| channels[c][i] = bent[c]);
            }
        }
        let fetched = Fetched { of: self, batch, channels: &channels, share: &share };
        if shading == Shading::Ndf {
            vectorised(Shade::<M, C, false> { fetched, radiance });
        } else {
            vectorised(Shade::<M, C, true> { fetched, radiance });
        }
    }
}

/// The first kernel: each lane's averaged channels, and its share of the filtered surface.
struct Fetch<'a, M, const C: usize> {
    of: &'a OneLobeMap<M, C>,
    batch: &'a Batch,
    channels: &'a mut [Lane; C],
    share: &'a mut Lane,
}

impl<M: OneLobe<C>, const C: usize> Kernel for Fetch<'_, M, C> {
    #[inline(always)]
    fn run(self) {
        let Self { of, batch, channels, share } = self;
        let mut levels = [0.0; BATCH];
        for i in 0..BATCH {
            levels[i] = batch.footprint(i).level(of.map.width(), of.map.height());
            share[i] = filtered_share(levels[i], batch.lookup);
        }
        if batch.lookup == Lookup::Trilinear {
            let at = (&batch.u, &batch.v, &levels);
            of.pyramid.trilinear_lanes(&of.map, at, batch.len, channels);
            return;
        }
        for i in (0..batch.len).filter(|&i| batch.irradiance[i] > 0.0) {
            let found = of.pyramid.fetch(&of.map, &batch.footprint(i));
            for c in 0..C {
                channels[c][i] = found[c];
            }
        }
    }
}

/// What was fetched for a batch.
struct Fetched<'a, M, const C: usize> {
    of: &'a OneLobeMap<M, C>,
    batch: &'a Batch,
    channels: &'a [Lane; C],
    share: &'a Lane,
}

/// The second kernel: lobes as vector code.
struct Shade<'a, M, const C: usize, const MICROFACET: bool> {
    fetched: Fetched<'a, M, C>,
    radiance: &'a mut Lane,
}

impl<M: OneLobe<C>, const C: usize, const MICROFACET: bool> Kernel for Shade<'_, M, C, MICROFACET> {
    #[inline(always)]
    fn run(self) {
        let Self { fetched: Fetched { of, batch, channels, share }, radiance } = self;
        let shading = if MICROFACET { Shading::Microfacet } else { Shading::Ndf };
        // The whole width, and no branches: the compiler makes it vector code.
        for i in 0..BATCH {
            let mut moments = [0.0; C];
            for c in 0..C {
                moments[c] = channels[c][i];
            }
            let lobe = of.pyramid.moments().lobe(moments);
            let sent = batch.irradiance[i]
                * lobe.radiance(shading, batch.half(i), batch.light(i), batch.view(i));
            // Where it is dark nothing may have been fetched.
            radiance[i] = if batch.irradiance[i] > 0.0 { sent } else { 0.0 };
        }
        for i in (0..batch.len).filter(|&i| share[i] < 1.0) {
            let lobe = unfiltered_lobe(&of.map, &of.base, &batch.footprint(i));
            let bare = batch.irradiance[i]
                * lobe.radiance(shading, batch.half(i), batch.light(i), batch.view(i));
            radiance[i] = share[i] * radiance[i] + (1.0 - share[i]) * bare;
        }
    }
}
