//! The lab without a terminal.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::fixture::{empty, findings, full};
use super::setup::tests::setup;
use super::*;
use crate::tui::keys::{BINDINGS, Context};
use crate::tui::message::{Effect, Message};
use crate::tui::model::{Model, Pane, Popup};
use crate::tui::picture::Depth;
use crate::tui::update;
use crate::tui::viewer::Side;

const SIZE: [u16; 2] = [120, 40];

fn press(model: &mut Model, key: char) -> Vec<Effect> {
    let event = KeyEvent::new(KeyCode::Char(key), KeyModifiers::NONE);
    update(model, Message::Key(event))
}

fn wanted(effects: &[Effect]) -> Option<&Wanted> {
    effects.iter().find_map(|effect| match effect {
        Effect::Lab(Order::Show(wanted)) => Some(wanted.as_ref()),
        _ => None,
    })
}

#[test]
fn an_empty_lab_opens_the_default_experiment() {
    let mut model = empty(SIZE, Depth::True);
    model.pane = Pane::Experiments;
    let effects = press(&mut model, 'L');
    assert!(matches!(&effects[..], [Effect::Lab(Order::Open(name))] if name == "highlight"));
    assert!(press(&mut model, 'L').is_empty(), "once");
}

#[test]
fn what_is_opened_is_rendered_with_the_sides_first() {
    let mut model = empty(SIZE, Depth::True);
    let effects = update(&mut model, Message::Lab(Told::Opened(Ok(Box::new(setup())))));
    let wanted = wanted(&effects).unwrap();
    assert_eq!((wanted.scene, wanted.spp, &wanted.first[..]), (1, 1, &[0][..]));
    assert_eq!(model.lab.viewer.caption(), "A unfiltered …");
}

#[test]
fn what_cannot_be_opened_is_said() {
    let mut model = empty(SIZE, Depth::True);
    update(&mut model, Message::Lab(Told::Opened(Err("there is no file x.png".into()))));
    assert!(model.status.problem && model.status.text.contains("x.png"));
}

#[test]
fn a_change_asks_for_another_scene_and_keeps_the_old_image_meanwhile() {
    let mut model = full(SIZE, Depth::True);
    let before = model.lab.spec.clone().unwrap();
    let effects = press(&mut model, 'd');
    let wanted = wanted(&effects).unwrap();
    assert_eq!(wanted.scene, 2);
    assert_ne!(wanted.spec.sweep.scale, before.sweep.scale);
    assert!(model.lab.is_stale() && model.lab.viewer.film(Side::A).is_some());
    assert_eq!(model.lab.rows[0].score, None, "numbers of the scene before are gone");
    assert!(model.status.text.starts_with("texels a pixel: "), "{}", model.status.text);
}

#[test]
fn what_is_told_of_a_scene_that_was_left_is_passed_over() {
    let mut model = full(SIZE, Depth::True);
    press(&mut model, 'd');
    for finding in findings(model.lab.rows.len()) {
        assert!(update(&mut model, Message::Lab(Told::Of(1, finding))).is_empty());
    }
    assert!(model.lab.reference.is_none() && !model.lab.done);
}

#[test]
fn a_key_for_each_setting_changes_that_setting() {
    for (key, setting) in [
        ('t', Setting::Texture),
        ('u', Setting::Surface),
        ('d', Setting::Texels),
        ('i', Setting::LightElevation),
        ('a', Setting::LightAzimuth),
        ('y', Setting::CameraAzimuth),
        ('w', Setting::Width),
        ('p', Setting::Lookup),
    ] {
        for key in [key, key.to_ascii_uppercase()] {
            let mut model = full(SIZE, Depth::True);
            let value = |model: &Model| {
                let (setup, spec) =
                    (model.lab.setup.as_ref().unwrap(), model.lab.spec.as_ref().unwrap());
                setting.value(setup, spec)
            };
            let before = value(&model);
            press(&mut model, key);
            // Lookups have one key.
            if key != 'P' {
                assert_ne!(value(&model), before, "{key}");
            }
        }
    }
}

#[test]
fn wider_is_wider_whatever_the_family() {
    let mut model = full(SIZE, Depth::True);
    for _ in 0..3 {
        let width = |model: &Model| model.lab.spec.as_ref().unwrap().sweep.lobes[0].spread();
        let before = width(&model);
        press(&mut model, 'w');
        assert!(width(&model) > before);
        let at = Setting::all(model.lab.spec.as_ref().unwrap());
        model.lab.focus = Focus::Settings;
        model.lab.setting = at.iter().position(|s| *s == Setting::Lobe).unwrap();
        press(&mut model, 'l');
    }
}

#[test]
fn number_keys_pick_and_ask_only_for_what_is_not_there() {
    let mut model = full(SIZE, Depth::True);
    let effects = press(&mut model, '5');
    assert_eq!(model.lab.viewer.caption(), "A schilling-anisotropic");
    assert!(wanted(&effects).is_none());
    assert!(matches!(&effects[..], [Effect::Lab(Order::Probe(look))] if look.methods == [4]));
    // In a scene that is new, the one looked at goes first.
    press(&mut model, 'd');
    let effects = press(&mut model, '7');
    assert_eq!(wanted(&effects).unwrap().first, [6]);
}

#[test]
fn the_cursor_asks_what_lies_under_it() {
    let mut model = full(SIZE, Depth::True);
    model.lab.focus = Focus::Picture;
    let effects = press(&mut model, 'l');
    assert!(matches!(&effects[..], [Effect::Lab(Order::Probe(look))] if look.pixel == [17, 12]));
}

#[test]
fn a_method_that_takes_no_part_says_why() {
    let mut model = full(SIZE, Depth::True);
    let scene = model.lab.scene;
    press(&mut model, '3');
    let reason = "it cannot".to_owned();
    let told = Told::Of(scene, Finding::Refused { method: 2, reason });
    update(&mut model, Message::Lab(told));
    assert_eq!(model.status.text, "fournier: it cannot");
}

#[test]
fn leaving_the_lab_lets_the_cores_go_and_coming_back_goes_on() {
    let mut model = full(SIZE, Depth::True);
    let effects = press(&mut model, 'E');
    assert!(matches!(&effects[..], [Effect::Lab(Order::Rest)]));
    assert!(press(&mut model, 'L').is_empty(), "all is done");
    press(&mut model, 'd');
    press(&mut model, 'E');
    assert!(wanted(&press(&mut model, 'L')).is_some());
}

#[test]
fn the_list_is_ordered_by_number_error_or_time() {
    let mut model = full(SIZE, Depth::True);
    assert_eq!(model.lab.order()[..3], [0, 1, 2]);
    press(&mut model, 'o');
    let order = model.lab.order();
    assert_eq!(
        (order[0], *order.last().unwrap()),
        (model.lab.rows.len() - 1, 2),
        "who has none is last"
    );
    press(&mut model, 'o');
    assert_eq!(model.lab.order()[..2], [0, 1]);
}

#[test]
fn a_scene_that_cannot_be_rendered_says_why() {
    let mut model = full(SIZE, Depth::True);
    let scene = model.lab.scene;
    let told = Told::Of(scene, Finding::Failed("bad.png: truncated".into()));
    update(&mut model, Message::Lab(told));
    assert!(model.status.problem);
    assert_eq!(model.lab.failed.as_deref(), Some("bad.png: truncated"));
}

/// Whatever is pressed, in whatever pane and focus, with whatever open: an answer, and never a panic.
#[test]
fn every_key_of_the_table_is_taken_everywhere() {
    for (pane, focus) in
        Pane::ALL.into_iter().flat_map(|pane| Focus::ALL.map(|focus| (pane, focus)))
    {
        for mut model in [empty(SIZE, Depth::True), full(SIZE, Depth::True)] {
            for binding in BINDINGS {
                for key in binding.keys {
                    (model.pane, model.lab.focus) = (pane, focus);
                    if binding.context == Context::Question {
                        model.popup = Popup::Quit;
                    }
                    update(&mut model, Message::Key((*key).into()));
                    if binding.context != Context::Help {
                        model.popup = Popup::None;
                    }
                }
            }
        }
    }
}
