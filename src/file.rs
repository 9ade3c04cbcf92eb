//! Floor 0: files that appear whole or not at all.

use std::io::Write;
use std::path::Path;

/// Writes a file beside where it belongs, brings it to the disk, and renames it into place, so that
/// whoever reads `path` finds the old bytes or the new ones, never a part. The folder must exist.
///
/// # Errors
/// Whatever the system says; `path` is then as it was.
pub fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let mut beside = beside(folder)?;
    beside.write_all(bytes)?;
    beside.as_file().sync_all()?;
    beside.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// How the names of files begin that are being written.
pub const BESIDE: &str = ".writing-";

/// A temporary file with the rights that any new file would have, not the private ones of a secret.
fn beside(folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let made = builder.prefix(BESIDE).tempfile_in(folder);
    // Without the temporary name, which would only confuse.
    made.map_err(|error| error.kind().into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_what_stood_there_and_leaves_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.txt");
        write_whole(&path, b"old").unwrap();
        write_whole(&path, b"new").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"new");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        assert!(write_whole(&folder.path().join("no/x.txt"), b"").is_err());
    }
}
