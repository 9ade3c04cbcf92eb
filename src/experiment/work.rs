//! How much work there is to an experiment, for its progress: guesses that need only be about right.
//!
//! The unit is the time of one unfiltered sample.

use super::author::{Plan, PlannedScene, PlannedTrial};
use super::spec::{MethodSpec, Spec};
use crate::method;

/// The work of an experiment's pieces.
pub(super) struct Work {
    pixels: f64,
    reference_spp: f64,
    replicates: f64,
    /// Texels of each texture.
    texels: Vec<f64>,
    /// Work a texel of each method's prefilter.
    prefilters: Vec<f64>,
}

impl Work {
    /// The work of `spec`, whose textures have these many texels.
    pub fn of(spec: &Spec, texels: Vec<f64>) -> Self {
        let a_texel = |of: &MethodSpec| {
            let entry = method::find(of.name);
            entry.map_or(0.0, |entry| (entry.build)(&of.values).prefilter_work())
        };
        Self {
            pixels: (spec.image.width * spec.image.height) as f64,
            reference_spp: f64::from(spec.reference.spp),
            replicates: f64::from(spec.reference.replicates),
            texels,
            prefilters: built_once(&spec.sweep.methods, a_texel),
        }
    }

    /// Of a trial. A filtered sample costs several bare ones, and an image has some cost of its own.
    pub fn trial(&self, trial: &PlannedTrial) -> f64 {
        self.pixels * (4.0 + f64::from(trial.spp))
    }

    /// Of a scene's reference.
    pub fn reference(&self) -> f64 {
        self.pixels * self.reference_spp
    }

    /// Of one replicate of a reference.
    pub fn replicate(&self) -> f64 {
        self.reference() / self.replicates
    }

    /// Of a method's prefilter of a scene's texture.
    pub fn prefilter(&self, scene: &PlannedScene, method: usize) -> f64 {
        self.prefilters[method] * self.texels[scene.texture]
    }

    /// Of a scene, without its prefilters: they may serve others too.
    pub fn scene(&self, scene: &PlannedScene) -> f64 {
        self.reference() + scene.trials.iter().map(|trial| self.trial(trial)).sum::<f64>()
    }

    /// Of all prefilters of a scene.
    pub fn prefilters(&self, scene: &PlannedScene) -> f64 {
        (0..self.prefilters.len()).map(|method| self.prefilter(scene, method)).sum()
    }

    /// Of everything.
    pub fn all(&self, plan: &Plan) -> f64 {
        let last = |scene: &&PlannedScene| plan.is_last_of_its_prefilters(scene);
        plan.scenes.iter().map(|scene| self.scene(scene)).sum::<f64>()
            + plan.scenes.iter().filter(last).map(|scene| self.prefilters(scene)).sum::<f64>()
    }
}

/// The work of each method's prefilter; none for one that an earlier method has as well.
fn built_once(methods: &[MethodSpec], work: impl Fn(&MethodSpec) -> f64) -> Vec<f64> {
    let before = |k: usize| methods[..k].iter().any(|other| other.same_filter(&methods[k]));
    let each = |(k, method)| if before(k) { 0.0 } else { work(method) };
    methods.iter().enumerate().map(each).collect()
}
