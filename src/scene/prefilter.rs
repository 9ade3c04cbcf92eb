//! Strategies, and the maps they make ready.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use bevy_ecs::prelude::*;

use super::shelf::{Kept, Key, Shelf};
use super::{Current, Halt, Map, Material, Progress, SceneOf, Stage, Watch};
use crate::lobe::BaseLobe;
use crate::method::{self, Damaged, Method, PrefilterError, Prefiltered, Refusal};
use crate::texture::{Lookup, NormalMap};

/// A filter strategy: a method with its options. Its label in the experiment is its [`Name`].
#[derive(Component)]
#[require(Name)]
pub struct Strategy(pub Box<dyn Method>);

/// A prefilter: what a strategy makes of a texture for a material's base lobe. Spawned by the author
/// for each combination that a trial needs, filled in when its turn comes.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[require(LookupBy)]
#[allow(missing_docs)]
pub struct PrefilterOf {
    pub texture: Entity,
    pub strategy: Entity,
    pub material: Entity,
}

/// How a prefilter's trials look up what lies under a footprint.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LookupBy(pub Lookup);

/// A prefilter that is the same as another, spawned before, but for its [`LookupBy`]: it takes what that one
/// has.
#[derive(Component, Clone, Copy, Debug)]
pub struct SameAs(pub Entity);

/// A prefilter that was built, or the reason why it cannot be.
#[derive(Component, Clone)]
pub struct Prefilter(pub Built);

/// A prefiltered map, or why the method does not take the base lobe.
pub type Built = Result<Arc<dyn Prefiltered>, Refusal>;

/// What building it took, in this run or in the one that put it on the [`Shelf`].
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct BuildCost {
    /// Wall-clock seconds.
    pub secs: f64,
    /// Bytes held beyond the normal map.
    pub bytes: usize,
}

pub(super) fn plugin(schedule: &mut Schedule) {
    schedule.add_systems(prepare.in_set(Stage::Prefilter));
}

/// Builds one prefilter of the current scene that is still missing, or takes it from the shelf.
#[allow(clippy::type_complexity)]
fn prepare(
    mut commands: Commands,
    current: Res<Current>,
    (halt, watch, shelf): (Res<Halt>, Res<Watch>, Option<Res<Shelf>>),
    scenes: Query<&SceneOf>,
    (maps, strategies, materials): (Query<&Map>, Query<&Strategy>, Query<&Material>),
    (pending, built): (
        Query<(Entity, &PrefilterOf, Option<&SameAs>), Without<Prefilter>>,
        Query<(&Prefilter, &BuildCost)>,
    ),
    mut progress: MessageWriter<Progress>,
) {
    let Ok(scene) = scenes.get(current.0) else { return };
    let Ok(map) = maps.get(scene.texture) else { return };
    let wanted = |of: &PrefilterOf| of.texture == scene.texture && of.material == scene.material;
    // The smallest entity: query order is not promised.
    let next = pending.iter().filter(|(_, of, _)| wanted(of)).min_by_key(|(entity, ..)| *entity);
    let Some((prefilter, of, same)) = next else { return };
    if let Some((other, cost)) = same.and_then(|same| built.get(same.0).ok()) {
        commands.entity(prefilter).insert((other.clone(), *cost));
        progress.write(Progress::Reloaded { prefilter });
        return;
    }
    let (Ok(strategy), Ok(material)) = (strategies.get(of.strategy), materials.get(of.material))
    else {
        return;
    };
    let order = Order { map: &map.normals, method: &*strategy.0, base: &material.base };
    let place = shelf.as_deref().map(|shelf| Place::of(shelf, &order));
    let mut note = |text| progress.write(Progress::Noted { text });
    let reloaded = place.as_ref().and_then(|place| {
        place.reload(&order).unwrap_or_else(|damaged| {
            let path = place.path.display();
            note(format!("{path} is not usable ({damaged}); it is built again and replaced"));
            None
        })
    });
    if let Some(Reloaded { prefiltered, cost }) = reloaded {
        commands.entity(prefilter).insert((Prefilter(Ok(prefiltered)), cost));
        progress.write(Progress::Reloaded { prefilter });
        return;
    }
    let Some((built, cost)) = order.build(&Onlooker { halt: &halt, watch: &watch }) else { return };
    if let (Some(place), Ok(prefiltered)) = (&place, &built)
        && let Err(error) = place.keep(prefiltered.as_ref(), cost.secs)
    {
        let path = place.path.display();
        note(format!("cannot keep {path}: {error}; the next run builds it again"));
    }
    commands.entity(prefilter).insert((Prefilter(built), cost));
    progress.write(Progress::Prefiltered { prefilter });
}

/// What is to be prefiltered, how, and for which lobe.
struct Order<'a> {
    map: &'a Arc<NormalMap>,
    method: &'a dyn Method,
    base: &'a BaseLobe,
}

impl Order<'_> {
    /// Builds it; `None` if it was halted.
    fn build(&self, onlooker: &Onlooker) -> Option<(Built, BuildCost)> {
        let start = Instant::now();
        let built: Built = match self.method.prefilter(self.map, self.base, onlooker) {
            Ok(prefiltered) => Ok(Arc::from(prefiltered)),
            Err(PrefilterError::Refused(refusal)) => Err(refusal),
            Err(PrefilterError::Cancelled) => return None,
        };
        let secs = start.elapsed().as_secs_f64();
        let bytes = built.as_ref().map_or(0, |prefiltered| prefiltered.bytes());
        Some((built, BuildCost { secs, bytes }))
    }
}

/// Where a prefilter stands on the shelf.
struct Place<'a> {
    shelf: &'a Shelf,
    key: Key,
    path: PathBuf,
}

/// What stood on the shelf.
struct Reloaded {
    prefiltered: Arc<dyn Prefiltered>,
    cost: BuildCost,
}

impl<'a> Place<'a> {
    fn of(shelf: &'a Shelf, order: &Order) -> Self {
        let key = shelf.key(order.map, order.method, order.base);
        Self { shelf, path: shelf.path(&key), key }
    }

    /// The prefilter and what building it took, if it stands there.
    fn reload(&self, order: &Order) -> Result<Option<Reloaded>, Damaged> {
        let Some(kept) = self.shelf.find(&self.path, &self.key)? else { return Ok(None) };
        let restored = order.method.restore(order.map, order.base, &kept.bytes)?;
        let cost = BuildCost { secs: kept.secs, bytes: restored.bytes() };
        Ok(Some(Reloaded { prefiltered: Arc::from(restored), cost }))
    }

    /// Puts a prefilter there, if it is of a kind that is kept.
    fn keep(&self, built: &dyn Prefiltered, secs: f64) -> std::io::Result<()> {
        let Some(bytes) = built.store() else { return Ok(()) };
        self.shelf.keep(&self.path, &self.key, &Kept { bytes, secs })
    }
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
