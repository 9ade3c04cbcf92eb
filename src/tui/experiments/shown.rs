//! What chart and table show of a board.

use std::collections::BTreeSet;

use super::board::{Board, COST, Scene, Sequence, Trial, geometric_mean, mean};
use crate::tui::chart::{Bar, Key, Series, keys};
use crate::tui::table::{Cell, Column};

/// A chart of the pane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Plot {
    /// Error against samples a pixel.
    #[default]
    Error,
    /// How wrong images change from frame to frame, against samples a pixel.
    Flicker,
    /// Error against time a pixel.
    Cost,
    /// How far distributions of normals are from the truth.
    Normals,
}

impl Plot {
    /// All of them, in the order they take turns.
    pub const ALL: [Self; 4] = [Self::Error, Self::Flicker, Self::Cost, Self::Normals];

    /// Its title.
    pub fn title(self) -> &'static str {
        match self {
            Self::Error => "RMSE against samples",
            Self::Flicker => "Flicker of the error",
            Self::Cost => "RMSE against time",
            Self::Normals => "Distance of normals",
        }
    }

    /// The one after it.
    pub fn next(self) -> Self {
        let place = Self::ALL.iter().position(|plot| *plot == self).unwrap_or(0);
        Self::ALL[(place + 1) % Self::ALL.len()]
    }
}

/// Which scenes chart and table are of.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Which {
    /// The one that a run works at; all, if none does.
    #[default]
    Current,
    /// Means over all that every method took part in; of a paper's sweeps, over those of the first.
    All,
    /// Means over those of this part of a paper's sweeps.
    Part(String),
    /// The one of this slug.
    One(String),
}

/// What is shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown {
    /// Which scenes it is of, in words.
    pub of: String,
    /// The curves.
    pub series: Vec<Series>,
    /// The bars, where the plot has bars.
    pub bars: Vec<Bar>,
    /// The reference's own error.
    pub floor: Option<f64>,
    /// The columns of the table.
    pub columns: Vec<Column>,
    /// The rows of the table.
    pub rows: Vec<Vec<Cell>>,
}

/// Scenes and sequences that figures are taken from.
struct Choice<'a> {
    scenes: Vec<&'a Scene>,
    sequences: Vec<&'a Sequence>,
    words: String,
}

impl<'a> Choice<'a> {
    fn of(board: &'a Board, which: &Which, running: bool) -> Self {
        let measured = |scene: &&Scene| !scene.trials.is_empty();
        let (one, words) = match which {
            Which::Current if running => {
                (board.scenes.iter().rfind(measured), "the scene under way")
            }
            Which::One(slug) => (board.scenes.iter().find(|scene| scene.slug == *slug), ""),
            Which::Part(part) => return Self::all(board, Some(part)),
            Which::Current | Which::All => (None, ""),
        };
        let Some(scene) = one else { return Self::all(board, board.parts().first().copied()) };
        let words =
            if words.is_empty() { scene.slug.clone() } else { format!("{words}: {}", scene.slug) };
        let sequences = board.sequence_of(scene).into_iter().collect();
        Self { scenes: vec![scene], sequences, words }
    }

    fn all(board: &'a Board, part: Option<&str>) -> Self {
        let of_part = board.scenes_of(part);
        let (scenes, all) = (Board::full(&of_part), of_part.len());
        let words = match scenes.len() {
            0 => String::new(),
            1 if all == 1 => scenes[0].slug.clone(),
            shown if shown == all => format!("mean over all {all} scenes"),
            shown => format!("mean over {shown} of {all} scenes, where all methods take part"),
        };
        let words = match part {
            Some(part) if all > 1 => format!("{part}: {words}"),
            _ => words,
        };
        Self { scenes, sequences: board.sequences_of(part), words }
    }

    /// The methods and sample counts there are trials of.
    fn trials(&self) -> BTreeSet<(usize, u32)> {
        let of_scenes = self.scenes.iter().flat_map(|scene| scene.trials.keys());
        of_scenes.chain(self.sequences.iter().flat_map(|s| s.trials.keys())).copied().collect()
    }

    /// A figure of a trial: the mean over scenes, or over sequences. None unless every scene that the method took part
    /// in has it.
    fn figure(&self, trial: (usize, u32), metric: &str) -> Option<f64> {
        let get = |trial: Option<&Trial>| trial.and_then(|trial| trial.get(metric));
        if super::board::OF_SEQUENCES.contains(&metric) {
            return mean(self.sequences.iter().filter_map(|s| get(s.trials.get(&trial))));
        }
        let own = (trial.0, 0)..=(trial.0, u32::MAX);
        let took_part = |scene: &&&Scene| scene.trials.range(own.clone()).next().is_some();
        let scenes = self.scenes.iter().filter(took_part);
        let values: Option<Vec<f64>> = scenes.map(|scene| get(scene.trials.get(&trial))).collect();
        let values = values?.into_iter();
        // Sizes are compared by ratio, the rest is on scales of its own.
        if matches!(metric, "rmse" | COST) && self.scenes.len() > 1 {
            geometric_mean(values)
        } else {
            mean(values)
        }
    }

    fn normals(&self, method: usize) -> Option<f64> {
        mean(self.scenes.iter().filter_map(|scene| scene.normals.get(&method).copied()))
    }
}

/// What is shown of a board; `running` tells whether a run fills it.
pub fn shown(board: &Board, plot: Plot, which: &Which, running: bool) -> Shown {
    let choice = Choice::of(board, which, running);
    let keys = keys(&board.methods);
    let floor = geometric_mean(choice.scenes.iter().filter_map(|scene| scene.own_error));
    let bar = |(method, key): (usize, &Key)| {
        let (name, value) = (board.methods[method].0.clone(), choice.normals(method)?);
        Some(Bar { name, key: *key, value })
    };
    let bars = if plot == Plot::Normals {
        keys.iter().enumerate().filter_map(bar).collect()
    } else {
        Vec::new()
    };
    let columns = columns(!board.sequences.is_empty());
    Shown {
        series: series(board, &choice, &keys, plot),
        bars,
        floor: floor.filter(|_| matches!(plot, Plot::Error | Plot::Cost)),
        rows: rows(board, &choice, &columns),
        columns: columns.into_iter().map(|(_, column)| column).collect(),
        of: choice.words,
    }
}

fn series(board: &Board, choice: &Choice, keys: &[Key], plot: Plot) -> Vec<Series> {
    let point = |trial: (usize, u32)| {
        let spp = f64::from(trial.1);
        Some(match plot {
            Plot::Error => (spp, choice.figure(trial, "rmse")?),
            Plot::Flicker => (spp, choice.figure(trial, "error_flicker")?),
            Plot::Cost => (choice.figure(trial, COST)?, choice.figure(trial, "rmse")?),
            Plot::Normals => return None,
        })
    };
    let trials = choice.trials();
    let of = |(method, key): (usize, &Key)| {
        let own = trials.iter().filter(|trial| trial.0 == method);
        let points: Vec<(f64, f64)> = own.filter_map(|trial| point(*trial)).collect();
        (!points.is_empty()).then(|| Series {
            name: board.methods[method].0.clone(),
            key: *key,
            points,
        })
    };
    keys.iter().enumerate().filter_map(of).collect()
}

/// The columns of the table, with the figures they hold.
fn columns(moving: bool) -> Vec<(&'static str, Column)> {
    let mut columns = vec![
        ("", Column::text("Method", 0)),
        ("", Column::numbers("spp", 1)),
        ("rmse", Column::numbers("RMSE", 2)),
        (COST, Column::numbers("ns/pixel", 3)),
        ("ndf_l1", Column::numbers("Normals", 5)),
        ("ssim", Column::numbers("SSIM", 6)),
        ("energy", Column::numbers("Energy", 7)),
        ("highlight_energy", Column::numbers("Highlight", 8)),
        ("psnr", Column::numbers("PSNR", 9)),
        ("relmse", Column::numbers("relMSE", 10)),
    ];
    if moving {
        columns.insert(4, ("error_flicker", Column::numbers("Err.flicker", 4)));
        columns.insert(5, ("flicker", Column::numbers("Flicker", 4)));
    }
    columns
}

fn rows(board: &Board, choice: &Choice, columns: &[(&str, Column)]) -> Vec<Vec<Cell>> {
    let row = |trial: (usize, u32)| {
        let fixed = [Cell::Text(board.methods[trial.0].0.clone()), Cell::count(Some(trial.1))];
        let figures = columns.iter().skip(2).map(|(metric, _)| {
            Cell::number(match *metric {
                "ndf_l1" => choice.normals(trial.0),
                metric => choice.figure(trial, metric),
            })
        });
        fixed.into_iter().chain(figures).collect()
    };
    choice.trials().into_iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::library::Row;

    fn board() -> Board {
        let mut board = Board::default();
        let row = |scene: &str, method: &str, spp, metric: &str, value| Row {
            scene: scene.into(),
            method: method.into(),
            spp,
            metric: metric.into(),
            value,
        };
        board.add_rows(
            None,
            &[],
            &[
                row("s-f001", "unfiltered", Some(1), "rmse", 1.0),
                row("s-f001", "unfiltered", Some(4), "rmse", 0.5),
                row("s-f001", "lean", Some(1), "rmse", 0.25),
                row("s-f001", "lean", Some(1), COST, 90.0),
                row("s-f001", "lean", None, "ndf_l1", 0.5),
                row("s-f001", "reference", Some(64), "rmse", 0.01),
                row("s-f002", "unfiltered", Some(1), "rmse", 4.0),
                row("s", "lean", Some(1), "error_flicker", 0.3),
            ],
        );
        board
    }

    #[test]
    fn a_running_board_follows_its_last_scene_and_a_finished_one_shows_means() {
        let board = board();
        let running = shown(&board, Plot::Error, &Which::Current, true);
        assert_eq!(running.of, "the scene under way: s-f002");
        assert_eq!(running.series.len(), 1);
        let done = shown(&board, Plot::Error, &Which::Current, false);
        // Only in the first scene did both take part.
        assert_eq!(done.of, "mean over 1 of 2 scenes, where all methods take part");
        assert_eq!(done.series[0].points, [(1.0, 1.0), (4.0, 0.5)]);
        assert!((done.floor.unwrap() - 0.01).abs() < 1e-12);
        assert_eq!(done.rows.len(), 3);
    }

    #[test]
    fn every_plot_has_its_figures() {
        let board = board();
        let one = Which::One("s-f001".into());
        let points = |plot| {
            shown(&board, plot, &one, false)
                .series
                .iter()
                .flat_map(|s| s.points.clone())
                .collect::<Vec<_>>()
        };
        assert_eq!(points(Plot::Flicker), [(1.0, 0.3)]);
        assert_eq!(points(Plot::Cost), [(90.0, 0.25)]);
        let normals = shown(&board, Plot::Normals, &one, false);
        assert_eq!((normals.bars.len(), normals.bars[0].value, normals.series.len()), (1, 0.5, 0));
        assert!(Plot::ALL.iter().all(|plot| plot.next() != *plot));
    }

    #[test]
    fn a_papers_sweeps_are_shown_one_at_a_time() {
        let mut board = Board::default();
        for (part, scene, method) in
            [("one", "a", "lean"), ("one", "b", "lean"), ("two", "a", "fournier")]
        {
            let (scene, method) = (scene.to_owned(), method.to_owned());
            let row = Row { scene, method, spp: Some(1), metric: "rmse".into(), value: 1.0 };
            board.add_rows(Some(part), &[], &[row]);
        }
        assert_eq!(board.parts(), ["one", "two"]);
        let first = shown(&board, Plot::Error, &Which::All, false);
        assert_eq!((first.of.as_str(), first.rows.len()), ("one: mean over all 2 scenes", 1));
        let second = shown(&board, Plot::Error, &Which::Part("two".into()), false);
        assert_eq!((second.of.as_str(), second.series[0].name.as_str()), ("two/a", "fournier"));
    }

    #[test]
    fn nothing_is_shown_of_an_empty_board() {
        for which in [Which::Current, Which::All, Which::One("x".into())] {
            let shown = shown(&Board::default(), Plot::Error, &which, true);
            assert_eq!((shown.of.as_str(), shown.rows.len()), ("", 0));
        }
    }
}
