//! Floor 3: the filters. One file a method; [`entries`] lists them.
//!
//! A method has two halves. [`Method::prefilter`] turns a normal map into something that can be looked
//! up, once per map and base lobe, as slowly as it likes. [`Prefiltered`] answers, for any footprint,
//! with a multiple surface, and shades whole batches at speed.

mod averaged;
mod batch;
mod constant;
pub mod fournier;
pub mod kautz;
mod lean;
mod mean_normal;
mod nearness;
mod olano_north;
mod one_lobe;
mod registry;
mod schilling;
mod storage;
mod toksvig;
mod truth;
mod unfiltered;

pub use batch::{BATCH, Batch, Bends, Lane};
pub use constant::Constant;
pub use mean_normal::MeanNormals;
pub use registry::{Entry, brute_force, build, entries, find};
pub use truth::{Truth, truth};

use crate::lobe::{BaseLobe, MultipleSurface, Shading};
use crate::texture::{Footprint, Lookup, NormalMap};

/// What a method is, for lists, reports and help.
#[derive(Clone, Copy, Debug)]
pub struct Card {
    /// Its name in specs, reports and on the command line.
    pub name: &'static str,
    /// Author, year, title, section.
    pub source: &'static str,
    /// What it does, in a sentence.
    pub summary: &'static str,
    /// The multiple surface it makes of a footprint, in words and symbols.
    pub formula: &'static str,
    /// What it cannot do.
    pub limits: &'static str,
    /// Whether its lobes keep the energy of the normals they stand for, within `precision` (see
    /// [`crate::lobe`]): those of the footprint, or, if it does not keep roughness, the one normal it
    /// draws. False for forms printed without a normalisation.
    pub normalised: bool,
    /// Whether bumps that fall into one footprint widen its lobes.
    pub keeps_roughness: bool,
    /// Whether it takes bumps to go on below the map's texels, so that even a single normal is as rough as the whole
    /// map; else, where a footprint holds a single normal, it is the base lobe.
    pub fractal: bool,
    /// How exactly its numbers hold what it claims (energy, variance), as a relative error: rounding
    /// for closed forms, the stopping rule for fits.
    pub precision: f64,
}

/// Why a method does not take a base lobe, as a sentence for the report's empty cell.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Refusal(pub String);

/// Why a prefilter did not finish.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PrefilterError {
    /// The base lobe is not one the method takes.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// [`Progress::cancelled`] said so.
    #[error("cancelled")]
    Cancelled,
}

/// Why kept bytes are no prefiltered map: what is wrong with them.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Damaged(pub String);

/// How a long prefilter tells how far it is and learns that it should stop.
pub trait Progress: Sync {
    /// `done` of `total` units of work are done. Called from any thread.
    fn advance(&self, done: usize, total: usize) {
        let _ = (done, total);
    }

    /// Whether the work should stop as soon as it can (within a tenth of a second).
    fn cancelled(&self) -> bool {
        false
    }
}

/// Progress that nobody watches.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;
impl Progress for Silent {}

/// A filter for bump maps.
pub trait Method: Send + Sync + std::fmt::Debug {
    /// What it is.
    fn card(&self) -> Card;

    /// How near it comes to `base` where a footprint holds a single normal, tilted by 45° or less: the
    /// total variation distance ½ ∫ |D − D_base| cos dω it claims to stay under (0 for exact, up to rounding).
    ///
    /// # Errors
    /// A [`Refusal`] if it cannot take this base lobe at all.
    fn base_error(&self, base: &BaseLobe) -> Result<f64, Refusal>;

    /// The lookups it can be used with; none if it looks at no footprint. All of them unless said otherwise.
    fn lookups(&self) -> &'static [Lookup] {
        &Lookup::ALL
    }

    /// Whether it can be used where the surface bends the map's slopes ([`Footprint::bend`]); a method that
    /// spreads normals would have to carry their spread along too.
    fn bends(&self) -> bool {
        false
    }

    /// Whether it looks at the heights a map's normals are of ([`NormalMap::heights`]). Where there are
    /// none it integrates them itself; a map that several share had better come with them.
    fn needs_heights(&self) -> bool {
        false
    }

    /// A guess of the work of [`Method::prefilter`] a texel, in times of one unfiltered sample: it tells
    /// how much of a long run is done.
    fn prefilter_work(&self) -> f64 {
        1.0
    }

    /// Builds what is looked up while rendering. The map is shared, not copied.
    ///
    /// # Errors
    /// [`PrefilterError::Refused`] if [`Method::base_error`] refuses, or
    /// [`PrefilterError::Cancelled`].
    fn prefilter(
        &self,
        map: &std::sync::Arc<NormalMap>,
        base: &BaseLobe,
        progress: &dyn Progress,
    ) -> Result<Box<dyn Prefiltered>, PrefilterError>;

    /// The prefiltered map whose [`Prefiltered::store`] gave `bytes`, for the same map and base lobe: it
    /// shades the same, bit by bit. Whoever keeps the bytes sees to it that they are whole and belong to
    /// this method with these options; any bytes may come, and none make it panic.
    ///
    /// # Errors
    /// [`Damaged`] if the bytes are no such map.
    fn restore(
        &self,
        map: &std::sync::Arc<NormalMap>,
        base: &BaseLobe,
        bytes: &[u8],
    ) -> Result<Box<dyn Prefiltered>, Damaged> {
        let _ = (map, base, bytes);
        Err(Damaged(format!("{} keeps no prefiltered maps", self.card().name)))
    }
}

/// A normal map made ready by a method.
pub trait Prefiltered: Send + Sync {
    /// Memory it holds beyond the normal map itself, in bytes.
    fn bytes(&self) -> usize;

    /// What [`Method::restore`] makes this from again; `None` if it is built too fast to be worth keeping.
    fn store(&self) -> Option<Vec<u8>> {
        None
    }

    /// Whether it looks at footprints at all; if not, batches come without them.
    fn needs_footprint(&self) -> bool {
        true
    }

    /// Whether it looks at the directions to light and eye even where shading needs only the half
    /// vector ([`Shading::Ndf`]); if not, such batches come without them.
    fn needs_directions(&self) -> bool {
        false
    }

    /// The multiple surface at a footprint, in tangent space.
    fn lobes_at(&self, footprint: &Footprint) -> MultipleSurface;

    /// Radiance of every lane of a batch, written to `radiance` (lanes past `batch.len` are left
    /// unspecified). This default walks [`Prefiltered::lobes_at`]; a method overrides it with a kernel
    /// that becomes vector code, and a test holds every such kernel to this.
    fn shade(&self, batch: &Batch, shading: Shading, radiance: &mut Lane) {
        shade_by_lobes(self, batch, shading, radiance);
    }
}

/// The generic path of [`Prefiltered::shade`]: lobe by lobe.
pub fn shade_by_lobes<P: Prefiltered + ?Sized>(
    prefiltered: &P,
    batch: &Batch,
    shading: Shading,
    radiance: &mut Lane,
) {
    for (i, out) in radiance.iter_mut().enumerate().take(batch.len) {
        *out = if batch.irradiance[i] > 0.0 {
            let surface = prefiltered.lobes_at(&batch.footprint(i));
            let (half, light, view) = (batch.half(i), batch.light(i), batch.view(i));
            batch.irradiance[i] * surface.radiance(shading, half, light, view)
        } else {
            0.0
        };
    }
}
