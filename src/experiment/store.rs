//! Results on disk: what a run keeps as it goes, so that a later one can go on.
//!
//! Every finished piece of work (a reference, a trial, a scene's probes, a prefilter's cost) is a record in the
//! archive, under an address that is the digest of all it depends on; so is every film, under the digest of
//! itself. A record depends on what its piece *is*, never on what it is called: pieces that are renamed, dropped and
//! taken in again are found. What users look at, `images/SCENE/NAME.exr`, is a second name of the film. A record or
//! film whose bytes are not what they were is worth nothing and is made again. Files appear whole or not at all.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::archive::{Archive, Record, film_name};
use super::results::{ProbedMethod, Score};
use crate::file::link_whole;
use crate::render::{Film, FilmError, Tally};
use crate::scene::Shelf;

/// The folder of an experiment's results.
#[derive(Clone, Debug)]
pub struct Store {
    folder: PathBuf,
    archive: Archive,
    /// The images that users find, of those that were kept or looked for.
    shown: Arc<Mutex<BTreeSet<PathBuf>>>,
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

/// Digest of the running program, read once: it is part of what every record depends on, so that no other build's
/// results are taken up.
///
/// # Errors
/// If the program's file cannot be read.
pub fn program() -> Result<blake3::Hash, StoreError> {
    static PROGRAM: OnceLock<blake3::Hash> = OnceLock::new();
    if let Some(known) = PROGRAM.get() {
        return Ok(*known);
    }
    let bytes = std::env::current_exe().and_then(std::fs::read).map_err(StoreError::Program)?;
    Ok(*PROGRAM.get_or_init(|| blake3::hash(&bytes)))
}

impl Store {
    /// The store in `folder`, which is made if it is not there. `depends` is all that every record
    /// depends on, beside the running program.
    ///
    /// # Errors
    /// If the folder cannot be made or the program cannot be read.
    pub fn open(folder: &Path, depends: &str) -> Result<Self, StoreError> {
        std::fs::create_dir_all(folder)
            .map_err(|source| StoreError::Write { path: folder.to_owned(), source })?;
        let program = program()?;
        let mut hasher = blake3::Hasher::new();
        hasher.update(program.as_bytes());
        hasher.update(depends.as_bytes());
        let archive = Archive::of(folder);
        let (folder, shown) = (folder.to_owned(), Arc::default());
        Ok(Self { folder, archive, shown, program, common: hasher.finalize() })
    }

    /// Where prefiltered maps are kept. They depend on the program and on what their own keys say, not on
    /// the rest of the spec.
    pub fn shelf(&self) -> Shelf {
        Shelf { folder: self.archive.prefilters(), program: *self.program.as_bytes() }
    }

    /// Where users find the image of a record.
    pub fn image_path(&self, scene: &str, name: &str) -> PathBuf {
        self.folder.join("images").join(scene).join(format!("{name}.exr"))
    }

    /// Keeps a record that depends on `depends`; it is of `scene`, and called `name` there, which only readers of
    /// the file look at.
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
        self.write(scene, name, depends, None, value)
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
        let image = self.keep_film(scene, name, film)?;
        self.write(scene, name, depends, Some(image), value)
    }

    /// Keeps an image without a record; what [`Store::find_film`] finds it by.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn keep_film(&self, scene: &str, name: &str, film: &Film) -> Result<String, StoreError> {
        let image = film_name(film);
        // Made again to the same bits, because its record was gone: the file stays.
        if self.archive.film(&image).is_none() {
            let path = self.archive.film_path(&image);
            make_parent(&path)?;
            film.write_exr(&path)?;
        }
        self.show(scene, name, &image)?;
        Ok(image)
    }

    /// The record that depends on just this, if there is one, of the type that was kept.
    pub fn find<T: DeserializeOwned>(&self, _scene: &str, _name: &str, depends: &str) -> Option<T> {
        self.read(depends).map(|record| record.value)
    }

    /// The record and its image, if both are there and belong together. Users then find the image under this name
    /// of this scene, if the disk has room for it.
    pub fn find_with_film<T: DeserializeOwned>(
        &self,
        scene: &str,
        name: &str,
        depends: &str,
    ) -> Option<(T, Film)> {
        let record: Record<T> = self.read(depends)?;
        let film = self.find_film(scene, name, &record.image?)?;
        Some((record.value, film))
    }

    /// The image that [`Store::keep_film`] kept, if it is there; users then find it as with
    /// [`Store::find_with_film`].
    pub fn find_film(&self, scene: &str, name: &str, image: &str) -> Option<Film> {
        let film = self.archive.film(image)?;
        // It was kept; a name that cannot be given is missed by nobody but the reader of images.
        let _ = self.show(scene, name, image);
        Some(film)
    }

    /// Takes in all that is kept in another folder of results.
    ///
    /// # Errors
    /// If something cannot be written, or read from there.
    pub fn take_in(folder: &Path, other: &Path) -> Result<(), StoreError> {
        Archive::of(folder)
            .take_in(&Archive::of(other))
            .map_err(|(path, source)| StoreError::Write { path, source })
    }

    /// Gives a kept film the name that users look for.
    fn show(&self, scene: &str, name: &str, image: &str) -> Result<(), StoreError> {
        let path = self.image_path(scene, name);
        make_parent(&path)?;
        self.shown.lock().unwrap_or_else(PoisonError::into_inner).insert(path.clone());
        link_whole(&self.archive.film_path(image), &path)
            .map_err(|source| StoreError::Write { path, source })
    }

    /// Takes away the images of earlier runs that were neither kept nor looked for since the store was opened: the
    /// names only, under which users would take them for this run's. The films stay kept. Image files that are no
    /// kept film's are not touched.
    pub fn clear_images(&self) {
        let shown = self.shown.lock().unwrap_or_else(PoisonError::into_inner);
        for scene in entries(&self.folder.join("images")) {
            for path in entries(&scene).into_iter().filter(|path| !shown.contains(path)) {
                let kept = path.extension().is_some_and(|e| e == "exr")
                    && Film::read_exr(&path)
                        .is_ok_and(|film| self.archive.film_path(&film_name(&film)).exists());
                if kept {
                    let _ = std::fs::remove_file(path);
                }
            }
            // Only if nothing is left in it.
            let _ = std::fs::remove_dir(scene);
        }
    }

    /// The address of what is of type `T` and depends on `depends`. Records of different kinds may depend on the
    /// same.
    fn address<T>(&self, depends: &str) -> String {
        let mut hasher = blake3::Hasher::new();
        hasher.update(self.common.as_bytes());
        hasher.update(std::any::type_name::<T>().as_bytes());
        hasher.update(b" ");
        hasher.update(depends.as_bytes());
        hasher.finalize().to_hex().to_string()
    }

    fn write<T: Serialize>(
        &self,
        scene: &str,
        name: &str,
        depends: &str,
        image: Option<String>,
        value: &T,
    ) -> Result<(), StoreError> {
        let address = self.address::<T>(depends);
        let path = self.archive.record_path(&address);
        make_parent(&path)?;
        self.archive
            .write(Record { address, of: format!("{scene}/{name}"), image, value })
            .map_err(|source| StoreError::Write { path, source })
    }

    fn read<T: DeserializeOwned>(&self, depends: &str) -> Option<Record<T>> {
        self.archive.read(&self.address::<T>(depends))
    }
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.path()).collect()
}

fn make_parent(path: &Path) -> Result<(), StoreError> {
    let parent = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(parent)
        .map_err(|source| StoreError::Write { path: parent.to_owned(), source })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film(value: f32) -> Film {
        Film::new(3, 2, vec![value; 6])
    }

    fn store(folder: &Path) -> Store {
        Store::open(folder, "all").unwrap()
    }

    #[test]
    fn what_is_changed_and_changed_back_is_still_there() {
        let folder = tempfile::tempdir().unwrap();
        let store = store(folder.path());
        for (depends, value) in [("a", 1.0), ("b", 2.0)] {
            store.keep_with_film("scene", "trial", depends, &value, &film(value as f32)).unwrap();
        }
        let shown = store.image_path("scene", "trial");
        assert_eq!(Film::read_exr(&shown).unwrap(), film(2.0));
        let (value, found): (f64, _) = store.find_with_film("scene", "trial", "a").unwrap();
        assert_eq!((value, found), (1.0, film(1.0)));
        assert_eq!(Film::read_exr(&shown).unwrap(), film(1.0), "the name goes with it");
    }

    #[test]
    fn names_do_not_matter_and_kinds_do() {
        let folder = tempfile::tempdir().unwrap();
        let store = store(folder.path());
        store.keep("scene", "probes", "a", &1.5f64).unwrap();
        assert_eq!(store.find::<f64>("renamed", "too", "a"), Some(1.5));
        assert_eq!(store.find::<String>("scene", "probes", "a"), None);
        assert_eq!(store.find::<f64>("scene", "probes", "b"), None);
        let other = Store::open(folder.path(), "another camera").unwrap();
        assert_eq!(other.find::<f64>("scene", "probes", "a"), None);
    }

    #[test]
    fn films_of_the_same_pixels_and_other_sizes_are_kept_apart() {
        let folder = tempfile::tempdir().unwrap();
        let store = store(folder.path());
        let black = [Film::new(3, 2, vec![0.0; 6]), Film::new(2, 3, vec![0.0; 6])];
        let names = black.each_ref().map(|film| store.keep_film("s", "n", film).unwrap());
        for (name, film) in names.iter().zip(black) {
            assert_eq!(store.find_film("s", "n", name), Some(film));
        }
    }

    #[test]
    fn an_image_that_was_touched_is_not_taken_for_the_film() {
        let folder = tempfile::tempdir().unwrap();
        let store = store(folder.path());
        store.keep_with_film("s", "n", "a", &1.0, &film(1.0)).unwrap();
        let shown = store.image_path("s", "n");
        std::fs::remove_file(&shown).unwrap();
        assert!(store.find_with_film::<f64>("s", "n", "a").is_some(), "only the name was gone");
        assert!(shown.exists());
        // Written in place: the film's own bytes.
        std::fs::write(&shown, b"scribble").unwrap();
        assert!(store.find_with_film::<f64>("s", "n", "a").is_none());
    }

    #[test]
    fn images_of_earlier_runs_go_and_others_files_stay() {
        let folder = tempfile::tempdir().unwrap();
        let first = store(folder.path());
        first.keep_with_film("old", "n", "a", &1.0, &film(1.0)).unwrap();
        first.keep_with_film("s", "n", "b", &2.0, &film(2.0)).unwrap();
        let mine = first.image_path("s", "mine");
        film(3.0).write_exr(&mine).unwrap();
        let second = store(folder.path());
        assert!(second.find_with_film::<f64>("s", "n", "b").is_some());
        second.clear_images();
        assert!(second.image_path("s", "n").exists() && mine.exists());
        assert!(!folder.path().join("images/old").exists());
        assert!(second.find_with_film::<f64>("old", "n", "a").is_some(), "its film is still kept");
    }
}
