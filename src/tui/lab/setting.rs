//! The settings of a setup: what they are, how they read, and how keys change them.

use toml::Value;

use super::setup::Setup;
use crate::experiment::spec::{
    EnvironmentSource, LightSpec, Reading, Scale, Spec, TextureSource, TextureSpec,
};
use crate::light::environment::maps;
use crate::texture::Lookup;
use crate::texture::image_file::Green;

/// Something of a setup that keys change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// The texture.
    Texture,
    /// Which way green is up in the texture's file.
    Green,
    /// What the texture's file holds.
    Kind,
    /// The surface.
    Surface,
    /// How far away it is: texels across a pixel at the image's centre.
    Texels,
    /// The camera's height above the surface.
    Camera,
    /// Where around the vertical the camera stands.
    CameraAzimuth,
    /// The kind of light.
    Light,
    /// How high the light stands.
    LightElevation,
    /// Where around the vertical the light stands.
    LightAzimuth,
    /// The family of the base lobe.
    Lobe,
    /// Its width: exponent or roughness.
    Width,
    /// What a lobe's density means for light.
    Shading,
    /// How what lies under a footprint is averaged.
    Lookup,
    /// Samples a pixel of every method.
    Samples,
    /// Pixels of the image.
    Image,
}

/// Shapes to choose from; an experiment's own may be another.
const SHAPES: [&str; 7] =
    ["plane", "sphere", "cylinder", "teapot", "drapery", "ribbon", "bent-patch"];
const LOBES: [&str; 3] = ["blinn-phong", "beckmann", "ggx"];
const SIZES: [[i64; 2]; 4] = [[160, 120], [320, 240], [640, 480], [960, 720]];
/// Texels a pixel, least and most.
const TEXELS: [f64; 2] = [0.0625, 4096.0];

impl Setting {
    /// All that a setup has, in the order they are shown.
    pub fn all(spec: &Spec) -> Vec<Self> {
        let mut all = vec![Self::Texture];
        if let TextureSource::File { reading, .. } = &spec.sweep.textures[0].source {
            all.push(Self::Kind);
            all.extend(matches!(reading, Reading::Normal { .. }).then_some(Self::Green));
        }
        all.extend([Self::Surface, Self::Texels, Self::Camera, Self::CameraAzimuth, Self::Light]);
        match &spec.light {
            LightSpec::Directional { .. } => all.extend([Self::LightElevation, Self::LightAzimuth]),
            LightSpec::Environment { .. } => all.push(Self::LightAzimuth),
            LightSpec::Point { .. } => {}
        }
        all.extend([Self::Lobe, Self::Width, Self::Shading]);
        all.extend([Self::Lookup, Self::Samples, Self::Image]);
        all
    }

    /// Its name.
    pub fn name(self, spec: &Spec) -> &'static str {
        match self {
            Self::Texture => "texture",
            Self::Green => "green is",
            Self::Kind => "file holds",
            Self::Surface => "surface",
            Self::Texels => "texels a pixel",
            Self::Camera => "camera above",
            Self::CameraAzimuth => "camera from",
            Self::Light => "light",
            Self::LightElevation => "light above",
            Self::LightAzimuth => "light from",
            Self::Lobe => "base lobe",
            Self::Width if spec.sweep.lobes[0].name() == "blinn-phong" => "exponent",
            Self::Width => "roughness α",
            Self::Shading => "shading",
            Self::Lookup => "lookup",
            Self::Samples => "samples a pixel",
            Self::Image => "image",
        }
    }

    /// Its value, as it is shown.
    pub fn value(self, setup: &Setup, spec: &Spec) -> String {
        match self {
            Self::Texture => setup.texture().to_owned(),
            Self::Green => green(&spec.sweep.textures[0]).to_owned(),
            Self::Kind => kind(&spec.sweep.textures[0]).to_owned(),
            Self::Surface => spec.surface.shape.name().to_owned(),
            Self::Texels => number(texels(spec)),
            Self::Camera => degrees(spec.camera.elevation),
            Self::CameraAzimuth => degrees(spec.camera.azimuth),
            Self::Light => light(&spec.light),
            Self::LightElevation | Self::LightAzimuth => degrees(self.angle(spec)),
            Self::Lobe => spec.sweep.lobes[0].name().to_owned(),
            Self::Width => number(spec.sweep.lobes[0].parameter()),
            Self::Shading => spec.shading.name().to_owned(),
            Self::Lookup => setup.lookup.name().to_owned(),
            Self::Samples => setup.spp.to_string(),
            Self::Image => format!("{} × {}", spec.image.width, spec.image.height),
        }
    }

    fn angle(self, spec: &Spec) -> f64 {
        match (self, &spec.light) {
            (Self::LightElevation, LightSpec::Directional { elevation, .. }) => *elevation,
            (_, LightSpec::Directional { azimuth, .. }) => *azimuth,
            (_, LightSpec::Environment { rotation, .. }) => *rotation,
            _ => 0.0,
        }
    }

    /// Changes it by some steps, up or down; lists go round. The setup may then be one that its reader refuses.
    pub fn change(self, setup: &mut Setup, spec: &Spec, steps: i32) {
        match self {
            Self::Texture => {
                let at = setup.textures.iter().position(|name| name == setup.texture());
                let next = round(at, steps, setup.textures.len());
                let name = Value::from(setup.textures[next].as_str());
                setup.draft.set("sweep", "texture", Value::Array(vec![name]));
            }
            Self::Green => {
                let turned = if green(&spec.sweep.textures[0]) == "up" { "down" } else { "up" };
                if let Some(table) = setup.texture_table() {
                    table.insert("green".into(), turned.into());
                }
            }
            Self::Kind => turn_kind(setup, kind(&spec.sweep.textures[0])),
            Self::Surface => {
                let shape = next(&SHAPES, spec.surface.shape.name(), steps);
                // Other keys of [surface], and what the camera looks at, belong to the shape before.
                setup.draft.table.insert("surface".into(), toml::Table::new().into());
                setup.draft.set("surface", "shape", shape);
                setup.draft.section("camera").remove("target");
            }
            Self::Texels => {
                let to = doubled(texels(spec), 2.0, steps).clamp(TEXELS[0], TEXELS[1]);
                setup.draft.set("sweep", "texels_per_pixel", Value::Array(vec![to.into()]));
            }
            Self::Camera => {
                let to = stepped(spec.camera.elevation, 5.0, steps).clamp(5.0, 90.0);
                setup.draft.set("camera", "elevation", to);
            }
            Self::Light => turn_light(setup, spec, steps),
            Self::LightElevation => {
                let to = stepped(self.angle(spec), 5.0, steps).clamp(5.0, 90.0);
                setup.draft.set("light", "elevation", to);
            }
            Self::CameraAzimuth => {
                setup.draft.set("camera", "azimuth", turned(spec.camera.azimuth, steps));
            }
            Self::LightAzimuth => {
                let to = turned(self.angle(spec), steps);
                let key = if spec.light.is_environment() { "rotation" } else { "azimuth" };
                setup.draft.set("light", key, to);
            }
            Self::Lobe => turn_lobe(setup, spec, steps),
            Self::Width => widen(setup, spec, steps),
            Self::Shading => {
                let shading = next(&["ndf", "microfacet"], spec.shading.name(), steps);
                setup.draft.set("material", "shading", shading);
            }
            Self::Lookup => {
                let at = Lookup::ALL.iter().position(|lookup| *lookup == setup.lookup);
                setup.lookup = Lookup::ALL[round(at, steps, Lookup::ALL.len())];
            }
            Self::Samples => {
                let power = setup.spp.max(1).ilog2() as i32 + steps;
                setup.spp = 1 << power.clamp(0, 8);
            }
            Self::Image => {
                let now = [spec.image.width as i64, spec.image.height as i64];
                let at = SIZES.iter().position(|size| *size == now);
                let [width, height] = SIZES[round(at, steps, SIZES.len())];
                setup.draft.set("image", "width", width);
                setup.draft.set("image", "height", height);
            }
        }
    }
}

/// The place `steps` after `at` in a list that goes round; from nowhere, its first.
fn round(at: Option<usize>, steps: i32, length: usize) -> usize {
    let Some(at) = at else { return 0 };
    (at as i64 + i64::from(steps)).rem_euclid(length.max(1) as i64) as usize
}

fn next(list: &[&'static str], now: &str, steps: i32) -> &'static str {
    list[round(list.iter().position(|name| *name == now), steps, list.len())]
}

/// The next multiple of a step, or so many on.
fn stepped(now: f64, step: f64, steps: i32) -> f64 {
    let at = now / step;
    let from = if steps > 0 { (at + 1e-9).floor() } else { (at - 1e-9).ceil() };
    step * (from + f64::from(steps))
}

/// The next direction around the vertical, degrees in (−180, 180].
fn turned(now: f64, steps: i32) -> f64 {
    180.0 - (180.0 - stepped(now, 10.0, steps)).rem_euclid(360.0)
}

/// The next power of two, `parts` of them to a doubling, or so many on: the same numbers up and down.
fn doubled(now: f64, parts: f64, steps: i32) -> f64 {
    let at = parts * libm::log2(now);
    // What was rounded to four digits stands on its step.
    let at = if (at - at.round()).abs() < 0.01 { at.round() } else { at };
    rounded(libm::exp2(stepped(at, 1.0, steps.clamp(-200, 200)) / parts))
}

/// To four digits, so that numbers stay readable.
fn rounded(value: f64) -> f64 {
    // Through text, so that what is shown is what is meant.
    format!("{value:.3e}").parse().unwrap_or(value)
}

fn number(value: f64) -> String {
    if value >= 100.0 { format!("{value:.0}") } else { rounded(value).to_string() }
}

fn degrees(value: f64) -> String {
    format!("{value}°")
}

fn texels(spec: &Spec) -> f64 {
    match &spec.sweep.scale {
        Scale::TexelsPerPixel(list) => list[0],
        Scale::Distance { .. } => 1.0,
    }
}

fn light(light: &LightSpec) -> String {
    match light {
        LightSpec::Environment { source: EnvironmentSource::Map { name, .. }, .. } => {
            format!("{name} sky")
        }
        LightSpec::Environment { source: EnvironmentSource::File { path }, .. } => {
            path.file_name().unwrap_or_default().to_string_lossy().into_owned()
        }
        other => other.name().to_owned(),
    }
}

fn green(texture: &TextureSpec) -> &'static str {
    match &texture.source {
        TextureSource::File { reading: Reading::Normal { green: Green::Down, .. }, .. } => "down",
        _ => "up",
    }
}

fn kind(texture: &TextureSpec) -> &'static str {
    match &texture.source {
        TextureSource::File { reading: Reading::Height { .. }, .. } => "heights",
        _ => "normals",
    }
}

/// From a map of normals to one of heights, and back.
fn turn_kind(setup: &mut Setup, now: &str) {
    let Some(table) = setup.texture_table() else { return };
    ["green", "zero", "height_scale"].iter().for_each(|key| drop(table.remove(*key)));
    let kind = if now == "normals" { "height" } else { "normal" };
    table.insert("kind".into(), kind.into());
}

/// From a directional light through every environment and back.
fn turn_light(setup: &mut Setup, spec: &Spec, steps: i32) {
    let names: Vec<&str> = maps::entries().iter().map(|entry| entry.card.name).collect();
    let now = match &spec.light {
        LightSpec::Environment { source: EnvironmentSource::Map { name, .. }, .. } => {
            names.iter().position(|known| known == name).map(|at| at + 1)
        }
        _ => Some(0),
    };
    let to = round(now, steps, names.len() + 1);
    setup.draft.table.insert("light".into(), toml::Table::new().into());
    if to > 0 {
        setup.draft.set("light", "kind", "environment");
        setup.draft.set("light", "map", names[to - 1]);
        // Environments are lit through plain distributions of normals only.
        setup.draft.set("material", "shading", "ndf");
    }
}

/// Another family of about the same width: α² = 2 / (s + 2) (Walter et al. 2007).
fn turn_lobe(setup: &mut Setup, spec: &Spec, steps: i32) {
    let lobe = spec.sweep.lobes[0];
    let alpha = match lobe.name() {
        "blinn-phong" => (2.0 / (lobe.parameter() + 2.0)).sqrt(),
        _ => lobe.parameter(),
    };
    let family = next(&LOBES, lobe.name(), steps);
    let material = setup.draft.section("material");
    ["exponent", "alpha"].iter().for_each(|key| drop(material.remove(*key)));
    setup.draft.set("material", "lobe", family);
    let (key, value) = match family {
        "blinn-phong" => ("exponent", (2.0 / (alpha * alpha) - 2.0).clamp(1.0, 1e5)),
        _ => ("alpha", alpha.clamp(0.005, 1.0)),
    };
    setup.draft.set("material", key, rounded(value));
}

/// Changes the lobe's number by quarters of a doubling of its roughness: an exponent goes by its square.
fn widen(setup: &mut Setup, spec: &Spec, steps: i32) {
    let lobe = spec.sweep.lobes[0];
    let (key, value) = match lobe.name() {
        "blinn-phong" => ("exponent", doubled(lobe.parameter(), 2.0, steps).clamp(1.0, 1e5)),
        _ => ("alpha", doubled(lobe.parameter(), 4.0, steps).clamp(0.005, 1.0)),
    };
    setup.draft.set("material", key, value);
}

#[cfg(test)]
mod tests {
    use super::super::setup::tests::setup;
    use super::*;

    fn changed(setting: Setting, steps: i32) -> (Setup, Spec) {
        let mut setup = setup();
        let spec = setup.spec().unwrap();
        setting.change(&mut setup, &spec, steps);
        let spec = setup.spec().unwrap_or_else(|error| panic!("{setting:?} by {steps}: {error}"));
        (setup, spec)
    }

    /// Whatever is changed, however far, is a spec again, and says so.
    #[test]
    fn every_change_is_a_scene() {
        let spec = setup().spec().unwrap();
        for setting in Setting::all(&spec) {
            for steps in [-1000, -3, -1, 1, 2, 5, 1000] {
                let (setup, spec) = changed(setting, steps);
                assert!(!setting.value(&setup, &spec).is_empty(), "{setting:?}");
                assert!(!setting.name(&spec).is_empty());
            }
        }
    }

    /// Going round every list, and every surface under every light, is never refused.
    #[test]
    fn every_combination_of_surface_light_and_lobe_is_a_scene() {
        let mut setup = setup();
        for setting in [Setting::Surface, Setting::Light, Setting::Lobe, Setting::Surface] {
            for _ in 0..8 {
                let spec = setup.spec().unwrap();
                setting.change(&mut setup, &spec, 1);
                let after = setup.spec();
                assert!(after.is_ok(), "{setting:?}: {after:?}");
            }
        }
    }

    #[test]
    fn up_and_down_comes_back() {
        for setting in [Setting::Texels, Setting::Surface, Setting::Lookup, Setting::Texture] {
            let (mut setup, spec) = changed(setting, 1);
            setting.change(&mut setup, &spec, -1);
            let before = super::super::setup::tests::setup();
            let (now, then) = (setup.spec().unwrap(), before.spec().unwrap());
            assert_eq!(setting.value(&setup, &now), setting.value(&before, &then), "{setting:?}");
        }
    }

    #[test]
    fn lobes_change_family_and_keep_their_width() {
        // beckmann 0.3 → ggx → blinn-phong → beckmann.
        let mut setup = setup();
        let mut widths = Vec::new();
        for _ in 0..3 {
            let spec = setup.spec().unwrap();
            turn_lobe(&mut setup, &spec, 1);
            let lobe = setup.spec().unwrap().sweep.lobes[0];
            widths.push((lobe.name(), lobe.parameter()));
        }
        assert_eq!(widths, [("ggx", 0.3), ("blinn-phong", 20.22), ("beckmann", 0.3)]);
    }

    #[test]
    fn steps_meet_round_numbers() {
        assert_eq!(stepped(42.0, 5.0, 1), 45.0);
        assert_eq!(stepped(42.0, 5.0, -1), 40.0);
        assert_eq!(stepped(40.0, 5.0, 1), 45.0);
        assert_eq!(stepped(40.0, 5.0, -2), 30.0);
        assert_eq!([1, 2].map(|steps| doubled(4.0, 2.0, steps)), [5.657, 8.0]);
        assert_eq!([-1, 1].map(|steps| doubled(5.657, 2.0, steps)), [4.0, 8.0]);
        assert_eq!([-1, 1].map(|steps| doubled(60.0, 2.0, steps)), [45.25, 64.0]);
    }
}
