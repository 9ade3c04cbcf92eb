//! A filtered map under an environment.

use super::View;
use crate::light::environment::Environment;
use crate::light::{Filter, Seen, mirrored};
use crate::method::{MeanNormals, Prefiltered};

/// What samples of a trial see.
pub(super) struct Trial<'a> {
    pub view: &'a View,
    pub environment: &'a Environment,
    pub filter: Filter,
    pub prefiltered: &'a dyn Prefiltered,
    pub means: Option<MeanNormals>,
    /// The part of a pixel's side that a sample stands for.
    pub spacing: f64,
}

impl Trial<'_> {
    /// What the ray through image point (x, y) sees; None if it misses.
    pub fn sees(&self, x: f64, y: f64) -> Option<Seen> {
        let sight = self.view.sight(x, y, self.spacing)?;
        let surface = self.prefiltered.lobes_at(&sight.footprint);
        let mean = self.means.as_ref().map(|means| means.at(&sight.footprint));
        let view = sight.frame.local_from_world(sight.view);
        let view = [view.x, view.y, view.z].map(|c| c as f32);
        Some(mirrored(self.environment, self.filter, &surface, mean, &sight.frame, view))
    }
}
