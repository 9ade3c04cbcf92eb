//! What the lab looks at: the spec of one scene, as TOML that keys edit.
//!
//! A setup is an experiment's spec all the time. So every change is checked by the reader of specs, what it refuses
//! is told in its words, and a scene worth measuring can be written as an experiment.

use std::path::Path;

use toml::{Table, Value};

use crate::experiment::spec::draft::absolute;
use crate::experiment::spec::{Draft, Scale, Spec, SpecErrors};
use crate::method;
use crate::pattern;
use crate::texture::Lookup;

/// The spec of one scene and what it can be changed to.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// What was opened: an experiment's name, or a map's file.
    pub name: String,
    /// The spec.
    pub(super) draft: Draft,
    /// The textures there are to choose from.
    pub(super) textures: Vec<String>,
    /// The lookup of methods that have it.
    pub lookup: Lookup,
    /// Samples a pixel of every method.
    pub spp: u32,
}

/// Methods in the order of the number keys: first the nine of the papers and of today's engines, as they are meant.
const FIRST: [&str; 9] = [
    "unfiltered",
    "averaged",
    "fournier",
    "schilling-isotropic",
    "schilling-anisotropic",
    "olano-north",
    "kautz",
    "toksvig",
    "lean",
];

/// The size of the lab's images, unless an experiment's are larger.
const SIZE: [i64; 2] = [320, 240];
/// Texels a pixel where a spec does not say.
const TEXELS: f64 = 4.0;
/// Samples of the reference that a saved experiment asks for.
const REFERENCE: i64 = 4096;

impl Setup {
    /// The first scene of an experiment.
    ///
    /// # Errors
    /// A sentence, if something is wrong with it.
    pub fn of_draft(name: &str, mut draft: Draft) -> Result<Self, String> {
        let spec = draft.read().map_err(|errors| first(&errors))?;
        draft.table.remove("motion");
        let mut setup = Self {
            name: name.to_owned(),
            textures: textures(&spec, &draft.table),
            draft,
            lookup: Lookup::default(),
            spp: 1,
        };
        setup.single(&spec);
        setup.spec()?;
        Ok(setup)
    }

    /// An image file that holds a normal map, on the default scene.
    ///
    /// # Errors
    /// A sentence, if there is no such file.
    pub fn of_map(file: &Path) -> Result<Self, String> {
        let written = absolute(file)?;
        let stem = file.file_stem().unwrap_or_default().to_string_lossy();
        let safe =
            |c: char| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
        let texture: String = stem.chars().map(safe).collect();
        let texture = if texture.is_empty() { "map".to_owned() } else { texture };
        let mut map = Table::new();
        map.insert("file".into(), written.into());
        map.insert("kind".into(), "normal".into());
        map.insert("green".into(), "up".into());
        let mut draft = Draft::of_texture(&texture, map, Path::new("lab.toml"));
        draft.table.insert("title".into(), format!("{stem} in the lab").into());
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        Self::of_draft(&name, draft)
    }

    /// Takes everything there are several of down to the first, and adds every method.
    fn single(&mut self, spec: &Spec) {
        let sweep = &spec.sweep;
        let lobe = sweep.lobes[0];
        let width = if lobe.name() == "blinn-phong" { "exponent" } else { "alpha" };
        let material = self.draft.section("material");
        ["exponent", "alpha"].iter().for_each(|key| drop(material.remove(*key)));
        material.insert("lobe".into(), lobe.name().into());
        material.insert(width.into(), lobe.parameter().into());
        self.draft.set("camera", "elevation", sweep.elevations[0]);
        let texels = match &sweep.scale {
            Scale::TexelsPerPixel(list) => list[0],
            Scale::Distance { .. } => TEXELS,
        };
        self.draft.section("surface").remove("tiles");
        let image = [("width", spec.image.width), ("height", spec.image.height)];
        if image[0].1 < SIZE[0] as usize {
            image.iter().zip(SIZE).for_each(|((key, _), side)| self.draft.set("image", key, side));
        }
        let methods = methods(spec, &self.draft.table);
        let mut single = Table::new();
        single.insert("texture".into(), list([sweep.textures[0].name.as_str()]));
        single.insert("method".into(), list(methods.iter().map(String::as_str)));
        single.insert("texels_per_pixel".into(), list([texels]));
        self.draft.table.insert("sweep".into(), single.into());
        let reference = self.draft.section("reference");
        if reference.get("spp").and_then(Value::as_integer).unwrap_or(0) < REFERENCE {
            reference.insert("spp".into(), REFERENCE.into());
        }
    }

    /// The spec as it stands.
    ///
    /// # Errors
    /// What is wrong with it, a sentence.
    pub fn spec(&self) -> Result<Spec, String> {
        let mut spec = self.draft.read().map_err(|e| first(&e))?;
        for method in &mut spec.sweep.methods {
            if method.build().lookups().contains(&self.lookup) {
                method.lookup = self.lookup;
            }
        }
        Ok(spec)
    }

    /// The experiment that measures this scene, as TOML.
    pub fn experiment(&self) -> String {
        let mut setup = self.clone();
        let spec = self.spec();
        for method in spec.iter().flat_map(|spec| &spec.sweep.methods) {
            if method.lookup == Lookup::default() {
                continue;
            }
            let table = setup.draft.section("method").entry(&method.label).or_insert_with(|| {
                Value::Table(Table::from_iter([("use".to_owned(), method.name.into())]))
            });
            if let Value::Table(table) = table {
                table.insert("lookup".into(), method.lookup.name().into());
            }
        }
        setup.draft.table.to_string()
    }

    /// The name of its texture.
    pub fn texture(&self) -> &str {
        let list = self.draft.table.get("sweep").and_then(|sweep| sweep.get("texture"));
        list.and_then(|list| list.get(0)).and_then(Value::as_str).unwrap_or("")
    }

    /// The table of its texture, if that is no plain pattern.
    pub(super) fn texture_table(&mut self) -> Option<&mut Table> {
        let name = self.texture().to_owned();
        self.draft.table.get_mut("texture")?.get_mut(&name)?.as_table_mut()
    }
}

fn list<V: Into<Value>>(values: impl IntoIterator<Item = V>) -> Value {
    Value::Array(values.into_iter().map(Into::into).collect())
}

/// The spec's textures, the tables it does not use, then every pattern.
fn textures(spec: &Spec, table: &Table) -> Vec<String> {
    let mut names: Vec<String> = spec.sweep.textures.iter().map(|t| t.name.clone()).collect();
    let tables = table.get("texture").and_then(Value::as_table);
    let tables = tables.into_iter().flat_map(|tables| tables.keys().cloned());
    let patterns = pattern::entries().into_iter().map(|entry| entry.card.name.to_owned());
    for name in tables.chain(patterns) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// Every registered method that takes the spec's surface and light, and the spec's own under other labels.
fn methods(spec: &Spec, table: &Table) -> Vec<String> {
    let bent = spec.surface.perturbation != crate::surface::Perturbation::Tangent;
    let takes = |name: &str| method::build(name).is_some_and(|method| !bent || method.bends());
    let mut names: Vec<String> =
        FIRST.into_iter().filter(|name| takes(name)).map(str::to_owned).collect();
    let registered = method::entries().into_iter().map(|entry| entry.card.name.to_owned());
    // Labels that a list of lookups made are no names: the lab has a lookup of its own.
    let tables = table.get("method").and_then(Value::as_table);
    let told = |label: &str| tables.is_some_and(|tables| tables.contains_key(label));
    let own = spec.sweep.methods.iter().map(|method| method.label.clone()).filter(|l| told(l));
    for name in registered.filter(|name| takes(name)).chain(own) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// The first thing that is wrong, without its place: the text is the lab's own.
fn first(errors: &SpecErrors) -> String {
    match errors {
        SpecErrors::Invalid(all) => all.first().map_or_else(String::new, |e| e.message.clone()),
        other => other.to_string(),
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::experiment::spec::Experiment;

    const SWEEP: &str = r#"
        title = "Two of everything"
        [material]
        lobe = "ggx"
        [motion]
        kind = "light"
        frames = 3
        [sweep]
        texture = ["twill", "mine"]
        method = ["rescaled", "unfiltered"]
        lobe = [{ lobe = "beckmann", alpha = 0.3 }, { lobe = "ggx", alpha = 0.1 }]
        elevation = [20.0, 70.0]
        texels_per_pixel = [8.0, 2.0]
        [texture.mine]
        pattern = "waves"
        [method.rescaled]
        use = "fournier"
        energy = "rescaled"
    "#;

    pub fn setup() -> Setup {
        Setup::of_draft("two", Draft::of_text(SWEEP, None, Path::new("two.toml")).unwrap()).unwrap()
    }

    #[test]
    fn a_sweep_comes_down_to_its_first_scene() {
        let spec = setup().spec().unwrap();
        let names: Vec<&str> = spec.sweep.textures.iter().map(|t| t.name.as_str()).collect();
        assert_eq!(names, ["twill"]);
        assert_eq!(spec.sweep.lobes.len(), 1);
        assert_eq!(
            (spec.sweep.lobes[0].name(), spec.sweep.lobes[0].parameter()),
            ("beckmann", 0.3)
        );
        assert_eq!(spec.sweep.elevations, [20.0]);
        assert_eq!(spec.sweep.scale, Scale::TexelsPerPixel(vec![8.0]));
        assert_eq!(spec.motion, None);
        assert_eq!((spec.image.width, spec.image.height), (320, 240));
    }

    #[test]
    fn every_method_is_there_and_the_papers_first() {
        let spec = setup().spec().unwrap();
        let labels: Vec<&str> = spec.sweep.methods.iter().map(|m| m.label.as_str()).collect();
        assert_eq!(labels[..9], FIRST);
        assert!(labels.contains(&"rescaled"));
        for entry in method::entries() {
            assert!(labels.contains(&entry.card.name), "{}", entry.card.name);
        }
    }

    #[test]
    fn textures_to_choose_from_begin_with_the_experiments() {
        let textures = setup().textures;
        assert_eq!(textures[..2], ["twill", "mine"]);
        assert!(textures.contains(&"hemispheres".to_owned()));
    }

    #[test]
    fn what_is_saved_is_an_experiment_with_the_lookup() {
        let setup = Setup { lookup: Lookup::Ewa, ..setup() };
        let text = setup.experiment();
        let spec = Spec::parse(&text, Path::new("saved.toml")).unwrap();
        for method in &spec.sweep.methods {
            let takes = method.build().lookups().contains(&Lookup::Ewa);
            assert_eq!(method.lookup == Lookup::Ewa, takes, "{}", method.label);
        }
    }

    #[test]
    fn a_map_is_on_the_default_scene() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("my map.png");
        image::RgbImage::from_pixel(4, 4, image::Rgb([128, 128, 255])).save(&file).unwrap();
        let setup = Setup::of_map(&file).unwrap();
        assert_eq!((setup.name.as_str(), setup.texture()), ("my map.png", "my-map"));
        let error = Setup::of_map(&folder.path().join("gone.png")).unwrap_err();
        assert!(error.contains("there is no file") && error.contains("gone.png"), "{error}");
    }

    /// Every experiment of the project's opens, every part of a paper's too.
    #[test]
    fn every_sweep_can_be_opened() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments");
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let text = std::fs::read_to_string(&path).unwrap();
            let parts: Vec<Option<String>> = match crate::job::load(path.to_str().unwrap()).unwrap()
            {
                Experiment::Sweep(_) => vec![None],
                Experiment::Paper(paper) => {
                    paper.parts.iter().map(|part| Some(part.name.clone())).collect()
                }
            };
            for part in parts {
                let draft = Draft::of_text(&text, part.as_deref(), &path).unwrap();
                let setup = Setup::of_draft("x", draft);
                assert!(setup.is_ok(), "{} {part:?}: {setup:?}", path.display());
            }
        }
    }
}
