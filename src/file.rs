//! Floor 0: files that appear whole or not at all.

use std::io::Write;
use std::path::Path;

/// Writes a file beside where it belongs, brings it to the disk, and renames it into place, so that
/// whoever reads `path` finds the old bytes or the new ones, never a part. The folder must exist.
///
/// # Errors
/// Whatever the system says; `path` is then as it was.
pub fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut beside = beside(folder_of(path))?;
    // By the plain file: errors of the temporary one name it, which would only confuse.
    beside.as_file_mut().write_all(bytes)?;
    beside.as_file().sync_all()?;
    beside.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// Gives the file `from` a second name `to`, which appears whole or not at all; where the file system has no hard
/// links, or the two are on different ones, `to` is a copy. What stands there with the same bytes stays. The folder of
/// `to` must exist.
///
/// # Errors
/// Whatever the system says; `to` is then as it was.
pub fn link_whole(from: &Path, to: &Path) -> std::io::Result<()> {
    let bytes = std::fs::read(from)?;
    if std::fs::read(to).is_ok_and(|there| there == bytes) {
        return Ok(());
    }
    let link = |beside: &Path| std::fs::hard_link(from, beside);
    match tempfile::Builder::new().prefix(BESIDE).make_in(folder_of(to), link) {
        Ok(beside) => beside.persist(to).map_err(|error| error.error),
        Err(_) => write_whole(to, &bytes),
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."))
}

/// How the names of files begin that are being written.
pub const BESIDE: &str = ".writing-";

/// A temporary file with the rights that any new file would have, not the private ones of a secret.
fn beside(folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let made = builder.prefix(BESIDE).tempfile_in(folder);
    // As above, without the temporary name.
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

    #[test]
    fn a_second_name_has_the_bytes_and_outlives_the_first() {
        let folder = tempfile::tempdir().unwrap();
        let [one, two] = ["one", "two"].map(|name| folder.path().join(name));
        write_whole(&one, b"first").unwrap();
        std::fs::write(&two, b"other").unwrap();
        // The second time nothing is to be done.
        for _ in 0..2 {
            link_whole(&one, &two).unwrap();
            assert_eq!(std::fs::read(&two).unwrap(), b"first");
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
        }
        // A new file under the first name is not one under the second.
        write_whole(&one, b"second").unwrap();
        assert_eq!(std::fs::read(&two).unwrap(), b"first");
        std::fs::remove_file(&one).unwrap();
        assert!(link_whole(&one, &two).is_err());
        assert_eq!(std::fs::read(&two).unwrap(), b"first");
    }
}
