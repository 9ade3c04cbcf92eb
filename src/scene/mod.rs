//! Floor 5: the ECS. Scenes, textures, filter strategies and trials are entities; one plugin a
//! concern wires its systems into an ordered schedule. Systems are thin: the work is on the floors
//! below.
//!
//! # How it runs
//! An author (the experiment, on the floor above) spawns entities and names the scene to work at in
//! [`Current`]. Every run of the schedule is a *tick*: each set, in order, does at most one piece of
//! work for that scene — load its texture, build one prefilter, render one replicate of the reference,
//! one trial, score one trial, draw up budgets — and tells of it in a [`Progress`] message. When nothing is
//! pending the scene is done. Systems run one after another, so that timings mean something, and use all
//! cores inside.

mod budget;
mod light;
mod measure;
mod prefilter;
mod reference;
mod settle;
mod shelf;
mod surface;
mod texture;
mod trial;

pub use budget::{Balance, BudgetPlan, Budgets, Entry};
pub use light::{Kindled, LightOrigin, MovedLight};
pub use measure::{Held, Probe, ProbedMethod, Probes, Scores, Under, look_under};
pub use prefilter::{BuildCost, LookupBy, Prefilter, PrefilterOf, SameAs, Strategy};
pub use reference::{ReferenceImage, Replicates};
pub use settle::Settled;
pub use shelf::Shelf;
pub use surface::{Shaped, SurfaceOrigin};
pub use texture::{BumpSource, LoadError, Map, Texture};
pub use trial::{Exposure, Spp, StagedScene, TrialOf, stage};

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use bevy_ecs::error::{BevyError, ErrorContext, FallbackErrorHandler};
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::{LogLevel, ScheduleBuildSettings, SingleThreadedExecutor};

use crate::light::Light;
use crate::lobe::{BaseLobe, Shading};
use crate::method::Truth;
use crate::render::Camera;
use crate::surface::Shape;

/// The sets of systems, in the order they run in a tick.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Bump sources become normal maps.
    Texture,
    /// Normal maps become prefiltered maps, one for each strategy.
    Prefilter,
    /// The scene's reference converges.
    Reference,
    /// Trials gain films.
    Render,
    /// Trials gain scores; footprints are probed.
    Measure,
    /// Errors are shared out among the parts of their methods.
    Budget,
}

/// What a surface is made of.
#[derive(Component, Clone, Copy, Debug)]
pub struct Material {
    /// The lobe of the unbumped surface.
    pub base: BaseLobe,
    /// How lobes become light.
    pub shading: Shading,
}

/// The form of a surface, not yet tiled.
#[derive(Component, Clone, Debug)]
pub struct SurfaceShape(pub Shape);

/// A camera, placed.
#[derive(Component, Clone, Copy, Debug)]
pub struct CameraPose {
    /// The camera.
    pub camera: Camera,
    /// Its distance from what it looks at, scene units.
    pub distance: f64,
}

/// A light that is there.
#[derive(Component, Clone, Debug)]
pub struct LightSource(pub Light);

/// A scene: which texture, on which surface, before which camera, under which light, of which
/// material. Each names an entity.
#[derive(Component, Clone, Copy, Debug)]
#[allow(missing_docs)]
pub struct SceneOf {
    pub texture: Entity,
    pub surface: Entity,
    pub camera: Entity,
    pub light: Entity,
    pub material: Entity,
}

/// How the texture is laid on the scene's surface.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub enum Tiling {
    /// As many tiles as put this many texels across the pixel at the image's centre.
    TexelsPerPixel(f64),
    /// This many tiles to a scene unit.
    Tiles(f64),
}

/// The camera that a scene's texture is tiled before, where it is not the scene's own: the frames of a sequence
/// share the tiling of their first.
#[derive(Component, Clone, Copy, Debug)]
pub struct TiledBefore(pub Entity);

/// Samples of the scene's reference.
#[derive(Component, Clone, Copy, Debug)]
pub struct ReferencePlan {
    /// Samples a pixel of each replicate.
    pub spp: u32,
    /// Independent replicates, at least 2. Doubled while it is open which trial is nearest, up to `most`.
    pub replicates: u32,
    /// The most replicates there may be.
    pub most: u32,
    /// The least relative difference of root mean square errors that it is to tell apart.
    pub gap: f64,
    /// Number of the first replicate, at least 1: replicate 0 belongs to the trials. References whose numbers
    /// differ share no random number.
    pub first: u32,
    /// What it shows of the bumps.
    pub truth: Truth,
}

/// Pixels whose footprints' distributions are looked at, or where the surface is not there, those nearest to them.
#[derive(Component, Clone, Debug)]
pub struct ProbePlan(pub Vec<[usize; 2]>);

/// The seed of every random choice.
#[derive(Resource, Clone, Copy, Debug)]
pub struct Seed(pub u64);

/// The scene that the next tick works at.
#[derive(Resource, Clone, Copy, Debug)]
pub struct Current(pub Entity);

/// Set from outside to stop: long work looks at it often.
#[derive(Resource, Clone, Debug, Default)]
pub struct Halt(pub Arc<AtomicBool>);

impl Halt {
    /// Whether to stop.
    pub fn now(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Told how far the long piece of work under way is, from 0 to 1, from any thread.
#[derive(Resource, Clone)]
pub struct Watch(pub Arc<dyn Fn(f64) + Send + Sync>);

impl Default for Watch {
    /// Nobody watches.
    fn default() -> Self {
        Self(Arc::new(|_| {}))
    }
}

/// Why the scene cannot go on; systems put the first such reason here and do nothing more.
#[derive(Resource, Debug, Default)]
pub struct Failure(pub Option<LoadError>);

/// What a tick did.
#[derive(Message, Clone, Debug, PartialEq, Eq)]
pub enum Progress {
    /// A texture was loaded or made.
    Loaded {
        /// The texture.
        texture: Entity,
    },
    /// A light was made ready.
    Lit {
        /// The light.
        light: Entity,
    },
    /// A surface was made ready.
    Shaped {
        /// The surface.
        surface: Entity,
    },
    /// A map was prefiltered, or a strategy refused its base lobe.
    Prefiltered {
        /// The prefilter.
        prefilter: Entity,
    },
    /// A map that an earlier run had prefiltered was taken from the [`Shelf`].
    Reloaded {
        /// The prefilter.
        prefilter: Entity,
    },
    /// Something that whoever waits should know, in a sentence.
    Noted {
        /// The sentence.
        text: String,
    },
    /// The reference has converged by another replicate.
    Converged {
        /// The scene.
        scene: Entity,
    },
    /// A trial was rendered.
    Rendered {
        /// The trial.
        trial: Entity,
    },
    /// A trial was scored.
    Scored {
        /// The trial.
        trial: Entity,
    },
    /// The reference leaves open which trial is nearest: it is sampled further, and trials are scored again.
    Undecided {
        /// The scene.
        scene: Entity,
    },
    /// The reference is as good as it needs to be, or as it may be.
    Settled {
        /// The scene.
        scene: Entity,
    },
    /// A scene's footprints were probed.
    Probed {
        /// The scene.
        scene: Entity,
    },
    /// The budgets of a scene's errors were drawn up.
    Budgeted {
        /// The scene.
        scene: Entity,
    },
}

/// A world with its schedule.
pub struct Stagehand {
    /// The entities.
    pub world: World,
    schedule: Schedule,
}

impl Stagehand {
    /// An empty world, its random choices drawn from `seed`, that stops when `halt` is set.
    pub fn new(seed: u64, halt: Halt) -> Self {
        let mut world = World::new();
        world.insert_resource(Seed(seed));
        world.insert_resource(halt);
        world.insert_resource(Failure::default());
        world.insert_resource(Watch::default());
        world.insert_resource(FallbackErrorHandler(report_system_error));
        world.init_resource::<Messages<Progress>>();
        let mut schedule = Schedule::default();
        schedule.set_executor(SingleThreadedExecutor::new());
        schedule.set_build_settings(ScheduleBuildSettings {
            ambiguity_detection: LogLevel::Error,
            ..Default::default()
        });
        schedule.configure_sets(
            (
                Stage::Texture,
                Stage::Prefilter,
                Stage::Reference,
                Stage::Render,
                Stage::Measure,
                Stage::Budget,
            )
                .chain(),
        );
        for plugin in [
            texture::plugin,
            light::plugin,
            surface::plugin,
            prefilter::plugin,
            reference::plugin,
            trial::plugin,
            measure::plugin,
            settle::plugin,
            budget::plugin,
        ] {
            plugin(&mut schedule);
        }
        Self { world, schedule }
    }

    /// One tick; what it did. Empty when the current scene has nothing pending, has failed, or the
    /// world was halted.
    pub fn tick(&mut self) -> Vec<Progress> {
        if self.world.resource::<Halt>().now() || self.world.resource::<Failure>().0.is_some() {
            return Vec::new();
        }
        self.schedule.run(&mut self.world);
        self.world.resource_mut::<Messages<Progress>>().drain().collect()
    }
}

/// Systems here do not return errors; one that cannot run (a missing resource) is a programming error.
fn report_system_error(error: BevyError, context: ErrorContext) {
    panic!("system {} of kind {}: {error}", context.name(), context.kind());
}
