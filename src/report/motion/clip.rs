//! An image in motion: its animation, its frames and its flicker map, as files and as the page holds them.

use serde::Serialize;

use super::animation::Codes;
use crate::experiment::results::{MethodInfo, Picture};
use crate::metric::flicker_map;
use crate::render::Film;
use crate::report::colour::magnitude;
use crate::report::figure::data_uri;
use crate::report::png;
use crate::report::viewer::Print;

/// A method's films, or the reference's.
pub struct Shown<'a> {
    /// The method's label, or `reference`.
    pub label: &'a str,
    /// What stands under it.
    pub remark: String,
    /// The method; `None` of the reference.
    pub method: Option<&'a MethodInfo>,
    /// Its films, in the order of time.
    pub films: Vec<&'a Film>,
}

/// How the images of a sequence are shown.
#[derive(Clone, Copy)]
pub struct Scales {
    /// Radiance shown as white.
    pub white: f64,
    /// Mean change from frame to frame shown in the last colour.
    pub flicker: f64,
    /// Frames a second.
    pub fps: u32,
}

/// An image in motion.
#[derive(Serialize)]
pub struct Clip {
    /// The method's label, or `reference`.
    pub label: String,
    /// What stands under it.
    pub remark: String,
    /// The animation's file, relative to the report.
    pub file: String,
    /// The animation as the page holds it; `None` if it does not.
    uri: Option<String>,
    /// The first frame, for those who want no motion.
    still: String,
    /// Its flicker map.
    map: String,
    /// The animation.
    #[serde(skip)]
    pub animation: Vec<u8>,
    /// Its frames, a PNG file each.
    #[serde(skip)]
    pub frames: Vec<Vec<u8>>,
}

impl Clip {
    /// The image of a sequence with this slug.
    pub fn of(shown: &Shown, slug: &str, scales: Scales) -> Self {
        let codes = Codes::of(&shown.films, scales.white);
        Self {
            label: shown.label.to_owned(),
            remark: shown.remark.clone(),
            file: format!("animations/{slug}/{}.png", shown.label),
            uri: None,
            still: data_uri(&codes.still(0)),
            map: data_uri(&png::exact(&shown.map(scales.flicker))),
            animation: codes.animated(scales.fps),
            frames: (0..shown.films.len()).map(|frame| codes.still(frame)).collect(),
        }
    }

    /// Puts the animation into the page if `room`, in bytes, holds it.
    pub fn embed(&mut self, room: &mut usize) {
        let uri = data_uri(&self.animation);
        if let Some(left) = room.checked_sub(uri.len()) {
            *room = left;
            self.uri = Some(uri);
        }
    }

    /// What stands for it where nothing moves: its first frame and its flicker map.
    pub fn prints(&self) -> Vec<Print> {
        let print = |what: &str, uri: &String| Print {
            alt: format!("{} of {}", what, self.label),
            uri: uri.clone(),
        };
        vec![print("first frame", &self.still), print("flicker map", &self.map)]
    }
}

impl Shown<'_> {
    /// Its flicker map in colour, `full` the change of the last colour.
    pub fn map(&self, full: f64) -> Picture {
        let map = flicker_map(&self.films).unwrap_or_else(|| self.films[0].clone());
        let rgb = map.pixels().iter().map(|change| magnitude(f64::from(*change) / full));
        Picture { width: map.width(), height: map.height(), rgb: rgb.collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn animations_go_into_the_page_as_far_as_room_lasts() {
        let films = [0.1, 0.2, 0.4].map(|v| Film::new(6, 4, vec![v; 24]));
        let films = films.iter().collect();
        let shown = Shown { label: "reference", remark: String::new(), method: None, films };
        let scales = Scales { white: 1.0, flicker: 0.1, fps: 12 };
        let mut clips = [(); 3].map(|()| Clip::of(&shown, "x", scales));
        let size = data_uri(&clips[0].animation).len();
        let mut room = 2 * size + 1;
        clips.iter_mut().for_each(|clip| clip.embed(&mut room));
        assert_eq!(clips.each_ref().map(|clip| clip.uri.is_some()), [true, true, false]);
        assert_eq!(room, 1);
        assert_eq!(clips[0].frames.len(), 3);
    }
}
