//! Images as the page's viewer takes them, of a scene that is still or moves: linear films that its script turns into
//! pictures, error maps and values; and what to begin with.

mod insets;
pub mod pack;
mod scene;

use rayon::prelude::*;
use serde::Serialize;

use crate::render::Film;
use insets::{Inset, insets};
pub use scene::viewer;

/// Magnified parts a scene.
const INSETS: usize = 2;

/// An image for a viewer.
pub struct Image<'a> {
    /// `reference`, the method's label, or what else it is called.
    pub label: String,
    /// What stands under it.
    pub remark: String,
    /// The lines of `metrics.csv` that the remark follows from, as `12 40`.
    pub lines: String,
    /// Its linear radiance, frame by frame; one film of what is still.
    pub films: Vec<&'a Film>,
    /// Pictures that stand in its place where no script runs, and in print.
    pub prints: Vec<Print>,
}

/// A picture for where the viewer cannot be.
#[derive(Clone, Serialize)]
pub struct Print {
    /// What it shows.
    pub alt: String,
    /// The picture, as a data URI.
    pub uri: String,
}

/// Images on one exposure and one scale of error.
pub struct Images<'a> {
    /// The images, with as many frames each; all films are of one size.
    pub images: Vec<Image<'a>>,
    /// Which one the others are compared with, if any.
    pub reference: Option<usize>,
    /// Which one improvements are measured against at first.
    pub against: usize,
    /// Which ones tell where insets lie.
    pub telling: Vec<usize>,
    /// Radiance shown as white.
    pub white: f64,
    /// Error shown in full colour.
    pub full: f64,
    /// How they move, if they do.
    pub motion: Option<Motion>,
}

/// How frames are shown.
#[derive(Clone, Copy, Serialize)]
pub struct Motion {
    /// Frames a second.
    pub fps: f64,
    /// Change from a frame to the next shown in full colour, of radiance.
    pub change: f64,
    /// Mean change shown in full colour, of radiance.
    pub flicker: f64,
}

/// A viewer, ready for the page.
#[derive(Serialize)]
pub struct Viewer {
    /// What the script has to know, as JSON without `<`.
    #[serde(serialize_with = "as_json")]
    settings: Settings,
    /// The images, in the order they are shown.
    shown: Vec<Shown>,
}

/// An image as the page holds it.
#[derive(Serialize)]
struct Shown {
    label: String,
    remark: String,
    lines: String,
    /// The packed films.
    film: String,
    prints: Vec<Print>,
}

/// What the script has to know of a scene.
#[derive(Serialize)]
struct Settings {
    width: usize,
    height: usize,
    frames: usize,
    motion: Option<Motion>,
    /// What the packed radiances were multiplied by.
    scale: f32,
    white: f64,
    full: f64,
    reference: Option<usize>,
    against: usize,
    labels: Vec<String>,
    insets: Vec<Inset>,
}

impl Viewer {
    /// A viewer of these images. `None` if there are none, one is of another size than the first, or has more frames
    /// or fewer.
    pub fn of(images: &Images) -> Option<Self> {
        let clips: Vec<&[&Film]> = images.images.iter().map(|image| &image.films[..]).collect();
        let first = *clips.first()?.first()?;
        let frames = clips[0].len();
        let size = |film: &Film| (film.width(), film.height());
        let mut films = clips.iter().copied().flatten();
        let alike = films.all(|film| size(film) == size(first));
        if !alike || first.pixels().is_empty() || clips.iter().any(|clip| clip.len() != frames) {
            return None;
        }
        let telling: Vec<&[&Film]> =
            images.telling.iter().filter_map(|i| clips.get(*i)).copied().collect();
        let scale = pack::scale(clips.iter().copied().flatten().copied());
        let settings = Settings {
            width: first.width(),
            height: first.height(),
            frames,
            motion: images.motion,
            scale,
            white: images.white,
            full: images.full,
            reference: images.reference,
            against: images.against,
            labels: images.images.iter().map(|image| image.label.clone()).collect(),
            insets: insets(&telling, images.white, INSETS),
        };
        let shown = images.images.par_iter().map(|image| Shown {
            label: image.label.clone(),
            remark: image.remark.clone(),
            lines: image.lines.clone(),
            film: pack::pack(&image.films, scale),
            prints: image.prints.clone(),
        });
        Some(Self { settings, shown: shown.collect() })
    }

    /// Bytes that its first `count` films take in the page.
    pub fn size(&self, count: usize) -> usize {
        self.shown.iter().take(count).map(|shown| shown.film.len()).sum()
    }

    /// How many images it has.
    pub fn len(&self) -> usize {
        self.shown.len()
    }

    /// What its images are called.
    #[cfg(test)]
    fn labels(&self) -> &[String] {
        &self.settings.labels
    }

    /// Keeps the first `count` images.
    pub fn shorten(&mut self, count: usize) {
        self.shown.truncate(count);
        self.settings.labels.truncate(count);
    }
}

fn as_json<S: serde::Serializer>(settings: &Settings, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(&json(settings))
}

/// A value for a script: JSON in which nothing can end the element that holds it.
pub fn json(value: &impl Serialize) -> String {
    let text = serde_json::to_string(value).expect("numbers and strings are always JSON");
    text.replace('<', "\\u003c")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn images<'a>(films: &'a [Film]) -> Images<'a> {
        let image = |film: &'a Film| Image {
            label: "</script>".into(),
            remark: String::new(),
            lines: String::new(),
            films: vec![film],
            prints: Vec::new(),
        };
        Images {
            images: films.iter().map(image).collect(),
            reference: Some(0),
            against: 1,
            telling: vec![0, 1],
            white: 1.0,
            full: 0.1,
            motion: None,
        }
    }

    #[test]
    fn what_the_script_reads_cannot_end_its_element() {
        let films = [0.1, 0.2].map(|v| Film::new(8, 8, vec![v; 64]));
        let viewer = Viewer::of(&images(&films)).unwrap();
        let settings = json(&viewer.settings);
        assert!(!settings.contains('<'));
        let read: serde_json::Value = serde_json::from_str(&settings).unwrap();
        assert_eq!(read["labels"][1], "</script>");
        assert_eq!(read["insets"].as_array().unwrap().len(), 1);
    }

    #[test]
    fn images_of_different_sizes_are_not_laid_over_each_other() {
        let films = [Film::new(2, 2, vec![0.0; 4]), Film::new(3, 2, vec![0.0; 6])];
        assert!(Viewer::of(&images(&films)).is_none());
        assert!(Viewer::of(&images(&[])).is_none());
    }

    #[test]
    fn what_moves_has_its_frames_and_all_images_have_as_many() {
        let films = [0.1, 0.2].map(|v| Film::new(8, 8, vec![v; 64]));
        let mut images = images(&films);
        images.motion = Some(Motion { fps: 12.0, change: 0.5, flicker: 0.25 });
        images.images.iter_mut().for_each(|image| image.films.push(&films[0]));
        let settings = json(&Viewer::of(&images).unwrap().settings);
        let read: serde_json::Value = serde_json::from_str(&settings).unwrap();
        assert_eq!(read["frames"], 2);
        assert_eq!(read["motion"]["change"], 0.5);
        images.images[1].films.pop();
        assert!(Viewer::of(&images).is_none());
    }
}
