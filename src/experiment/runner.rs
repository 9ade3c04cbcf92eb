//! The runner: works through the scenes of an experiment, keeps what is done, and takes up what an
//! earlier run kept.

mod budget;
mod part;
mod records;
mod tell;

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use bevy_ecs::prelude::Entity;

pub use super::event::{RunEvent, Watcher, unwatched};
pub use part::{missing, run_units, units};

use super::author::{Plan, PlannedScene, PlannedTrial, author, load};
use super::collect::collect;
use super::keys;
use super::results::{Costs, Results};
use super::spec::{EnvironmentSource, LightSpec, Spec, TextureSpec};
use super::store::{Store, StoreError};
use super::work::Work;
use crate::light::environment::{self, EnvironmentError};
use crate::scene::{
    Current, Exposure, Failure, Halt, LoadError, Prefilter, ReferenceImage, Replicates, Stagehand,
    Watch,
};

/// How a run ended, if not in an error.
#[derive(Debug)]
pub enum Outcome {
    /// All of it is done.
    Finished(Box<(Results, Costs)>),
    /// It was halted; what was finished is kept.
    Halted,
}

/// Why a run could not go on.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// A texture could not be loaded.
    #[error("texture `{texture}`: {source}")]
    Texture {
        /// Its name.
        texture: String,
        /// Why.
        source: LoadError,
    },
    /// A model could not be read.
    #[error("[surface]: {0}")]
    Surface(LoadError),
    /// An environment could not be read.
    #[error("[light]: {0}")]
    Light(#[from] EnvironmentError),
    /// Results could not be kept.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// Runs an experiment, with its results kept in `folder`, until it is done or `halt` is set.
///
/// # Errors
/// If a texture or an environment cannot be loaded or results cannot be written. Textures that are files are read
/// first, so that a bad one is told before any work is done.
///
/// Only one run may work in a folder at a time: hold its [`super::lock::Lock`].
pub fn run(spec: &Spec, folder: &Path, halt: &Halt, watch: &Watcher) -> Result<Outcome, RunError> {
    let start = Instant::now();
    let Desk { mut stage, plan, store, work } = Desk::lay(spec, folder, halt, watch)?;
    let mut run =
        Run { spec, plan: &plan, store: &store, stage: &mut stage, watch, work, left: 0.0 };
    run.announce();
    for (number, scene) in (1..).zip(&plan.scenes) {
        if !run.scene(number, scene)? {
            return Ok(Outcome::Halted);
        }
        run.tell_flicker(scene);
    }
    store.clear_images();
    let costs = Costs {
        total_secs: start.elapsed().as_secs_f64(),
        threads: rayon::current_num_threads(),
        ..Costs::default()
    };
    Ok(Outcome::Finished(Box::new(collect(spec, &plan, &store, &mut stage, costs))))
}

/// All that a run works with.
struct Desk {
    stage: Stagehand,
    plan: Plan,
    store: Store,
    work: Work,
}

impl Desk {
    /// Reads and lays out all that an experiment needs.
    fn lay(spec: &Spec, folder: &Path, halt: &Halt, watch: &Watcher) -> Result<Self, RunError> {
        let work = Work::of(spec, texels(spec)?);
        if let LightSpec::Environment { source: EnvironmentSource::File { path }, .. } = &spec.light
        {
            environment::inspect(path)?;
        }
        let mut stage = Stagehand::new(spec.seed, halt.clone());
        let watch = Arc::clone(watch);
        stage.world.insert_resource(Watch(Arc::new(move |part| watch(RunEvent::Partly { part }))));
        let plan = author(spec, &mut stage);
        let store = Store::open(folder, &keys::common(spec))?;
        stage.world.insert_resource(store.shelf());
        Ok(Self { stage, plan, store, work })
    }
}

/// How much there is to an experiment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Units of work.
    pub work: f64,
    /// Scenes.
    pub scenes: usize,
    /// Trials.
    pub trials: usize,
}

/// How much there is to an experiment, if nothing of it was done before.
///
/// # Errors
/// If a texture cannot be loaded.
pub fn extent(spec: &Spec) -> Result<Extent, RunError> {
    let work = Work::of(spec, texels(spec)?);
    let plan = author(spec, &mut Stagehand::new(spec.seed, Halt::default()));
    Ok(Extent::of(&work, &plan))
}

impl Extent {
    fn of(work: &Work, plan: &Plan) -> Self {
        let trials = plan.scenes.iter().map(|scene| scene.trials.len()).sum();
        Self { work: work.all(plan), scenes: plan.scenes.len(), trials }
    }
}

/// The texels of each texture, once it is known that it can be had.
fn texels(spec: &Spec) -> Result<Vec<f64>, RunError> {
    let count = |texture: &TextureSpec| match load(texture, spec.needs_heights()) {
        Ok(bumps) => Ok((bumps.normals.width() * bumps.normals.height()) as f64),
        Err(source) => Err(RunError::Texture { texture: texture.name.clone(), source }),
    };
    spec.sweep.textures.iter().map(count).collect()
}

/// A run under way.
struct Run<'a> {
    spec: &'a Spec,
    plan: &'a Plan,
    store: &'a Store,
    stage: &'a mut Stagehand,
    watch: &'a Watcher,
    work: Work,
    /// Work of the current scene that nothing has been told of yet.
    left: f64,
}

impl Run<'_> {
    fn announce(&mut self) {
        let Extent { work, scenes, trials } = Extent::of(&self.work, self.plan);
        (self.watch)(RunEvent::Started { work, scenes, trials });
    }

    /// Tells that a piece of the current scene is done.
    fn advance(&mut self, work: f64, kept: bool) {
        self.left -= work;
        (self.watch)(RunEvent::Advanced { work, kept });
    }

    /// Works at one scene until it is done (true) or the run is halted (false).
    fn scene(&mut self, number: usize, scene: &PlannedScene) -> Result<bool, RunError> {
        let (slug, of) = (scene.slug.clone(), self.plan.scenes.len());
        (self.watch)(RunEvent::Scene { slug, part: None, number, of });
        self.left = self.work.scene(scene);
        self.take_up(scene);
        self.take_up_budgets(scene);
        self.stage.world.insert_resource(Current(scene.entity));
        let done = self.complete(scene) || self.work_at(scene)?;
        if done {
            self.stage.world.entity_mut(scene.entity).remove::<Replicates>();
            self.let_go(scene);
            // Trials that a method refused.
            self.advance(self.left, true);
        }
        Ok(done)
    }

    /// Works at what is pending of a scene until nothing is (true) or the run is halted (false).
    fn work_at(&mut self, scene: &PlannedScene) -> Result<bool, RunError> {
        loop {
            let (what, work) = self.next_piece(scene);
            (self.watch)(RunEvent::Working { what, work });
            let done = self.stage.tick();
            if let Some(source) = self.stage.world.resource_mut::<Failure>().0.take() {
                // Textures were read before any work began.
                return Err(if self.spec.surface.model.is_some() {
                    RunError::Surface(source)
                } else {
                    let texture = self.spec.sweep.textures[scene.texture].name.clone();
                    RunError::Texture { texture, source }
                });
            }
            if done.is_empty() {
                break;
            }
            for piece in done {
                self.keep(scene, &piece)?;
            }
        }
        Ok(!self.stage.world.resource::<Halt>().now())
    }

    /// Lets go of what no later scene needs: the maps of the texture after its last scene.
    fn let_go(&mut self, scene: &PlannedScene) {
        if !self.plan.is_last_of_its_prefilters(scene) {
            return;
        }
        for (method, &prefilter) in scene.prefilters.iter().enumerate() {
            match self.stage.world.get::<Prefilter>(prefilter) {
                Some(built) if built.0.is_ok() => {
                    self.stage.world.entity_mut(prefilter).remove::<Prefilter>();
                }
                // A refusal is small and is reported; a map is neither.
                Some(_) => {}
                // All its scenes were taken up: nothing asked for it.
                None => {
                    let work = self.work.prefilter(scene, method);
                    (self.watch)(RunEvent::Advanced { work, kept: true });
                }
            }
        }
    }

    /// What the next tick will begin with, in a few words, and its work.
    fn next_piece(&self, scene: &PlannedScene) -> (String, f64) {
        let world = &self.stage.world;
        let missing = |&p: &Entity| world.get::<Prefilter>(p).is_none();
        if let Some(method) = scene.prefilters.iter().position(missing) {
            let what = format!("prefiltering for {}", self.spec.sweep.methods[method].label);
            return (what, self.work.prefilter(scene, method));
        }
        if world.get::<ReferenceImage>(scene.entity).is_none() {
            let further = world
                .get::<Replicates>(scene.entity)
                .is_some_and(|so_far| so_far.0.replicates() >= self.spec.reference.replicates);
            let what = if further {
                "sampling the reference further, to tell methods apart"
            } else {
                "converging the reference"
            };
            return (what.to_owned(), if further { 0.0 } else { self.work.replicate() });
        }
        let taken = |trial: &PlannedTrial| {
            world.get::<Prefilter>(scene.prefilters[trial.method]).is_some_and(|p| p.0.is_ok())
        };
        let pending =
            |trial: &&PlannedTrial| taken(trial) && world.get::<Exposure>(trial.entity).is_none();
        match scene.trials.iter().find(pending) {
            Some(trial) => {
                let label = &self.spec.sweep.methods[trial.method].label;
                (format!("rendering {label} at {} spp", trial.spp), self.work.trial(trial))
            }
            None if self.wants_budgets(scene) => ("sharing errors out".to_owned(), 0.0),
            None => ("measuring".to_owned(), 0.0),
        }
    }
}
