//! Whether a scene's reference tells its trials apart.

use bevy_ecs::prelude::*;

use super::{
    Current, Exposure, Prefilter, Progress, ReferenceImage, ReferencePlan, Scores, Spp, Stage,
    TrialOf, measure,
};
use crate::metric::Lead;
use crate::render::{Converged, Film};

/// A scene whose reference will not be sampled further: it tells the trials apart as finely as is wanted, or has as
/// many samples as it may.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settled;

pub(super) fn plugin(schedule: &mut Schedule) {
    schedule.add_systems(settle.in_set(Stage::Measure).after(measure::score).after(measure::probe));
}

type Trials<'w, 's> =
    Query<'w, 's, (Entity, &'static TrialOf, &'static Spp, Option<&'static Exposure>, Has<Scores>)>;

/// Once all trials of the current scene are scored: plans twice the replicates and takes the reference and the scores
/// back, if the reference's noise leaves open who is nearest. The films stay.
#[allow(clippy::type_complexity)]
fn settle(
    mut commands: Commands,
    current: Res<Current>,
    mut scenes: Query<(&mut ReferencePlan, &ReferenceImage), Without<Settled>>,
    trials: Trials,
    prefilters: Query<&Prefilter>,
    mut progress: MessageWriter<Progress>,
) {
    let Ok((mut plan, reference)) = scenes.get_mut(current.0) else { return };
    let ours = || trials.iter().filter(|(_, of, ..)| of.scene == current.0);
    let refused = |of: &TrialOf| prefilters.get(of.prefilter).is_ok_and(|built| built.0.is_err());
    if !ours().all(|(_, of, _, _, scored)| scored || refused(of)) {
        return;
    }
    let fewest = ours().filter(|(.., scored)| *scored).map(|(_, _, spp, ..)| spp.0).min();
    let compared = ours().filter(|(_, _, spp, ..)| Some(spp.0) == fewest);
    let films = compared.filter_map(|(_, _, _, exposure, _)| Some(&*exposure?.film));
    let films: Vec<&Film> = films.filter(|f| f.pixels().iter().all(|p| p.is_finite())).collect();
    if plan.replicates > plan.most / 2 || is_resolved(&films, &reference.0, plan.gap) {
        commands.entity(current.0).insert(Settled);
        progress.write(Progress::Settled { scene: current.0 });
        return;
    }
    plan.replicates *= 2;
    commands.entity(current.0).remove::<ReferenceImage>();
    for (trial, ..) in ours() {
        commands.entity(trial).remove::<Scores>();
    }
    progress.write(Progress::Undecided { scene: current.0 });
}

/// Whether a less noisy reference could not change which of the films are the nearest.
fn is_resolved(films: &[&Film], reference: &Converged, gap: f64) -> bool {
    let lead =
        |near: &Film, far: &Film| Lead::of(near, far, &reference.film, &reference.variance, gap);
    let nearer = |near, film| if lead(near, film).difference < 0.0 { film } else { near };
    let nearest = films.iter().copied().reduce(nearer);
    nearest.is_none_or(|nearest| films.iter().all(|film| lead(nearest, film).is_resolved()))
}
