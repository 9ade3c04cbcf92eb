//! A spec that is still being written: TOML tables that options, words and keys change before it is read.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use toml::{Table, Value};

use super::paper::OWN;
use super::{Spec, SpecErrors};

/// The tables of a spec that is not read yet. What is wrong with them is told by the reader of specs, in its words.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {
    /// The spec, as TOML.
    pub table: Table,
    /// The file that paths in it are relative to, and whose stem is its name.
    pub path: PathBuf,
}

/// A setting of a spec in words: `KEY=VALUE`, the key with a dot between table and key, the value as in TOML, where
/// words need no quotes.
///
/// `camera.elevation=25`, `surface.shape=teapot` and `surface.main=[0,1,0]` are settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// As it was written.
    words: String,
    keys: Vec<String>,
    value: Value,
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(words: &str) -> Result<Self, String> {
        let example = "write KEY=VALUE, such as camera.elevation=25";
        let (key, value) = words.split_once('=').ok_or(example)?;
        let keys: Vec<String> = key.split('.').map(|key| key.trim().to_owned()).collect();
        if keys.iter().any(String::is_empty) {
            return Err(format!("`{key}` is no key: {example}"));
        }
        let parsed = format!("value = {value}").parse::<Table>().ok();
        let parsed = parsed.filter(|table| table.len() == 1).and_then(|mut t| t.remove("value"));
        let value = parsed.unwrap_or_else(|| value.trim().into());
        Ok(Self { words: words.to_owned(), keys, value })
    }
}

impl Draft {
    /// The text of an experiment, or of one part of a paper's: what the part says over what is common to all parts.
    ///
    /// # Errors
    /// A sentence, if it is no TOML or there is no such part.
    pub fn of_text(text: &str, part: Option<&str>, path: &Path) -> Result<Self, String> {
        let mut table: Table = text.parse().map_err(|error: toml::de::Error| error.to_string())?;
        if let Some(part) = part {
            let own = table.get("part").and_then(|parts| parts.get(part)?.as_table()).cloned();
            let own = own.ok_or_else(|| format!("there is no part `{part}`"))?;
            OWN.iter().for_each(|key| drop(table.remove(*key)));
            lay_over(&mut table, own);
        }
        Ok(Self { table, path: path.to_owned() })
    }

    /// The default scene with one texture, called `name` and told by the keys of `texture`.
    pub fn of_texture(name: &str, texture: Table, path: &Path) -> Self {
        let mut draft = Self { table: Table::new(), path: path.to_owned() };
        draft.set("sweep", "texture", list(name));
        draft.set("sweep", "method", list("unfiltered"));
        draft.set("sweep", "texels_per_pixel", list(TEXELS));
        draft.section("texture").insert(name.to_owned(), texture.into());
        draft
    }

    /// Puts the bumps on another surface: a shape by name, or the model in an OBJ, glTF or GLB file. What belongs to the
    /// surface before is forgotten. The path of a model is from the working folder.
    ///
    /// # Errors
    /// A sentence, if there is no such file.
    pub fn put_on(&mut self, shape: &str) -> Result<(), String> {
        let model = is_model(Path::new(shape)).then(|| absolute(Path::new(shape))).transpose()?;
        self.table.insert("surface".into(), Table::new().into());
        self.section("camera").remove("target");
        match model {
            Some(model) => {
                self.set("surface", "shape", "mesh");
                self.set("surface", "file", model);
            }
            None => self.set("surface", "shape", shape),
        }
        Ok(())
    }

    /// Lets a solid be seen and lit from a little above and aside where nothing says from where: light from behind, the
    /// default, shows a plane's highlight and a solid's rim.
    pub fn stand_aside(&mut self) {
        let kind = self.section("light").get("kind").and_then(Value::as_str);
        let directional = kind.is_none_or(|kind| kind == "directional");
        let mut lack = |section: &str, elevation: f64, azimuth: f64| {
            let section = self.section(section);
            section.entry("elevation").or_insert_with(|| elevation.into());
            section.entry("azimuth").or_insert_with(|| azimuth.into());
        };
        lack("camera", 25.0, -75.0);
        if directional {
            lack("light", 50.0, -130.0);
        }
    }

    /// Changes what a setting says; tables that are missing are made.
    ///
    /// # Errors
    /// A sentence, if a key before the last is there and no table.
    pub fn change(&mut self, setting: &Setting) -> Result<(), String> {
        let (last, tables) = setting.keys.split_last().expect("a setting has a key");
        let mut table = &mut self.table;
        for key in tables {
            let below = table.entry(key).or_insert_with(|| Table::new().into());
            let Value::Table(next) = below else {
                return Err(format!("{}: `{key}` is no table", setting.words));
            };
            table = next;
        }
        table.insert(last.clone(), setting.value.clone());
        Ok(())
    }

    /// Reads the spec.
    ///
    /// # Errors
    /// All that is wrong with it.
    pub fn read(&self) -> Result<Spec, SpecErrors> {
        Spec::parse(&self.table.to_string(), &self.path)
    }

    /// The table of a name, made if it is missing.
    pub fn section(&mut self, name: &str) -> &mut Table {
        let section = self.table.entry(name).or_insert_with(|| Table::new().into());
        if !section.is_table() {
            *section = Table::new().into();
        }
        section.as_table_mut().expect("just made one")
    }

    /// Gives a key of a table a value.
    pub fn set(&mut self, section: &str, key: &str, value: impl Into<Value>) {
        self.section(section).insert(key.into(), value.into());
    }
}

/// Texels a pixel where nothing says how many.
const TEXELS: f64 = 4.0;

/// All that is wrong with a draft, a line each: the setting it is about if there is one, and the reader's words, without
/// places in a text that nobody wrote.
pub fn told(errors: &SpecErrors, settings: &[Setting]) -> String {
    let SpecErrors::Invalid(errors) = errors else { return errors.to_string() };
    let one = |error: &super::SpecError| {
        let key = error.source_line.split('=').next().unwrap_or("").trim();
        let about = settings.iter().rfind(|s| s.keys.last().is_some_and(|last| last == key));
        let about = about.map_or(String::new(), |setting| format!("{}: ", setting.words));
        let help = error.help.as_ref().map_or(String::new(), |help| format!("; {help}"));
        format!("{about}{}{help}", error.message)
    };
    errors.iter().map(one).collect::<Vec<_>>().join("\n")
}

/// Whether a path is that of a file with a model, by its ending.
pub fn is_model(path: &Path) -> bool {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| ["obj", "gltf", "glb"].contains(&ending.as_str()))
}

/// The whole path of a file, as TOML can hold it.
///
/// # Errors
/// A sentence, if it is not there or TOML cannot hold its path.
pub fn absolute(file: &Path) -> Result<String, String> {
    if !file.is_file() {
        return Err(format!("there is no file {}", file.display()));
    }
    let whole =
        std::path::absolute(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let words = whole.to_str().map(str::to_owned);
    words.ok_or_else(|| format!("the path of {} is not UTF-8: rename it", file.display()))
}

/// Lays what a part says over what is common to all, table by table.
fn lay_over(common: &mut Table, own: Table) {
    for (key, value) in own {
        match (common.get_mut(&key), value) {
            (Some(Value::Table(below)), Value::Table(above)) => lay_over(below, above),
            (_, value) => drop(common.insert(key, value)),
        }
    }
}

/// A list of one value.
fn list(value: impl Into<Value>) -> Value {
    Value::Array(vec![value.into()])
}

#[cfg(test)]
mod tests {
    use super::super::{MotionKind, Shape};
    use super::*;

    fn draft() -> Draft {
        let twill = Table::from_iter([("pattern".to_owned(), Value::from("twill"))]);
        Draft::of_texture("cloth", twill, Path::new("draft.toml"))
    }

    fn changed(words: &[&str]) -> Result<Spec, String> {
        let settings: Vec<Setting> =
            words.iter().map(|words| words.parse()).collect::<Result<_, _>>()?;
        let mut draft = draft();
        for setting in &settings {
            draft.change(setting)?;
        }
        draft.read().map_err(|errors| told(&errors, &settings))
    }

    #[test]
    fn settings_are_words_numbers_and_lists() {
        let spec = changed(&[
            "surface.shape=teapot",
            "camera.elevation = -12.5",
            "camera.target=[0, 0, 0.25]",
            "motion.kind=\"light\"",
            "motion.frames=7",
            "texture.cloth.width=64",
        ])
        .unwrap();
        assert_eq!(spec.surface.shape, Shape::Teapot);
        assert_eq!((spec.camera.elevation, spec.camera.target[2]), (-12.5, 0.25));
        assert!(matches!(spec.motion.unwrap().kind, MotionKind::Light { .. }));
        assert_eq!(spec.motion.unwrap().frames, 7);
    }

    #[test]
    fn what_is_wrong_names_the_setting() {
        let told = changed(&["camera.elevatoin=20", "material.exponent=glossy"]).unwrap_err();
        let lines: Vec<&str> = told.lines().collect();
        assert_eq!(lines.len(), 2, "{told}");
        assert!(lines[0].starts_with("camera.elevatoin=20: unknown key"), "{told}");
        assert!(lines[0].contains("did you mean `elevation`?"), "{told}");
        assert!(lines[1].starts_with("material.exponent=glossy: "), "{told}");
        for nonsense in ["camera", "=3", "camera..x=1", ".=", ""] {
            assert!(changed(&[nonsense]).is_err(), "{nonsense}");
        }
        assert!(changed(&["seed=1", "seed.x=1"]).unwrap_err().contains("`seed` is no table"));
    }

    #[test]
    fn a_value_cannot_bring_keys_of_its_own() {
        let setting: Setting = "title=1\nseed = 5".parse().unwrap();
        assert_eq!(setting.value, Value::from("1\nseed = 5"));
    }

    #[test]
    fn bumps_are_put_on_every_shape_and_on_models() {
        for shape in ["plane", "sphere", "drapery", "wavy-sphere", "teapot", "bent-patch"] {
            let mut draft = draft();
            draft.set("surface", "perturbation", "displacement");
            draft.set("camera", "target", vec![0.0, 0.0, 0.1]);
            draft.put_on(shape).unwrap();
            let spec = draft.read().unwrap();
            assert_eq!(spec.surface.shape.name(), shape);
            assert_eq!(spec.camera.target, [0.0; 3]);
            draft.set("camera", "azimuth", 7.0);
            draft.stand_aside();
            let spec = draft.read().unwrap();
            assert_eq!((spec.camera.azimuth, spec.camera.elevation), (7.0, 25.0));
        }
        let told = draft().put_on("gone.obj").unwrap_err();
        assert!(told.contains("there is no file gone.obj"), "{told}");
        let mut other = draft();
        other.put_on("teapto").unwrap();
        assert!(super::told(&other.read().unwrap_err(), &[]).contains("teapot"));
    }

    #[test]
    fn a_part_lies_over_what_is_common() {
        let text = "seed = 3\n[image]\nwidth = 20\nheight = 10\n[part.a]\nimage.width = 30\n\
                    sweep.texture = [\"twill\"]\nsweep.method = [\"unfiltered\"]\n";
        let draft = Draft::of_text(text, Some("a"), Path::new("whole.toml")).unwrap();
        let spec = draft.read().unwrap();
        assert_eq!((spec.seed, spec.image.width, spec.image.height), (3, 30, 10));
        assert!(Draft::of_text(text, Some("b"), Path::new("whole.toml")).is_err());
    }
}
