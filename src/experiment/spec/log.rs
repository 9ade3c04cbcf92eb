//! Where readers write what they find wrong, so that all of it can be told at once.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::Path;

use super::error::{SpecError, SpecErrors};

/// Everything wrong with a text so far, and every key that was looked for.
pub(super) struct Log<'a> {
    path: &'a Path,
    text: &'a str,
    errors: RefCell<Vec<SpecError>>,
    keys: RefCell<BTreeSet<(&'static str, &'static str)>>,
}

impl<'a> Log<'a> {
    /// A log about `text`, which came from the file `path`.
    pub fn new(path: &'a Path, text: &'a str) -> Self {
        Self { path, text, errors: RefCell::default(), keys: RefCell::default() }
    }

    /// The spec's file.
    pub fn path(&self) -> &'a Path {
        self.path
    }

    /// The text of a span.
    pub fn slice(&self, span: Range<usize>) -> &'a str {
        self.text.get(span).unwrap_or("")
    }

    /// The place just past the last word of the text: where a missing table could be written.
    pub fn end(&self) -> Range<usize> {
        let end = self.text.trim_end().len();
        end..end
    }

    /// Something is wrong at `span`.
    pub fn error(&self, span: Range<usize>, message: String, help: Option<String>) {
        let error = SpecError::new(self.path, self.text, span, message, help);
        self.errors.borrow_mut().push(error);
    }

    /// A key that specs may have under a heading was looked for.
    pub fn looked_for(&self, heading: &'static str, key: &'static str) {
        self.keys.borrow_mut().insert((heading, key));
    }

    /// Whether all is well so far.
    ///
    /// # Errors
    /// Everything logged, in the order of the text.
    pub fn check(&self) -> Result<(), SpecErrors> {
        let mut errors = self.errors.borrow().clone();
        errors.sort_by_key(|e| (e.span.start, e.span.end));
        // What is common to several parts is read with each.
        errors.dedup();
        if errors.is_empty() { Ok(()) } else { Err(SpecErrors::Invalid(errors)) }
    }

    /// Every (heading, key) looked for so far.
    #[cfg(test)]
    pub fn keys(&self) -> BTreeSet<(&'static str, &'static str)> {
        self.keys.borrow().clone()
    }
}
