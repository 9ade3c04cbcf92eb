//! The lab: one scene, live, through every method, with the truth beside them.

mod bench;
mod disc;
#[cfg(test)]
pub(in crate::tui) mod fixture;
mod setting;
mod setup;
mod told;
mod update;
#[cfg(test)]
mod update_tests;
mod view;
mod worker;

pub use setting::Setting;
pub use setup::Setup;
pub use told::{Finding, Held, Look, Order, Score, Told, Under, Wanted};
pub use update::{act, click, enter, open, take};
pub use view::{Layout, draw};
pub use worker::{Tell, Worker};

use super::keys::Context;
use super::viewer::Viewer;
use crate::experiment::spec::Spec;

/// What of the lab has the focus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Focus {
    /// The picture and its cursor.
    Picture,
    /// The settings.
    Settings,
    /// The methods and their numbers.
    #[default]
    Methods,
    /// The distributions of normals under the cursor.
    Normals,
}

impl Focus {
    /// All of them, in the order they take turns.
    pub const ALL: [Self; 4] = [Self::Methods, Self::Settings, Self::Normals, Self::Picture];

    /// Where its keys are looked for.
    pub fn contexts(self) -> &'static [Context] {
        use Context::{Cursor, Lab, Methods, Picture, Settings};
        match self {
            Self::Settings => &[Settings, Lab, Picture],
            Self::Methods => &[Methods, Lab, Picture],
            Self::Normals | Self::Picture => &[Cursor, Lab, Picture],
        }
    }
}

/// A column that methods are ordered by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum By {
    /// The number keys.
    #[default]
    Number,
    /// The error.
    Error,
    /// The time a pixel.
    Time,
}

/// A method of the scene, and what is known of it.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// Its label.
    pub label: String,
    /// What it does, a sentence.
    pub summary: String,
    /// Why it takes no part, if it does not.
    pub refused: Option<String>,
    /// Its error.
    pub score: Option<Score>,
    /// CPU nanoseconds a pixel.
    pub ns_per_pixel: Option<f64>,
    /// Seconds its map took to build, and bytes a texel.
    pub built: Option<(f64, f64)>,
}

/// One scene, live.
#[derive(Debug, Default)]
pub struct Lab {
    /// What has the focus.
    pub focus: Focus,
    /// The spec that keys edit; None before anything is open.
    pub setup: Option<Setup>,
    /// The spec as it stands.
    pub spec: Option<Spec>,
    /// The scene's number: it counts changes.
    pub scene: u64,
    /// The setting that is chosen.
    pub setting: usize,
    /// The methods, in the order of the number keys.
    pub rows: Vec<Row>,
    /// The method that is chosen in the list.
    pub row: usize,
    /// What the list is ordered by.
    pub by: By,
    /// The images.
    pub viewer: Viewer,
    /// Samples a pixel and own error of the reference, once there is one.
    pub reference: Option<(u32, f64)>,
    /// What is being worked at, and how much of it is done.
    pub working: Option<(String, f64)>,
    /// Whether all is done.
    pub done: bool,
    /// Why the scene cannot be rendered.
    pub failed: Option<String>,
    /// What lies under the cursor.
    pub under: Option<Under>,
    /// What is known of the texture.
    pub notes: Vec<String>,
    /// Which images, by their number in the viewer, are of a scene that has been left.
    pub stale: Vec<bool>,
    /// What is being opened.
    pub opening: Option<String>,
}

impl Lab {
    /// The places of the methods in the list, as it is ordered.
    pub fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.rows.len()).collect();
        let key = |m: &usize| match self.by {
            By::Number => None,
            By::Error => Some(self.rows[*m].score.map_or(f64::INFINITY, |score| score.rmse)),
            By::Time => Some(self.rows[*m].ns_per_pixel.unwrap_or(f64::INFINITY)),
        };
        order.sort_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal));
        order
    }

    /// The methods on the sides, by their places in the spec.
    pub fn shown(&self) -> Vec<usize> {
        let mut shown: Vec<usize> = Vec::new();
        let on = self.viewer.on as usize;
        for side in [self.viewer.sides[on], self.viewer.sides[1 - on]] {
            if side > 0 && !shown.contains(&(side - 1)) {
                shown.push(side - 1);
            }
        }
        shown
    }
}
