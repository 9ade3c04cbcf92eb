//! Bumps baked from a distribution of normals (Kautz et al. 2001): what `wrinkle bake` writes, and textures of experiments
//! that have the key `ndf`, `like` or `onto`.

mod error;
mod lobes;
mod source;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

pub use error::BakeError;
pub(super) use lobes::ndf_of;
pub use lobes::{Family, WrittenLobe};
pub use source::NdfSource;

use super::file::{Reading, read};
use super::{Bumps, square_cells};
use crate::lobe::NdfImage;
use crate::synthesis::{Missed, Noise, Synthesis, octaves_for};
use crate::texture::NormalMap;

/// Pixels a side of distributions that are made or measured here.
pub const SIDE: usize = 256;
/// Most texels of a map: as many as are read from one.
pub const MOST_TEXELS: usize = 1 << 26;
/// Lattice cells of the first octave along the shorter side, if nothing else is said.
pub const CELLS: u32 = 16;

/// What is to be baked.
#[derive(Clone, Debug, PartialEq)]
pub struct Recipe {
    /// What the noise stands on.
    pub ground: Ground,
    /// Lattice cells of the first octave along the map's shorter side; if not said [`CELLS`], or onto a map a quarter of
    /// its texels there.
    pub cells: Option<u32>,
    /// Octaves of noise; as many as the texels can show if not said.
    pub octaves: Option<u32>,
    /// Height of each octave over that of the one before, in (0, 1).
    pub gain: f64,
    /// What the noise is drawn from.
    pub seed: u64,
}

/// What noise stands on.
#[derive(Clone, Debug, PartialEq)]
pub enum Ground {
    /// Nothing: bumps of noise alone, which repeat.
    Bare {
        /// The distribution their normals follow.
        ndf: NdfSource,
        /// Texels along u and v.
        size: [usize; 2],
    },
    /// The bumps of a map: detail on top (§7). What is made repeats if the map does.
    Onto {
        /// The map.
        map: MapFile,
        /// The distribution that detail follows; the map's own if not said.
        ndf: Option<NdfSource>,
        /// How strong the noise is, of what it is on its own: 0 for the map as it is.
        amount: f64,
        /// Part of the map's own distribution that is mixed into the one that was told, in [0, 1): where that has no
        /// density, no indices lead back to a normal. Of no matter if the distribution is the map's own.
        floor: f64,
        /// Texels along u and v, none fewer than the map's; the map's if not said. The map is interpolated.
        size: Option<[usize; 2]>,
    },
}

/// A map in an image file.
#[derive(Clone, Debug, PartialEq)]
pub struct MapFile {
    /// The file.
    pub path: PathBuf,
    /// What it holds.
    pub reading: Reading,
}

/// What was baked.
#[derive(Clone, Debug)]
pub struct Baked {
    /// The bumps.
    pub normals: NormalMap,
    /// The distribution that was asked for, before a floor.
    pub ndf: NdfImage,
    /// Lattice cells of the first octave along u and v.
    pub cells: [u32; 2],
    /// Octaves of noise that are in it.
    pub octaves: f64,
    /// Of detail on a map, what it did.
    pub onto: Option<OntoMap>,
    /// Things worth knowing, a sentence each.
    pub notes: Vec<String>,
}

/// What detail did to a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OntoMap {
    /// Texels of the map's file along u and v.
    pub size: [usize; 2],
    /// Root mean square tilt of the map, at the size that was made, and with detail, degrees.
    pub tilt: [f64; 2],
    /// How far the map's normals, at that size, miss themselves with detail of amount 0.
    pub missed: Missed,
}

impl MapFile {
    fn read(&self) -> Result<Bumps, BakeError> {
        Ok(read(&self.path, &self.reading)?)
    }

    /// The distribution of `map`, which is what was read or made of it.
    fn ndf(&self, map: &NormalMap, side: usize) -> Result<NdfImage, BakeError> {
        NdfImage::of_normals(map.texels(), None, side)
            .map_err(|error| BakeError::of_file(&self.path, error))
    }
}

impl Recipe {
    /// Bakes it.
    ///
    /// # Errors
    /// [`BakeError`], a sentence that names the file.
    pub fn bake(&self) -> Result<Baked, BakeError> {
        match &self.ground {
            Ground::Bare { ndf, size } => {
                few_enough(*size)?;
                Ok(self.bare(ndf.read()?, *size))
            }
            Ground::Onto { map, ndf, amount, floor, size } => {
                let Bumps { normals, notes, .. } = map.read()?;
                let own = [normals.width(), normals.height()];
                let size = size.unwrap_or(own);
                few_enough(size)?;
                if size[0] < own[0] || size[1] < own[1] {
                    return Err(BakeError::Smaller { path: map.path.clone(), own, asked: size });
                }
                let ground = normals.resampled(size[0], size[1]);
                let told = ndf.as_ref().map(NdfSource::read).transpose()?;
                let own_ndf = map.ndf(&ground, told.as_ref().map_or(SIDE, NdfImage::side))?;
                let ndf = told.unwrap_or_else(|| own_ndf.clone());
                let used = NdfImage::mixed(&[(1.0 - floor, &ndf), (*floor, &own_ndf)])
                    .map_err(|error| BakeError::of_file(&map.path, error))?;
                let noise = self.noise(size, own.map(|side| side as u32 / 4));
                let mut baked = self.onto(&ground, own, used, noise, *amount);
                baked.notes.splice(0..0, notes);
                baked.ndf = ndf;
                Ok(baked)
            }
        }
    }

    /// The files it is made of.
    pub fn files(&self) -> Vec<&Path> {
        match &self.ground {
            Ground::Bare { ndf, .. } => ndf.file().into_iter().collect(),
            Ground::Onto { map, ndf, .. } => {
                let ndf = ndf.as_ref().and_then(NdfSource::file);
                std::iter::once(map.path.as_path()).chain(ndf).collect()
            }
        }
    }

    /// The same without the names of its files.
    pub fn nameless(mut self) -> Self {
        match &mut self.ground {
            Ground::Bare { ndf, .. } => *ndf = ndf.clone().nameless(),
            Ground::Onto { map, ndf, .. } => {
                map.path.clear();
                *ndf = ndf.take().map(NdfSource::nameless);
            }
        }
        self
    }

    fn bare(&self, ndf: NdfImage, size: [usize; 2]) -> Baked {
        let noise = self.noise(size, [CELLS; 2]);
        let (octaves, notes) = octaves(self.octaves, size, noise.cells);
        let normals = Synthesis::new(ndf.clone(), noise).bake(size[0], size[1], octaves);
        Baked { normals, ndf, cells: noise.cells, octaves, onto: None, notes }
    }

    fn onto(
        &self,
        ground: &NormalMap,
        file: [usize; 2],
        ndf: NdfImage,
        noise: Noise,
        amount: f64,
    ) -> Baked {
        let size = [ground.width(), ground.height()];
        let (octaves, notes) = octaves(self.octaves, size, noise.cells);
        let synthesis = Synthesis::new(ndf.clone(), noise);
        let normals = synthesis.with_detail(ground, amount, octaves);
        let through =
            |t: &[f32; 4]| synthesis.normals.at(synthesis.normals.indices_of([t[0], t[1], t[2]]));
        let missed = Missed::of(ground.texels(), ground.texels().iter().map(through));
        let tilt = [ground, &normals].map(|map| Missed::upright(map.texels()).rms);
        let onto = Some(OntoMap { size: file, tilt, missed });
        Baked { normals, ndf, cells: noise.cells, octaves, onto, notes }
    }

    /// The noise on a map of this size; `usual` cells along either side if none are told.
    fn noise(&self, size: [usize; 2], usual: [u32; 2]) -> Noise {
        let cells = self.cells.unwrap_or(usual[0].min(usual[1]).max(1));
        Noise { cells: square_cells(size, cells), gain: self.gain, seed: self.seed }
    }
}

fn few_enough([width, height]: [usize; 2]) -> Result<(), BakeError> {
    let few = width.checked_mul(height).is_some_and(|texels| texels <= MOST_TEXELS);
    if few { Ok(()) } else { Err(BakeError::TooMany { width, height }) }
}

/// How many octaves are summed on a map of this size, and what is worth knowing of that.
pub(super) fn octaves(asked: Option<u32>, size: [usize; 2], cells: [u32; 2]) -> (f64, Vec<String>) {
    let most = octaves_for(size, cells);
    let octaves = asked.map_or(most, f64::from);
    let mut notes = vec![];
    if octaves > most {
        let [width, height] = size;
        notes.push(format!(
            "{width}x{height} texels can show {most} of {octaves} octaves; the others alias"
        ));
    }
    if most == 0.0 {
        notes.push(
            "too few texels a lattice cell to show the noise: have more texels or fewer cells"
                .into(),
        );
    }
    (octaves, notes)
}
