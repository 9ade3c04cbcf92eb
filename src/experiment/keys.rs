//! Names of records, and what each depends on.
//!
//! A record is worth taking up only if nothing it depends on has changed. What that is, as text, goes
//! into its address (see [`super::store`]). Names are no part of it.

use std::path::Path;

use super::author::{PlannedScene, PlannedTrial};
use super::spec::{
    EnvironmentSource, LightSpec, MethodSpec, ReferenceSpec, Spec, SurfaceSpec, TextureSource,
    TextureSpec,
};
use crate::render::{Converged, Film};
use crate::surface::files_of;

/// Name of a scene's reference among its records.
pub(super) const REFERENCE: &str = "reference";
/// Name of the errors of its pixels.
pub(super) const REFERENCE_ERROR: &str = "reference-error";
/// Name of the record that it is as good as it needs to be.
pub(super) const SETTLED: &str = "settled";
/// Name of a scene's probes among its records.
pub(super) const PROBES: &str = "probes";

/// Name of the budgets of a scene's errors among its records.
pub(super) const BUDGET: &str = "budget";

/// What is common to all scenes of an experiment. (Where things stand in a first frame is how textures are laid in
/// the others.)
pub(super) fn common(spec: &Spec) -> String {
    format!(
        "{:?} {} {:?} {} {:?} {} {:?}",
        spec.image,
        surface(&spec.surface),
        spec.camera,
        light(&spec.light),
        spec.shading,
        spec.seed,
        spec.motion.map(|motion| motion.pose(0))
    )
}

/// A surface: of a model, the bytes of its files, wherever they are; see [`texture`].
fn surface(surface: &SurfaceSpec) -> String {
    let SurfaceSpec { shape, axes, perturbation, model } = surface;
    let model = model.as_ref().map(|model| {
        let mut hasher = blake3::Hasher::new();
        for file in files_of(&model.path) {
            hasher.update(&std::fs::read(file).unwrap_or_default());
        }
        // A reader is chosen by the file's ending.
        let kind = model.path.extension();
        format!("{kind:?} {:?} {}", model.up, hasher.finalize().to_hex())
    });
    format!("{shape:?} {axes:?} {perturbation:?} {model:?}")
}

/// A light: of a picture, the bytes of its file; see [`texture`].
fn light(light: &LightSpec) -> String {
    match light {
        LightSpec::Environment {
            source: EnvironmentSource::File { path },
            rotation,
            intensity,
            filter,
        } => format!("{} {rotation:?} {intensity:?} {filter:?}", contents(path)),
        _ => format!("{light:?}"),
    }
}

/// A texture, whatever it is called: of an image, the bytes of its file, wherever that is. (Of a file that
/// cannot be read nothing is said here; reading it as a texture tells why.)
pub(super) fn texture(texture: &TextureSpec) -> String {
    let TextureSpec { name: _, source, wrap, interpolation, repeat } = texture;
    let source = match source {
        TextureSource::File { path, written: _, reading } => {
            format!("{} {reading:?}", contents(path))
        }
        TextureSource::Pattern { .. } => format!("{source:?}"),
        TextureSource::Baked { recipe, written: _ } => {
            let files: Vec<String> = recipe.files().into_iter().map(contents).collect();
            format!("{:?} {files:?}", recipe.clone().nameless())
        }
    };
    format!("{source} {wrap:?} {interpolation:?} {repeat}")
}

/// The digest of a file, and its ending, by which a reader is chosen.
fn contents(path: &Path) -> String {
    let bytes = std::fs::read(path).unwrap_or_default();
    format!("{:?} {}", path.extension(), blake3::hash(&bytes).to_hex())
}

/// A method, whatever it is called.
fn method(method: &MethodSpec) -> String {
    let MethodSpec { label: _, name, values, lookup } = method;
    format!("{name} {values:?} {lookup:?}")
}

/// What all images of a scene depend on, beyond what is common.
fn scene(scene: &PlannedScene) -> String {
    let PlannedScene { texture_key, base, tiling, distance, elevation, frame, .. } = scene;
    format!("{texture_key} {base:?} {tiling:?} {distance:?} {elevation:?} {frame:?}")
}

/// What a scene's reference of so many replicates depends on. (Frames take their random numbers one after another,
/// each as many as it may need.)
pub(super) fn reference(spec: &Spec, of: &PlannedScene, replicates: u32) -> String {
    let ReferenceSpec { truth, most, .. } = spec.reference;
    let (spp, most) = (spec.reference.replicate_spp(), of.frame.map(|_| most));
    format!("{} {truth:?} {replicates} replicates of {spp} {most:?}", scene(of))
}

/// What it depends on how many replicates a scene's reference needs: the trials it is to tell apart.
pub(super) fn settled(spec: &Spec, of: &PlannedScene) -> String {
    let ReferenceSpec { replicates, most, gap, .. } = spec.reference;
    let trials: Vec<String> = of.trials.iter().map(|t| trial(spec, of, t)).collect();
    format!("{} {most} {gap:?} {trials:?}", reference(spec, of, replicates))
}

/// What a trial's scores depend on: its film, and the reference with its errors.
pub(super) fn scores(trial: &Film, reference: &Converged) -> String {
    format!("{} {} {}", trial.digest(), reference.film.digest(), reference.error().digest())
}

/// Name of a trial's scores.
pub(super) fn scores_name(spec: &Spec, trial: &PlannedTrial) -> String {
    format!("{}-scores", trial_name(spec, trial))
}

/// What a trial depends on; its scores depend on the reference too.
pub(super) fn trial(spec: &Spec, of: &PlannedScene, trial: &PlannedTrial) -> String {
    let method = method(&spec.sweep.methods[trial.method]);
    format!("{} {method} {}", scene(of), trial.spp)
}

/// What a scene's probes depend on, the labels of methods among it: they stand in the record.
pub(super) fn probes(spec: &Spec, of: &PlannedScene) -> String {
    format!("{} {:?} {:?}", scene(of), spec.reference.truth, spec.sweep.methods)
}

/// What the budgets of a scene's errors depend on: what its probes do, and its reference.
pub(super) fn budget(spec: &Spec, of: &PlannedScene, reference: &Film) -> String {
    format!("budgets {} {:?} {}", probes(spec, of), spec.budget, reference.digest())
}

/// What a prefilter depends on.
pub(super) fn prefilter(spec: &Spec, of: &PlannedScene, index: usize) -> String {
    let method = method(&spec.sweep.methods[index]);
    format!("{} {:?} {method}", of.texture_key, of.base)
}

/// Name of a trial's record and image.
pub(super) fn trial_name(spec: &Spec, trial: &PlannedTrial) -> String {
    format!("{}-{}spp", spec.sweep.methods[trial.method].label, trial.spp)
}

/// Folder and name of a prefilter's record: one a texture, method and lobe.
pub(super) fn prefilter_name(spec: &Spec, of: &PlannedScene, method: usize) -> (String, String) {
    let label = &spec.sweep.methods[method].label;
    let name = format!("{label}-{}-{}", of.base.name(), of.base.parameter());
    (format!("prefilters-{}", of.texture), name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(folder: &Path, keys: &str) -> String {
        let text =
            format!("[sweep]\ntexture = [\"x\"]\nmethod = [\"averaged\"]\n[texture.x]\n{keys}");
        let spec = Spec::parse(&text, &folder.join("spec.toml")).unwrap();
        texture(&spec.sweep.textures[0])
    }

    #[test]
    fn baked_textures_depend_on_bytes_of_files_and_not_on_their_names() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, bytes: &str| std::fs::write(folder.path().join(name), bytes);
        write("a.png", "one").unwrap();
        write("b.png", "one").unwrap();
        write("c.png", "two").unwrap();
        let key = |keys: &str| key(folder.path(), keys);
        assert_eq!(key("like = \"a.png\""), key("like = \"b.png\""));
        assert_ne!(key("like = \"a.png\""), key("like = \"c.png\""));
        assert_ne!(key("like = \"a.png\""), key("onto = \"a.png\""));
        assert_ne!(key("ndf = \"a.png\""), key("ndf = \"a.png\"\nmeasure = \"solid-angle\""));
        assert_ne!(
            key("onto = \"a.png\"\nndf = \"c.png\""),
            key("onto = \"c.png\"\nndf = \"a.png\"")
        );
    }
}
