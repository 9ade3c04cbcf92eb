//! Measures: trials against the reference, and the distributions under chosen footprints.

use bevy_ecs::prelude::*;

use super::trial::{SceneView, StagedScene};
use super::{
    Current, Exposure, LookupBy, Prefilter, PrefilterOf, ProbePlan, Progress, ReferenceImage,
    Stage, TrialOf,
};
use crate::geometry::HemisphereGrid;
use crate::lobe::{MultipleSurface, Spread};
use crate::method::Prefiltered;
use crate::metric;
use crate::render::{Converged, true_distribution};
use crate::texture::{Footprint, Lookup};

/// A trial's scores against the reference, in the metrics' own order.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Scores(pub Vec<metric::Scored>);

/// What lies under a scene's chosen footprints.
#[derive(Component, Clone, Debug)]
pub struct Probes(pub Vec<Probe>);

/// The distribution of normals under a pixel's footprint, true and as each strategy has it, on
/// [`HemisphereGrid::fournier`].
#[derive(Clone, Debug)]
pub struct Probe {
    /// The pixel, from the left and from the top.
    pub pixel: [usize; 2],
    /// Texels the footprint is across.
    pub texels_across: f64,
    /// The true distribution, densities per steradian.
    pub truth: Vec<f32>,
    /// One for each prefilter of the scene, by entity.
    pub methods: Vec<ProbedMethod>,
}

/// A strategy's distribution at a [`Probe`].
#[derive(Clone, Debug)]
pub struct ProbedMethod {
    /// The prefilter.
    pub prefilter: Entity,
    /// Its lobes.
    pub surface: MultipleSurface,
    /// Its distribution, densities per steradian.
    pub density: Vec<f32>,
    /// Total variation distance to the truth.
    pub distance: f64,
    /// Its divergence from the truth, nats; see [`metric::kl_divergence`].
    pub kl: Option<f64>,
    /// Sliced Wasserstein distance to the truth; see [`metric::wasserstein`].
    pub wasserstein: Option<f64>,
}

/// Points of a footprint that make its true distribution.
const PROBE_POINTS: u32 = 4096;

pub(super) fn plugin(schedule: &mut Schedule) {
    schedule.add_systems((score, probe).chain().in_set(Stage::Measure));
}

/// Scores one trial of the current scene that has a film.
#[allow(clippy::type_complexity)]
pub(super) fn score(
    mut commands: Commands,
    current: Res<Current>,
    references: Query<&ReferenceImage>,
    pending: Query<(Entity, &TrialOf, &Exposure), Without<Scores>>,
    mut progress: MessageWriter<Progress>,
) {
    let Ok(reference) = references.get(current.0) else { return };
    let ours = pending.iter().filter(|(_, trial, _)| trial.scene == current.0);
    let Some((trial, _, exposure)) = ours.min_by_key(|(entity, ..)| *entity) else { return };
    let Converged { film, variance, .. } = &*reference.0;
    let scores = metric::scores_with_intervals(&exposure.film, film, variance);
    commands.entity(trial).insert(Scores(scores));
    progress.write(Progress::Scored { trial });
}

/// Looks under the current scene's chosen footprints, once all its prefilters are there.
pub(super) fn probe(
    mut commands: Commands,
    current: Res<Current>,
    view: SceneView,
    plans: Query<(&ProbePlan, &super::SceneOf), Without<Probes>>,
    prefilters: Query<(Entity, &PrefilterOf, &LookupBy, Option<&Prefilter>)>,
    mut progress: MessageWriter<Progress>,
) {
    let Ok((plan, scene)) = plans.get(current.0) else { return };
    let Some(staged) = view.of(current.0) else { return };
    let ours = |of: &PrefilterOf| of.texture == scene.texture && of.material == scene.material;
    let mut ready: Vec<(Entity, Lookup, Option<&Prefilter>)> = prefilters
        .iter()
        .filter(|(_, of, ..)| ours(of))
        .map(|(entity, _, lookup, prefilter)| (entity, lookup.0, prefilter))
        .collect();
    if ready.iter().any(|(.., prefilter)| prefilter.is_none()) {
        return;
    }
    ready.sort_by_key(|(entity, ..)| *entity);
    let built: Vec<(Entity, Lookup, &dyn Prefiltered)> = ready
        .iter()
        .filter_map(|&(entity, lookup, prefilter)| {
            Some((entity, lookup, prefilter?.0.as_ref().ok()?.as_ref()))
        })
        .collect();
    let found = plan.0.iter().filter_map(|&pixel| probed(&staged, pixel, &built)).collect();
    commands.entity(current.0).insert(Probes(found));
    progress.write(Progress::Probed { scene: current.0 });
}

/// The probe of one pixel, or of the nearest that sees the surface; None if none does.
fn probed(
    staged: &StagedScene,
    pixel: [usize; 2],
    prefilters: &[(Entity, Lookup, &dyn Prefiltered)],
) -> Option<Probe> {
    let maps: Vec<_> = prefilters.iter().map(|&(_, lookup, map)| (lookup, map)).collect();
    let pixel = staged.view.seen_nearest(pixel)?;
    let Under { texels_across, truth, methods } = look_under(staged, pixel, PROBE_POINTS, &maps)?;
    let of = |(found, &(prefilter, ..)): (Held, &(Entity, Lookup, &dyn Prefiltered))| {
        let Held { surface, density, distance, kl, wasserstein } = found;
        ProbedMethod { prefilter, surface, density, distance, kl, wasserstein }
    };
    let methods = methods.into_iter().zip(prefilters).map(of).collect();
    Some(Probe { pixel, texels_across, truth, methods })
}

/// What lies under a pixel.
#[derive(Clone, Debug)]
pub struct Under {
    /// Texels its footprint is across.
    pub texels_across: f64,
    /// The true distribution of normals, densities per steradian on [`HemisphereGrid::fournier`].
    pub truth: Vec<f32>,
    /// What each prefiltered map holds of it.
    pub methods: Vec<Held>,
}

/// What a prefiltered map holds of a footprint.
#[derive(Clone, Debug)]
pub struct Held {
    /// Its lobes.
    pub surface: MultipleSurface,
    /// Its distribution, densities per steradian on [`HemisphereGrid::fournier`].
    pub density: Vec<f32>,
    /// Total variation distance to the truth.
    pub distance: f64,
    /// Its divergence from the truth, nats; see [`metric::kl_divergence`].
    pub kl: Option<f64>,
    /// Sliced Wasserstein distance to the truth; see [`metric::wasserstein`].
    pub wasserstein: Option<f64>,
}

/// Looks under a pixel: the true distribution from `points` samples, and what each of the maps, by its lookup, holds
/// of it. None if the pixel misses the surface.
pub fn look_under(
    staged: &StagedScene,
    pixel: [usize; 2],
    points: u32,
    maps: &[(Lookup, &dyn Prefiltered)],
) -> Option<Under> {
    let grid = HemisphereGrid::fournier();
    let (view, map) = (&staged.view, &staged.map);
    let footprint = view.footprint(pixel[0] as f64 + 0.5, pixel[1] as f64 + 0.5)?;
    let truth = true_distribution(view, map, &staged.material.base, pixel, points, &grid)?;
    let held = |&(lookup, prefiltered): &(Lookup, &dyn Prefiltered)| {
        let surface = prefiltered.lobes_at(&Footprint { lookup, ..footprint });
        let density: Vec<f32> = grid
            .samples()
            .iter()
            .map(|s| [s.direction.x, s.direction.y, s.direction.z].map(|c| c as f32))
            .map(|h| surface.lobes().iter().map(|lobe| lobe.density(h)).sum())
            .collect();
        let distance = metric::total_variation(&grid, &density, &truth);
        let kl = metric::kl_divergence(&grid, &truth, &density);
        let wasserstein = metric::wasserstein(&grid, &density, &truth);
        Held { surface, density, distance, kl, wasserstein }
    };
    let texels_across = footprint.texels_across(map.width(), map.height());
    let methods = maps.iter().map(held).collect();
    Some(Under { texels_across, truth, methods })
}
