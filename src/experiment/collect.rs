//! From entities and records to results.

use std::sync::Arc;

use super::author::{Plan, PlannedScene, load};
use super::budget::budgets;
use super::keys;
use super::results::{
    Costs, MethodInfo, Peak, Picture, PrefilterCost, Probe, ProbedMethod, Reference, RefusalInfo,
    Results, SceneKey, SceneResult, Score, TextureInfo, TrialCost, TrialResult,
};
use super::sequence::sequences;
use super::spec::{Shape, Spec, TextureSource, TextureSpec};
use super::store::{PrefilterRecord, ProbeRecord, Store};
use crate::lobe::Spread;
use crate::metric;
use crate::scene::{Exposure, Probes, ReferenceImage, Scores, Stagehand, Tiling};
use crate::texture::Lookup;
use crate::texture::image_file::{Preview, preview};

/// Gathers what a finished run has found, and fills in `costs`.
pub(super) fn collect(
    spec: &Spec,
    plan: &Plan,
    store: &Store,
    stage: &mut Stagehand,
    mut costs: Costs,
) -> (Results, Costs) {
    let pixels = (spec.image.width * spec.image.height) as f64;
    let textures: Vec<TextureInfo> =
        spec.sweep.textures.iter().map(|t| describe_texture(t, spec.needs_heights())).collect();
    let mut scenes = Vec::with_capacity(plan.scenes.len());
    let mut seen = std::collections::BTreeSet::new();
    for scene in &plan.scenes {
        let texture = &textures[scene.texture];
        let mut refusals = Vec::new();
        for (index, method) in spec.sweep.methods.iter().enumerate() {
            let (folder, name) = keys::prefilter_name(spec, scene, index);
            let depends = keys::prefilter(spec, scene, index);
            let Some(record) = store.find::<PrefilterRecord>(&folder, &name, &depends) else {
                continue;
            };
            if let Some(reason) = record.refusal {
                refusals.push(RefusalInfo { method: method.label.clone(), reason });
            } else if let Some((secs, bytes)) = record.cost
                && seen.insert((folder, name))
            {
                costs.prefilters.push(PrefilterCost {
                    texture: texture.name.clone(),
                    method: method.label.clone(),
                    lobe: scene.base.name().to_owned(),
                    parameter: scene.base.parameter(),
                    secs,
                    bytes_per_texel: bytes as f64 / (texture.width * texture.height) as f64,
                });
            }
        }
        let mut trials = Vec::with_capacity(scene.trials.len());
        for trial in &scene.trials {
            let world = &stage.world;
            let (Some(exposure), Some(scores)) =
                (world.get::<Exposure>(trial.entity), world.get::<Scores>(trial.entity))
            else {
                continue;
            };
            let method = spec.sweep.methods[trial.method].label.clone();
            costs.trials.push(TrialCost {
                scene: scene.slug.clone(),
                method: method.clone(),
                spp: trial.spp,
                ns_per_pixel: exposure.cpu_secs * 1e9 / pixels,
            });
            let film = Arc::clone(&exposure.film);
            let scores = named_scores(scores);
            trials.push(TrialResult { method, spp: trial.spp, film, scores });
        }
        let probes: Vec<ProbeRecord> =
            store.find(&scene.slug, keys::PROBES, &keys::probes(spec, scene)).unwrap_or_default();
        let Some(image) = stage.world.get::<ReferenceImage>(scene.entity) else { continue };
        scenes.push(SceneResult {
            key: key(spec, scene, &probes),
            slug: scene.slug.clone(),
            sequence: scene.sequence.clone(),
            reference: Reference {
                film: Arc::new(image.0.film.clone()),
                variance: image.0.variance.clone(),
                spp: image.0.spp,
                rmse: image.0.rmse,
                mean_error: image.0.mean_error,
                truth: spec.reference.truth,
                gap: spec.reference.gap,
            },
            trials,
            refusals,
            probes: probes.into_iter().map(probe).collect(),
            budgets: budgets(spec, scene, &stage.world),
        });
    }
    let results = Results {
        name: spec.name.clone(),
        title: spec.title.clone(),
        question: spec.question.clone(),
        spec: spec.text.clone(),
        seed: spec.seed,
        methods: spec.sweep.methods.iter().map(describe_method).collect(),
        textures,
        sequences: sequences(&scenes),
        motion: spec.motion,
        scenes,
    };
    (results, costs)
}

fn key(spec: &Spec, scene: &PlannedScene, probes: &[ProbeRecord]) -> SceneKey {
    // A plane's tiling meets the wish to rounding. A sphere's is rounded to close its seam, and a moving
    // camera has no wish: there the first probe tells, at the pixel beside the image's centre.
    let measured = probes.first().map_or(f64::NAN, |probe| probe.texels_across);
    let texels_per_pixel = match (spec.surface.shape, scene.tiling) {
        (Shape::Plane, Tiling::TexelsPerPixel(wish)) if scene.frame.is_none() => wish,
        _ => (measured * 1e4).round() / 1e4,
    };
    SceneKey {
        texture: spec.sweep.textures[scene.texture].name.clone(),
        surface: spec.surface.shape.name().to_owned(),
        light: spec.light.name().to_owned(),
        lobe: scene.base.name().to_owned(),
        parameter: scene.base.parameter(),
        shading: spec.shading.name().to_owned(),
        texels_per_pixel,
        distance: scene.distance,
        elevation: scene.elevation,
        frame: scene.frame.map(|frame| frame.number + 1),
    }
}

fn probe(record: ProbeRecord) -> Probe {
    let ProbeRecord { pixel, texels_across, truth, methods } = record;
    Probe { pixel, texels_across, truth, methods }
}

/// A scene's probes as they are kept.
pub(super) fn probe_records(
    spec: &Spec,
    scene: &PlannedScene,
    probes: &Probes,
) -> Vec<ProbeRecord> {
    let label_of = |prefilter| {
        let method = scene.prefilters.iter().position(|&p| p == prefilter).unwrap_or_default();
        spec.sweep.methods[method].label.clone()
    };
    let record = |probe: &crate::scene::Probe| ProbeRecord {
        pixel: probe.pixel,
        texels_across: probe.texels_across,
        truth: probe.truth.clone(),
        methods: probe
            .methods
            .iter()
            .map(|found| ProbedMethod {
                method: label_of(found.prefilter),
                density: found.density.clone(),
                peaks: found
                    .surface
                    .lobes()
                    .iter()
                    .map(|lobe| Peak { axis: lobe.axis(), density: lobe.density(lobe.axis()) })
                    .collect(),
                l1: found.distance,
                kl: found.kl,
                wasserstein: found.wasserstein,
            })
            .collect(),
    };
    probes.0.iter().map(record).collect()
}

/// Scores with names that can be written.
pub(super) fn named_scores(scores: &Scores) -> Vec<Score> {
    let named = |&(metric, value, interval): &metric::Scored| Score {
        metric: metric.to_owned(),
        value,
        interval,
    };
    scores.0.iter().map(named).collect()
}

/// Scores read back, for the metrics that still exist.
pub(super) fn known_scores(scores: &[Score]) -> Scores {
    let known = |score: &Score| {
        metric::find(&score.metric).map(|found| (found.name, score.value, score.interval))
    };
    Scores(scores.iter().filter_map(known).collect())
}

fn describe_method(spec: &super::spec::MethodSpec) -> MethodInfo {
    let method = spec.build();
    let card = method.card();
    let lookup = (!method.lookups().is_empty()).then_some(spec.lookup);
    let options = spec.values.iter().map(|(name, value)| format!("{name} = {value}"));
    let named = |lookup: &Lookup| *lookup != Lookup::default();
    let by = lookup.filter(named).map(|lookup| format!("lookup = {}", lookup.name()));
    MethodInfo {
        label: spec.label.clone(),
        name: card.name.to_owned(),
        source: card.source.to_owned(),
        summary: card.summary.to_owned(),
        formula: card.formula.to_owned(),
        limits: card.limits.to_owned(),
        normalised: card.normalised,
        options: options.chain(by).collect(),
        lookup,
    }
}

fn describe_texture(spec: &TextureSpec, heights: bool) -> TextureInfo {
    let description = match &spec.source {
        TextureSource::Pattern { name, values, seed, .. } => {
            let options: Vec<String> =
                values.iter().map(|(name, value)| format!("{name} = {value}")).collect();
            format!("pattern {name} ({}; seed {seed})", options.join(", "))
        }
        TextureSource::File { written, reading, .. } => format!("file {written} ({reading:?})"),
        TextureSource::Baked { written, .. } => written.clone(),
    };
    let description =
        format!("{description}, {:?} wrap, {:?} interpolation", spec.wrap, spec.interpolation);
    // The runner loaded every texture before it began.
    let bumps = load(spec, heights).ok();
    TextureInfo {
        name: spec.name.clone(),
        description,
        width: bumps.as_ref().map_or(0, |b| b.normals.width()),
        height: bumps.as_ref().map_or(0, |b| b.normals.height()),
        notes: bumps.as_ref().map_or_else(Vec::new, |b| b.notes.clone()),
        picture: bumps.as_ref().map(|b| Arc::new(picture(&b.normals))),
    }
}

/// A map as a small picture.
fn picture(map: &crate::texture::NormalMap) -> Picture {
    let Preview { width, height, rgb } = preview(map, 192);
    Picture { width, height, rgb }
}
