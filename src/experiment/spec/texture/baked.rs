//! Textures baked from a distribution of normals (Kautz et al. 2001), or laid onto a map as detail.

use super::{DEFAULT_SIDE, MAX_SIDE, TextureSource, folder, read_path, read_reading};
use crate::experiment::spec::item::Item;
use crate::experiment::spec::limits::Limits;
use crate::experiment::spec::reader::Reader;
use crate::lobe::Measure;
use crate::pattern::baked::{Ground, MapFile, NdfSource, Recipe};
use crate::texture::Wrap;

/// The keys that say what bumps are baked from.
pub(super) struct Words<'a> {
    ndf: Option<Item<'a>>,
    like: Option<Item<'a>>,
    onto: Option<Item<'a>>,
}

impl<'a> Words<'a> {
    /// Those of a table.
    pub fn of(reader: &Reader<'a>) -> Self {
        let [ndf, like, onto] = ["ndf", "like", "onto"].map(|key| reader.item(key));
        Self { ndf, like, onto }
    }

    /// Whether there is any.
    pub fn any(&self) -> bool {
        self.ndf.is_some() || self.like.is_some() || self.onto.is_some()
    }

    /// Reads the rest of the table. `None` if it does not say what is baked; that is logged.
    pub fn read(&self, reader: &Reader<'a>, seed: u64, wrap: Wrap) -> Option<TextureSource> {
        let maps = Maps::of(self, reader, wrap);
        let mut written = vec![];
        let ndf = self.source(reader, &maps, &mut written);
        let ground = match &self.onto {
            Some(onto) => self.onto(reader, &maps, (onto, ndf), &mut written),
            None => {
                let side = |key| reader.whole(key, DEFAULT_SIDE as u64, 1, MAX_SIDE) as usize;
                let size = [side("width"), side("height")];
                ndf.flatten().map(|ndf| Ground::Bare { ndf, size })
            }
        };
        let cells = reader.item("cells").and_then(|cells| cells.whole(1, 65536));
        let octaves = reader.whole("octaves", 0, 0, 24) as u32;
        let gain = reader.real("gain", 0.5, Limits::from_to(0.05, 0.95));
        let seed = reader.whole("seed", seed, 0, i64::MAX as u64);
        written.extend(cells.map(|cells| format!("cells = {cells}")));
        written.push(format!("octaves = {octaves}, gain = {gain}; seed {seed}"));
        let written = format!("baked ({})", written.join(", "));
        let cells = cells.map(|cells| cells as u32);
        let octaves = Some(octaves).filter(|octaves| *octaves > 0);
        let recipe = Recipe { ground: ground?, cells, octaves, gain, seed };
        Some(TextureSource::Baked { recipe, written })
    }

    /// The distribution: none that was told, or `None` if what was told is wrong.
    fn source(
        &self,
        reader: &Reader,
        maps: &Maps,
        written: &mut Vec<String>,
    ) -> Option<Option<NdfSource>> {
        match (&self.ndf, &self.like) {
            (Some(ndf), None) => {
                let measures = [("map", Measure::Map), ("solid-angle", Measure::SolidAngle)];
                let measure = reader.choice("measure", &measures);
                let text = ndf.text()?;
                let by_angle = if measure == Measure::SolidAngle { ", by solid angle" } else { "" };
                written.push(format!("ndf = {text:?}{by_angle}"));
                match NdfSource::parse(text, &folder(reader), measure) {
                    Ok(source) => Some(Some(source)),
                    Err(message) => {
                        ndf.error(format!("`ndf`: {message}"), None);
                        None
                    }
                }
            }
            (None, Some(like)) => {
                maps.file(reader, "like", like, written).map(NdfSource::Map).map(Some)
            }
            (Some(_), Some(like)) => {
                let message = format!("{} has both `ndf` and `like`", reader.name());
                like.error(message, Some("keep one of them".to_owned()));
                reader.forgive();
                None
            }
            (None, None) => Some(None),
        }
    }

    fn onto(
        &self,
        reader: &Reader,
        maps: &Maps,
        (onto, ndf): (&Item, Option<Option<NdfSource>>),
        written: &mut Vec<String>,
    ) -> Option<Ground> {
        let map = maps.file(reader, "onto", onto, written);
        let amount = reader.real("amount", 0.5, Limits::from_to(0.0, 8.0));
        let floor = reader.real("floor", 0.02, Limits::from_to(0.0, 0.99));
        written.push(format!("amount = {amount}, floor = {floor}"));
        let [width, height] = ["width", "height"].map(|key| reader.item(key));
        let size = match (&width, &height) {
            (None, None) => None,
            (Some(width), Some(height)) => {
                let side = |item: &Item| item.whole(1, MAX_SIDE).map(|side| side as usize);
                let (width, height) = (side(width), side(height));
                Some([width?, height?])
            }
            (Some(only), None) | (None, Some(only)) => {
                let help = "the map's own are taken if neither is given".to_owned();
                only.error("`width` and `height` go together".to_owned(), Some(help));
                None
            }
        };
        Some(Ground::Onto { map: map?, ndf: ndf?, amount, floor, size })
    }
}

/// How maps of a table are read.
struct Maps {
    reading: Option<super::Reading>,
    wrap: Wrap,
}

impl Maps {
    /// The keys of that are read once, and only where there is a map.
    fn of(words: &Words, reader: &Reader, wrap: Wrap) -> Self {
        let any = words.like.is_some() || words.onto.is_some();
        Self { reading: any.then(|| read_reading(reader)), wrap }
    }

    fn file(
        &self,
        reader: &Reader,
        key: &str,
        item: &Item,
        written: &mut Vec<String>,
    ) -> Option<MapFile> {
        let (path, as_written) = read_path(reader, item)?;
        let reading = self.reading.as_ref()?;
        written.push(format!("{key} = {as_written:?}, {reading:?}"));
        Some(MapFile { path, reading: reading.of(self.wrap) })
    }
}
