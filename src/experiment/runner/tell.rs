//! What a run tells of what it found.

use super::super::author::{PlannedScene, PlannedTrial};
use super::super::results::{Score, mean_distances};
use super::super::store::ProbeRecord;
use super::{Run, RunEvent};
use crate::metric::Flicker;
use crate::render::Film;
use crate::scene::{Exposure, ReferenceImage};

impl Run<'_> {
    /// Tells what a trial scored and cost.
    pub(super) fn tell_scores(
        &self,
        scene: &PlannedScene,
        trial: &PlannedTrial,
        scores: Vec<Score>,
        cpu_secs: f64,
        kept: bool,
    ) {
        let pixels = (self.spec.image.width * self.spec.image.height) as f64;
        (self.watch)(RunEvent::Scored {
            scene: scene.slug.clone(),
            method: self.spec.sweep.methods[trial.method].label.clone(),
            spp: trial.spp,
            scores,
            ns_per_pixel: cpu_secs * 1e9 / pixels,
            kept,
        });
    }

    /// Tells how far methods' distributions of normals are from the true ones.
    pub(super) fn tell_probes(&self, scene: &PlannedScene, probes: &[ProbeRecord]) {
        let means = mean_distances(probes.iter().map(|probe| probe.methods.as_slice()));
        let distances = means.into_iter().map(|(method, l1)| (method.to_owned(), l1)).collect();
        (self.watch)(RunEvent::Probed { scene: scene.slug.clone(), distances });
    }

    /// Tells how trials flicker over the sequence whose last frame this scene is, if it is one.
    pub(super) fn tell_flicker(&self, last: &PlannedScene) {
        let of_sequence = |scene: &&PlannedScene| scene.sequence == last.sequence;
        let frames: Vec<&PlannedScene> = self.plan.scenes.iter().filter(of_sequence).collect();
        if last.frame.is_none() || frames.last().is_none_or(|frame| frame.entity != last.entity) {
            return;
        }
        let world = &self.stage.world;
        let images = frames.iter().map(|frame| world.get::<ReferenceImage>(frame.entity));
        let Some(images) = images.collect::<Option<Vec<_>>>() else { return };
        let references: Vec<&Film> = images.iter().map(|image| &image.0.film).collect();
        let errors: Vec<f64> = images.iter().map(|image| image.0.mean_error).collect();
        for (place, trial) in last.trials.iter().enumerate() {
            // All frames have the same trials in the same order.
            let of_frame = |frame: &&PlannedScene| world.get(frame.trials[place].entity);
            let exposures: Option<Vec<&Exposure>> = frames.iter().map(of_frame).collect();
            let Some(exposures) = exposures else { continue };
            let films: Vec<&Film> = exposures.iter().map(|exposure| &*exposure.film).collect();
            let Some(flicker) = Flicker::of(&films, &references, &errors) else { continue };
            (self.watch)(RunEvent::Flickered {
                sequence: last.sequence.clone(),
                method: self.spec.sweep.methods[trial.method].label.clone(),
                spp: trial.spp,
                flicker: flicker.ratio(),
                error_flicker: flicker.error_ratio(),
            });
        }
    }
}
