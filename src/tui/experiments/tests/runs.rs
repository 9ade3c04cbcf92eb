//! A real run, from the order to the report.

use std::sync::{Arc, mpsc};
use std::time::Duration;

use super::fixture::at;
use crate::tui::experiments::{Ask, End, Experiments, Order, Plot, State, Told, Worker};
use crate::tui::keys::Action;
use crate::tui::library::listed;

const SPEC: &str = r#"
title = "Small"
seed = 5
[image]
width = 12
height = 10
[surface]
shape = "sphere"
[reference]
spp = 64
replicates = 2
[sweep]
texture = ["gaussian"]
method = ["unfiltered", "averaged"]
spp = [1]
unfiltered_spp = [1, 4]
texels_per_pixel = [2.0]
[motion]
kind = "rotate"
degrees = 4
frames = 2
[texture.gaussian]
pattern = "gaussian"
width = 16
height = 16
"#;

/// A pane with its threads in a folder.
struct Stage {
    pane: Experiments,
    worker: Worker,
    heard: mpsc::Receiver<Told>,
}

impl Stage {
    fn new(folder: &std::path::Path) -> Self {
        let path = folder.join("small.toml");
        std::fs::write(&path, SPEC).unwrap();
        let (tell, heard) = mpsc::channel();
        let worker =
            Worker::start(Arc::new(move |told| drop(tell.send(told))), folder.join("reports"));
        let mut pane = Experiments::default();
        pane.hear(Told::Listed(vec![listed(&path)], vec![]), at(0));
        Self { pane, worker, heard }
    }

    fn press(&mut self, action: Action) {
        let asks = self.pane.press(action, at(0));
        self.pass_on(asks);
    }

    /// Passes orders on; the list stays the one of the folder.
    fn pass_on(&self, asks: Vec<Ask>) {
        for ask in asks {
            if let Ask::Order(order) = ask
                && order != Order::List
            {
                self.worker.order(order);
            }
        }
    }

    /// Hears what is told until the run has ended; what `at_each` gives is passed on.
    fn until_it_ends(&mut self, mut at_each: impl FnMut(&mut Experiments) -> Vec<Ask>) -> End {
        loop {
            let told = self.heard.recv().unwrap();
            let asks = self.pane.hear(told, at(1));
            self.pass_on(asks);
            if let Some(State::Ended(end)) = self.pane.run.as_ref().map(|run| &run.state) {
                return end.clone();
            }
            let asks = at_each(&mut self.pane);
            self.pass_on(asks);
        }
    }
}

#[test]
fn what_a_run_shows_is_what_its_report_shows() {
    let folder = tempfile::tempdir().unwrap();
    let mut stage = Stage::new(folder.path());
    stage.press(Action::Run);
    let end = stage.until_it_ends(|_| Vec::new());
    let End::Done { report, lead, .. } = end else { panic!("{end:?}") };
    assert!(report.unwrap().is_file() && !lead.is_empty());
    let live = stage.pane.run.as_ref().unwrap().board.clone();
    stage.worker.order(Order::Read { name: "small".into() });
    let read = loop {
        if let Told::Read { board, problems, .. } = stage.heard.recv().unwrap() {
            assert_eq!(problems, [""; 0]);
            break board;
        }
    };
    assert_eq!((live.scenes.len(), live.sequences.len()), (2, 1));
    assert!(live == *read, "{live:#?}\n{read:#?}");
    stage.pane.plot = Plot::Flicker;
    stage.press(Action::NextScene);
    assert_eq!(stage.pane.shown.series.len(), 2);
}

#[test]
fn a_run_is_paused_at_once_goes_on_and_is_halted() {
    let folder = tempfile::tempdir().unwrap();
    let mut stage = Stage::new(folder.path());
    stage.press(Action::Run);
    stage.press(Action::Pause);
    let mut paused = 0;
    let end = stage.until_it_ends(|pane| {
        if pane.run.as_ref().unwrap().state != State::Paused {
            return Vec::new();
        }
        paused += 1;
        pane.press(if paused == 1 { Action::Cancel } else { Action::Pause }, at(2))
    });
    assert_eq!((end, paused), (End::Halted, 1));
    // What it had begun it goes on with.
    stage.press(Action::Run);
    assert!(matches!(stage.until_it_ends(|_| Vec::new()), End::Done { .. }));
    stage.worker.end(Duration::from_secs(60));
}

#[test]
fn a_run_that_cannot_be_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let mut stage = Stage::new(folder.path());
    std::fs::write(folder.path().join("reports"), "in the way").unwrap();
    stage.press(Action::Run);
    let end = stage.until_it_ends(|_| Vec::new());
    assert!(matches!(&end, End::Failed(error) if error.contains("cannot write")), "{end:?}");
}
