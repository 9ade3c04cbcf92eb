//! What keys and findings do.

use std::path::PathBuf;

use super::fixture::{at, list, pane, reports, scene};
use crate::experiment::runner::RunEvent;
use crate::tui::experiments::{Ask, End, Experiments, Focus, Order, Plot, State, Told, Which};
use crate::tui::keys::Action;

fn orders(asks: &[Ask]) -> Vec<&Order> {
    asks.iter()
        .filter_map(|ask| if let Ask::Order(order) = ask { Some(order) } else { None })
        .collect()
}

fn problem(asks: &[Ask]) -> &str {
    let found =
        asks.iter().find_map(|ask| if let Ask::Problem(text) = ask { Some(text) } else { None });
    found.map_or("", |text| text)
}

fn done() -> End {
    End::Done { report: None, secs: 61.0, lead: vec!["Choose fournier.".into()] }
}

/// A pane in which `quick` runs.
fn running() -> Experiments {
    let mut pane = pane();
    let asks = pane.press(Action::Run, at(0));
    let path = PathBuf::from("experiments/quick.toml");
    assert_eq!(orders(&asks), [&Order::Run { number: 1, path, name: "quick".into() }]);
    pane
}

#[test]
fn a_run_is_paused_resumed_and_cancelled() {
    let mut pane = running();
    assert!(pane.is_running() && pane.is_chosen_running());
    assert_eq!(orders(&pane.press(Action::Pause, at(1))), [&Order::Pause(true)]);
    assert_eq!(pane.run.as_ref().unwrap().state, State::Pausing);
    pane.hear(Told::Ran(1, RunEvent::Paused), at(2));
    assert_eq!(pane.run.as_ref().unwrap().state, State::Paused);
    // The key that runs lets a paused run go on.
    assert_eq!(orders(&pane.press(Action::Run, at(3))), [&Order::Pause(false)]);
    pane.hear(Told::Ran(1, RunEvent::Resumed), at(3));
    assert_eq!(pane.run.as_ref().unwrap().state, State::Running);
    assert_eq!(orders(&pane.press(Action::Cancel, at(4))), [&Order::Cancel]);
    // A pause that comes late does not hide that it halts.
    pane.hear(Told::Ran(1, RunEvent::Paused), at(4));
    assert_eq!(pane.run.as_ref().unwrap().state, State::Halting);
    let asks = pane.hear(Told::Ended(1, End::Halted), at(5));
    assert_eq!(orders(&asks)[0], &Order::List);
    assert!(!pane.is_running() && problem(&asks).is_empty());
    // And it can be run again.
    assert!(matches!(orders(&pane.press(Action::Run, at(6)))[..], [Order::Run { number: 2, .. }]));
}

#[test]
fn what_is_told_of_an_earlier_run_is_not_heard() {
    let mut pane = running();
    pane.hear(Told::Ended(1, End::Halted), at(1));
    pane.press(Action::Run, at(2));
    pane.hear(Told::Ended(1, done()), at(3));
    assert!(pane.is_running());
    pane.hear(Told::Ran(1, RunEvent::Paused), at(3));
    assert_eq!(pane.run.as_ref().unwrap().state, State::Running);
}

#[test]
fn another_experiment_waits_for_its_turn() {
    let mut pane = running();
    pane.press(Action::Down, at(1));
    assert!(orders(&pane.press(Action::Run, at(1))).is_empty());
    assert_eq!(pane.queue, ["sphere"]);
    let asks = pane.hear(Told::Ended(1, done()), at(2));
    assert!(matches!(orders(&asks)[..], [Order::List, Order::Run { number: 2, .. }]));
    assert_eq!(pane.running().unwrap().name, "sphere");
    // What waits is taken out again.
    pane.press(Action::Up, at(3));
    pane.press(Action::Run, at(3));
    assert!(orders(&pane.press(Action::Cancel, at(4))).is_empty());
    assert!(pane.queue.is_empty() && pane.running().unwrap().state == State::Running);
}

#[test]
fn everything_that_is_wrong_is_said() {
    let mut pane = pane();
    pane.press(Action::Up, at(0));
    assert!(problem(&pane.press(Action::Run, at(0))).contains("unknown key `widht`"));
    assert!(problem(&pane.press(Action::OpenReport, at(0))).contains("odd has no report yet"));
    let problems = vec!["metrics.json is missing".to_owned()];
    let told = Told::Read { name: "odd".into(), board: Box::default(), problems };
    assert_eq!(problem(&pane.hear(told, at(0))), "odd: metrics.json is missing");
    pane.press(Action::Down, at(0));
    pane.press(Action::Run, at(0));
    let failed =
        Told::Ended(1, End::Failed("cannot write reports/quick: disk full\n\x1b[2J".into()));
    assert_eq!(
        problem(&pane.hear(failed, at(0))),
        "quick: cannot write reports/quick: disk full [2J"
    );
    assert_eq!(pane.log.shown(1).next().unwrap().kind.sign(), '!');
    let mut empty = Experiments::default();
    assert!(
        problem(&empty.hear(Told::Listed(vec![], vec![]), at(0))).contains("no experiments here")
    );
    assert!(problem(&empty.press(Action::Run, at(0))).contains("no experiment to run"));
    for action in [Action::Pause, Action::Cancel, Action::OpenReport, Action::Down, Action::Last] {
        empty.press(action, at(0));
    }
}

#[test]
fn a_report_is_opened_where_it_is() {
    let asks = pane().press(Action::OpenReport, at(0));
    assert_eq!(asks, [Ask::Open(PathBuf::from("reports/quick/report.html"))]);
    assert_eq!(pane().press(Action::ToLabWith, at(0)), [Ask::Lab("quick".into())]);
}

#[test]
fn figures_are_read_for_what_is_chosen_once() {
    let mut pane = pane();
    assert_eq!(orders(&pane.press(Action::Down, at(0))), [&Order::Read { name: "sphere".into() }]);
    assert!(pane.shown.series.is_empty());
    assert_eq!(pane.hear(Told::Listed(list(), reports()), at(0)), []);
    let name = "sphere".to_owned();
    pane.hear(Told::Read { name, board: Box::default(), problems: vec![] }, at(0));
    assert_eq!(pane.hear(Told::Listed(list(), reports()), at(0)), []);
}

#[test]
fn the_chart_grows_with_the_run_and_time_shows_it() {
    let mut pane = running();
    assert!(pane.shown.series.is_empty());
    for event in scene(1, "twill-2-texels", 2) {
        pane.hear(Told::Ran(1, event), at(1));
    }
    assert!(pane.stale && pane.shown.series.is_empty());
    pane.tick(at(2));
    assert_eq!((pane.shown.series.len(), pane.table.len()), (2, 7));
    assert_eq!(pane.shown.of, "the scene under way: twill-2-texels");
    assert!(pane.headline().unwrap().contains("quick 0 %"));
    pane.hear(Told::Ended(1, done()), at(3));
    assert_eq!(pane.shown.of, "twill-2-texels");
    assert_eq!(pane.headline(), None);
}

#[test]
fn charts_scenes_and_columns_take_turns() {
    let mut pane = pane();
    let plots: Vec<Plot> = (0..5)
        .map(|_| {
            pane.press(Action::NextChart, at(0));
            pane.plot
        })
        .collect();
    assert_eq!(plots, [Plot::Flicker, Plot::Cost, Plot::Normals, Plot::Error, Plot::Flicker]);
    pane.press(Action::NextScene, at(0));
    assert_eq!(pane.which, Which::One("twill-2-texels".into()));
    pane.press(Action::PreviousScene, at(0));
    pane.press(Action::PreviousScene, at(0));
    assert_eq!(pane.which, Which::One("twill-16-texels".into()));
    for _ in 0..3 {
        pane.press(Action::SortNext, at(0));
    }
    pane.press(Action::SortTurn, at(0));
    assert_eq!(pane.table.sorted_by(), Some((2, true)));
    // Another experiment keeps the order.
    pane.press(Action::Up, at(0));
    pane.press(Action::Down, at(0));
    assert_eq!(pane.table.sorted_by(), Some((2, true)));
    pane.press(Action::NextFocus, at(0));
    pane.press(Action::Down, at(0));
    assert_eq!((pane.focus, pane.table.chosen()), (Focus::Table, 1));
}

#[test]
fn a_file_elsewhere_is_looked_at_and_stays_in_the_list() {
    let mut pane = Experiments::default();
    pane.prefer("somewhere/else.toml");
    let asks = pane.hear(Told::Listed(list(), reports()), at(0));
    assert_eq!(orders(&asks)[0], &Order::Look("somewhere/else.toml".into()));
    let mut one = list().pop().unwrap();
    one.name = "else".into();
    pane.hear(Told::Looked(Box::new(one)), at(0));
    assert_eq!(pane.chosen().unwrap().name, "else");
    pane.hear(Told::Listed(list(), reports()), at(0));
    assert_eq!(pane.chosen().unwrap().name, "else");
    pane.prefer("nosuch");
    assert!(problem(&pane.hear(Told::Listed(list(), reports()), at(0))).contains("nosuch"));
    pane.prefer("quick/part");
    pane.hear(Told::Listed(list(), reports()), at(0));
    assert_eq!(pane.chosen().unwrap().name, "quick");
}
