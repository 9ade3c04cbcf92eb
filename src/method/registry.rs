//! The list of methods. A new one is a file and a line here.

use super::{
    Card, Method, averaged, fournier, kautz, lean, olano_north, schilling, toksvig, unfiltered,
};
use crate::parameter::{Parameter, Values};

/// A method the program knows: what it is, what it takes, how to make one.
pub struct Entry {
    /// What it is.
    pub card: Card,
    /// Its options.
    pub parameters: &'static [Parameter],
    /// Makes one with these options (complete, within their domains).
    pub build: fn(&Values) -> Box<dyn Method>,
}

/// Every method, in the order reports show them.
pub fn entries() -> Vec<Entry> {
    let mut all = vec![unfiltered::entry(), averaged::entry(), fournier::entry()];
    all.extend(schilling::entries());
    all.extend(olano_north::entries());
    all.extend([kautz::entry(), toksvig::entry(), lean::entry()]);
    all
}

/// The method of this name.
pub fn find(name: &str) -> Option<Entry> {
    entries().into_iter().find(|entry| entry.card.name == name)
}

/// The method of this name with its default options.
pub fn build(name: &str) -> Option<Box<dyn Method>> {
    find(name).map(|entry| (entry.build)(&Values::defaults(entry.parameters)))
}

/// The method that, with many samples a pixel, is the supersampled truth.
pub fn brute_force() -> Box<dyn Method> {
    Box::new(unfiltered::Unfiltered::default())
}
