//! What a folder of results says of itself: which experiment was run there, by which program, and whether all of it.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::archive::STATE;
use super::share::Share;
use super::spec::Experiment;
use super::store::{StoreError, program};
use crate::file::write_whole;

/// The version of manifests.
const FORMAT: u32 = 1;
/// The manifest's file, in the folder of the run's own.
const FILE: &str = "run.json";

/// What a folder of results says of itself, in `.state/run.json`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// The version of its format.
    pub format: u32,
    /// The experiment's name.
    pub experiment: String,
    /// Whether it gathers a paper's evidence.
    pub paper: bool,
    /// Digest of the program, in hexadecimal.
    pub program: String,
    /// The experiment's file as written.
    pub spec: String,
    /// Which share of the experiment was run there; none if all of it.
    pub share: Option<Share>,
    /// Whether that was finished.
    pub finished: bool,
}

/// Why a manifest cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ManifestError {
    /// There is none, or it cannot be had.
    #[error("{0}")]
    Unreadable(std::io::Error),
    /// A newer program wrote it.
    #[error("it was written by a newer wrinkle, format {0}; this one reads up to {FORMAT}")]
    Newer(u32),
    /// It is no manifest.
    #[error("it is damaged: {0}")]
    Damaged(serde_json::Error),
}

impl Manifest {
    /// That of a run of `experiment` by this program which is not finished.
    ///
    /// # Errors
    /// If the running program cannot be read.
    pub fn begun(experiment: &Experiment, share: Option<Share>) -> Result<Self, StoreError> {
        Ok(Self {
            format: FORMAT,
            experiment: experiment.name().to_owned(),
            paper: matches!(experiment, Experiment::Paper(_)),
            program: program()?.to_hex().to_string(),
            spec: experiment.text().to_owned(),
            share,
            finished: false,
        })
    }

    /// Writes it into a folder of results, whose `.state` is made if it is missing.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), StoreError> {
        let state = folder.join(STATE);
        let path = state.join(FILE);
        let text = serde_json::to_vec_pretty(self).expect("manifests are plain data");
        let written = std::fs::create_dir_all(&state).and_then(|()| write_whole(&path, &text));
        written.map_err(|source| StoreError::Write { path, source })
    }

    /// Reads that of a folder of results.
    ///
    /// # Errors
    /// [`ManifestError`].
    pub fn read(folder: &Path) -> Result<Self, ManifestError> {
        #[derive(Deserialize)]
        struct Version {
            format: u32,
        }
        let path = folder.join(STATE).join(FILE);
        let text = std::fs::read(path).map_err(ManifestError::Unreadable)?;
        let version: Version = serde_json::from_slice(&text).map_err(ManifestError::Damaged)?;
        if version.format > FORMAT {
            return Err(ManifestError::Newer(version.format));
        }
        serde_json::from_slice(&text).map_err(ManifestError::Damaged)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_comes_back_and_a_newer_one_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let manifest = Manifest {
            format: FORMAT,
            experiment: "quick".into(),
            paper: false,
            program: "ab".into(),
            spec: "seed = 1".into(),
            share: Some(Share { of: 3, number: 2 }),
            finished: true,
        };
        let read = || Manifest::read(folder.path());
        assert!(matches!(read(), Err(ManifestError::Unreadable(_))));
        manifest.write(folder.path()).unwrap();
        assert_eq!(read().unwrap(), manifest);
        let path = folder.path().join(STATE).join(FILE);
        std::fs::write(&path, r#"{ "format": 7, "anything": "else" }"#).unwrap();
        let error = read().unwrap_err().to_string();
        assert_eq!(error, "it was written by a newer wrinkle, format 7; this one reads up to 1");
        std::fs::write(&path, "{").unwrap();
        assert!(matches!(read(), Err(ManifestError::Damaged(_))));
    }
}
