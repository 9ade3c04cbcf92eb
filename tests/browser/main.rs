//! The report page in a real browser: keys flip, zoom and pan are one for all images, values are those of the films,
//! improvement has its sign, nothing is fetched. Skipped with a notice where there is no browser, unless
//! `WRINKLE_BROWSER=required`.
//! Frames are tested in `motion.rs`, figures of papers in `paper.rs`.
#![cfg(unix)]
#![allow(clippy::disallowed_methods, reason = "tests compare numbers within tolerances")]

mod chromium;
mod motion;
mod paper;

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, OnceLock};

use chromium::Browser;
use serde_json::{Value, json};
use wrinkle::experiment::results::{Results, SceneResult};
use wrinkle::experiment::runner::{self, Outcome};
use wrinkle::experiment::spec::Spec;
use wrinkle::report;
use wrinkle::scene::Halt;

const SPEC: &str = r#"
title = "Tiny"
question = "Does the page show what was rendered?"
seed = 3

[image]
width = 24
height = 16

[material]
lobe = "blinn-phong"
exponent = 40.0

[reference]
spp = 256

[sweep]
texture = ["weave", "bumps"]
method = ["unfiltered", "averaged", "schilling-anisotropic"]
spp = [1, 4]
texels_per_pixel = [4.0]

[texture.weave]
pattern = "twill"
width = 16
height = 16

[texture.bumps]
pattern = "gaussian"
width = 16
height = 16
"#;

/// Films in the order of the page.
fn films(scene: &SceneResult) -> Vec<(String, &[f32])> {
    let reference = ("reference".to_owned(), scene.reference.film.pixels());
    let compared = scene.trials.iter().filter(|t| t.spp == 1);
    let compared = compared.map(|t| (t.method.clone(), t.film.pixels()));
    let more = scene.trials.iter().filter(|t| t.spp > 1 && t.method == "unfiltered");
    let more = more.map(|t| (format!("unfiltered, {} spp", t.spp), t.film.pixels()));
    std::iter::once(reference).chain(compared).chain(more).collect()
}

/// A report and where it stands.
type Report = (PathBuf, Results);

/// A report that tests look at, made once.
fn reported(name: &str, spec: &str, made: &'static OnceLock<Report>) -> &'static Report {
    made.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let spec = Spec::parse(spec, Path::new("tiny.toml")).unwrap();
        let halt = Halt(Arc::new(AtomicBool::new(false)));
        let outcome = runner::run(&spec, &folder, &halt, &runner::unwatched()).unwrap();
        let Outcome::Finished(found) = outcome else { panic!("nobody halted the run") };
        report::write(&found.0, &found.1, &folder).unwrap();
        (folder, found.0)
    })
}

/// A browser; `None`, with a notice, where there is none.
fn browser() -> Option<Browser> {
    let Some(program) = chromium::find() else {
        let required = std::env::var("WRINKLE_BROWSER").is_ok_and(|value| value == "required");
        assert!(!required, "no Chromium on the path; CHROME may name one");
        eprintln!("NOTICE: skipped, for there is no Chromium on the path; CHROME may name one");
        return None;
    };
    Some(Browser::start(&program))
}

/// Brings the stage of the first scene into view.
fn scroll_to_stage(browser: &mut Browser) {
    browser.eval("document.querySelector('.scene .stage').scrollIntoView({ block: 'center', behavior: 'instant' })");
    browser.paint();
}

/// The page in a browser with what it shows.
fn opened() -> Option<(Browser, &'static Path, &'static Results)> {
    static REPORT: OnceLock<Report> = OnceLock::new();
    let mut browser = browser()?;
    let (folder, results) = reported("browser", SPEC, &REPORT);
    browser.open(&folder.join("report.html"));
    scroll_to_stage(&mut browser);
    Some((browser, folder, results))
}

const SCENE: &str = "document.querySelector('.scene')";

fn text(browser: &mut Browser, selector: &str) -> String {
    let text = browser.eval(&format!("{SCENE}.querySelector('{selector}').textContent"));
    text.as_str().unwrap_or_default().to_owned()
}

/// A digest of what each canvas of the scene shows.
fn canvases(browser: &mut Browser) -> Vec<Value> {
    let all = browser.eval(&format!(
        "[...{SCENE}.querySelectorAll('.stage canvas, figure > canvas:not(.close)')].map((c) => c.toDataURL())"
    ));
    all.as_array().unwrap().clone()
}

/// The middle of a pixel of the stage, in the window, while all of the image is seen.
fn on_stage(browser: &mut Browser, x: usize, y: usize) -> [f64; 2] {
    let share = [(x as f64 + 0.5) / 24.0, (y as f64 + 0.5) / 16.0];
    let found = browser.eval(&format!(
        "(({{ left, top, width, height }}) => [left + {} * width, top + {} * height])({SCENE}.querySelector('.stage canvas').getBoundingClientRect())",
        share[0], share[1]
    ));
    [found[0].as_f64().unwrap(), found[1].as_f64().unwrap()]
}

/// A number as the page writes it.
fn number(text: &str) -> f64 {
    text.replace('−', "-").parse().unwrap_or(f64::NAN)
}

#[test]
fn keys_flip_hold_and_expose() {
    let Some((mut browser, _, results)) = opened() else { return };
    let labels: Vec<String> = films(&results.scenes[0]).into_iter().map(|(l, _)| l).collect();
    for (i, label) in labels.iter().enumerate() {
        browser.press(&i.to_string());
        assert_eq!(text(&mut browser, ".says"), format!("{label}: radiance"));
        assert_eq!(text(&mut browser, ".films [aria-pressed=true] .name"), *label);
    }
    browser.press("ArrowRight");
    assert_eq!(text(&mut browser, ".says"), "reference: radiance");
    browser.press("2");
    browser.key("keyDown", "r");
    assert_eq!(text(&mut browser, ".says"), "reference: radiance");
    browser.key("keyUp", "r");
    assert_eq!(text(&mut browser, ".says"), "averaged: radiance");

    let before = canvases(&mut browser);
    browser.press("e");
    assert_eq!(text(&mut browser, ".group output"), "+0.5 stops");
    let after = canvases(&mut browser);
    assert!(before.iter().zip(&after).filter(|(a, b)| a != b).count() > before.len() / 2);
    browser.press("E");
    browser.paint();
    assert!(canvases(&mut browser) == before, "as bright as before");

    browser.press("?");
    assert_eq!(browser.eval("document.querySelector('dialog.help').open"), json!(true));
}

#[test]
fn zoom_and_pan_move_all_images_of_a_scene_and_there_is_a_way_back() {
    let Some((mut browser, _, _)) = opened() else { return };
    // Once the page has settled.
    browser.press("f");
    browser.paint();
    let all = canvases(&mut browser);
    let middle = on_stage(&mut browser, 12, 8);
    // Who has not clicked scrolls past.
    browser
        .eval(&format!("{SCENE}.querySelector('.stage canvas').focus({{ preventScroll: true }})"));
    let wheel = json!({ "deltaX": 0, "deltaY": -480 });
    browser.mouse("mouseWheel", middle, wheel);
    browser.mouse("mouseMoved", [2.0, 2.0], json!({}));
    browser.paint();
    let zoomed = canvases(&mut browser);
    let same = |a: &[Value], b: &[Value]| a.iter().zip(b).filter(|(a, b)| a == b).count();
    // The reference's own error is white all over; every other image has moved.
    assert!(same(&all, &zoomed) <= 1, "{} of {} stood still", same(&all, &zoomed), all.len());

    let button = json!({ "button": "left", "buttons": 1, "clickCount": 1 });
    browser.mouse("mouseMoved", middle, json!({}));
    browser.mouse("mousePressed", middle, button.clone());
    browser.mouse("mouseMoved", [middle[0] + 90.0, middle[1]], button);
    let let_go = json!({ "button": "left", "buttons": 0, "clickCount": 1 });
    browser.mouse("mouseReleased", [middle[0] + 90.0, middle[1]], let_go);
    browser.mouse("mouseMoved", [2.0, 2.0], json!({}));
    browser.paint();
    assert!(same(&zoomed, &canvases(&mut browser)) <= 1);

    browser.press("f");
    browser.paint();
    let back = canvases(&mut browser);
    let differ: Vec<usize> = (0..all.len()).filter(|&i| all[i] != back[i]).collect();
    assert!(differ.is_empty(), "images {differ:?} of {} are not as before", all.len());
}

#[test]
fn values_are_those_of_the_films_to_the_precision_of_half_floats() {
    let Some((mut browser, _, results)) = opened() else { return };
    for (x, y) in [(3, 5), (12, 8), (23, 15)] {
        let at = on_stage(&mut browser, x, y);
        browser.mouse("mouseMoved", at, json!({}));
        assert!(text(&mut browser, ".pixel").starts_with(&format!("pixel ({x}, {y})")));
        let shown = browser.eval(&format!(
            "[...{SCENE}.querySelectorAll('.films .value')].map((v) => v.firstChild.textContent)"
        ));
        let all = films(&results.scenes[0]);
        assert_eq!(shown.as_array().unwrap().len(), all.len());
        for ((label, film), shown) in all.iter().zip(shown.as_array().unwrap()) {
            let (value, shown) = (f64::from(film[y * 24 + x]), number(shown.as_str().unwrap()));
            // Three digits are shown, and a half float has eleven bits.
            let bound = value.abs() * (0.005 + 0.0005);
            assert!(
                (value - shown).abs() <= bound,
                "{label} at ({x}, {y}): {value}, shown {shown}"
            );
        }
    }
}

#[test]
fn improvement_is_blue_where_the_shown_image_is_nearer() {
    let Some((mut browser, _, results)) = opened() else { return };
    let all = films(&results.scenes[0]);
    browser.press("3");
    (0..3).for_each(|_| browser.press("m"));
    browser.mouse("mouseMoved", [2.0, 2.0], json!({}));
    browser.paint();
    let pixels = browser.eval(&format!(
        "((c) => {{ const [w, h] = [c.width / 24, c.height / 16]; const d = c.getContext('2d'); \
         return Array.from({{ length: 384 }}, (_, i) => [...d.getImageData((i % 24 + 0.5) * w, (Math.floor(i / 24) + 0.5) * h, 1, 1).data]); \
         }})({SCENE}.querySelectorAll('figure')[3].querySelectorAll('canvas')[1])"
    ));
    let mut seen = [0, 0];
    for (i, pixel) in pixels.as_array().unwrap().iter().enumerate() {
        let off = |film: &[f32]| (film[i] - all[0].1[i]).abs();
        let gap = off(all[3].1) - off(all[1].1);
        let warm = pixel[0].as_i64().unwrap() - pixel[2].as_i64().unwrap();
        if gap.abs() > 0.05 * all[0].1.iter().copied().fold(0.0, f32::max) {
            assert_eq!(gap < 0.0, warm < 0, "pixel {i}: {gap}, {pixel}");
            seen[usize::from(gap < 0.0)] += 1;
        }
    }
    assert!(seen[1] > 20, "too few pixels to tell: {seen:?}");
}

#[test]
fn the_wipe_shows_two_images_and_follows_keys() {
    let Some((mut browser, _, _)) = opened() else { return };
    let stage = |browser: &mut Browser| {
        browser.paint();
        browser.eval(&format!("{SCENE}.querySelector('.stage canvas').toDataURL()"))
    };
    browser.press("1");
    browser.press("b");
    let unfiltered = stage(&mut browser);
    browser.press("3");
    let schilling = stage(&mut browser);
    browser.press("w");
    assert_eq!(text(&mut browser, ".says"), "schilling-anisotropic | unfiltered: radiance");
    let half = stage(&mut browser);
    assert!(half != unfiltered && half != schilling);
    (0..25).for_each(|_| browser.press(","));
    assert!(stage(&mut browser) == unfiltered, "the line is at the left edge");
    (0..50).for_each(|_| browser.press("."));
    assert!(stage(&mut browser) == schilling, "the line is at the right edge");
}

#[test]
fn nothing_is_fetched_and_a_print_has_its_pictures_in_light_and_dark() {
    let Some((mut browser, _, _)) = opened() else { return };
    let paper = "getComputedStyle(document.documentElement).backgroundColor";
    let dark = json!({ "features": [{ "name": "prefers-color-scheme", "value": "dark" }] });
    assert_eq!(browser.eval(paper), json!("rgb(255, 255, 255)"));
    browser.call("Emulation.setEmulatedMedia", dark.clone());
    assert_eq!(browser.eval(paper), json!("rgb(21, 24, 27)"));
    browser.eval("document.querySelector('.theme').click()");
    assert_eq!(browser.eval(paper), json!("rgb(255, 255, 255)"), "light, whatever the system has");

    browser.eval("window.dispatchEvent(new Event('beforeprint'))");
    let blank = browser.eval(
        "[...document.querySelectorAll('.row figure > canvas:first-of-type')].filter((c) => { \
         const d = c.width && c.getContext('2d').getImageData(0, 0, c.width, c.height).data; \
         return !d || d.every((v, i) => i % 4 !== 3 || v === 0); }).length",
    );
    assert_eq!(blank, json!(0), "every image of every scene is drawn");
    let print = browser.call("Page.printToPDF", json!({ "printBackground": false }));
    assert!(print["data"].as_str().unwrap().len() > 50_000);
    assert_eq!(browser.requests(), Vec::<String>::new());
    assert_eq!(browser.complaints(), Vec::<&Value>::new());
}

#[test]
fn a_figure_leads_to_its_row() {
    let Some((mut browser, folder, results)) = opened() else { return };
    let rows: Vec<String> = std::fs::read_to_string(folder.join("metrics.csv"))
        .unwrap()
        .lines()
        .map(str::to_owned)
        .collect();
    for (i, (label, _)) in films(&results.scenes[0]).iter().enumerate().skip(1) {
        let line = browser
            .eval(&format!("{SCENE}.querySelectorAll('figcaption span')[{i}].dataset.lines"));
        let row = &rows[line.as_str().unwrap().parse::<usize>().unwrap() - 1];
        let method = label.split(',').next().unwrap();
        assert!(row.starts_with("weave,") && row.contains(&format!(",{method},")), "{row}");
        let value: f64 = row.rsplit(',').next().unwrap().parse().unwrap();
        let shown =
            browser.eval(&format!("{SCENE}.querySelectorAll('figcaption span')[{i}].textContent"));
        let shown = shown.as_str().unwrap().trim_start_matches("RMSE ").to_owned();
        let shown = number(shown.split([',', ' ', '\u{a0}', '±']).next().unwrap());
        assert!((value - shown).abs() <= 0.06 * value, "{label}: {value}, shown {shown}");
    }
    browser.eval(&format!("{SCENE}.querySelectorAll('figcaption span')[1].click()"));
    browser.eval("new Promise((done) => setTimeout(done, 300)).then(() => 0)");
    let shown = browser.eval("document.querySelector('dialog.sources tbody').textContent");
    assert!(shown.as_str().unwrap().contains("unfiltered"), "{shown}");
}
