//! A multiple surface: more than one normal at a point (Fournier 1992 §4).

use arrayvec::ArrayVec;

use super::vector::V3;
use super::{EllipticLobe, Facet, PearsonLobe, PedalLobe, PhongPeak, Shading, Spread};

/// The most lobes a footprint can have: 12 peaks a texel (7 in Fournier 1992 §2.4), 4 texels, 2 levels,
/// and the unfiltered lobe that magnification blends in.
pub const CAPACITY: usize = 12 * 4 * 2 + 1;

/// Any lobe, its amplitude included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lobe {
    /// A slope lobe: base lobes, and the normalised form of the one-lobe methods.
    Elliptic(EllipticLobe),
    /// Fournier's Phong peak.
    Peak(PhongPeak),
    /// Schilling's lobe as printed.
    Pedal(PedalLobe),
    /// Olano and North's lobe as printed.
    Pearson(PearsonLobe),
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
            Self::Pearson(lobe) => Self::Pearson(lobe.faded(factor)),
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
            Self::Pearson(lobe) => lobe.density(h),
        }
    }

    fn facet(&self) -> Facet {
        match self {
            Self::Elliptic(lobe) => lobe.facet(),
            Self::Peak(lobe) => lobe.facet(),
            Self::Pedal(lobe) => lobe.facet(),
            Self::Pearson(lobe) => lobe.facet(),
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
lobe_from!(Elliptic(EllipticLobe), Peak(PhongPeak), Pedal(PedalLobe), Pearson(PearsonLobe));

/// What a filter makes of a footprint: up to [`CAPACITY`] lobes whose densities add.
#[derive(Clone, Debug, Default)]
pub struct MultipleSurface {
    lobes: ArrayVec<Lobe, CAPACITY>,
}

/// A surface of all these lobes.
///
/// # Panics
/// If there are more than [`CAPACITY`]: whoever takes lobes from a user counts them.
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
    ///
    /// # Panics
    /// If there are more than [`CAPACITY`] lobes: a programming error in a method.
    pub fn add(&mut self, lobe: impl Into<Lobe>, weight: f32) {
        if weight > 0.0 {
            self.lobes.push(lobe.into().faded(weight));
        }
    }

    /// The lobes.
    pub fn lobes(&self) -> &[Lobe] {
        &self.lobes
    }

    /// D(h) per steradian, summed over the lobes.
    pub fn density(&self, h: V3) -> f32 {
        self.lobes.iter().map(|lobe| lobe.density(h)).sum()
    }

    /// Radiance for unit irradiance (see [`Shading`]), summed over the lobes.
    pub fn radiance(&self, shading: Shading, half: V3, light: V3, view: V3) -> f32 {
        self.lobes.iter().map(|lobe| lobe.radiance(shading, half, light, view)).sum()
    }
}
