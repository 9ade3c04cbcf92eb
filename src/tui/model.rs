//! The model: all that the view draws.

use std::time::SystemTime;

use ratatui::layout::Rect;

use super::experiments::Experiments;
use super::keys::Context;
use super::lab::{self, Lab};
use super::picture::Screen;
use super::results::{self, Results};

/// One of the three panes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pane {
    /// Runs of experiments.
    #[default]
    Experiments,
    /// One scene, live.
    Lab,
    /// Reports of earlier runs.
    Results,
}

impl Pane {
    /// All of them, in order.
    pub const ALL: [Self; 3] = [Self::Experiments, Self::Lab, Self::Results];

    /// Its title.
    pub fn title(self) -> &'static str {
        match self {
            Self::Experiments => "Experiments",
            Self::Lab => "Lab",
            Self::Results => "Results",
        }
    }
}

/// What lies over a pane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Popup {
    /// Nothing.
    #[default]
    None,
    /// The page of keys, from this line on.
    Help(usize),
    /// Whether to quit though a run is under way.
    Quit,
}

/// The line at the foot: what was last said.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Status {
    /// A sentence; empty if there is nothing to say.
    pub text: String,
    /// Whether something is wrong.
    pub problem: bool,
}

/// Everything.
#[derive(Debug)]
pub struct Model {
    /// Columns and rows of the terminal.
    pub size: [u16; 2],
    /// What the terminal can show.
    pub screen: Screen,
    /// The time, as last heard.
    pub now: SystemTime,
    /// The pane that is shown.
    pub pane: Pane,
    /// What lies over it.
    pub popup: Popup,
    /// What was last said.
    pub status: Status,
    /// Whether the mouse is ours.
    pub mouse: bool,
    /// Runs of experiments.
    pub experiments: Experiments,
    /// One scene, live.
    pub lab: Lab,
    /// Reports of earlier runs.
    pub results: Results,
}

/// Columns and rows under which the program only says that the terminal is too small.
pub const LEAST: [u16; 2] = [60, 16];

impl Model {
    /// A model at the beginning, on a terminal of this size.
    pub fn new(size: [u16; 2], screen: Screen, now: SystemTime) -> Self {
        Self {
            size,
            screen,
            now,
            pane: Pane::default(),
            popup: Popup::default(),
            status: Status::default(),
            mouse: true,
            experiments: Experiments::default(),
            lab: Lab::default(),
            results: Results::default(),
        }
    }

    /// What has the focus, from the most special to the most general.
    pub fn contexts(&self) -> Vec<Context> {
        match self.popup {
            Popup::Quit => vec![Context::Question],
            Popup::Help(_) => vec![Context::Help],
            Popup::None => {
                let mut contexts = match self.pane {
                    Pane::Experiments => vec![Context::Experiments],
                    Pane::Lab => self.lab.focus.contexts().to_vec(),
                    Pane::Results => self.results.focus.contexts().to_vec(),
                };
                contexts.push(Context::Everywhere);
                contexts
            }
        }
    }

    /// All contexts that can hold together.
    pub fn all_contexts() -> Vec<Vec<Context>> {
        let mut all =
            vec![vec![Context::Question], vec![Context::Help], vec![Context::Experiments]];
        all.extend(lab::Focus::ALL.map(|focus| focus.contexts().to_vec()));
        all.extend(results::Focus::ALL.map(|focus| focus.contexts().to_vec()));
        all[2..].iter_mut().for_each(|contexts| contexts.push(Context::Everywhere));
        all
    }

    /// Whether the terminal is too small to show anything.
    pub fn is_too_small(&self) -> bool {
        self.size[0] < LEAST[0] || self.size[1] < LEAST[1]
    }

    /// Where the pane is: between the line of titles and the two lines at the foot.
    pub fn pane_area(&self) -> Rect {
        let [columns, rows] = self.size;
        Rect::new(0, 1, columns, rows.saturating_sub(3))
    }

    /// Says something.
    pub fn say(&mut self, text: impl Into<String>, problem: bool) {
        self.status = Status { text: plain(&text.into()), problem };
    }
}

/// A text without control characters, which a terminal would obey: they, and line ends, become spaces.
pub fn plain(text: &str) -> String {
    let words: Vec<&str> = text.split(|c: char| c.is_control() || c == '\u{feff}').collect();
    let kept: Vec<&str> =
        words.into_iter().map(str::trim).filter(|word| !word.is_empty()).collect();
    kept.join(" ")
}

/// [`plain`], spaces kept.
pub fn plain_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_left_out() {
        assert_eq!(plain("a\x1b[31mb\nc\u{9b}d"), "a [31mb c d");
        assert_eq!(plain("\r\n"), "");
    }
}
