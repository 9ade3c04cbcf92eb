//! A table that can be sorted by any of its columns.

mod view;

#[cfg(test)]
mod tests;

use std::cmp::Ordering;

pub use view::{TableView, fitted};

/// A column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its heading.
    pub title: String,
    /// Whether it holds numbers: those stand at the right.
    pub numbers: bool,
    /// Which columns go first where there is no room for all: those of the greatest value, from the right. One of
    /// value 0 stays.
    pub rank: u8,
}

impl Column {
    /// A column of text.
    pub fn text(title: &str, rank: u8) -> Self {
        Self { title: title.to_owned(), numbers: false, rank }
    }

    /// A column of numbers.
    pub fn numbers(title: &str, rank: u8) -> Self {
        Self { title: title.to_owned(), numbers: true, rank }
    }
}

/// A cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A number, and how it is written.
    Number(f64, String),
    /// Nothing: not measured.
    None,
}

impl Cell {
    /// A number to three digits; nothing if it is not finite.
    pub fn number(value: Option<f64>) -> Self {
        match value.filter(|value| value.is_finite()) {
            Some(value) => Self::Number(value, crate::report::phrase::number(value)),
            None => Self::None,
        }
    }

    /// A whole number; nothing if there is none.
    pub fn count(value: Option<u32>) -> Self {
        value.map_or(Self::None, |value| Self::Number(value.into(), value.to_string()))
    }

    fn shown(&self) -> &str {
        match self {
            Self::Text(text) | Self::Number(_, text) => text,
            Self::None => "–",
        }
    }

    /// By value: numbers before words before nothing, whichever the direction.
    fn order(&self, other: &Self, descending: bool) -> Ordering {
        let turned = |order: Ordering| if descending { order.reverse() } else { order };
        let kind = |cell: &Self| match cell {
            Self::Number(..) => 0,
            Self::Text(_) => 1,
            Self::None => 2,
        };
        match (self, other) {
            (Self::Number(a, _), Self::Number(b, _)) => turned(a.total_cmp(b)),
            (Self::Text(a), Self::Text(b)) => turned(a.cmp(b)),
            (a, b) => kind(a).cmp(&kind(b)),
        }
    }
}

/// A table with its order and its chosen row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
    /// Places in `rows`, in the order they are shown.
    order: Vec<usize>,
    /// The column it is sorted by, and whether from the greatest; as the rows came if there is none.
    by: Option<(usize, bool)>,
    /// The chosen row, a place in `order`.
    chosen: usize,
}

impl Table {
    /// A table without rows.
    pub fn new(columns: Vec<Column>) -> Self {
        Self { columns, ..Self::default() }
    }

    /// Its columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether it has no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Gives it other rows, which are sorted as those before. The chosen row stays the one that is alike in the columns
    /// of the ranks 0 and 1, which tell rows apart, if there still is one. A row of more or fewer cells than columns is cut or filled up.
    pub fn set_rows(&mut self, mut rows: Vec<Vec<Cell>>) {
        let own: Vec<bool> = self.columns.iter().map(|column| column.rank <= 1).collect();
        let name = |row: &[Cell]| {
            let cells = row.iter().zip(&own).filter(|(_, own)| **own);
            cells.map(|(cell, _)| cell.clone()).collect::<Vec<_>>()
        };
        let before = self.chosen_row().map(name);
        rows.iter_mut().for_each(|row| row.resize(self.columns.len(), Cell::None));
        self.rows = rows;
        self.sort();
        let same = |row: &usize| Some(name(&self.rows[*row])) == before;
        let found = self.order.iter().position(same);
        self.chosen = found.unwrap_or(self.chosen.min(self.rows.len().saturating_sub(1)));
    }

    /// Sorts by a column: from the least, or, if it was sorted so already, from the greatest; and then not at all. The
    /// chosen row stays chosen. A column that is not there changes nothing.
    pub fn sort_by(&mut self, column: usize) {
        if column >= self.columns.len() {
            return;
        }
        self.by = match self.by {
            Some((by, false)) if by == column => Some((column, true)),
            Some((by, true)) if by == column => None,
            _ => Some((column, false)),
        };
        let row = self.order.get(self.chosen).copied();
        self.sort();
        self.chosen = self.order.iter().position(|place| Some(*place) == row).unwrap_or(0);
    }

    /// Sorts by the column that is `steps` further, around the ends; from the least.
    pub fn sort_by_next(&mut self, steps: isize) {
        let all = self.columns.len() as isize;
        if all > 0 {
            let from = self.by.map_or(if steps > 0 { -1 } else { 0 }, |(by, _)| by as isize);
            self.by = None;
            self.sort_by((from + steps).rem_euclid(all) as usize);
        }
    }

    /// Turns the order it is sorted in around.
    pub fn turn_around(&mut self) {
        if let Some((column, descending)) = self.by {
            self.by = Some((column, !descending));
            let row = self.order.get(self.chosen).copied();
            self.sort();
            self.chosen = self.order.iter().position(|place| Some(*place) == row).unwrap_or(0);
        }
    }

    /// Sorts by the column of this title, from the greatest if the second says so; not at all if there is none.
    pub fn sort_by_title(&mut self, by: Option<(String, bool)>) {
        self.by = by.and_then(|(title, descending)| {
            let place = self.columns.iter().position(|column| column.title == title)?;
            Some((place, descending))
        });
        self.sort();
    }

    /// The column it is sorted by, and whether from the greatest.
    pub fn sorted_by(&self) -> Option<(usize, bool)> {
        self.by
    }

    /// Chooses the row `steps` further, within the table.
    pub fn go(&mut self, steps: isize) {
        let last = self.rows.len().saturating_sub(1);
        self.chosen = self.chosen.saturating_add_signed(steps).min(last);
    }

    /// Place of the chosen row, from the top.
    pub fn chosen(&self) -> usize {
        self.chosen
    }

    /// The cells of the chosen row.
    pub fn chosen_row(&self) -> Option<&[Cell]> {
        self.order.get(self.chosen).map(|&place| self.rows[place].as_slice())
    }

    /// The rows as they are shown.
    fn shown(&self) -> impl ExactSizeIterator<Item = &[Cell]> {
        self.order.iter().map(|&place| self.rows[place].as_slice())
    }

    fn sort(&mut self) {
        self.order = (0..self.rows.len()).collect();
        if let Some((column, descending)) = self.by {
            let rows = &self.rows;
            let order =
                |a: &usize, b: &usize| rows[*a][column].order(&rows[*b][column], descending);
            self.order.sort_by(order);
        }
    }
}
