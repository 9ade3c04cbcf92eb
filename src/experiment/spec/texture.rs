//! Textures: a pattern of the program's, an image file, or bumps baked from a distribution.

mod baked;

use std::path::PathBuf;

use super::catalogue::Catalogue;
use super::item::Item;
use super::limits::Limits;
use super::reader::Reader;
use super::values::read_values;
use crate::parameter::Values;
use crate::pattern;
use crate::pattern::baked::Recipe;
use crate::texture::image_file::{Green, HeightReading, NormalReading, Zero};
use crate::texture::{Interpolation, Wrap};

/// A texture of the sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureSpec {
    /// Its name in this experiment: letters, digits, `-` and `_`.
    pub name: String,
    /// Where its bumps come from.
    pub source: TextureSource,
    /// What lies beyond its edge.
    pub wrap: Wrap,
    /// How normals between texel centres are found.
    pub interpolation: Interpolation,
    /// How many times it stands along each side of a tile.
    pub repeat: usize,
}

/// Where bumps come from.
#[derive(Clone, Debug, PartialEq)]
pub enum TextureSource {
    /// A pattern the program computes.
    Pattern {
        /// The pattern's name in [`crate::pattern::entries`].
        name: &'static str,
        /// Texels along u.
        width: usize,
        /// Texels along v.
        height: usize,
        /// Its options.
        values: Values,
        /// Seed of its random choices, if it makes any.
        seed: u64,
    },
    /// An image file.
    File {
        /// Where it is: the spec's folder joined with `written`.
        path: PathBuf,
        /// Its path as the spec has it.
        written: String,
        /// What its pixels mean.
        reading: Reading,
    },
    /// Bumps baked from a distribution of normals.
    Baked {
        /// What is to be baked.
        recipe: Recipe,
        /// What it is made of, with paths as the spec has them.
        written: String,
    },
}

/// What an image file's pixels mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// Normals: red is x, green is y, blue is z.
    Normal {
        /// Which way green is positive.
        green: Green,
        /// The code of a zero coordinate.
        zero: Zero,
    },
    /// Heights: black is 0, white is `scale`.
    Height {
        /// Height of white, in sides of a texel; negative turns bumps into dents.
        scale: f64,
    },
}

impl Reading {
    /// The same for a reader of files; `wrap` is what lies beyond the edge.
    pub fn of(&self, wrap: Wrap) -> pattern::file::Reading {
        match *self {
            Self::Normal { green, zero } => {
                pattern::file::Reading::Normals(NormalReading { green, zero, wrap })
            }
            Self::Height { scale } => {
                pattern::file::Reading::Heights(HeightReading { height_scale: scale, wrap })
            }
        }
    }
}

/// Texels along a side of a pattern.
const MAX_SIDE: u64 = 4096;
const DEFAULT_SIDE: usize = 128;
/// Times a texture stands along a side of a tile.
const MAX_REPEAT: u64 = 64;
/// Texels along a side of a tile that a texture is repeated in.
pub const MAX_REPEATED: usize = 8192;

impl TextureSpec {
    /// A pattern with its defaults, named after it.
    pub(super) fn plain(catalogue: &Catalogue, pattern: &str, seed: u64) -> Option<Self> {
        let entry = catalogue.pattern(pattern)?;
        let source = TextureSource::Pattern {
            name: entry.card.name,
            width: DEFAULT_SIDE,
            height: DEFAULT_SIDE,
            values: Values::defaults(entry.parameters),
            seed,
        };
        let (wrap, interpolation) = (Wrap::default(), Interpolation::default());
        Some(Self { name: pattern.to_owned(), source, wrap, interpolation, repeat: 1 })
    }

    /// Reads a `[texture.NAME]` table. `None` if it does not say what it is; that is logged.
    pub(super) fn read(
        name: &str,
        reader: &Reader,
        catalogue: &Catalogue,
        seed: u64,
    ) -> Option<Self> {
        let wraps = [("repeat", Wrap::Repeat), ("clamp", Wrap::Clamp)];
        let wrap = reader.choice("wrap", &wraps);
        let source = read_source(reader, catalogue, seed, wrap);
        let interpolation = reader.choice("interpolation", &Interpolation::ALL);
        let repeat = reader.whole("repeat", 1, 1, MAX_REPEAT) as usize;
        Some(Self { name: name.to_owned(), source: source?, wrap, interpolation, repeat })
    }
}

fn read_source(
    reader: &Reader,
    catalogue: &Catalogue,
    seed: u64,
    wrap: Wrap,
) -> Option<TextureSource> {
    let baked = baked::Words::of(reader);
    let (pattern, file) = (reader.item("pattern"), reader.item("file"));
    match (pattern, file) {
        (None, None) if baked.any() => baked.read(reader, seed, wrap),
        (Some(other), _) | (_, Some(other)) if baked.any() => {
            let message = format!("{} has both bumps and what to bake them from", reader.name());
            let help = "keep `pattern`, `file`, or those of `ndf`, `like` and `onto`".to_owned();
            other.error(message, Some(help));
            reader.forgive();
            None
        }
        (Some(pattern), None) => {
            let entry = pattern.text().and_then(|name| catalogue.need_pattern(name, &pattern));
            if entry.is_none() {
                reader.forgive();
            }
            let entry = entry?;
            let side = |key| reader.whole(key, DEFAULT_SIDE as u64, 1, MAX_SIDE) as usize;
            Some(TextureSource::Pattern {
                name: entry.card.name,
                width: side("width"),
                height: side("height"),
                seed: reader.whole("seed", seed, 0, i64::MAX as u64),
                values: read_values(reader, entry.parameters),
            })
        }
        (None, Some(file)) => {
            let found = read_path(reader, &file);
            let reading = read_reading(reader);
            let (path, written) = found?;
            Some(TextureSource::File { path, written, reading })
        }
        (Some(_), Some(file)) => {
            let message = format!("{} has both `pattern` and `file`", reader.name());
            file.error(message, Some("keep one of them".to_owned()));
            reader.forgive();
            None
        }
        (None, None) => {
            let message = format!(
                "{} needs the key `pattern`, `file`, `ndf`, `like` or `onto`",
                reader.name()
            );
            reader.error(message, None);
            reader.forgive();
            None
        }
    }
}

/// The file that a value names, and its path as written.
fn read_path(reader: &Reader, item: &Item) -> Option<(PathBuf, String)> {
    let written = item.text()?;
    let path = folder(reader).join(written);
    if !path.is_file() {
        let help = "paths are relative to the folder of this file".to_owned();
        item.error(format!("there is no file {}", path.display()), Some(help));
    }
    Some((path, written.to_owned()))
}

/// The folder that paths in the spec start from.
pub(super) fn folder(reader: &Reader) -> PathBuf {
    reader.log().path().parent().map(PathBuf::from).unwrap_or_default()
}

fn read_reading(reader: &Reader) -> Reading {
    if reader.choice("kind", &[("normal", false), ("height", true)]) {
        let scale = reader.real("height_scale", 1.0, Limits::from_to(-1e4, 1e4));
        Reading::Height { scale }
    } else {
        let green = reader.choice("green", &[("up", Green::Up), ("down", Green::Down)]);
        let zero = reader.choice("zero", &[("half", Zero::Middle), ("128", Zero::Above)]);
        Reading::Normal { green, zero }
    }
}
