//! A scene's images as the page's viewer takes them: linear films that its script turns into pictures, error maps
//! and values; and what to begin with.

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
    /// Its linear radiance.
    pub film: &'a Film,
}

/// Images on one exposure and one scale of error.
pub struct Images<'a> {
    /// The images; all films are of one size.
    pub images: Vec<Image<'a>>,
    /// Which one the others are compared with.
    pub reference: usize,
    /// Which one improvements are measured against at first.
    pub against: usize,
    /// Which ones tell where insets lie.
    pub telling: Vec<usize>,
    /// Radiance shown as white.
    pub white: f64,
    /// Error shown in full colour.
    pub full: f64,
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
    /// The packed film.
    film: String,
}

/// What the script has to know of a scene.
#[derive(Serialize)]
struct Settings {
    width: usize,
    height: usize,
    /// What the packed radiances were multiplied by.
    scale: f32,
    white: f64,
    full: f64,
    reference: usize,
    against: usize,
    labels: Vec<String>,
    insets: Vec<Inset>,
}

impl Viewer {
    /// A viewer of these images. `None` if there are none, or one is of another size than the first.
    pub fn of(images: &Images) -> Option<Self> {
        let films: Vec<&Film> = images.images.iter().map(|image| image.film).collect();
        let first = films.first()?;
        let size = |film: &Film| (film.width(), film.height());
        if films.iter().any(|film| size(film) != size(first)) || first.pixels().is_empty() {
            return None;
        }
        let telling: Vec<&Film> =
            images.telling.iter().filter_map(|i| films.get(*i)).copied().collect();
        let scale = pack::scale(films.iter().copied());
        let settings = Settings {
            width: first.width(),
            height: first.height(),
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
            film: pack::pack(image.film, scale),
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
            film,
        };
        Images {
            images: films.iter().map(image).collect(),
            reference: 0,
            against: 1,
            telling: vec![0, 1],
            white: 1.0,
            full: 0.1,
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
}
