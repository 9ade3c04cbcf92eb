//! Records of a run: what it takes up of an earlier one, and what it keeps.

use std::sync::Arc;

use bevy_ecs::prelude::Entity;

use super::super::author::{PlannedScene, PlannedTrial};
use super::super::collect::{known_scores, named_scores, probe_records};
use super::super::keys;
use super::super::store::{PrefilterRecord, ProbeRecord, ReferenceRecord, TrialRecord};
use super::{Run, RunError, RunEvent};
use crate::render::Converged;
use crate::scene::{BuildCost, Exposure, Prefilter, Probes, Progress, ReferenceImage, Scores};

impl Run<'_> {
    /// Puts into the world what an earlier run finished of this scene.
    pub(super) fn take_up(&mut self, scene: &PlannedScene) {
        let (depends, slug) = (keys::reference(self.spec, scene), scene.slug.as_str());
        let world = &mut self.stage.world;
        let found: Option<(ReferenceRecord, _)> =
            self.store.find_with_film(slug, keys::REFERENCE, &depends);
        if let Some((record, film)) = found {
            let ReferenceRecord { spp, rmse, mean_error } = record;
            let converged = Converged { film, spp, rmse, mean_error };
            world.entity_mut(scene.entity).insert(ReferenceImage(Arc::new(converged)));
            self.advance(self.work.reference(), true);
            (self.watch)(RunEvent::Converged { scene: slug.to_owned(), rmse });
        }
        for trial in &scene.trials {
            let name = keys::trial_name(self.spec, trial);
            let depends = keys::trial(self.spec, scene, trial);
            let found: Option<(TrialRecord, _)> = self.store.find_with_film(slug, &name, &depends);
            if let Some((record, film)) = found {
                let exposure = Exposure { film: Arc::new(film), cpu_secs: record.cpu_secs };
                let scores = known_scores(&record.scores);
                let world = &mut self.stage.world;
                world.entity_mut(trial.entity).insert((exposure, scores));
                self.advance(self.work.trial(trial), true);
                self.tell_scores(scene, trial, record, true);
            }
        }
    }

    /// Whether nothing of this scene is pending (its probes and refusals included); tells of the probes if so.
    pub(super) fn complete(&self, scene: &PlannedScene) -> bool {
        let world = &self.stage.world;
        let depends = keys::probes(self.spec, scene);
        let refused = |trial: &PlannedTrial| {
            let (folder, name) = keys::prefilter_name(self.spec, scene, trial.method);
            let depends = keys::prefilter(self.spec, scene, trial.method);
            let record: Option<PrefilterRecord> = self.store.find(&folder, &name, &depends);
            record.is_some_and(|record| record.refusal.is_some())
        };
        let done =
            |trial: &PlannedTrial| world.get::<Scores>(trial.entity).is_some() || refused(trial);
        if world.get::<ReferenceImage>(scene.entity).is_none() || !scene.trials.iter().all(done) {
            return false;
        }
        let probes: Option<Vec<ProbeRecord>> = self.store.find(&scene.slug, keys::PROBES, &depends);
        if let Some(probes) = &probes {
            self.tell_probes(scene, probes);
        }
        probes.is_some()
    }

    /// Keeps a piece of work that a tick has done.
    pub(super) fn keep(&mut self, scene: &PlannedScene, piece: &Progress) -> Result<(), RunError> {
        match *piece {
            Progress::Loaded { .. }
            | Progress::Lit { .. }
            | Progress::Shaped { .. }
            | Progress::Rendered { .. } => {}
            Progress::Prefiltered { prefilter } => self.keep_prefilter(scene, prefilter, false)?,
            Progress::Reloaded { prefilter } => self.keep_prefilter(scene, prefilter, true)?,
            Progress::Noted { ref text } => (self.watch)(RunEvent::Noted { text: text.clone() }),
            Progress::Converged { .. } => self.keep_reference(scene)?,
            Progress::Scored { trial } => self.keep_trial(scene, trial)?,
            Progress::Probed { .. } => self.keep_probes(scene)?,
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
        self.advance(self.work.replicate(), false);
        let Some(image) = self.stage.world.get::<ReferenceImage>(scene.entity) else {
            return Ok(());
        };
        let Converged { spp, rmse, mean_error, .. } = *image.0;
        let record = ReferenceRecord { spp, rmse, mean_error };
        let depends = keys::reference(self.spec, scene);
        self.store.keep_with_film(
            &scene.slug,
            keys::REFERENCE,
            &depends,
            &record,
            &image.0.film,
        )?;
        (self.watch)(RunEvent::Converged { scene: scene.slug.clone(), rmse });
        Ok(())
    }

    fn keep_trial(&mut self, scene: &PlannedScene, entity: Entity) -> Result<(), RunError> {
        let Some(trial) = scene.trials.iter().find(|trial| trial.entity == entity) else {
            return Ok(());
        };
        let world = &self.stage.world;
        let (Some(exposure), Some(scores)) =
            (world.get::<Exposure>(entity), world.get::<Scores>(entity))
        else {
            return Ok(());
        };
        let record = TrialRecord { scores: named_scores(scores), cpu_secs: exposure.cpu_secs };
        let name = keys::trial_name(self.spec, trial);
        let depends = keys::trial(self.spec, scene, trial);
        self.store.keep_with_film(&scene.slug, &name, &depends, &record, &exposure.film)?;
        self.advance(self.work.trial(trial), false);
        self.tell_scores(scene, trial, record, false);
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
