//! Where a distribution of normals comes from.

use std::path::{Path, PathBuf};

use super::lobes::{WrittenLobe, lobes, ndf_of};
use super::{BakeError, MapFile, SIDE};
use crate::lobe::{Measure, MultipleSurface, NdfError, NdfImage, find_named, read_peaks};
use crate::texture::image_file::read_values;

/// A distribution of normals: where it comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum NdfSource {
    /// Lobes.
    Lobes(Vec<WrittenLobe>),
    /// A multiple surface of the program's own, by its name.
    Named(&'static str),
    /// A multiple surface from a JSON file of peaks.
    Peaks(PathBuf),
    /// A picture of it.
    Image {
        /// The file.
        path: PathBuf,
        /// What its values are densities of.
        measure: Measure,
    },
    /// Measured from a map.
    Map(MapFile),
}

impl NdfSource {
    /// What a text means: lobes in words (`[SHARE*]FAMILY:U[,V[,DEGREES]][@TILT,AZIMUTH]`, joined by `+`), a multiple surface by its name, a JSON file of peaks, or a picture
    /// whose values `measure` tells of. Files are looked for in `folder`.
    ///
    /// # Errors
    /// A sentence that says what is wrong with it, or that there is no such file.
    pub fn parse(text: &str, folder: &Path, measure: Measure) -> Result<Self, String> {
        if let Some(lobes) = lobes(text) {
            return lobes.map(Self::Lobes);
        }
        if let Some(named) = find_named(text) {
            return Ok(Self::Named(named.name));
        }
        let path = folder.join(text);
        if !path.is_file() {
            return Err(format!(
                "there is no file {}; a distribution is a lobe such as beckmann:0.3 or beckmann:0.1,0.4,30, several joined \
                 by +, a multiple surface (`wrinkle list`), or an image file",
                path.display()
            ));
        }
        let is_json = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("json"));
        Ok(if is_json { Self::Peaks(path) } else { Self::Image { path, measure } })
    }

    /// The distribution.
    ///
    /// # Errors
    /// [`BakeError`], which names the file.
    pub fn read(&self) -> Result<NdfImage, BakeError> {
        let of_surface = |surface: &MultipleSurface| NdfImage::of_surface(surface, SIDE);
        match self {
            Self::Lobes(lobes) => ndf_of(lobes, SIDE).map_err(|e| BakeError::ndf("the lobes", e)),
            Self::Named(name) => {
                let surface = find_named(name).ok_or(NdfError::Empty);
                let ndf = surface.and_then(|named| of_surface(&named.surface()));
                ndf.map_err(|error| BakeError::ndf(*name, error))
            }
            Self::Peaks(path) => {
                let surface: MultipleSurface = read_peaks(path)?.into_iter().collect();
                of_surface(&surface).map_err(|error| BakeError::of_file(path, error))
            }
            Self::Image { path, measure } => {
                let (size, values) = read_values(path)?;
                NdfImage::of_image(size, &values, *measure)
                    .map_err(|error| BakeError::of_file(path, error))
            }
            Self::Map(map) => map.ndf(&map.read()?.normals, SIDE),
        }
    }

    /// The file it comes from, if any.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::Lobes(_) | Self::Named(_) => None,
            Self::Peaks(path) | Self::Image { path, .. } => Some(path),
            Self::Map(map) => Some(&map.path),
        }
    }

    /// The same, but that the file's name is left out: what tells two of one name apart is in the files.
    pub fn nameless(mut self) -> Self {
        match &mut self {
            Self::Lobes(_) | Self::Named(_) => {}
            Self::Peaks(path) | Self::Image { path, .. } => path.clear(),
            Self::Map(map) => map.path.clear(),
        }
        self
    }
}
