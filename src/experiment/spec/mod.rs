//! The spec of an experiment: a TOML file that says what to render and compare.
//!
//! [`Spec::load`] reads and checks all of it before anything is built. It collects everything that is
//! wrong, each with its place in the file, what would be right, and the nearest name to a misspelt
//! one. `docs/experiments.md` is the manual of the format.

mod budget;
mod catalogue;
pub mod draft;
mod error;
mod item;
mod light;
mod limits;
mod log;
mod material;
mod method;
mod motion;
mod paper;
#[cfg(test)]
mod paper_tests;
mod reader;
mod reference;
mod scene;
mod suggest;
mod surface;
mod sweep;
mod texture;
mod values;

#[cfg(test)]
mod tests;

use std::path::Path;

use toml::Spanned;
use toml::de::DeTable;

pub use budget::BudgetSpec;
pub use draft::{Draft, Setting};
pub use error::{SpecError, SpecErrors};
pub use light::{EnvironmentSource, LightSpec};
pub use method::MethodSpec;
pub use motion::{MotionKind, MotionSpec, Pose};
pub use paper::{Experiment, PaperKeys, PaperSpec, RowKeys, RowSpec};
pub use reference::ReferenceSpec;
pub use scene::{CameraSpec, ImageSpec};
pub(crate) use suggest::no_such;
pub use surface::{AxesSpec, ModelSpec, Shape, SurfaceSpec, WavySphereSpec};
pub use sweep::{Scale, SweepSpec};
pub use texture::{MAX_REPEATED, Reading, TextureSource, TextureSpec};

use crate::lobe::Shading;
use crate::method::Truth;
use crate::surface::Perturbation;
use budget::Surroundings;
use catalogue::Catalogue;
use log::Log;
use material::Material;
use reader::Reader;
use suggest::all_of;
use sweep::Context;

/// An experiment: what to render, and what to hold it to. Every value is checked and every default
/// filled in.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    /// Its name: the file's stem.
    pub name: String,
    /// Its title, a line; the name if the file has none.
    pub title: String,
    /// The question it answers; may be empty.
    pub question: String,
    /// The seed of every random choice.
    pub seed: u64,
    /// The size of every image.
    pub image: ImageSpec,
    /// The surface.
    pub surface: SurfaceSpec,
    /// The camera.
    pub camera: CameraSpec,
    /// The light.
    pub light: LightSpec,
    /// What a lobe's density means for the light that leaves the surface.
    pub shading: Shading,
    /// The reference.
    pub reference: ReferenceSpec,
    /// How every scene moves; None if all is still.
    pub motion: Option<MotionSpec>,
    /// What is combined with what.
    pub sweep: SweepSpec,
    /// Which errors are shared out among the parts of their methods; None if none are.
    pub budget: Option<BudgetSpec>,
    /// The file as written.
    pub text: String,
}

impl Spec {
    /// Whether something in it looks at the heights of textures: its truth, or a method.
    pub fn needs_heights(&self) -> bool {
        self.reference.truth != Truth::Bumps
            || self.sweep.methods.iter().any(|method| method.build().needs_heights())
    }

    /// Reads the experiment in a file.
    ///
    /// # Errors
    /// [`SpecErrors::Unreadable`], or all that is wrong with it.
    pub fn load(path: &Path) -> Result<Self, SpecErrors> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| SpecErrors::Unreadable { path: path.to_owned(), source })?;
        Self::parse(&text, path)
    }

    /// Reads an experiment from `text`, which came from the file `path`. Image files it names are
    /// looked for, from the path's folder, but not opened.
    ///
    /// # Errors
    /// All that is wrong with it.
    pub fn parse(text: &str, path: &Path) -> Result<Self, SpecErrors> {
        Self::parse_with(&Catalogue::all(), &Log::new(path, text), text)
    }

    /// Reads an experiment that may name what the catalogue holds.
    fn parse_with(catalogue: &Catalogue, log: &Log, text: &str) -> Result<Self, SpecErrors> {
        let document = Self::document(log, text)?;
        let title = ("the experiment".to_owned(), "The experiment");
        let spec = Reader::read(log, title, log.end(), Some(document.get_ref()), |root| {
            let name = log.path().file_stem().unwrap_or_default().to_string_lossy();
            read_spec(root, catalogue, &name, text)
        });
        log.check()?;
        Ok(spec)
    }

    /// The tables of a text. What is no TOML is all that is said of such a file: what could not be
    /// parsed would seem to be missing.
    fn document<'t>(log: &Log, text: &'t str) -> Result<Spanned<DeTable<'t>>, SpecErrors> {
        let (document, syntax_errors) = DeTable::parse_recoverable(text);
        for error in &syntax_errors {
            let span = error.span().unwrap_or_else(|| log.end());
            log.error(span, format!("not TOML: {}", error.message()), None);
        }
        log.check()?;
        Ok(document)
    }
}

/// Logs that the value of a key does not go with an environment.
fn refuse(reader: &Reader, key: &'static str, message: &str) {
    if let Some(item) = reader.item(key) {
        item.error(message.to_owned(), Some("choose another value, or another light".to_owned()));
    }
}

/// Logs methods, and a truth, that take slopes only as they are in the map.
fn check_bends(root: &Reader, sweep: &SweepSpec, truth: Truth) {
    let unable = sweep.methods.iter().filter(|method| !method.build().bends());
    let labels: Vec<String> = unable.map(|method| format!("\"{}\"", method.label)).collect();
    if !labels.is_empty() {
        let message = format!(
            "{} cannot be used with this `perturbation`: what they spread of the map's slopes would have to be \
             carried along at every point",
            all_of(&labels)
        );
        let help = "methods that shade single normals can: \"unfiltered\" (without shadowing), \"averaged\"";
        root.error(message, Some(help.to_owned()));
    }
    if truth != Truth::Bumps {
        let message = format!("the truth \"{}\" takes slopes as they are in the map", truth.name());
        root.error(message, Some("use \"bumps\" with this `perturbation`".to_owned()));
    }
}

/// Reads everything; the spec means something only if nothing was logged.
fn read_spec(root: &Reader, catalogue: &Catalogue, name: &str, text: &str) -> Spec {
    let name = name.to_owned();
    let text_at = |key| root.item(key).and_then(|item| item.text()).map(str::to_owned);
    let title = text_at("title").unwrap_or_else(|| name.clone());
    let question = text_at("question").unwrap_or_default();
    let seed = root.whole("seed", 1, 0, i64::MAX as u64);
    let image = root.section("image", "[image]", ImageSpec::read);
    let (surface, tiles) = root.section("surface", "[surface]", SurfaceSpec::read);
    let shape = surface.shape;
    let camera = root.section("camera", "[camera]", |r| CameraSpec::read(r, shape));
    let light = root.section("light", "[light]", |r| LightSpec::read(r, shape));
    let everywhere = light.is_environment();
    let material = root.section("material", "[material]", |r| {
        let material = Material::read(r);
        if everywhere && material.shading != Shading::Ndf {
            refuse(r, "shading", "facets mirror an environment with shading \"ndf\" only");
        }
        material
    });
    let reference = root.section("reference", "[reference]", |r| {
        let reference = ReferenceSpec::read(r);
        if everywhere && reference.truth != Truth::Bumps {
            refuse(r, "truth", "under an environment the truth is \"bumps\" only: what heights hide of it is not known");
        }
        reference
    });
    let textures = root.each_table("texture", "[texture.NAME]", |name, reader| {
        (name, TextureSpec::read(name, reader, catalogue, seed))
    });
    let methods = root.each_table("method", "[method.LABEL]", |label, reader| {
        let method = MethodSpec::read(label, reader, catalogue);
        if everywhere && method.as_ref().is_some_and(|method| method.build().needs_heights()) {
            let message =
                format!("{} looks for shadows, which an environment does not cast", reader.name());
            reader.error(
                message,
                Some("leave out its shadowing, or choose another light".to_owned()),
            );
        }
        (label, method)
    });
    let moves = root.item("motion").is_some();
    let motion =
        moves.then(|| root.section("motion", "[motion]", |r| MotionSpec::read(r, &camera, shape)));
    let context = Context {
        catalogue,
        textures,
        methods,
        shape,
        elevation: camera.elevation,
        tiles,
        material,
        reference,
        motion,
        seed,
    };
    let sweep = root.section("sweep", "[sweep]", |r| SweepSpec::read(r, &context));
    if surface.perturbation != Perturbation::Tangent {
        check_bends(root, &sweep, reference.truth);
    }
    let around = Surroundings {
        sweep: &sweep,
        shading: material.shading,
        environment: everywhere,
        moves: motion.is_some(),
    };
    let wanted = root.item("budget").is_some();
    let budget =
        wanted.then(|| root.section("budget", "[budget]", |r| BudgetSpec::read(r, &around)));
    Spec {
        name,
        title,
        question,
        seed,
        image,
        surface,
        camera,
        light,
        shading: material.shading,
        reference,
        motion,
        sweep,
        budget,
        text: text.to_owned(),
    }
}
