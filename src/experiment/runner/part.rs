//! Runs of a part of an experiment, and what of an experiment is there.

use std::path::Path;

use super::super::author::{Plan, PlannedScene, author};
use super::super::work::Work;
use super::{Desk, Halt, Run, RunError, Spec, Stagehand, Watcher, texels, unwatched};

/// The experiment's units of work, by their weights, in the order of the plan: a unit is a scene, or all frames of
/// a sequence. What is prefiltered for several units weighs with the first of them.
///
/// # Errors
/// If a texture cannot be loaded.
pub fn units(spec: &Spec) -> Result<Vec<f64>, RunError> {
    let work = Work::of(spec, texels(spec)?);
    let plan = author(spec, &mut Stagehand::new(spec.seed, Halt::default()));
    let weight = |unit: &[PlannedScene]| {
        let first = plan.scenes.iter().find(|scene| scene.prefilters == unit[0].prefilters);
        let opens = first.is_some_and(|first| first.entity == unit[0].entity);
        let prefilters = if opens { work.prefilters(&unit[0]) } else { 0.0 };
        prefilters + unit.iter().map(|scene| work.scene(scene)).sum::<f64>()
    };
    Ok(sequences(&plan).map(weight).collect())
}

/// Scenes of one sequence each.
fn sequences(plan: &Plan) -> impl Iterator<Item = &[PlannedScene]> {
    plan.scenes.chunk_by(|one, next| one.sequence == next.sequence)
}

/// Runs some of the [`units`] of an experiment, those that are true in `mine`, with what is found kept in `folder`.
/// How many scenes these are; `None` if it was halted.
///
/// # Errors
/// As of [`super::run`].
pub fn run_units(
    spec: &Spec,
    mine: &[bool],
    folder: &Path,
    halt: &Halt,
    watch: &Watcher,
) -> Result<Option<usize>, RunError> {
    let Desk { mut stage, mut plan, store, work } = Desk::lay(spec, folder, halt, watch)?;
    let chosen = sequences(&plan).zip(mine).filter(|(_, mine)| **mine);
    plan.scenes = chosen.flat_map(|(unit, _)| unit.to_vec()).collect();
    let mut run =
        Run { spec, plan: &plan, store: &store, stage: &mut stage, watch, work, left: 0.0 };
    run.announce();
    for (number, scene) in (1..).zip(&plan.scenes) {
        if !run.scene(number, scene)? {
            return Ok(None);
        }
    }
    Ok(Some(plan.scenes.len()))
}

/// The slugs of the scenes of which not everything is kept in `folder`.
///
/// # Errors
/// As of [`super::run`].
pub fn missing(spec: &Spec, folder: &Path) -> Result<Vec<String>, RunError> {
    let watch = unwatched();
    let Desk { mut stage, plan, store, work } = Desk::lay(spec, folder, &Halt::default(), &watch)?;
    let mut run =
        Run { spec, plan: &plan, store: &store, stage: &mut stage, watch: &watch, work, left: 0.0 };
    let mut missing = Vec::new();
    for scene in &plan.scenes {
        run.take_up(scene);
        run.take_up_budgets(scene);
        if !run.complete(scene) {
            missing.push(scene.slug.clone());
        }
        // Its films are of no use here.
        run.stage.world.despawn(scene.entity);
        scene.trials.iter().for_each(|trial| {
            run.stage.world.despawn(trial.entity);
        });
    }
    Ok(missing)
}
