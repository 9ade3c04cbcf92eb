//! The converged reference of a scene.

use std::sync::Arc;

use bevy_ecs::prelude::*;

use super::trial::SceneView;
use super::{Current, Halt, Progress, ReferencePlan, Seed, Stage};
use crate::render::{Converged, PixelSampler, Tally, reference_replicate};

/// A scene's converged reference. Rendered by the reference system, or put there by the author from
/// an earlier run.
#[derive(Component, Clone, Debug)]
pub struct ReferenceImage(pub Arc<Converged>);

/// The replicates of a scene's reference so far; more can be added.
#[derive(Component, Clone, Debug)]
pub struct Replicates(pub Tally);

pub(super) fn plugin(schedule: &mut Schedule) {
    schedule.add_systems(converge.in_set(Stage::Reference));
}

/// Renders one more replicate of the current scene's reference; the last that is planned completes it.
fn converge(
    mut commands: Commands,
    current: Res<Current>,
    (halt, seed): (Res<Halt>, Res<Seed>),
    view: SceneView,
    mut scenes: Query<(&ReferencePlan, Option<&mut Replicates>), Without<ReferenceImage>>,
    mut progress: MessageWriter<Progress>,
) {
    let Ok((plan, replicates)) = scenes.get_mut(current.0) else { return };
    let Some(staged) = view.of(current.0) else { return };
    let truth = (plan.truth, &staged.map, &staged.material.base);
    let done = replicates.as_ref().map_or(0, |r| r.0.replicates());
    let sampler = PixelSampler::new(plan.spp);
    let stop = || halt.now();
    let number = plan.first + done;
    let replicate = reference_replicate(&staged.view, truth, &sampler, seed.0, number, &stop);
    let Ok(film) = replicate else { return };
    let mut scene = commands.entity(current.0);
    let completed = if let Some(mut replicates) = replicates {
        replicates.0.add(&film);
        (done + 1 == plan.replicates).then(|| replicates.0.converged())
    } else {
        let mut tally = Tally::new(film.width(), film.height(), plan.spp);
        tally.add(&film);
        scene.insert(Replicates(tally));
        None
    };
    if let Some(converged) = completed {
        scene.insert(ReferenceImage(Arc::new(converged)));
    }
    progress.write(Progress::Converged { scene: current.0 });
}
