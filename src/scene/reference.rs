//! The converged reference of a scene.

use std::sync::Arc;

use bevy_ecs::prelude::*;

use super::trial::SceneView;
use super::{Current, Halt, Progress, ReferencePlan, Seed, Stage};
use crate::render::{Converged, Film, PixelSampler, average, reference_replicate};

/// A scene's converged reference. Rendered by the reference system, or put there by the author from
/// an earlier run.
#[derive(Component, Clone, Debug)]
pub struct ReferenceImage(pub Arc<Converged>);

/// Replicates of a reference that is still converging.
#[derive(Component, Clone, Debug, Default)]
struct Replicates(Vec<Film>);

pub(super) fn plugin(schedule: &mut Schedule) {
    schedule.add_systems(converge.in_set(Stage::Reference));
}

/// Renders one more replicate of the current scene's reference; the last completes it.
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
    let done = replicates.as_ref().map_or(0, |r| r.0.len()) as u32;
    let sampler = PixelSampler::new(plan.spp / plan.replicates);
    let stop = || halt.now();
    let number = plan.first + done;
    let replicate = reference_replicate(&staged.view, truth, &sampler, seed.0, number, &stop);
    let Ok(film) = replicate else { return };
    let mut films = replicates.map(|mut r| std::mem::take(&mut r.0)).unwrap_or_default();
    films.push(film);
    let mut scene = commands.entity(current.0);
    if films.len() == plan.replicates as usize {
        scene.insert(ReferenceImage(Arc::new(average(&films, plan.spp)))).remove::<Replicates>();
    } else {
        scene.insert(Replicates(films));
    }
    progress.write(Progress::Converged { scene: current.0 });
}
