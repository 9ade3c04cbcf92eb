//! The archive: records and films on disk, found by what they are.
//!
//! `.state/records/AB/CD….json` holds the record whose address is ABCD…, `.state/films/AB/CD….exr` the film whose
//! digest that is. Nothing is ever changed in place, so archives of one program can be poured together.

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::file::{link_whole, write_whole};
use crate::render::Film;

/// The version of records; a file of another one is no record. (Version 1 had a file a name.)
const FORMAT: u32 = 2;

/// The archive of a folder of results.
#[derive(Clone, Debug)]
pub(super) struct Archive {
    state: PathBuf,
}

/// A record: something that was found, and the film that belongs to it, if one does.
#[derive(Debug, PartialEq)]
pub(super) struct Record<T> {
    /// Digest of all it depends on, in hexadecimal.
    pub address: String,
    /// What it was of when it was kept, for whoever reads the file.
    pub of: String,
    /// [`film_name`] of its film.
    pub image: Option<String>,
    pub value: T,
}

/// The first line of a record; the second is its value.
#[derive(Serialize, Deserialize)]
struct Head {
    format: u32,
    of: String,
    address: String,
    image: Option<String>,
    /// Digest of the second line.
    digest: String,
}

/// What a film is found by: the digest of its pixels, and its size.
pub(super) fn film_name(film: &Film) -> String {
    format!("{}-{}x{}", film.digest(), film.width(), film.height())
}

impl Archive {
    /// The archive of the results in `folder`.
    pub fn of(folder: &Path) -> Self {
        Self { state: folder.join(STATE) }
    }

    /// Where prefiltered maps are.
    pub fn prefilters(&self) -> PathBuf {
        self.state.join("prefilters")
    }

    pub fn record_path(&self, address: &str) -> PathBuf {
        self.place("records", address, "json")
    }

    pub fn film_path(&self, name: &str) -> PathBuf {
        self.place("films", name, "exr")
    }

    /// Folders by the first two digits: no folder gets too many files.
    fn place(&self, kind: &str, address: &str, ending: &str) -> PathBuf {
        let (first, rest) = address.split_at_checked(2).unwrap_or(("__", address));
        self.state.join(kind).join(first).join(format!("{rest}.{ending}"))
    }

    /// The film of this name, if it is there and is the one.
    pub fn film(&self, name: &str) -> Option<Film> {
        let film = Film::read_exr(&self.film_path(name)).ok()?;
        (film_name(&film) == name).then_some(film)
    }

    /// The record at an address, if one is there and is whole.
    pub fn read<T: DeserializeOwned>(&self, address: &str) -> Option<Record<T>> {
        let text = std::fs::read(self.record_path(address)).ok()?;
        let (head, value) = text.split_at(text.iter().position(|&byte| byte == b'\n')?);
        let value = value.trim_ascii();
        let head: Head = serde_json::from_slice(head).ok()?;
        let whole = head.format == FORMAT
            && head.address == address
            && blake3::hash(value).to_hex().as_str() == head.digest;
        let value = whole.then(|| serde_json::from_slice(value).ok())??;
        Some(Record { address: head.address, of: head.of, image: head.image, value })
    }

    /// Writes a record; its folder must be there.
    pub fn write<T: Serialize>(&self, record: Record<T>) -> std::io::Result<()> {
        let Record { address, of, image, value } = record;
        let path = self.record_path(&address);
        let value = serde_json::to_vec(&value).expect("records are plain data");
        let digest = blake3::hash(&value).to_hex().to_string();
        let head = Head { format: FORMAT, of, address, image, digest };
        let mut text = serde_json::to_vec(&head).expect("heads are plain data");
        text.push(b'\n');
        text.extend(value);
        text.push(b'\n');
        write_whole(&path, &text)
    }

    /// Takes in all that another archive holds: links where the file system can, copies elsewhere.
    ///
    /// # Errors
    /// The file that could not be read or written, and why.
    pub fn take_in(&self, other: &Self) -> Result<(), (PathBuf, std::io::Error)> {
        for kind in ["records", "films", "prefilters"] {
            let from = other.state.join(kind);
            if from.is_dir() {
                pour(&from, &self.state.join(kind))?;
            }
        }
        Ok(())
    }
}

/// Where, in a folder of results, a run keeps what is its own.
pub const STATE: &str = ".state";

/// Links every file under a folder into another, in order of names.
fn pour(from: &Path, to: &Path) -> Result<(), (PathBuf, std::io::Error)> {
    let at = |path: &Path| {
        let path = path.to_owned();
        |error| (path, error)
    };
    std::fs::create_dir_all(to).map_err(at(to))?;
    let entries = std::fs::read_dir(from).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    let mut entries = entries.map_err(at(from))?;
    entries.sort_by_key(std::fs::DirEntry::file_name);
    for entry in entries {
        let (path, name) = (entry.path(), entry.file_name());
        let target = to.join(&name);
        if path.is_dir() {
            pour(&path, &target)?;
        } else if !name.to_string_lossy().starts_with(crate::file::BESIDE) {
            link_whole(&path, &target).map_err(at(&target))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(address: &str, value: f64) -> Record<f64> {
        Record { address: address.into(), of: "scene/trial".into(), image: None, value }
    }

    fn keep(archive: &Archive, address: &str, value: f64) -> PathBuf {
        let path = archive.record_path(address);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        archive.write(record(address, value)).unwrap();
        path
    }

    #[test]
    fn a_record_comes_back_and_a_flipped_byte_anywhere_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let archive = Archive::of(folder.path());
        let path = keep(&archive, "abcd", 0.1 + 0.2);
        assert_eq!(archive.read("abcd"), Some(record("abcd", 0.1 + 0.2)));
        let whole = std::fs::read(&path).unwrap();
        let of = whole.windows(11).position(|part| part == b"scene/trial").unwrap();
        for at in (0..whole.len() - 1).filter(|at| !(of..of + 11).contains(at)) {
            let mut hurt = whole.clone();
            hurt[at] ^= 0x01;
            std::fs::write(&path, &hurt).unwrap();
            // White space between two parts may become other white space; the value is then what it was.
            let read: Option<Record<f64>> = archive.read("abcd");
            assert!(read.is_none_or(|read| read.value == 0.1 + 0.2), "byte {at}");
            std::fs::write(&path, &whole[..at]).unwrap();
            assert_eq!(archive.read::<f64>("abcd"), None, "cut at {at}");
        }
    }

    #[test]
    fn a_record_elsewhere_than_its_address_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let archive = Archive::of(folder.path());
        let (one, other) = (keep(&archive, "abcd", 1.0), keep(&archive, "abef", 2.0));
        std::fs::copy(one, other).unwrap();
        assert_eq!(archive.read::<f64>("abef"), None);
    }

    #[test]
    fn archives_are_poured_together() {
        let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
        let [one, two] = folders.each_ref().map(|folder| Archive::of(folder.path()));
        keep(&one, "aa11", 1.0);
        let left = keep(&two, "aa22", 2.0).with_file_name(".writing-x");
        std::fs::write(left, b"half").unwrap();
        for _ in 0..2 {
            one.take_in(&two).unwrap();
        }
        assert_eq!(one.read("aa11"), Some(record("aa11", 1.0)));
        assert_eq!(one.read("aa22"), Some(record("aa22", 2.0)));
        let beside = one.record_path("aa22").with_file_name(".writing-x");
        assert!(!beside.exists());
    }
}
