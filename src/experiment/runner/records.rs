//! Records of a run: what it takes up of an earlier one, and what it keeps.

use std::sync::Arc;

use bevy_ecs::prelude::Entity;

use super::super::author::{PlannedScene, PlannedTrial};
use super::super::collect::{known_scores, named_scores, probe_records};
use super::super::keys;
use super::super::store::{
    PrefilterRecord, ProbeRecord, ReferenceRecord, ScoresRecord, SettledRecord, TrialRecord,
};
use super::{Run, RunError, RunEvent};
use crate::render::Film;
use crate::scene::{
    BuildCost, Exposure, Prefilter, ProbePlan, Probes, Progress, ReferenceImage, ReferencePlan,
    Replicates, Scores, Settled,
};

impl Run<'_> {
    /// Puts into the world what an earlier run finished of this scene.
    pub(super) fn take_up(&mut self, scene: &PlannedScene) {
        if self.kept_probes(scene).is_some() {
            // They are read where results are collected.
            self.stage.world.entity_mut(scene.entity).remove::<ProbePlan>();
        }
        let settled: Option<SettledRecord> =
            self.store.find(&scene.slug, keys::SETTLED, &keys::settled(self.spec, scene));
        let planned = self.spec.reference.replicates;
        let kept = settled.filter(|settled| self.take_up_reference(scene, settled.replicates));
        if kept.is_some() {
            self.stage.world.entity_mut(scene.entity).insert(Settled);
        } else if !self.take_up_reference(scene, planned) {
            return self.take_up_films(scene);
        }
        self.advance(self.work.reference(), true);
        self.take_up_films(scene);
    }

    /// Puts into the world the scene's reference of so many replicates, if an earlier run had it.
    fn take_up_reference(&mut self, scene: &PlannedScene, replicates: u32) -> bool {
        let depends = keys::reference(self.spec, scene, replicates);
        let find = |name| self.store.find_with_film(&scene.slug, name, &depends);
        let errors: Option<((), Film)> =
            self.store.find_with_film(&scene.slug, keys::REFERENCE_ERROR, &depends);
        let found: Option<(ReferenceRecord, Film)> = find(keys::REFERENCE);
        let Some((ReferenceRecord { tally }, _)) =
            found.filter(|(record, _)| record.tally.is_sound())
        else {
            return false;
        };
        if errors.is_none() || tally.replicates() != replicates || replicates < 2 {
            return false;
        }
        let converged = tally.converged();
        let event = RunEvent::Converged { scene: scene.slug.clone(), rmse: converged.rmse };
        let image = ReferenceImage(Arc::new(converged));
        self.stage.world.entity_mut(scene.entity).insert((image, Replicates(tally)));
        (self.watch)(event);
        true
    }

    /// Puts into the world the films and scores of this scene's trials that an earlier run had.
    fn take_up_films(&mut self, scene: &PlannedScene) {
        for trial in &scene.trials {
            let name = keys::trial_name(self.spec, trial);
            let depends = keys::trial(self.spec, scene, trial);
            let found: Option<(TrialRecord, _)> =
                self.store.find_with_film(&scene.slug, &name, &depends);
            let Some((TrialRecord { cpu_secs }, film)) = found else { continue };
            let exposure = Exposure { film: Arc::new(film), cpu_secs };
            self.stage.world.entity_mut(trial.entity).insert(exposure);
            self.advance(self.work.trial(trial), true);
        }
        self.take_up_scores(scene);
    }

    /// Puts into the world the scores of films against the scene's reference that an earlier run had.
    fn take_up_scores(&mut self, scene: &PlannedScene) {
        let world = &self.stage.world;
        let Some(reference) = world.get::<ReferenceImage>(scene.entity) else { return };
        let reference = Arc::clone(&reference.0);
        for trial in &scene.trials {
            let Some(exposure) = self.stage.world.get::<Exposure>(trial.entity) else { continue };
            let cpu_secs = exposure.cpu_secs;
            let name = keys::scores_name(self.spec, trial);
            let depends = keys::scores(&exposure.film, &reference);
            let found: Option<ScoresRecord> = self.store.find(&scene.slug, &name, &depends);
            if let Some(ScoresRecord { scores }) = found {
                self.stage.world.entity_mut(trial.entity).insert(known_scores(&scores));
                self.tell_scores(scene, trial, scores, cpu_secs, true);
            }
        }
    }

    /// The scene's probes, if an earlier run or this one has kept them.
    fn kept_probes(&self, scene: &PlannedScene) -> Option<Vec<ProbeRecord>> {
        self.store.find(&scene.slug, keys::PROBES, &keys::probes(self.spec, scene))
    }

    /// Whether nothing of this scene is pending (its probes and refusals included); tells of the probes if so.
    pub(super) fn complete(&self, scene: &PlannedScene) -> bool {
        let world = &self.stage.world;
        let refused = |trial: &PlannedTrial| {
            let (folder, name) = keys::prefilter_name(self.spec, scene, trial.method);
            let depends = keys::prefilter(self.spec, scene, trial.method);
            let record: Option<PrefilterRecord> = self.store.find(&folder, &name, &depends);
            record.is_some_and(|record| record.refusal.is_some())
        };
        let done =
            |trial: &PlannedTrial| world.get::<Scores>(trial.entity).is_some() || refused(trial);
        if world.get::<Settled>(scene.entity).is_none() || !scene.trials.iter().all(done) {
            return false;
        }
        let probes = self.kept_probes(scene);
        if let Some(probes) = &probes {
            self.tell_probes(scene, probes);
        }
        probes.is_some() && !self.wants_budgets(scene)
    }

    /// Keeps a piece of work that a tick has done.
    pub(super) fn keep(&mut self, scene: &PlannedScene, piece: &Progress) -> Result<(), RunError> {
        match *piece {
            Progress::Loaded { .. } | Progress::Lit { .. } | Progress::Shaped { .. } => {}
            Progress::Prefiltered { prefilter } => self.keep_prefilter(scene, prefilter, false)?,
            Progress::Reloaded { prefilter } => self.keep_prefilter(scene, prefilter, true)?,
            Progress::Noted { ref text } => (self.watch)(RunEvent::Noted { text: text.clone() }),
            Progress::Converged { .. } => self.keep_reference(scene)?,
            Progress::Rendered { trial } => self.keep_trial(scene, trial)?,
            Progress::Scored { trial } => self.keep_scores(scene, trial)?,
            Progress::Undecided { .. } => self.look_for_more(scene),
            Progress::Settled { .. } => self.keep_settled(scene)?,
            Progress::Probed { .. } => self.keep_probes(scene)?,
            Progress::Budgeted { .. } => self.keep_budgets(scene)?,
        }
        Ok(())
    }

    /// Keeps what a prefilter cost, whether now or (`reloaded`) when an earlier run built it.
    fn keep_prefilter(
        &mut self,
        scene: &PlannedScene,
        entity: Entity,
        reloaded: bool,
    ) -> Result<(), RunError> {
        let world = &self.stage.world;
        let (Some(built), Some(cost)) =
            (world.get::<Prefilter>(entity), world.get::<BuildCost>(entity))
        else {
            return Ok(());
        };
        let record = match &built.0 {
            Ok(_) => PrefilterRecord { cost: Some((cost.secs, cost.bytes)), refusal: None },
            Err(refusal) => PrefilterRecord { cost: None, refusal: Some(refusal.0.clone()) },
        };
        let method = scene.prefilters.iter().position(|&p| p == entity).unwrap_or_default();
        let (folder, name) = keys::prefilter_name(self.spec, scene, method);
        let depends = keys::prefilter(self.spec, scene, method);
        self.store.keep(&folder, &name, &depends, &record)?;
        // Prefilters are counted beside the scenes, which may share them.
        let work = self.work.prefilter(scene, method);
        let kept = reloaded || record.refusal.is_some();
        (self.watch)(RunEvent::Advanced { work, kept });
        Ok(())
    }

    fn keep_reference(&mut self, scene: &PlannedScene) -> Result<(), RunError> {
        let entity = self.stage.world.entity(scene.entity);
        let Some(Replicates(tally)) = entity.get() else { return Ok(()) };
        // What tells trials apart beyond what was asked for was not counted as work to do.
        if tally.replicates() <= self.spec.reference.replicates {
            self.advance(self.work.replicate(), false);
        }
        let entity = self.stage.world.entity(scene.entity);
        let (Some(Replicates(tally)), Some(image)) = (entity.get(), entity.get::<ReferenceImage>())
        else {
            return Ok(());
        };
        let (slug, depends) = (&scene.slug, keys::reference(self.spec, scene, tally.replicates()));
        let record = ReferenceRecord { tally: tally.clone() };
        self.store.keep_with_film(slug, keys::REFERENCE, &depends, &record, &image.0.film)?;
        self.store.keep_with_film(slug, keys::REFERENCE_ERROR, &depends, &(), &image.0.error())?;
        (self.watch)(RunEvent::Converged { scene: slug.clone(), rmse: image.0.rmse });
        Ok(())
    }

    /// The reference is to have more replicates: an earlier run may have had them.
    fn look_for_more(&mut self, scene: &PlannedScene) {
        let planned =
            self.stage.world.get::<ReferencePlan>(scene.entity).map(|plan| plan.replicates);
        if planned.is_some_and(|replicates| self.take_up_reference(scene, replicates)) {
            self.take_up_scores(scene);
        }
    }

    fn keep_settled(&self, scene: &PlannedScene) -> Result<(), RunError> {
        let Some(Replicates(tally)) = self.stage.world.get(scene.entity) else { return Ok(()) };
        let record = SettledRecord { replicates: tally.replicates() };
        let depends = keys::settled(self.spec, scene);
        Ok(self.store.keep(&scene.slug, keys::SETTLED, &depends, &record)?)
    }

    fn keep_trial(&mut self, scene: &PlannedScene, entity: Entity) -> Result<(), RunError> {
        let Some(trial) = scene.trials.iter().find(|trial| trial.entity == entity) else {
            return Ok(());
        };
        let Some(exposure) = self.stage.world.get::<Exposure>(entity) else { return Ok(()) };
        let record = TrialRecord { cpu_secs: exposure.cpu_secs };
        let name = keys::trial_name(self.spec, trial);
        let depends = keys::trial(self.spec, scene, trial);
        self.store.keep_with_film(&scene.slug, &name, &depends, &record, &exposure.film)?;
        self.advance(self.work.trial(trial), false);
        Ok(())
    }

    fn keep_scores(&mut self, scene: &PlannedScene, entity: Entity) -> Result<(), RunError> {
        let Some(trial) = scene.trials.iter().find(|trial| trial.entity == entity) else {
            return Ok(());
        };
        let world = &self.stage.world;
        let (Some(exposure), Some(scores), Some(reference)) = (
            world.get::<Exposure>(entity),
            world.get::<Scores>(entity),
            world.get::<ReferenceImage>(scene.entity),
        ) else {
            return Ok(());
        };
        let scores = named_scores(scores);
        let name = keys::scores_name(self.spec, trial);
        let depends = keys::scores(&exposure.film, &reference.0);
        let record = ScoresRecord { scores };
        self.store.keep(&scene.slug, &name, &depends, &record)?;
        self.tell_scores(scene, trial, record.scores, exposure.cpu_secs, false);
        Ok(())
    }

    fn keep_probes(&mut self, scene: &PlannedScene) -> Result<(), RunError> {
        let Some(probes) = self.stage.world.get::<Probes>(scene.entity) else { return Ok(()) };
        let records = probe_records(self.spec, scene, probes);
        self.store.keep(&scene.slug, keys::PROBES, &keys::probes(self.spec, scene), &records)?;
        self.tell_probes(scene, &records);
        Ok(())
    }
}
