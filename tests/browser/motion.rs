//! What moves in the page: one frame for all images, played, stopped, stepped and looked into.

use std::sync::OnceLock;
use std::time::Duration;

use serde_json::{Value, json};
use wrinkle::experiment::results::Results;
use wrinkle::experiment::sequence::{films, references};
use wrinkle::render::Film;

use crate::chromium::Browser;
use crate::{Report, SCENE, browser, canvases, number, on_stage, reported, scroll_to_stage, text};

const SPEC: &str = r#"
title = "Tiny, turning"
question = "Does the page show every frame that was rendered?"
seed = 3

[image]
width = 24
height = 16

[surface]
shape = "sphere"

[material]
exponent = 40.0

[reference]
spp = 256

[motion]
degrees = 20.0
frames = 5

[sweep]
texture = ["gaussian"]
method = ["unfiltered", "averaged", "lean"]
spp = [1]
texels_per_pixel = [4.0]
"#;

/// The page at its sequence, in the first frame, for someone who wants less motion or does not mind.
fn opened(reduced: bool) -> Option<(Browser, &'static Results)> {
    static REPORT: OnceLock<Report> = OnceLock::new();
    let mut browser = browser()?;
    let (folder, results) = reported("browser-motion", SPEC, &REPORT);
    let value = if reduced { "reduce" } else { "no-preference" };
    let feature = json!({ "name": "prefers-reduced-motion", "value": value });
    browser.call("Emulation.setEmulatedMedia", json!({ "features": [feature] }));
    browser.open(&folder.join("report.html"));
    scroll_to_stage(&mut browser);
    // Films are decoded when the scene comes near, and canvases drawn then.
    let drawn = format!(
        "{SCENE}.querySelector('figure canvas').width > 0 && !{SCENE}.querySelector('figure script')"
    );
    for _ in 0..600 {
        if browser.eval(&drawn) == json!(true) {
            browser.paint();
            return Some((browser, results));
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    panic!("the sequence was not decoded: {:?}", browser.complaints());
}

fn frame(browser: &mut Browser) -> String {
    text(browser, ".player output")
}

fn playing(browser: &mut Browser) -> bool {
    let label = format!("{SCENE}.querySelector('.player button').getAttribute('aria-label')");
    browser.eval(&label) == json!("pause")
}

/// Every image's films: the reference, then the methods, in the order of the page.
fn all_films(results: &Results) -> Vec<Vec<&Film>> {
    let of = |method: &&str| films(&results.scenes, method, 1).unwrap();
    let methods = ["unfiltered", "averaged", "lean"];
    std::iter::once(references(&results.scenes)).chain(methods.iter().map(of)).collect()
}

/// What is printed beside each image at a pixel: its value, and its error or nothing.
fn values_at(browser: &mut Browser, x: usize, y: usize) -> Vec<f64> {
    let at = on_stage(browser, x, y);
    browser.mouse("mouseMoved", at, json!({}));
    let shown = browser.eval(&format!(
        "[...{SCENE}.querySelectorAll('.films .value')].map((v) => v.firstChild.textContent)"
    ));
    shown.as_array().unwrap().iter().map(|text| number(text.as_str().unwrap())).collect()
}

#[test]
fn it_plays_at_once_unless_less_motion_is_wanted_and_space_stops_and_starts_it() {
    let Some((mut browser, _)) = opened(false) else { return };
    assert!(playing(&mut browser));
    let first = frame(&mut browser);
    let moved = (0..100).any(|_| {
        std::thread::sleep(Duration::from_millis(20));
        frame(&mut browser) != first
    });
    assert!(moved, "it stayed at {first}");
    browser.press(" ");
    assert!(!playing(&mut browser));
    let stopped = frame(&mut browser);
    std::thread::sleep(Duration::from_millis(400));
    assert_eq!(frame(&mut browser), stopped);
    browser.press(" ");
    assert!(playing(&mut browser));

    let (mut browser, _) = opened(true).unwrap();
    assert!(!playing(&mut browser));
    assert_eq!(frame(&mut browser), "frame 1 of 5");
}

#[test]
fn a_step_changes_the_frame_of_every_image() {
    let Some((mut browser, _)) = opened(true) else { return };
    browser.mouse("mouseMoved", [2.0, 2.0], json!({}));
    // The maps below the images show what changed since the frame before.
    (0..4).for_each(|_| browser.press("m"));
    assert_eq!(text(&mut browser, ".says"), "unfiltered: change from the frame before");
    let first = canvases(&mut browser);
    browser.press(">");
    assert_eq!(frame(&mut browser), "frame 2 of 5");
    let second = canvases(&mut browser);
    assert_eq!(first.len(), 9);
    assert!(first.iter().zip(&second).all(|(a, b)| a != b), "some image stood still");
    browser.press("<");
    assert!(canvases(&mut browser) == first, "back to the first frame");
    browser.press("<");
    assert_eq!(frame(&mut browser), "frame 5 of 5");
}

#[test]
fn the_slider_chooses_a_frame_and_values_are_those_of_the_films_in_it() {
    let Some((mut browser, results)) = opened(true) else { return };
    let all = all_films(results);
    for shown in [3, 5, 1] {
        browser.eval(&format!(
            "((s) => {{ s.value = '{shown}'; s.dispatchEvent(new Event('input')); }})({SCENE}.querySelector('.player input'))"
        ));
        assert_eq!(frame(&mut browser), format!("frame {shown} of 5"));
        for (x, y) in [(10, 6), (13, 8), (12, 4)] {
            let values = values_at(&mut browser, x, y);
            assert_eq!(values.len(), all.len());
            for (films, value) in all.iter().zip(values) {
                let truth = f64::from(films[shown - 1].pixels()[y * 24 + x]);
                // Three digits are shown, and a half float has eleven bits.
                assert!((value - truth).abs() <= truth.abs() * 0.0055, "{value}, film {truth}");
            }
        }
    }
}

#[test]
fn maps_of_change_have_the_changes_of_the_films() {
    let Some((mut browser, results)) = opened(true) else { return };
    let all = all_films(results);
    browser.press(">");
    browser.press(">");
    let [x, y] = [12, 7];
    let at = |film: usize, frame: usize| f64::from(all[film][frame].pixels()[y * 24 + x]);
    let change = |film: usize| at(film, 2) - at(film, 1);
    let steps = |film: usize| (1..5).map(move |t| at(film, t) - at(film, t - 1));
    let flicker = |film: usize| steps(film).map(f64::abs).sum::<f64>() / 4.0;
    let wrong = steps(3).zip(steps(0)).map(|(a, r)| (a - r).abs()).sum::<f64>() / 4.0;
    let expected = [
        ("error", (at(3, 2) - at(0, 2)).abs()),
        ("change", change(3).abs()),
        ("wrong change", (change(3) - change(0)).abs()),
        ("flicker", flicker(3)),
        ("wrong flicker", wrong),
    ];
    browser.press("3");
    let largest =
        all.iter().flatten().flat_map(|film| film.pixels()).fold(0.0f32, |a, b| a.max(*b));
    for (name, value) in expected {
        choose_map(&mut browser, name);
        let shown = colour_at(&mut browser, x, y);
        let ends = text(&mut browser, ".key span:last-child");
        let unit = number(ends.split(' ').next().unwrap());
        let scale = wrinkle::report::magnitude(value / unit);
        // The end of the scale is printed to three digits.
        for (a, b) in shown.iter().zip(scale) {
            assert!(
                (a - f64::from(b)).abs() <= 4.0,
                "{name}: {value} of {unit}: {shown:?}, {scale:?}"
            );
        }
        assert!(unit > 0.0 && unit <= f64::from(largest));
    }
}

/// Presses the button of a map.
fn choose_map(browser: &mut Browser, name: &str) {
    let found = browser.eval(&format!(
        "(([b]) => {{ b?.click(); return !!b; }})([...{SCENE}.querySelectorAll('.tools button')].filter((b) => b.textContent.replaceAll('|', '') === '{name}'))"
    ));
    assert_eq!(found, json!(true), "no button {name}");
    browser.mouse("mouseMoved", [2.0, 2.0], json!({}));
    browser.paint();
}

/// The colour of the stage at a pixel, while all of the image is seen.
fn colour_at(browser: &mut Browser, x: usize, y: usize) -> Vec<f64> {
    let [across, down] = [(x as f64 + 0.5) / 24.0, (y as f64 + 0.5) / 16.0];
    let rgb = browser.eval(&format!(
        "((c) => [...c.getContext('2d').getImageData(c.width * {across}, c.height * {down}, 1, 1).data])({SCENE}.querySelector('.stage canvas'))"
    ));
    rgb.as_array().unwrap()[..3].iter().map(|c| c.as_f64().unwrap()).collect()
}

#[test]
fn tools_work_while_it_runs_and_nothing_is_fetched() {
    let Some((mut browser, _)) = opened(false) else { return };
    for key in ["2", "w", "e", "+", "m", "b", "x", "s", "S", "f", "i", "r"] {
        browser.press(key);
    }
    assert!(playing(&mut browser));
    assert!(text(&mut browser, ".says").contains(" | "), "the wipe stands");
    browser.eval("window.dispatchEvent(new Event('beforeprint'))");
    let print = browser.call("Page.printToPDF", json!({ "printBackground": false }));
    assert!(print["data"].as_str().unwrap().len() > 20_000);
    assert_eq!(browser.requests(), Vec::<String>::new());
    assert_eq!(browser.complaints(), Vec::<&Value>::new());
}
