//! Budgets of a run: taken up, kept, told to be pending.

use super::super::author::PlannedScene;
use super::super::budget::{Budget, budgets, known};
use super::super::keys;
use super::{Run, RunError};
use crate::scene::{BudgetPlan, Budgets, ReferenceImage, Settled};

impl Run<'_> {
    /// Puts into the world the budgets that an earlier run drew up against the reference that the scene has.
    pub(super) fn take_up_budgets(&mut self, scene: &PlannedScene) {
        let world = &self.stage.world;
        if world.get::<Settled>(scene.entity).is_none() || !self.wants_budgets(scene) {
            return;
        }
        let Some(image) = world.get::<ReferenceImage>(scene.entity) else { return };
        let depends = keys::budget(self.spec, scene, &image.0.film);
        let found: Option<Vec<Budget>> = self.store.find(&scene.slug, keys::BUDGET, &depends);
        if let Some(found) = found {
            let found = known(self.spec, scene, found);
            self.stage.world.entity_mut(scene.entity).insert(found);
        }
    }

    /// Keeps the budgets of a scene.
    pub(super) fn keep_budgets(&self, scene: &PlannedScene) -> Result<(), RunError> {
        let world = &self.stage.world;
        let Some(image) = world.get::<ReferenceImage>(scene.entity) else { return Ok(()) };
        let depends = keys::budget(self.spec, scene, &image.0.film);
        let record = budgets(self.spec, scene, world);
        Ok(self.store.keep(&scene.slug, keys::BUDGET, &depends, &record)?)
    }

    /// Whether budgets of this scene are asked for and not there yet.
    pub(super) fn wants_budgets(&self, scene: &PlannedScene) -> bool {
        let world = &self.stage.world;
        let planned = world.get::<BudgetPlan>(scene.entity).is_some();
        planned && world.get::<Budgets>(scene.entity).is_none()
    }
}
