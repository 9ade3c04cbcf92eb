//! The pane without a terminal: keys and findings in, frames out.

use std::path::PathBuf;
use std::time::{Duration, SystemTime};

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::Terminal;
use ratatui::backend::TestBackend;

use super::*;
use crate::evidence::Verdict;
use crate::tui::library::{Claim, ImageFile, Kind, PaperRow, Row, SceneImages};
use crate::tui::message::{Effect, Message};
use crate::tui::model::{Model, Pane};
use crate::tui::picture::{Depth, Gallery, Screen};
use crate::tui::{update, view};

fn model(size: [u16; 2], depth: Depth) -> Model {
    let now = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000);
    let mut model = Model::new(size, Screen::plain(depth), now);
    model.pane = Pane::Results;
    model
}

fn listed(now: SystemTime) -> Vec<Report> {
    let report = |name: &str, kind, problem: &str| Report {
        name: name.to_owned(),
        folder: PathBuf::from("reports").join(name),
        kind,
        written: problem.is_empty().then(|| now - Duration::from_secs(3 * 3600)),
        lead: vec![format!("What {name} answers, in a sentence that is long enough to be broken.")],
        problems: if problem.is_empty() { vec![] } else { vec![problem.to_owned()] },
    };
    vec![
        report("fournier-1992", Kind::Paper, ""),
        report("quick", Kind::Sweep, ""),
        report("torn", Kind::Sweep, "no report yet: a run was interrupted, or is under way"),
    ]
}

fn sweep() -> Opened {
    let image = |method: &str, spp| ImageFile {
        method: method.to_owned(),
        spp,
        path: PathBuf::from(format!("{method}-{spp}spp.exr")),
    };
    let scene = |slug: &str| SceneImages {
        slug: slug.to_owned(),
        reference: Some("reference.exr".into()),
        images: vec![image("unfiltered", 1), image("unfiltered", 16), image("fournier", 1)],
    };
    let row = |scene: &str, method: &str, value| Row {
        scene: scene.to_owned(),
        method: method.to_owned(),
        spp: Some(1),
        metric: "rmse".to_owned(),
        value,
    };
    Opened {
        folder: "reports/quick".into(),
        kind: Kind::Sweep,
        title: "A quick look".into(),
        question: String::new(),
        methods: Vec::new(),
        rows: vec![row("twill", "unfiltered", 0.25), row("twill", "fournier", 0.0125)],
        scenes: vec![scene("twill"), scene("bricks")],
        plots: vec![("samples".into(), "samples.png".into())],
        paper: Vec::new(),
        problems: Vec::new(),
    }
}

fn paper() -> Opened {
    let claim = |verdict, because: &str| Claim {
        what: "a peak is as high as the printed one".into(),
        paper: "0.31".into(),
        here: "0.305".into(),
        verdict,
        rule: "within 5 %".into(),
        because: because.into(),
    };
    let row = |name: &str, claims| PaperRow {
        name: name.into(),
        title: "Peaks of a bumpy plane".into(),
        claims,
        plots: vec![("peaks".into(), format!("{name}-peaks.png").into())],
        images: vec![("a".into(), "a.exr".into()), ("truth".into(), "truth.exr".into())],
    };
    let differs = claim(Verdict::Differs, "the print leaves the exponent open");
    let rows = vec![
        row("fournier-f2", vec![claim(Verdict::Reproduced, ""), differs]),
        row("fournier-f3", vec![]),
    ];
    Opened { folder: "reports/fournier-1992".into(), kind: Kind::Paper, paper: rows, ..sweep() }
}

fn film(scale: f32) -> Arc<Film> {
    let pixels = (0..64 * 48).map(|i| scale * (i % 64) as f32 / 64.0 * (i / 64) as f32 / 48.0);
    Arc::new(Film::new(64, 48, pixels.collect()))
}

fn press(model: &mut Model, code: KeyCode) -> Vec<Effect> {
    update(model, Message::Key(KeyEvent::new(code, KeyModifiers::NONE)))
}

fn tell(model: &mut Model, told: Told) -> Vec<Effect> {
    update(model, Message::Results(told))
}

/// A model that looks into a report.
fn into(report: Opened, size: [u16; 2], depth: Depth) -> (Model, Vec<Effect>) {
    let mut model = model(size, depth);
    let now = model.now;
    tell(&mut model, Told::Listed(listed(now)));
    model.results.opening = Some(report.folder.clone());
    let effects = tell(&mut model, Told::Opened(Box::new(report)));
    (model, effects)
}

/// A model that shows the first scene's images, read.
fn scene(size: [u16; 2], depth: Depth) -> Model {
    let (mut model, effects) = into(sweep(), size, depth);
    let [Effect::Results(Order::Films(ticket, files))] = &effects[..] else {
        panic!("{effects:?}")
    };
    assert_eq!(files.iter().map(|(place, _)| *place).collect::<Vec<_>>(), [0, 1, 2, 3]);
    for (place, scale) in [1.0, 0.5, 0.8, 1.2].into_iter().enumerate() {
        tell(&mut model, Told::Film(*ticket, place, Ok(film(scale))));
    }
    model
}

fn drawn(model: &Model) -> String {
    let [columns, rows] = model.size;
    let mut terminal = Terminal::new(TestBackend::new(columns, rows)).unwrap();
    let gallery = Gallery::new(model.screen);
    terminal.draw(|frame| view::draw(model, &gallery, frame)).unwrap();
    terminal.backend().to_string()
}

const SIZES: [[u16; 2]; 3] = [[80, 24], [120, 40], [300, 80]];

#[test]
fn reports_are_listed_with_what_they_answer() {
    for size in SIZES {
        let mut model = model(size, Depth::True);
        let now = model.now;
        tell(&mut model, Told::Listed(listed(now)));
        press(&mut model, KeyCode::Down);
        press(&mut model, KeyCode::Down);
        insta::assert_snapshot!(format!("reports_{}", size[0]), drawn(&model));
    }
}

#[test]
fn images_of_a_scene_are_compared() {
    for size in SIZES {
        let mut model = scene(size, Depth::True);
        press(&mut model, KeyCode::Enter);
        insta::assert_snapshot!(format!("images_{}", size[0]), drawn(&model));
    }
}

#[test]
fn claims_stand_with_their_verdicts() {
    for size in SIZES {
        let (model, _) = into(paper(), size, Depth::True);
        insta::assert_snapshot!(format!("claims_{}", size[0]), drawn(&model));
    }
}

#[test]
fn without_colour_nothing_is_lost() {
    let mut model = scene([80, 24], Depth::None);
    insta::assert_snapshot!("images_without_colour", drawn(&model));
    press(&mut model, KeyCode::Enter);
    press(&mut model, KeyCode::Char('v'));
    insta::assert_snapshot!("values_without_colour", drawn(&model));
}

#[test]
fn any_size_is_drawn() {
    for size in [[60, 16], [61, 17], [65, 200], [400, 16]] {
        for mut model in [scene(size, Depth::True), into(paper(), size, Depth::None).0] {
            drawn(&model);
            press(&mut model, KeyCode::Enter);
            drawn(&model);
        }
    }
}

#[test]
fn a_report_is_opened_looked_at_and_left() {
    let mut model = model([120, 40], Depth::True);
    let now = model.now;
    tell(&mut model, Told::Listed(listed(now)));
    press(&mut model, KeyCode::Down);
    let effects = press(&mut model, KeyCode::Enter);
    assert!(matches!(&effects[..], [Effect::Results(Order::Open(at))] if at.ends_with("quick")));
    tell(&mut model, Told::Opened(Box::new(sweep())));
    assert!(model.results.book.is_some());
    press(&mut model, KeyCode::Enter);
    assert_eq!(model.results.focus, Focus::Picture);
    press(&mut model, KeyCode::Esc);
    press(&mut model, KeyCode::Esc);
    assert!(model.results.book.is_none());
    assert_eq!(model.results.report, 1);
}

#[test]
fn what_comes_late_is_of_no_more_use() {
    let (mut model, effects) = into(sweep(), [120, 40], Depth::True);
    let [Effect::Results(Order::Films(old, _))] = &effects[..] else { panic!("{effects:?}") };
    press(&mut model, KeyCode::Down);
    tell(&mut model, Told::Film(*old, 0, Ok(film(1.0))));
    let viewer = &model.results.book.as_ref().unwrap().viewer;
    assert!(viewer.shots.iter().all(|shot| shot.film.is_none()));
    // A report nobody waits for any more.
    tell(&mut model, Told::Opened(Box::new(paper())));
    assert_eq!(model.results.book.as_ref().unwrap().report.kind, Kind::Sweep);
}

#[test]
fn digits_flip_through_methods_of_one_count() {
    let mut model = scene([120, 40], Depth::True);
    let caption = |model: &Model| model.results.book.as_ref().unwrap().viewer.caption();
    assert_eq!(caption(&model), "A unfiltered 1 spp");
    press(&mut model, KeyCode::Char('2'));
    assert_eq!(caption(&model), "A fournier 1 spp");
    press(&mut model, KeyCode::Char(' '));
    assert_eq!(caption(&model), "B reference");
    press(&mut model, KeyCode::Char('n'));
    assert_eq!(model.status.text, "16 samples a pixel");
    press(&mut model, KeyCode::Char('1'));
    assert_eq!(caption(&model), "B unfiltered 16 spp");
    press(&mut model, KeyCode::Char('m'));
    assert_eq!(caption(&model), "B reference", "round and round");
    press(&mut model, KeyCode::Char('b'));
    assert_eq!(caption(&model), "B unfiltered 16 spp");
}

#[test]
fn a_scene_is_looked_at_as_the_one_before() {
    let mut model = scene([120, 40], Depth::True);
    press(&mut model, KeyCode::Char('2'));
    press(&mut model, KeyCode::Char('s'));
    let effects = press(&mut model, KeyCode::Char(']'));
    assert!(matches!(&effects[..], [Effect::Results(Order::Films(..))]));
    let book = model.results.book.as_ref().unwrap();
    assert_eq!((book.item, book.viewer.split, book.viewer.sides), (1, Some(0.5), [2, 0]));
    assert!(press(&mut model, KeyCode::Char(']')).len() == 1, "plots come after scenes");
    assert!(press(&mut model, KeyCode::Char(']')).is_empty(), "and nothing after them");
}

#[test]
fn a_file_that_cannot_be_read_is_a_sentence() {
    let (mut model, effects) = into(sweep(), [120, 40], Depth::True);
    let [Effect::Results(Order::Films(ticket, _))] = &effects[..] else { panic!("{effects:?}") };
    tell(&mut model, Told::Film(*ticket, 0, Ok(film(1.0))));
    tell(
        &mut model,
        Told::Film(*ticket, 1, Err("a.exr: cannot read the image: it ends early".into())),
    );
    assert!(model.status.problem && model.status.text.contains("a.exr"));
    assert!(drawn(&model).contains("(cannot be read)"));
    let other = Arc::new(Film::new(2, 2, vec![0.0; 4]));
    tell(&mut model, Told::Film(*ticket, 3, Ok(other)));
    assert!(model.status.text.contains("2 × 2 pixels"), "{}", model.status.text);
    drawn(&model);
}

#[test]
fn a_report_that_is_not_whole_says_so() {
    let problems = vec!["metrics.json breaks off".to_owned(), "3 images are missing".to_owned()];
    let torn = Opened { problems, scenes: vec![], plots: vec![], ..sweep() };
    let (mut model, effects) = into(torn, [80, 24], Depth::True);
    assert!(effects.is_empty());
    assert_eq!(model.status.text, "metrics.json breaks off (and 1 more)");
    for key in [KeyCode::Enter, KeyCode::Char('n'), KeyCode::Up, KeyCode::Char(']'), KeyCode::End] {
        press(&mut model, key);
        drawn(&model);
    }
}

#[test]
fn panels_of_a_row_have_the_truth_first() {
    let (mut model, _) = into(paper(), [120, 40], Depth::True);
    press(&mut model, KeyCode::Down);
    press(&mut model, KeyCode::Down);
    let book = model.results.book.as_ref().unwrap();
    assert_eq!(book.chosen(), Some(Item::Panels(0)));
    let labels: Vec<_> = book.viewer.shots.iter().map(|shot| shot.label.as_str()).collect();
    assert_eq!(labels, ["truth", "a"]);
}

#[test]
fn clicks_choose_lines_and_pixels() {
    use crossterm::event::{MouseButton, MouseEvent, MouseEventKind};
    let mut model = scene([120, 40], Depth::True);
    let click = |model: &mut Model, column, row| {
        let kind = MouseEventKind::Down(MouseButton::Left);
        let modifiers = KeyModifiers::NONE;
        update(model, Message::Mouse(MouseEvent { kind, column, row, modifiers }))
    };
    let list = Layout::of(&model).list.unwrap();
    assert_eq!(click(&mut model, list.x, list.y + 1).len(), 1);
    assert_eq!(model.results.book.as_ref().unwrap().item, 1);
    assert!(click(&mut model, list.x, list.y + 9).is_empty(), "below the last");
    let mut model = scene([120, 40], Depth::True);
    let shown = Layout::of(&model).shown;
    click(&mut model, shown.x + shown.width / 2 + 3, shown.y + shown.height / 2);
    assert_eq!(model.results.focus, Focus::Picture);
    assert_ne!(model.results.book.as_ref().unwrap().viewer.cursor, [32, 24]);
}
