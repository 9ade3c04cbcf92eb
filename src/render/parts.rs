//! What of a filter's image is wrong, part by part: each part replaced by the truth, alone and with those before it.
//!
//! A pixel of a filter, at one sample, is its multiple surface for the pixel's footprint, shaded at the pixel's
//! centre. The truth is a mean over the pixel. Between the two stand [`Part`]s, each of which can be replaced by
//! what is true under the pixel, found from many points spread evenly over it: the same rays, the same maps as the
//! reference's, and other random numbers.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::view::Sight;
use super::{Cancelled, PixelSampler, View, stream};
use crate::lobe::vector::V3;
use crate::lobe::{
    BaseLobe, EllipticLobe, MultipleSurface, Replacing, Shading, SlopeMoments, Spread, Warp, Warped,
};
use crate::method::Prefiltered;
use crate::texture::{Footprint, Lookup, NormalMap};

/// What of a filter's pixel may be wrong, in the order in which it is replaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// Which texels stand for the footprint: replaced by [`Lookup::Exact`].
    Lookup,
    /// How much light there is in all: ∫ D cosθ dω.
    Energy,
    /// The mean direction: the mean slope.
    Direction,
    /// How widely normals spread: the trace of the slopes' covariance.
    Width,
    /// Along which direction how widely: the rest of the covariance.
    Anisotropy,
    /// The form of the distribution: replaced by the true one, which has these same moments.
    Shape,
    /// Light and eye as seen from the pixel's centre: replaced by those from each point.
    Centre,
    /// Which of the bumps see the light and are seen.
    Shadowing,
}

impl Part {
    /// All of them, in order.
    pub const ALL: [Self; 8] = [
        Self::Lookup,
        Self::Energy,
        Self::Direction,
        Self::Width,
        Self::Anisotropy,
        Self::Shape,
        Self::Centre,
        Self::Shadowing,
    ];

    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lookup => "lookup",
            Self::Energy => "energy",
            Self::Direction => "direction",
            Self::Width => "width",
            Self::Anisotropy => "anisotropy",
            Self::Shape => "shape",
            Self::Centre => "centre",
            Self::Shadowing => "shadowing",
        }
    }
}

/// A filter whose parts are replaced.
pub struct Subject<'a> {
    /// Its prefiltered map.
    pub prefiltered: &'a dyn Prefiltered,
    /// Its lookup.
    pub lookup: Lookup,
    /// Whether it can be used by the exact lookup, and its own is another.
    pub exact: bool,
    /// Its image at one sample a pixel.
    pub image: &'a [f32],
}

/// A pixel's radiance with parts replaced, in the order of [`Part::ALL`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Replaced {
    /// With this part replaced and all before it.
    pub together: [f32; Part::ALL.len()],
    /// With this part alone replaced.
    pub alone: [f32; Part::ALL.len()],
}

/// What is seen, and what is true of it.
pub struct Scene<'a> {
    /// The view; its light is no environment.
    pub view: &'a View,
    /// The map on the surface.
    pub map: &'a NormalMap,
    /// The base lobe.
    pub base: BaseLobe,
    /// The reference's pixels.
    pub reference: &'a [f32],
    /// Whether the reference shows the bumps without shadows.
    pub open: bool,
}

/// The random numbers of the points under a pixel are those of this replicate: no reference has so many.
const REPLICATE: u32 = u32::MAX;
/// Points at which a filter's own lobes are shaded to replace [`Part::Centre`] alone.
const FEW: usize = 64;

/// Replaces the parts of each subject in every pixel, with the truth from `points` points a pixel: pixel by pixel from
/// the top left, in each the subjects in their order. `done` is told how many rows are.
///
/// # Errors
/// [`Cancelled`] if `cancelled` says so; it is asked before each row.
pub fn replaced(
    scene: &Scene,
    subjects: &[Subject],
    (seed, points): (u64, u32),
    cancelled: &(dyn Fn() -> bool + Sync),
    row_done: &(dyn Fn() + Sync),
) -> Result<Vec<Vec<Replaced>>, Cancelled> {
    let camera = &scene.view.camera;
    let (width, height) = (camera.width(), camera.height());
    let sampler = PixelSampler::new(points);
    let rows: Result<Vec<Vec<Vec<Replaced>>>, Cancelled> = (0..height)
        .into_par_iter()
        .map(|row| {
            if cancelled() {
                return Err(Cancelled);
            }
            let pixel = |column: usize| {
                let index = row * width + column;
                let points = sampler.positions(stream(seed, REPLICATE, index));
                let ground = Ground::under(scene, [column as f64, row as f64], &points);
                let of = |subject| pixel_of(scene, &ground, subject, index);
                subjects.iter().map(of).collect()
            };
            let line = (0..width).map(pixel).collect();
            row_done();
            Ok(line)
        })
        .collect();
    Ok(rows?.into_iter().flatten().collect())
}

/// How a point is lit and seen, in tangent space.
#[derive(Clone, Copy)]
struct Lit {
    half: V3,
    light: V3,
    view: V3,
    irradiance: f32,
}

impl Lit {
    fn of(view: &View, sight: &Sight) -> Self {
        let (light, irradiance) = view.light.seen_from(sight.point);
        let lit = light.dot(&sight.frame.normal) > 0.0;
        let [light, eye] = [light, sight.view].map(|d| sight.frame.local_from_world(d));
        let narrow = |v: crate::geometry::Vec3| [v.x, v.y, v.z].map(|c| c as f32);
        Self {
            half: narrow(light + eye),
            light: narrow(light),
            view: narrow(eye),
            irradiance: if lit { irradiance as f32 } else { 0.0 },
        }
    }

    fn shows(&self, surface: &MultipleSurface, warp: &Warp, shading: Shading) -> f32 {
        if self.irradiance <= 0.0 {
            return 0.0;
        }
        let Self { half, light, view, irradiance } = *self;
        irradiance * surface.warped_radiance(warp, shading, half, light, view)
    }
}

/// What is under a pixel.
struct Ground {
    /// The centre, if it is on the surface.
    centre: Option<(Footprint, Lit)>,
    /// The base lobes at the points that are.
    lobes: Vec<EllipticLobe>,
    /// How each of these is lit.
    lit: Vec<Lit>,
    /// The moments of their mean.
    moments: Option<SlopeMoments>,
    /// The part of the points that is on the surface.
    covered: f32,
    shading: Shading,
}

impl Ground {
    fn under(scene: &Scene, corner: [f64; 2], points: &[[f64; 2]]) -> Self {
        let view = scene.view;
        let sight = |[x, y]: [f64; 2]| view.sight(corner[0] + x, corner[1] + y, 1.0);
        let centre = sight([0.5, 0.5]).map(|sight| (sight.footprint, Lit::of(view, &sight)));
        let (mut lobes, mut lit) = (Vec::with_capacity(points.len()), Vec::new());
        for sight in points.iter().filter_map(|point| sight(*point)) {
            let at = &sight.footprint;
            let [x, y, z, weight] = scene.map.sample(at.u, at.v);
            lobes.push(scene.base.about(at.bend.turn([x, y, z]), weight));
            lit.push(Lit::of(view, &sight));
        }
        let count = lobes.len() as f64;
        let moments = SlopeMoments::of(lobes.iter())
            .map(|sum| SlopeMoments { mass: sum.mass / count, ..sum });
        let covered = lobes.len() as f32 / points.len() as f32;
        Self { centre, lobes, lit, moments, covered, shading: view.shading }
    }

    /// The true distribution through a warp, shaded as at the centre.
    fn at_centre(&self, warp: &Warp) -> f32 {
        let Some((_, lit)) = self.centre.filter(|(_, lit)| lit.irradiance > 0.0) else {
            return 0.0;
        };
        let sent =
            |lobe| Warped { lobe, warp }.radiance(self.shading, lit.half, lit.light, lit.view);
        lit.irradiance * mean(self.lobes.iter().map(sent))
    }

    /// The true distribution, each lobe shaded where it is: the pixel of the bumps alone.
    fn in_place(&self) -> f32 {
        let sent = |(lobe, lit): (&EllipticLobe, &Lit)| {
            if lit.irradiance <= 0.0 {
                return 0.0;
            }
            lit.irradiance * lobe.radiance(self.shading, lit.half, lit.light, lit.view)
        };
        self.covered * mean(self.lobes.iter().zip(&self.lit).map(sent))
    }

    /// A surface, the same everywhere, at the first few points.
    fn across(&self, surface: &MultipleSurface) -> f32 {
        let few = self.lit.iter().take(FEW);
        self.covered * mean(few.map(|lit| lit.shows(surface, &Warp::IDENTITY, self.shading)))
    }

    fn warp(&self, own: Option<&SlopeMoments>, replacing: Replacing) -> Warp {
        let both = own.zip(self.moments.as_ref());
        both.map_or(Warp::IDENTITY, |(own, truth)| Warp::new(own, truth, replacing))
    }

    /// The true distribution with a method's moments.
    fn likened(&self, own: Option<&SlopeMoments>) -> f32 {
        let all = Replacing { energy: true, direction: true, width: true, anisotropy: true };
        let both = own.zip(self.moments.as_ref());
        self.at_centre(&both.map_or(Warp::IDENTITY, |(own, truth)| Warp::new(truth, own, all)))
    }
}

/// The mean, summed in order in double precision; 0 of nothing.
fn mean(values: impl ExactSizeIterator<Item = f32>) -> f32 {
    let count = values.len().max(1) as f64;
    (values.map(f64::from).sum::<f64>() / count) as f32
}

/// A method's lobes under a pixel, and how the centre shows them.
struct Held<'a> {
    surface: MultipleSurface,
    moments: Option<SlopeMoments>,
    ground: &'a Ground,
    lit: Lit,
}

impl<'a> Held<'a> {
    fn by(ground: &'a Ground, prefiltered: &dyn Prefiltered, lookup: Lookup) -> Option<Self> {
        let (footprint, lit) = ground.centre?;
        let surface = prefiltered.lobes_at(&Footprint { lookup, ..footprint });
        let moments = surface.slope_moments();
        Some(Self { surface, moments, ground, lit })
    }

    fn shown(&self, replacing: Replacing) -> f32 {
        let warp = self.ground.warp(self.moments.as_ref(), replacing);
        self.lit.shows(&self.surface, &warp, self.ground.shading)
    }

    /// The part of its light that its horizons let by, its moments being the truth's; 1 without any.
    fn visible(&self, replacing: Replacing) -> f32 {
        if !self.surface.has_horizons() {
            return 1.0;
        }
        let warp = self.ground.warp(self.moments.as_ref(), replacing);
        let open = self.lit.shows(&self.surface.clone().open(), &warp, self.ground.shading);
        let part = self.lit.shows(&self.surface, &warp, self.ground.shading) / open;
        if part.is_finite() { part } else { 1.0 }
    }
}

fn pixel_of(scene: &Scene, ground: &Ground, subject: &Subject, index: usize) -> Replaced {
    let own = Held::by(ground, subject.prefiltered, subject.lookup);
    let better =
        if subject.exact { Held::by(ground, subject.prefiltered, Lookup::Exact) } else { None };
    let (image, reference) = (subject.image[index], scene.reference[index]);
    let exact = better.as_ref().or(own.as_ref());
    let bumps = ground.in_place();
    let shown = |held: Option<&Held>, replacing| held.map_or(0.0, |held| held.shown(replacing));
    let seen = |held: Option<&Held>, replacing| held.map_or(1.0, |held| held.visible(replacing));

    let none = Replacing::default();
    let energy = Replacing { energy: true, ..none };
    let direction = Replacing { direction: true, ..energy };
    let width = Replacing { width: true, ..direction };
    let all = Replacing { anisotropy: true, ..width };
    let part = seen(exact, all);
    let lookup = if subject.exact { shown(exact, none) } else { image };
    let together = [
        lookup,
        shown(exact, energy),
        shown(exact, direction),
        shown(exact, width),
        shown(exact, all),
        part * ground.at_centre(&Warp::IDENTITY),
        part * bumps,
        if scene.open { bumps } else { reference },
    ];

    let own = own.as_ref();
    let moments = own.and_then(|held| held.moments.as_ref());
    let only = |replacing| shown(own, replacing);
    let alone = [
        lookup,
        only(energy),
        only(Replacing { direction: true, ..none }),
        only(Replacing { width: true, ..none }),
        only(Replacing { anisotropy: true, ..none }),
        seen(own, none) * ground.likened(moments),
        own.map_or_else(|| ground.across(&MultipleSurface::new()), |h| ground.across(&h.surface)),
        shadowed(scene.open, image, own, [bumps, reference]),
    ];
    Replaced { together, alone }
}

/// A method's pixel with the truth's shadows instead of its own: what they take of the bumps they take of it, and
/// what they add, where rays meet the heights elsewhere, they add.
fn shadowed(open: bool, image: f32, own: Option<&Held>, [bumps, truth]: [f32; 2]) -> f32 {
    let lit = match own {
        Some(held) if held.surface.has_horizons() => {
            let open = held.surface.clone().open();
            held.lit.shows(&open, &Warp::IDENTITY, held.ground.shading)
        }
        _ => image,
    };
    match (open, truth <= bumps) {
        (true, _) => lit,
        (false, true) => lit * (truth / bumps.max(f32::MIN_POSITIVE)),
        (false, false) => lit + (truth - bumps),
    }
}
