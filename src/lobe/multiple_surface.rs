//! A multiple surface: more than one normal at a point (Fournier 1992 §4).

use super::vector::V3;
use super::{
    EllipticLobe, Facet, Horizon, PedalLobe, PhongPeak, RestrictedLobe, SampledLobe, Shading,
    Slopes, Spread, Warp, Warped,
};

/// The most lobes a surface from a file may have: 12 peaks a texel (7 in Fournier 1992 §2.4), 4 texels, 2
/// levels, and one more. Only footprints under wide lookups have more.
pub const CAPACITY: usize = 12 * 4 * 2 + 1;

/// Any lobe, its amplitude included.
#[derive(Clone, Debug, PartialEq)]
pub enum Lobe {
    /// A slope lobe: base lobes, and the normalised form of the one-lobe methods.
    Elliptic(EllipticLobe),
    /// Fournier's Phong peak.
    Peak(PhongPeak),
    /// Schilling's lobe as printed.
    Pedal(PedalLobe),
    /// Olano and North's lobe as printed.
    Restricted(RestrictedLobe),
    /// A surface's own NDF, an image.
    Sampled(SampledLobe),
}

impl Lobe {
    /// The same lobe with its density multiplied by `factor` ≥ 0: how interpolation combines lobes.
    pub fn faded(self, factor: f32) -> Self {
        match self {
            Self::Elliptic(lobe) => Self::Elliptic(lobe.faded(factor)),
            Self::Peak(peak) => {
                Self::Peak(PhongPeak { amplitude: peak.amplitude * factor, ..peak })
            }
            Self::Pedal(lobe) => Self::Pedal(lobe.faded(factor)),
            Self::Restricted(lobe) => Self::Restricted(lobe.faded(factor)),
            Self::Sampled(lobe) => Self::Sampled(lobe.faded(factor)),
        }
    }

    /// Its axis, of unit length, in tangent space.
    pub fn axis(&self) -> V3 {
        self.facet().axis
    }
}

impl Spread for Lobe {
    fn density(&self, h: V3) -> f32 {
        match self {
            Self::Elliptic(lobe) => lobe.density(h),
            Self::Peak(lobe) => lobe.density(h),
            Self::Pedal(lobe) => lobe.density(h),
            Self::Restricted(lobe) => lobe.density(h),
            Self::Sampled(lobe) => lobe.density(h),
        }
    }

    fn facet(&self) -> Facet {
        match self {
            Self::Elliptic(lobe) => lobe.facet(),
            Self::Peak(lobe) => lobe.facet(),
            Self::Pedal(lobe) => lobe.facet(),
            Self::Restricted(lobe) => lobe.facet(),
            Self::Sampled(lobe) => lobe.facet(),
        }
    }

    fn slopes(&self) -> Slopes {
        match self {
            Self::Elliptic(lobe) => lobe.slopes(),
            Self::Peak(lobe) => lobe.slopes(),
            Self::Pedal(lobe) => lobe.slopes(),
            Self::Restricted(lobe) => lobe.slopes(),
            Self::Sampled(lobe) => lobe.slopes(),
        }
    }
}

macro_rules! lobe_from {
    ($($variant:ident($lobe:ty)),*) => {$(
        impl From<$lobe> for Lobe {
            fn from(lobe: $lobe) -> Self {
                Self::$variant(lobe)
            }
        }
    )*};
}
lobe_from!(
    Elliptic(EllipticLobe),
    Peak(PhongPeak),
    Pedal(PedalLobe),
    Restricted(RestrictedLobe),
    Sampled(SampledLobe)
);

/// What a filter makes of a footprint: lobes whose densities add. Lobes may have
/// horizons, which matter to the light they send ([`MultipleSurface::radiance`]) but not to what they
/// are.
#[derive(Clone, Debug, Default)]
pub struct MultipleSurface {
    lobes: Vec<Lobe>,
    /// One a lobe, or none at all.
    horizons: Vec<(Horizon, f32)>,
    ratioed: bool,
}

/// How much of a multiple surface sees light and eye, lobe by lobe (Fournier 1992 §5).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Visibility {
    area: f32,
    seen: f32,
}

impl Visibility {
    /// The part of a lobe's light that its horizon lets by, from `light` and to `view`: the product of
    /// both. `area` is the part of the surface the lobe stands for.
    #[inline(always)]
    pub fn of(&mut self, horizon: &Horizon, area: f32, light: V3, view: V3) -> f32 {
        let seen = horizon.visibility(view);
        self.area += area;
        self.seen += area * seen;
        seen * horizon.visibility(light)
    }

    /// What light is multiplied by where what is seen fills the view: the area of all lobes over that of
    /// their parts that the eye sees; 0 if it sees none ("the contributions of the visible components
    /// should be correctly ratioed to correct for the smaller visible area", §5).
    #[inline(always)]
    pub fn ratio(&self) -> f32 {
        let ratio = self.area / self.seen;
        if ratio.is_finite() { ratio } else { 0.0 }
    }
}

/// A surface of all these lobes.
impl<L: Into<Lobe>> FromIterator<L> for MultipleSurface {
    fn from_iter<I: IntoIterator<Item = L>>(lobes: I) -> Self {
        let mut surface = Self::new();
        lobes.into_iter().for_each(|lobe| surface.add(lobe, 1.0));
        surface
    }
}

impl MultipleSurface {
    /// A surface without lobes: it sends no light.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a lobe with its density multiplied by `weight`; a weight of 0 adds nothing.
    pub fn add(&mut self, lobe: impl Into<Lobe>, weight: f32) {
        if weight > 0.0 {
            self.lobes.push(lobe.into().faded(weight));
        }
    }

    /// Adds a lobe as [`MultipleSurface::add`] does, with its horizon and the part of the surface it
    /// stands for at weight 1. If one lobe has a horizon, all must.
    pub fn add_behind(&mut self, lobe: impl Into<Lobe>, weight: f32, horizon: Horizon, area: f32) {
        if weight > 0.0 {
            self.add(lobe, weight);
            self.horizons.push((horizon, weight * area));
        }
    }

    /// The same surface, the light of its visible parts [`Visibility::ratio`]ed.
    pub fn ratioed(mut self) -> Self {
        self.ratioed = true;
        self
    }

    /// Whether its lobes have horizons: what light they send depends on where it comes from and goes to.
    pub fn has_horizons(&self) -> bool {
        !self.horizons.is_empty()
    }

    /// The lobes.
    pub fn lobes(&self) -> &[Lobe] {
        &self.lobes
    }

    /// D(h) per steradian, summed over the lobes.
    pub fn density(&self, h: V3) -> f32 {
        self.lobes.iter().map(|lobe| lobe.density(h)).sum()
    }

    /// Radiance for unit irradiance (see [`Shading`]), summed over the lobes, of each what its horizon
    /// lets by.
    pub fn radiance(&self, shading: Shading, half: V3, light: V3, view: V3) -> f32 {
        self.gathered(light, view, |lobe| lobe.radiance(shading, half, light, view))
    }

    /// [`MultipleSurface::radiance`] with every lobe seen through a warp, behind the horizon it has.
    pub fn warped_radiance(
        &self,
        warp: &Warp,
        shading: Shading,
        half: V3,
        light: V3,
        view: V3,
    ) -> f32 {
        if *warp == Warp::IDENTITY {
            return self.radiance(shading, half, light, view);
        }
        let sent = |lobe: &Lobe| Warped { lobe, warp }.radiance(shading, half, light, view);
        self.gathered(light, view, sent)
    }

    /// The same surface without horizons: all of it is seen and lit.
    pub fn open(mut self) -> Self {
        self.horizons.clear();
        self
    }

    /// What the lobes send, of each what its horizon lets by.
    fn gathered(&self, light: V3, view: V3, sent: impl Fn(&Lobe) -> f32) -> f32 {
        let all = self.lobes.iter().map(sent);
        if self.horizons.is_empty() {
            return all.sum();
        }
        let mut visibility = Visibility::default();
        let by = self.horizons.iter().map(|(h, area)| visibility.of(h, *area, light, view));
        let sum: f32 = all.zip(by).map(|(sent, part)| sent * part).sum();
        if self.ratioed { sum * visibility.ratio() } else { sum }
    }
}
