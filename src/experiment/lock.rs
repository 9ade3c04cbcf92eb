//! One run at a time in a folder of results.

use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

use super::archive::STATE;
use super::share::SHARDS;
use super::store::StoreError;

/// Holds a folder of results for one run, until it is dropped or the program ends in any way.
#[derive(Debug)]
pub struct Lock {
    _file: File,
}

/// Why a folder could not be had.
#[derive(Debug, thiserror::Error)]
pub enum LockError {
    /// Another run has it.
    #[error(
        "another run is writing to {}: wait for it, or choose another folder with --out",
        folder.display()
    )]
    Taken {
        /// The folder.
        folder: PathBuf,
    },
    /// It cannot be made or written to.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl Lock {
    /// Takes the folder, made if it is missing, and clears away what a killed run left half-written
    /// beside its results. On a file system without locks this only makes the folder.
    ///
    /// # Errors
    /// If another run has it or it cannot be written to.
    pub fn take(folder: &Path) -> Result<Self, LockError> {
        let state = folder.join(STATE);
        let path = state.join("lock");
        let cannot = |path: &Path| {
            let path = path.to_owned();
            |source| StoreError::Write { path, source }
        };
        std::fs::create_dir_all(&state).map_err(cannot(&state))?;
        let file = File::options().create(true).append(true).open(&path).map_err(cannot(&path))?;
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(LockError::Taken { folder: folder.to_owned() });
        }
        clear_leftovers(folder);
        Ok(Self { _file: file })
    }
}

/// Removes the temporary files of [`crate::file::write_whole`] that nobody is left to rename. What
/// cannot be removed stays: it is in nobody's way.
fn clear_leftovers(folder: &Path) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if is_folder && entry.file_name() == SHARDS {
            // They have locks of their own, and may be at work.
        } else if is_folder {
            clear_leftovers(&entry.path());
        } else if entry.file_name().to_string_lossy().starts_with(crate::file::BESIDE) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_held_until_it_is_let_go() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("a/b");
        let held = Lock::take(&folder).unwrap();
        let error = Lock::take(&folder).unwrap_err();
        assert!(matches!(error, LockError::Taken { .. }), "{error}");
        drop(held);
        Lock::take(&folder).unwrap();
    }

    #[test]
    fn leftovers_go_and_results_stay() {
        let folder = tempfile::tempdir().unwrap();
        let images = folder.path().join("images");
        std::fs::create_dir(&images).unwrap();
        let (half, whole) = (images.join(".writing-Ab3"), images.join("whole.exr"));
        let shards = folder.path().join(".shards/1-of-2");
        std::fs::create_dir_all(&shards).unwrap();
        let other = shards.join(".writing-Cd4");
        std::fs::write(&other, b"of a shard at work").unwrap();
        std::fs::write(&half, b"ha").unwrap();
        std::fs::write(&whole, b"whole").unwrap();
        Lock::take(folder.path()).unwrap();
        assert!(!half.exists() && whole.exists() && other.exists());
    }

    #[test]
    fn a_file_in_the_way_is_named() {
        let root = tempfile::tempdir().unwrap();
        std::fs::write(root.path().join("quick"), b"").unwrap();
        let error = Lock::take(&root.path().join("quick")).unwrap_err().to_string();
        assert!(error.contains("quick") && error.contains("cannot write"), "{error}");
    }
}
