//! No filter (Blinn 1978).

use std::sync::Arc;

use super::one_lobe::unfiltered_lobe;
use super::{
    BATCH, Batch, Card, Entry, Lane, Method, PrefilterError, Prefiltered, Progress, Refusal,
};
use crate::geometry::{Kernel, vectorised};
use crate::lobe::round::{Beckmann, Ggx, Phong, RoundLobe};
use crate::lobe::vector::{dot, tan_squared};
use crate::lobe::{BaseLobe, Horizon, MultipleSurface, Shading, Spread};
use crate::parameter::{Domain, Parameter};
use crate::texture::{Footprint, HorizonMap, Lookup, NormalMap, Wrap};

/// One base lobe about the perturbed normal at the sample's centre, whatever the footprint holds.
///
/// With many samples a pixel this *is* the supersampled truth: the reference averages it.
///
/// Shadowed, it is dark where the horizon hides the light or the eye (Fournier 1992 §5). The slopes of the
/// horizon are interpolated between texels as normals are.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unfiltered {
    /// Whether bumps mask and shadow each other.
    pub shadowed: bool,
}

const CARD: Card = Card {
    name: "unfiltered",
    source: "Blinn 1978, Simulation of Wrinkled Surfaces",
    summary: "Shades the perturbed normal at the sample's centre.",
    formula: "one base lobe about the interpolated normal",
    limits: "aliases: a pixel sees one normal of the many it covers",
    normalised: true,
    keeps_roughness: false,
    fractal: false,
    precision: 1e-3,
};

const PARAMETERS: &[Parameter] = &[Parameter {
    name: "shadowing",
    meaning: "none: all is seen and lit; printed: what lies below the horizon of light or eye is dark \
              (Fournier 1992 §5)",
    domain: Domain::Choice { words: &["none", "printed"] },
}];

/// The registry's line.
pub(super) fn entry() -> Entry {
    Entry {
        card: CARD,
        parameters: PARAMETERS,
        build: |values| Box::new(Unfiltered { shadowed: values.word("shadowing") == "printed" }),
    }
}

impl Method for Unfiltered {
    fn card(&self) -> Card {
        CARD
    }

    fn base_error(&self, _base: &BaseLobe) -> Result<f64, Refusal> {
        Ok(0.0)
    }

    fn lookups(&self) -> &'static [Lookup] {
        &[]
    }

    fn needs_heights(&self) -> bool {
        self.shadowed
    }

    fn bends(&self) -> bool {
        !self.shadowed
    }

    fn prefilter(
        &self,
        map: &Arc<NormalMap>,
        base: &BaseLobe,
        _progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError> {
        let unfiltered = UnfilteredMap { map: Arc::clone(map), base: *base };
        if !self.shadowed {
            return Ok(Box::new(unfiltered));
        }
        let horizons = HorizonMap::of(&map.heights_or_integrated());
        Ok(Box::new(ShadowedMap { unfiltered, horizons }))
    }
}

struct UnfilteredMap {
    map: Arc<NormalMap>,
    base: BaseLobe,
}

impl Prefiltered for UnfilteredMap {
    fn bytes(&self) -> usize {
        0
    }

    fn needs_footprint(&self) -> bool {
        false
    }

    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        let mut surface = MultipleSurface::new();
        surface.add(unfiltered_lobe(&self.map, &self.base, at), 1.0);
        surface
    }

    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        if !matches!(shading, Shading::Ndf | Shading::Microfacet) {
            return self.shade_by_lobe(batch, shading, radiance);
        }
        let of = Of { map: &self.map, batch, radiance };
        match self.base {
            BaseLobe::BlinnPhong { exponent } => of.shade(shading, Phong::new(exponent)),
            BaseLobe::Beckmann { alpha } => of.shade(shading, Beckmann::new(alpha)),
            BaseLobe::Ggx { alpha } => of.shade(shading, Ggx::new(alpha)),
        }
    }
}

impl UnfilteredMap {
    /// Lane by lane, for shadings that have no kernel.
    fn shade_by_lobe(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        for (i, out) in radiance.iter_mut().enumerate().take(batch.len) {
            *out = 0.0;
            if batch.irradiance[i] > 0.0 {
                let lobe = unfiltered_lobe(&self.map, &self.base, &batch.footprint(i));
                let (half, light, view) = (batch.half(i), batch.light(i), batch.view(i));
                *out = batch.irradiance[i] * lobe.radiance(shading, half, light, view);
            }
        }
    }
}

/// The same behind the horizons of the map's heights.
struct ShadowedMap {
    unfiltered: UnfilteredMap,
    horizons: HorizonMap,
}

impl ShadowedMap {
    #[inline(always)]
    fn horizon(&self, u: f32, v: f32) -> Horizon {
        Horizon::sharp(self.horizons.sample(u, v))
    }
}

impl Prefiltered for ShadowedMap {
    fn bytes(&self) -> usize {
        self.horizons.bytes()
    }

    fn needs_footprint(&self) -> bool {
        false
    }

    fn needs_directions(&self) -> bool {
        true
    }

    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        let UnfilteredMap { map, base } = &self.unfiltered;
        let mut surface = MultipleSurface::new();
        let lobe = unfiltered_lobe(map, base, at);
        surface.add_behind(lobe, 1.0, self.horizon(at.u, at.v), 1.0);
        surface
    }

    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        self.unfiltered.shade(batch, shading, radiance);
        for (i, out) in radiance.iter_mut().enumerate().take(batch.len) {
            let horizon = self.horizon(batch.u[i], batch.v[i]);
            *out *= horizon.visibility(batch.light(i)) * horizon.visibility(batch.view(i));
        }
    }
}

/// A batch of points of a map, and where its radiance goes.
struct Of<'a> {
    map: &'a NormalMap,
    batch: &'a Batch,
    radiance: &'a mut Lane,
}

impl Of<'_> {
    /// Decides once what the loop need not ask at every lane.
    fn shade<B: RoundLobe>(self, shading: Shading, base: B) {
        match (shading == Shading::Ndf, self.map.wrap()) {
            (true, Wrap::Repeat) => vectorised(Bare::<B, false, true> { of: self, base }),
            (true, Wrap::Clamp) => vectorised(Bare::<B, false, false> { of: self, base }),
            (false, Wrap::Repeat) => vectorised(Bare::<B, true, true> { of: self, base }),
            (false, Wrap::Clamp) => vectorised(Bare::<B, true, false> { of: self, base }),
        }
    }
}

/// The kernel: base lobes about interpolated normals. It computes what [`EllipticLobe`] with a round
/// spread does, without building one: D needs only tan² of the angle between normal and half vector.
///
/// [`EllipticLobe`]: crate::lobe::EllipticLobe
struct Bare<'a, B, const MICROFACET: bool, const REPEAT: bool> {
    of: Of<'a>,
    base: B,
}

impl<B: RoundLobe, const MICROFACET: bool, const REPEAT: bool> Kernel
    for Bare<'_, B, MICROFACET, REPEAT>
{
    #[inline(always)]
    fn run(self) {
        let Of { map, batch, radiance } = self.of;
        let mut normals = [[0.0; BATCH]; 4];
        map.sample_lanes::<BATCH, REPEAT>(&batch.u, &batch.v, &mut normals);
        if let Some(bends) = &batch.bends {
            let [x, y, z, _] = &mut normals;
            bends.turn([x, y, z]);
        }
        let [x, y, z, weight] = &normals;
        for i in 0..BATCH {
            let n = [x[i], y[i], z[i]];
            let half = batch.half(i);
            let density = self.base.density(tan_squared(n, half));
            let mut sent = batch.irradiance[i] * weight[i] * density;
            if MICROFACET {
                sent *= self.base.geometry(n, batch.light(i), batch.view(i));
            }
            radiance[i] = if dot(n, half) > 0.0 { sent } else { 0.0 };
        }
    }
}
