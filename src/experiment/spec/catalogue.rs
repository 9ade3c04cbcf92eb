//! The patterns and methods that a spec may name.

use super::item::Item;
use super::suggest::{any_of, nearest};
use crate::{method, pattern};

/// All patterns and methods; tests use lists of their own.
pub(super) struct Catalogue {
    pub patterns: Vec<pattern::Entry>,
    pub methods: Vec<method::Entry>,
}

impl Catalogue {
    /// Everything the program knows.
    pub fn all() -> Self {
        Self { patterns: pattern::entries(), methods: method::entries() }
    }

    /// The pattern of this name.
    pub fn pattern(&self, name: &str) -> Option<&pattern::Entry> {
        self.patterns.iter().find(|entry| entry.card.name == name)
    }

    /// The method of this name.
    pub fn method(&self, name: &str) -> Option<&method::Entry> {
        self.methods.iter().find(|entry| entry.card.name == name)
    }

    /// The pattern `name`, which `item` asks for; logs if there is none.
    pub fn need_pattern(&self, name: &str, item: &Item) -> Option<&pattern::Entry> {
        self.pattern(name).or_else(|| unknown("pattern", name, item, &self.pattern_names()))
    }

    /// The method `name`, which `item` asks for; logs if there is none.
    pub fn need_method(&self, name: &str, item: &Item) -> Option<&method::Entry> {
        self.method(name).or_else(|| unknown("method", name, item, &self.method_names()))
    }

    /// The names of all patterns.
    pub fn pattern_names(&self) -> Vec<&'static str> {
        self.patterns.iter().map(|entry| entry.card.name).collect()
    }

    /// The names of all methods.
    pub fn method_names(&self) -> Vec<&'static str> {
        self.methods.iter().map(|entry| entry.card.name).collect()
    }
}

/// Logs that `item` names a `what` that there is not, and the names there are.
pub(super) fn unknown<T>(what: &str, name: &str, item: &Item, names: &[&str]) -> Option<T> {
    let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    let valid = format!("it may be {}", any_of(&quoted));
    let help = match nearest(name, names) {
        Some(near) => format!("did you mean \"{near}\"? Here {valid}"),
        None => valid,
    };
    item.error(format!("unknown {what} \"{name}\""), Some(help));
    None
}
