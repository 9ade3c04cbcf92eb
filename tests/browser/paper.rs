//! Images of a paper's figures: as they were printed, and in the viewer for who looks closer.

use std::path::Path;
use std::sync::Arc;

use serde_json::{Value, json};
use wrinkle::evidence::{Drawing, Evidence, Exhibit, Figure, Images, Panel};
use wrinkle::render::Film;
use wrinkle::report;

use crate::chromium::Browser;
use crate::{SCENE, browser, number, on_stage, scroll_to_stage, text};

/// A slope of radiances, steeper from film to film.
fn film(n: usize) -> Film {
    let at = |i: usize| (i % 24 + 2 * (i / 24) + 1) as f32 * (n + 1) as f32 / 64.0;
    Film::new(24, 16, (0..384).map(at).collect())
}

fn evidence() -> Evidence {
    let names = ["truth", "near", "far"];
    let panel = |(n, name): (usize, &&str)| Panel::new(name, *name, Arc::new(film(n)));
    let panels: Vec<Panel> = names.iter().enumerate().map(panel).collect();
    let images = |reference| Images { panels: panels.clone(), white: None, reference, across: 3 };
    let figure =
        |name, reference| Figure::new(name, "Three slopes.", Drawing::Images(images(reference)));
    let figures = vec![figure("compared", Some(0)), figure("alone", None)];
    let exhibit = Exhibit { row: "slopes".into(), figures, ..Exhibit::default() };
    Evidence { name: "slopes".into(), exhibits: vec![exhibit], ..Evidence::default() }
}

fn opened() -> Option<Browser> {
    let mut browser = browser()?;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("browser-paper");
    report::write_evidence(&evidence(), &[], &folder).unwrap();
    browser.open(&folder.join("report.html"));
    browser.eval(&format!(
        "{SCENE}.querySelector('.row').scrollIntoView({{ block: 'center', behavior: 'instant' }})"
    ));
    browser.paint();
    Some(browser)
}

/// Whether the first figure's bench is seen.
fn is_open(browser: &mut Browser) -> bool {
    browser.eval(&format!("{SCENE}.querySelector('.bench').checkVisibility()")) == json!(true)
}

/// Clicks an image of the first figure.
fn click(browser: &mut Browser, image: usize) {
    let at = browser.eval(&format!(
        "(({{ left, top, width, height }}) => [left + width / 2, top + height / 2])({SCENE}.querySelectorAll('figure')[{image}].querySelector('canvas').getBoundingClientRect())"
    ));
    let at = [at[0].as_f64().unwrap(), at[1].as_f64().unwrap()];
    for (kind, buttons) in [("mousePressed", 1), ("mouseReleased", 0)] {
        browser.mouse(kind, at, json!({ "button": "left", "buttons": buttons, "clickCount": 1 }));
    }
    browser.paint();
}

#[test]
fn a_click_looks_closer_and_escape_goes_back() {
    let Some(mut browser) = opened() else { return };
    assert!(!is_open(&mut browser), "as it was printed");
    click(&mut browser, 2);
    assert!(is_open(&mut browser));
    assert_eq!(text(&mut browser, ".says"), "far: radiance");
    scroll_to_stage(&mut browser);
    let at = on_stage(&mut browser, 20, 10);
    browser.mouse("mouseMoved", at, json!({}));
    let shown = text(&mut browser, ".films button:last-child .value");
    let expected = f64::from(film(2).pixels()[10 * 24 + 20]);
    // The value, then its error.
    let error = f64::from(film(2).pixels()[10 * 24 + 20] - film(0).pixels()[10 * 24 + 20]);
    let value = browser.eval(&format!(
        "{SCENE}.querySelector('.films button:last-child .value').firstChild.textContent"
    ));
    let value = number(value.as_str().unwrap());
    assert!((value - expected).abs() < 0.006 * expected, "{value}, film {expected}");
    let rest = number(text(&mut browser, ".films button:last-child small").as_str());
    assert!((rest - error).abs() < 0.06 * error, "{shown}: error {rest}, films {error}");
    browser.press("Escape");
    assert!(!is_open(&mut browser));
    browser.press("1");
    assert!(is_open(&mut browser));
}

#[test]
fn without_a_reference_there_is_radiance_alone() {
    let Some(mut browser) = opened() else { return };
    let maps = |browser: &mut Browser, scene: usize| {
        browser.eval(&format!(
            "document.querySelectorAll('.scene')[{scene}].querySelectorAll('.tools .group:first-child button').length"
        ))
    };
    assert_eq!(maps(&mut browser, 0), json!(4));
    assert_eq!(maps(&mut browser, 1), json!(1));
    let canvases = "[...document.querySelectorAll('.scene')].map((s) => [...s.querySelectorAll('.row canvas')].filter((c) => c.checkVisibility()).length)";
    assert_eq!(browser.eval(canvases), json!([6, 3]));
    assert_eq!(browser.requests(), Vec::<String>::new());
    assert_eq!(browser.complaints(), Vec::<&Value>::new());
}
