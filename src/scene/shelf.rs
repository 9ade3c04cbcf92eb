//! Prefiltered maps kept on disk from run to run.

use std::path::{Path, PathBuf};

use bevy_ecs::prelude::Resource;

use crate::file::write_whole;
use crate::lobe::BaseLobe;
use crate::method::{Damaged, Method};
use crate::texture::NormalMap;

/// A folder of prefiltered maps that are slow to build, each named by its key: maps that were built for other options
/// stay, and serve again.
///
/// A file has, in this order (numbers little-endian; docs/results.md describes it too): the eight bytes
/// `wrinkleP`, the format's version (4 bytes), the key (32), the seconds it took to build (8, a double), what
/// [`crate::method::Prefiltered::store`] gave, and the BLAKE3 digest (32) of all before it.
#[derive(Resource, Clone, Debug)]
pub struct Shelf {
    /// The folder; made when something is kept.
    pub folder: PathBuf,
    /// Digest of the program: what another build prefiltered is not taken.
    pub program: [u8; 32],
}

/// How a file begins.
const MAGIC: [u8; 8] = *b"wrinkleP";
/// The version of the format, of [`crate::method::Prefiltered::store`]'s bytes too.
const VERSION: u32 = 1;
/// Bytes before the stored map.
const HEAD: usize = 8 + 4 + 32 + 8;
/// Bytes of the digest at the end.
const DIGEST: usize = 32;

/// What all a prefiltered map depends on, as a digest.
pub(super) type Key = [u8; 32];

/// A prefiltered map from the shelf.
#[derive(Debug, PartialEq)]
pub(super) struct Kept {
    /// What the prefiltered map is restored from.
    pub bytes: Vec<u8>,
    /// Wall-clock seconds that building it took.
    pub secs: f64,
}

impl Shelf {
    /// The key of a method's (its options included) prefilter of a map for a base lobe.
    pub(super) fn key(&self, map: &NormalMap, method: &dyn Method, base: &BaseLobe) -> Key {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&self.program);
        let form = (map.width(), map.height(), map.wrap(), map.interpolation());
        hasher.update(format!("{form:?} {method:?} {base:?}").as_bytes());
        hasher.update(bytemuck::cast_slice(map.texels()));
        if let Some(heights) = map.heights() {
            hasher.update(bytemuck::cast_slice(heights.values()));
        }
        *hasher.finalize().as_bytes()
    }

    /// The file of the prefilter with this key.
    pub(super) fn path(&self, key: &Key) -> PathBuf {
        self.folder.join(format!("{}.prefilter", blake3::Hash::from(*key).to_hex()))
    }

    /// What is kept in a file under this key; `None` if there is no file, or one of another key.
    pub(super) fn find(&self, path: &Path, key: &Key) -> Result<Option<Kept>, Damaged> {
        match std::fs::read(path) {
            Ok(file) => opened(file, key),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(Damaged(error.to_string())),
        }
    }

    /// Keeps a prefiltered map in a file, whole or not at all.
    pub(super) fn keep(&self, path: &Path, key: &Key, kept: &Kept) -> std::io::Result<()> {
        std::fs::create_dir_all(&self.folder)?;
        write_whole(path, &sealed(key, kept))
    }
}

/// The bytes of a file.
fn sealed(key: &Key, kept: &Kept) -> Vec<u8> {
    let mut file = Vec::with_capacity(HEAD + kept.bytes.len() + DIGEST);
    file.extend(MAGIC);
    file.extend(VERSION.to_le_bytes());
    file.extend(key);
    file.extend(kept.secs.to_le_bytes());
    file.extend(&kept.bytes);
    let digest = blake3::hash(&file);
    file.extend(digest.as_bytes());
    file
}

/// What a file's bytes keep under this key; `None` if their key is another.
fn opened(mut file: Vec<u8>, key: &Key) -> Result<Option<Kept>, Damaged> {
    let damaged = |what: &str| Err(Damaged(what.to_owned()));
    if file.len() < HEAD + DIGEST {
        return damaged("it is too short");
    }
    if file[..8] != MAGIC {
        return damaged("it does not begin as a prefiltered map does");
    }
    let version = u32::from_le_bytes([file[8], file[9], file[10], file[11]]);
    let (content, digest) = file.split_at(file.len() - DIGEST);
    if blake3::hash(content).as_bytes() != digest {
        return damaged("its check sum is wrong");
    }
    if version != VERSION {
        return damaged(&format!("its format is version {version}, this program's is {VERSION}"));
    }
    if content[12..44] != *key {
        return Ok(None);
    }
    let secs = f64::from_le_bytes(std::array::from_fn(|i| content[44 + i]));
    file.truncate(file.len() - DIGEST);
    file.drain(..HEAD);
    Ok(Some(Kept { bytes: file, secs }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEY: Key = [7; 32];

    fn kept() -> Kept {
        Kept { bytes: (0..100).map(|i| i * 2).collect(), secs: 1.5 }
    }

    #[test]
    fn what_is_kept_is_found() {
        let file = sealed(&KEY, &kept());
        assert_eq!(opened(file.clone(), &KEY), Ok(Some(kept())));
        assert_eq!(opened(file, &[8; 32]), Ok(None), "another key is not damage");
    }

    #[test]
    fn a_flipped_byte_anywhere_is_noticed() {
        let file = sealed(&KEY, &kept());
        for at in 0..file.len() {
            let mut bad = file.clone();
            bad[at] ^= 0x10;
            assert!(opened(bad, &KEY).is_err(), "byte {at}");
        }
    }

    #[test]
    fn a_cut_anywhere_is_noticed() {
        let file = sealed(&KEY, &kept());
        for length in 0..file.len() {
            assert!(opened(file[..length].to_vec(), &KEY).is_err(), "{length} bytes");
        }
        let longer = [file.as_slice(), &[0]].concat();
        assert!(opened(longer, &KEY).is_err());
    }

    #[test]
    fn another_version_is_named() {
        let mut file = sealed(&KEY, &kept());
        file.truncate(file.len() - DIGEST);
        file[8] = 9;
        let digest = blake3::hash(&file);
        file.extend(digest.as_bytes());
        let error = opened(file, &KEY).unwrap_err().to_string();
        assert_eq!(error, "its format is version 9, this program's is 1");
    }
}
