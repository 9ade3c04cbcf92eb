//! Strategies, and the maps they make ready.

use std::sync::Arc;
use std::time::Instant;

use bevy_ecs::prelude::*;

use super::{Current, Halt, Map, Material, Progress, SceneOf, Stage, Watch};
use crate::method::{self, Method, PrefilterError, Prefiltered, Refusal};

/// A filter strategy: a method with its options. Its label in the experiment is its [`Name`].
#[derive(Component)]
#[require(Name)]
pub struct Strategy(pub Box<dyn Method>);

/// A prefilter: what a strategy makes of a texture for a material's base lobe. Spawned by the author
/// for each combination that a trial needs, filled in when its turn comes.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub struct PrefilterOf {
    pub texture: Entity,
    pub strategy: Entity,
    pub material: Entity,
}

/// A prefilter that was built, or the reason why it cannot be.
#[derive(Component, Clone)]
pub struct Prefilter(pub Result<Arc<dyn Prefiltered>, Refusal>);

/// What building it took.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct BuildCost {
    /// Wall-clock seconds.
    pub secs: f64,
    /// Bytes held beyond the normal map.
    pub bytes: usize,
}

pub(super) fn plugin(schedule: &mut Schedule) {
    schedule.add_systems(build.in_set(Stage::Prefilter));
}

/// Builds one prefilter of the current scene that is still missing.
#[allow(clippy::type_complexity)]
fn build(
    mut commands: Commands,
    current: Res<Current>,
    (halt, watch): (Res<Halt>, Res<Watch>),
    scenes: Query<&SceneOf>,
    maps: Query<&Map>,
    strategies: Query<&Strategy>,
    materials: Query<&Material>,
    pending: Query<(Entity, &PrefilterOf), Without<Prefilter>>,
    mut progress: MessageWriter<Progress>,
) {
    let Ok(scene) = scenes.get(current.0) else { return };
    let Ok(map) = maps.get(scene.texture) else { return };
    let wanted = |of: &PrefilterOf| of.texture == scene.texture && of.material == scene.material;
    // The smallest entity: query order is not promised.
    let next = pending.iter().filter(|(_, of)| wanted(of)).min_by_key(|(entity, _)| *entity);
    let Some((entity, of)) = next else { return };
    let (Ok(strategy), Ok(material)) = (strategies.get(of.strategy), materials.get(of.material))
    else {
        return;
    };
    let start = Instant::now();
    let onlooker = Onlooker { halt: &halt, watch: &watch };
    let built = match strategy.0.prefilter(&map.normals, &material.base, &onlooker) {
        Ok(prefiltered) => Ok(Arc::from(prefiltered)),
        Err(PrefilterError::Refused(refusal)) => Err(refusal),
        Err(PrefilterError::Cancelled) => return,
    };
    let secs = start.elapsed().as_secs_f64();
    let bytes = built.as_ref().map_or(0, |p: &Arc<dyn Prefiltered>| p.bytes());
    commands.entity(entity).insert((Prefilter(built), BuildCost { secs, bytes }));
    progress.write(Progress::Prefiltered { prefilter: entity });
}

/// Hears how far a prefilter is, and lets it see that it should stop.
struct Onlooker<'a> {
    halt: &'a Halt,
    watch: &'a Watch,
}

impl method::Progress for Onlooker<'_> {
    fn advance(&self, done: usize, total: usize) {
        (self.watch.0)(done as f64 / total as f64);
    }

    fn cancelled(&self) -> bool {
        self.halt.now()
    }
}
