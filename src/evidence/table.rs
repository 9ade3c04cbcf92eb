//! Tables of an exhibit.

use serde::{Deserialize, Serialize};

use super::Quantity;

/// A cell of a [`Table`].
pub type Cell = Quantity;

/// A table of an exhibit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// Its name within the row, safe as part of a file's name.
    pub name: String,
    /// What it shows, a sentence.
    pub caption: String,
    /// Column headings with units; the first column names the row.
    pub head: Vec<String>,
    /// Rows as long as `head`.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table without rows.
    pub fn new(name: &str, caption: impl Into<String>, head: &[&str]) -> Self {
        let head = head.iter().map(|&heading| heading.to_owned()).collect();
        Self { name: name.into(), caption: caption.into(), head, rows: Vec::new() }
    }

    /// Adds a row.
    ///
    /// # Panics
    /// If it has not one cell for each heading: a programming error.
    pub fn push(&mut self, row: Vec<Cell>) {
        assert_eq!(row.len(), self.head.len(), "cells of a row of {}", self.name);
        self.rows.push(row);
    }
}
