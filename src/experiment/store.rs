//! Results on disk: what a run keeps as it goes, so that a later one can go on.
//!
//! Every finished piece of work (a reference, a trial, a scene's probes, a prefilter's cost) is a
//! record under `.state/`, and every image a float EXR under `images/`. A record carries the digest of
//! all it depends on; one whose digest or image does not match is worth nothing and is made again.
//! Files appear whole or not at all.

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::results::{ProbedMethod, Score};
use crate::file::write_whole;
use crate::render::{Film, FilmError, Tally};
use crate::scene::Shelf;

/// The folder of an experiment's results.
#[derive(Clone, Debug)]
pub struct Store {
    folder: PathBuf,
    /// Digest of the running program.
    program: blake3::Hash,
    /// Digest of everything that all records depend on.
    common: blake3::Hash,
}

/// Why results could not be kept.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// A file or folder could not be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// An image could not be written.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// The running program could not be read for its digest.
    #[error("cannot read the running program to tell its results from another's: {0}")]
    Program(std::io::Error),
}

/// What of a reference is kept beside its image, so that it can be sampled further.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReferenceRecord {
    /// Its replicates.
    pub tally: Tally,
}

/// That a scene's reference needs no further replicates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SettledRecord {
    /// How many it has.
    pub replicates: u32,
}

/// A trial as a record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrialRecord {
    /// CPU seconds of its rendering.
    pub cpu_secs: f64,
}

/// A trial's scores against one reference, as a record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScoresRecord {
    /// By metric.
    pub scores: Vec<Score>,
}

/// A prefilter as a record: what it cost, or why it was refused.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PrefilterRecord {
    /// Wall-clock seconds and bytes beyond the map; None where the method refused.
    pub cost: Option<(f64, usize)>,
    /// Why the method refused the base lobe.
    pub refusal: Option<String>,
}

/// A scene's probes as a record.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ProbeRecord {
    /// The pixel.
    pub pixel: [usize; 2],
    /// Texels the footprint is across.
    pub texels_across: f64,
    /// The true distribution.
    pub truth: Vec<f32>,
    /// Each method's, by label.
    pub methods: Vec<ProbedMethod>,
}

/// A record on disk.
#[derive(Serialize, Deserialize)]
struct Kept<T> {
    digest: String,
    /// Digest of the image that belongs to it, if one does.
    image: Option<String>,
    value: T,
}

impl Store {
    /// The store in `folder`, which is made if it is not there. `depends` is all that every record
    /// depends on; the running program is added to it, so that no other build's results are taken up.
    ///
    /// # Errors
    /// If the folder cannot be made or the program cannot be read.
    pub fn open(folder: &Path, depends: &str) -> Result<Self, StoreError> {
        std::fs::create_dir_all(folder)
            .map_err(|source| StoreError::Write { path: folder.to_owned(), source })?;
        let program = std::env::current_exe().and_then(std::fs::read);
        let program = blake3::hash(&program.map_err(StoreError::Program)?);
        let mut hasher = blake3::Hasher::new();
        hasher.update(program.as_bytes());
        hasher.update(depends.as_bytes());
        Ok(Self { folder: folder.to_owned(), program, common: hasher.finalize() })
    }

    /// Where prefiltered maps are kept. They depend on the program and on what their own keys say, not on
    /// the rest of the spec.
    pub fn shelf(&self) -> Shelf {
        let folder = self.folder.join(".state").join("prefilters");
        Shelf { folder, program: *self.program.as_bytes() }
    }

    /// Where the image of a record is.
    pub fn image_path(&self, scene: &str, name: &str) -> PathBuf {
        self.folder.join("images").join(scene).join(format!("{name}.exr"))
    }

    /// Keeps a record named `name` of `scene` that depends on `depends`.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn keep<T: Serialize>(
        &self,
        scene: &str,
        name: &str,
        depends: &str,
        value: &T,
    ) -> Result<(), StoreError> {
        self.write_record(scene, name, depends, None, value)
    }

    /// Keeps a record and its image.
    ///
    /// # Errors
    /// If either cannot be written.
    pub fn keep_with_film<T: Serialize>(
        &self,
        scene: &str,
        name: &str,
        depends: &str,
        value: &T,
        film: &Film,
    ) -> Result<(), StoreError> {
        self.keep_film(scene, name, film)?;
        self.write_record(scene, name, depends, Some(film.digest()), value)
    }

    /// Keeps an image without a record.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn keep_film(&self, scene: &str, name: &str, film: &Film) -> Result<(), StoreError> {
        let path = self.image_path(scene, name);
        make_parent(&path)?;
        Ok(film.write_exr(&path)?)
    }

    /// The record named `name` of `scene`, if there is one and it depends on just this.
    pub fn find<T: DeserializeOwned>(&self, scene: &str, name: &str, depends: &str) -> Option<T> {
        self.read_record(scene, name, depends).map(|kept| kept.value)
    }

    /// The record and its image, if both are there and belong together.
    pub fn find_with_film<T: DeserializeOwned>(
        &self,
        scene: &str,
        name: &str,
        depends: &str,
    ) -> Option<(T, Film)> {
        let kept: Kept<T> = self.read_record(scene, name, depends)?;
        let film = Film::read_exr(&self.image_path(scene, name)).ok()?;
        (kept.image? == film.digest()).then_some((kept.value, film))
    }

    fn record_path(&self, scene: &str, name: &str) -> PathBuf {
        self.folder.join(".state").join(scene).join(format!("{name}.json"))
    }

    fn digest(&self, depends: &str) -> String {
        let mut hasher = blake3::Hasher::new();
        hasher.update(self.common.as_bytes());
        hasher.update(depends.as_bytes());
        hasher.finalize().to_hex().to_string()
    }

    fn write_record<T: Serialize>(
        &self,
        scene: &str,
        name: &str,
        depends: &str,
        image: Option<String>,
        value: &T,
    ) -> Result<(), StoreError> {
        let path = self.record_path(scene, name);
        make_parent(&path)?;
        let kept = Kept { digest: self.digest(depends), image, value };
        let text = serde_json::to_vec(&kept).expect("records are plain data");
        write_whole(&path, &text).map_err(|source| StoreError::Write { path, source })
    }

    fn read_record<T: DeserializeOwned>(
        &self,
        scene: &str,
        name: &str,
        depends: &str,
    ) -> Option<Kept<T>> {
        let text = std::fs::read(self.record_path(scene, name)).ok()?;
        let kept: Kept<T> = serde_json::from_slice(&text).ok()?;
        (kept.digest == self.digest(depends)).then_some(kept)
    }
}

fn make_parent(path: &Path) -> Result<(), StoreError> {
    let parent = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(parent)
        .map_err(|source| StoreError::Write { path: parent.to_owned(), source })
}
