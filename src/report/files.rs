//! The folder of a report, filled file by file.

use std::path::{Path, PathBuf};

use crate::file::write_whole;

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {cause}; is the disk full, or the folder not yours?", path.display())]
pub struct ReportError {
    path: PathBuf,
    #[source]
    cause: std::io::Error,
}

/// A folder being filled.
pub(super) struct Folder {
    root: PathBuf,
    written: Vec<PathBuf>,
}

impl Folder {
    /// Opens the folder, making it if it is missing.
    pub fn create(root: &Path) -> Result<Self, ReportError> {
        make(root)?;
        Ok(Self { root: root.to_owned(), written: Vec::new() })
    }

    /// Writes one file; `name` may hold folders, separated by `/`.
    pub fn put(&mut self, name: &str, bytes: &[u8]) -> Result<(), ReportError> {
        let path = self.root.join(name);
        let parent = path.parent().unwrap_or(&self.root);
        make(parent)?;
        write_whole(&path, bytes).map_err(|cause| ReportError { path: path.clone(), cause })?;
        self.written.push(path);
        Ok(())
    }

    /// Everything written, in order.
    pub fn written(self) -> Vec<PathBuf> {
        self.written
    }
}

fn make(folder: &Path) -> Result<(), ReportError> {
    std::fs::create_dir_all(folder).map_err(|cause| ReportError { path: folder.to_owned(), cause })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_replace_what_stood_there_and_leave_nothing_else() {
        let root = tempfile::tempdir().unwrap();
        let mut folder = Folder::create(&root.path().join("a/b")).unwrap();
        folder.put("images/x.txt", b"old").unwrap();
        folder.put("images/x.txt", b"new").unwrap();
        let images = root.path().join("a/b/images");
        assert_eq!(std::fs::read(images.join("x.txt")).unwrap(), b"new");
        assert_eq!(std::fs::read_dir(images).unwrap().count(), 1);
    }

    #[test]
    fn an_error_names_the_file() {
        let root = tempfile::tempdir().unwrap();
        std::fs::write(root.path().join("images"), b"in the way").unwrap();
        let mut folder = Folder::create(root.path()).unwrap();
        let error = folder.put("images/x.png", b"").unwrap_err().to_string();
        assert!(error.contains("images"), "{error}");
    }
}
