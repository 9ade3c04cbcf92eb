//! The table of keys holds what it says.

use super::bindings::{DOWN, LEFT, RIGHT, UP};
use super::*;

#[test]
fn no_key_means_two_things_in_one_context() {
    for (i, one) in BINDINGS.iter().enumerate() {
        for other in &BINDINGS[..i] {
            let same = one.keys.iter().find(|key| other.keys.contains(key));
            assert!(
                one.context != other.context || same.is_none(),
                "{:?}: {same:?} does {:?} and {:?}",
                one.context,
                one.action,
                other.action
            );
        }
    }
}

/// What is shown together shadows nothing of itself.
#[test]
fn contexts_that_hold_together_do_not_hide_each_other() {
    for contexts in crate::tui::model::Model::all_contexts() {
        for (i, context) in contexts.iter().enumerate() {
            for binding in BINDINGS.iter().filter(|b| b.context == *context) {
                for key in binding.keys {
                    let hidden = find(&contexts[..i], *key);
                    assert!(hidden.is_none(), "{contexts:?}: {key} of {context:?} is {hidden:?}");
                }
            }
        }
    }
}

#[test]
fn every_binding_is_found_and_explained() {
    for binding in BINDINGS {
        assert!(!binding.words.is_empty());
        for (nth, key) in binding.keys.iter().enumerate() {
            let found = find(&[binding.context], *key);
            assert_eq!(found, Some(Pressed { action: binding.action, nth }), "{key}");
        }
        assert!(Context::ALL.contains(&binding.context));
    }
}

#[test]
fn arrows_and_vi_keys_are_one() {
    for pair in [UP, DOWN, LEFT, RIGHT] {
        assert!(matches!(
            pair[0].code,
            KeyCode::Up | KeyCode::Down | KeyCode::Left | KeyCode::Right
        ));
        assert!(matches!(pair[1].code, KeyCode::Char('h' | 'j' | 'k' | 'l')));
    }
}
