//! Names of records, and what each depends on.
//!
//! A record is worth taking up only if nothing it depends on has changed. What that is, as text, goes
//! into its digest (see [`super::store`]).

use super::author::{PlannedScene, PlannedTrial};
use super::spec::{
    EnvironmentSource, LightSpec, ReferenceSpec, Spec, SurfaceSpec, TextureSource, TextureSpec,
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

/// What is common to all scenes of an experiment.
pub(super) fn common(spec: &Spec) -> String {
    format!(
        "{:?} {} {:?} {} {:?} {} {:?} {}",
        spec.image,
        surface(&spec.surface),
        spec.camera,
        light(&spec.light),
        spec.shading,
        spec.reference.replicate_spp(),
        spec.reference.truth,
        spec.seed
    )
}

/// A surface, with the bytes of its model's files if it is one; see [`texture`].
fn surface(surface: &SurfaceSpec) -> String {
    let mut hasher = blake3::Hasher::new();
    for file in surface.model.iter().flat_map(|model| files_of(&model.path)) {
        hasher.update(&std::fs::read(file).unwrap_or_default());
    }
    format!("{surface:?} {}", hasher.finalize().to_hex())
}

/// A light, with the bytes of its file if it has one; see [`texture`].
fn light(light: &LightSpec) -> String {
    match light {
        LightSpec::Environment { source: EnvironmentSource::File { path }, .. } => {
            let bytes = std::fs::read(path).unwrap_or_default();
            format!("{light:?} {}", blake3::hash(&bytes).to_hex())
        }
        _ => format!("{light:?}"),
    }
}

/// A texture, with the bytes of its file. (Of a file that cannot be read nothing is said here; reading
/// it as a texture tells why.)
pub(super) fn texture(texture: &TextureSpec) -> String {
    let bytes = match &texture.source {
        TextureSource::File { path, .. } => std::fs::read(path).unwrap_or_default(),
        TextureSource::Pattern { .. } => Vec::new(),
    };
    format!("{texture:?} {}", blake3::hash(&bytes).to_hex())
}

/// What a scene's reference depends on, beyond what is common.
pub(super) fn scene(scene: &PlannedScene) -> String {
    let PlannedScene { texture_key, base, tiling, distance, elevation, frame, .. } = scene;
    format!("{texture_key} {base:?} {tiling:?} {distance:?} {elevation:?} {frame:?}")
}

/// What its reference of so many replicates depends on.
pub(super) fn reference(scene: &PlannedScene, replicates: u32) -> String {
    format!("{} {replicates} replicates", self::scene(scene))
}

/// What it depends on how many replicates a scene's reference needs: the trials it is to tell apart.
pub(super) fn settled(spec: &Spec, of: &PlannedScene) -> String {
    let counts: Vec<(usize, u32)> = of.trials.iter().map(|t| (t.method, t.spp)).collect();
    let ReferenceSpec { most, gap, .. } = spec.reference;
    format!("{} {:?} {counts:?} {most} {gap:?}", scene(of), spec.sweep.methods)
}

/// What a trial's scores depend on: its film, and the reference with its errors.
pub(super) fn scores(trial: &Film, reference: &Converged) -> String {
    format!("{} {} {}", trial.digest(), reference.film.digest(), reference.error().digest())
}

/// Name of a trial's scores.
pub(super) fn scores_name(spec: &Spec, trial: &PlannedTrial) -> String {
    format!("{}-scores", trial_name(spec, trial))
}

/// What a trial depends on.
pub(super) fn trial(spec: &Spec, of: &PlannedScene, trial: &PlannedTrial) -> String {
    format!("{} {:?} {}", scene(of), spec.sweep.methods[trial.method], trial.spp)
}

/// What a scene's probes depend on.
pub(super) fn probes(spec: &Spec, of: &PlannedScene) -> String {
    format!("{} {:?}", scene(of), spec.sweep.methods)
}

/// What the budgets of a scene's errors depend on: what its probes do, and its reference.
pub(super) fn budget(spec: &Spec, of: &PlannedScene, reference: &Film) -> String {
    format!("{} {:?} {}", probes(spec, of), spec.budget, reference.digest())
}

/// What a prefilter depends on.
pub(super) fn prefilter(spec: &Spec, of: &PlannedScene, method: usize) -> String {
    format!("{} {:?} {:?}", of.texture_key, of.base, spec.sweep.methods[method])
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
