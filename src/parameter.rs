//! Floor 0: what patterns, methods and environments say of themselves: the options they take, described so that
//! a spec can be checked against them and help can be printed from them.

use std::collections::BTreeMap;

/// What a pattern or an environment is, for lists, reports and help.
#[derive(Clone, Copy, Debug)]
pub struct Card {
    /// Its name in specs.
    pub name: &'static str,
    /// Author, year, section it comes from, or what defines it.
    pub source: &'static str,
    /// What it looks like, in a sentence.
    pub summary: &'static str,
}

/// One option of a pattern or method.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Its key in a spec.
    pub name: &'static str,
    /// What it does, its unit and space.
    pub meaning: &'static str,
    /// What it may be, and what it is if the spec is silent.
    pub domain: Domain,
}

/// The values a [`Parameter`] may take, and its default.
#[derive(Clone, Copy, Debug)]
pub enum Domain {
    /// A real number in [min, max].
    Real {
        /// Value if not given.
        default: f64,
        /// Smallest value allowed.
        min: f64,
        /// Largest value allowed.
        max: f64,
    },
    /// A whole number in [min, max].
    Whole {
        /// Value if not given.
        default: u32,
        /// Smallest value allowed.
        min: u32,
        /// Largest value allowed.
        max: u32,
    },
    /// One of a few words; the first is the default.
    Choice {
        /// The words.
        words: &'static [&'static str],
    },
    /// A text.
    Text {
        /// Text if not given.
        default: &'static str,
        /// Tells what is wrong with a text, a phrase that goes on "`text` ".
        check: fn(&str) -> Result<(), String>,
    },
    /// A list of rows of numbers, such as the terms of a series.
    Rows {
        /// What each number of a row is.
        columns: &'static [Column],
        /// The rows if not given.
        default: &'static [&'static [f64]],
        /// Most rows allowed; at least one is.
        most: usize,
    },
}

/// A number in each row of [`Domain::Rows`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// What it is.
    pub name: &'static str,
    /// Smallest value allowed.
    pub min: f64,
    /// Largest value allowed.
    pub max: f64,
    /// Whether it must be a whole number.
    pub whole: bool,
}

impl Domain {
    /// The value if a spec is silent.
    pub fn default(&self) -> Value {
        match *self {
            Self::Real { default, .. } => Value::Number(default),
            Self::Whole { default, .. } => Value::Number(f64::from(default)),
            Self::Choice { words } => Value::Word(words[0]),
            Self::Text { default, .. } => Value::Text(default.to_owned()),
            Self::Rows { default, .. } => {
                Value::Rows(default.iter().map(|row| row.to_vec()).collect())
            }
        }
    }
}

/// The columns of [`Domain::Rows`] in brackets, as a spec writes a row.
pub fn row_form(columns: &[Column]) -> String {
    let names: Vec<&str> = columns.iter().map(|column| column.name).collect();
    format!("[{}]", names.join(", "))
}

/// A parameter's value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Of a real or whole parameter.
    Number(f64),
    /// Of a choice.
    Word(&'static str),
    /// Of a text.
    Text(String),
    /// Of rows of numbers.
    Rows(Vec<Vec<f64>>),
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Word(word) => f.write_str(word),
            Self::Text(text) => write!(f, "{text:?}"),
            Self::Rows(rows) => write!(f, "{rows:?}"),
        }
    }
}

/// Values for all parameters of a pattern or method; complete and within their domains.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Values(BTreeMap<&'static str, Value>);

impl Values {
    /// The defaults of these parameters.
    pub fn defaults(parameters: &[Parameter]) -> Self {
        Self(parameters.iter().map(|p| (p.name, p.domain.default())).collect())
    }

    /// The same with some values set, as [`Values::set`] does.
    pub fn with(mut self, set: &[(&'static str, Value)]) -> Self {
        set.iter().for_each(|(name, value)| self.set(name, value.clone()));
        self
    }

    /// Sets a value. The caller has checked it against the parameter's domain.
    pub fn set(&mut self, name: &'static str, value: Value) {
        self.0.insert(name, value);
    }

    /// The number of parameter `name`.
    ///
    /// # Panics
    /// If there is no such number: a programming error, as values are complete.
    pub fn number(&self, name: &str) -> f64 {
        match self.0.get(name) {
            Some(Value::Number(number)) => *number,
            other => panic!("parameter {name} is {other:?}, not a number"),
        }
    }

    /// The whole number of parameter `name`.
    ///
    /// # Panics
    /// If there is no such number.
    pub fn whole(&self, name: &str) -> usize {
        self.number(name) as usize
    }

    /// The word of parameter `name`.
    ///
    /// # Panics
    /// If there is no such word.
    pub fn word(&self, name: &str) -> &'static str {
        match self.0.get(name) {
            Some(Value::Word(word)) => word,
            other => panic!("parameter {name} is {other:?}, not a word"),
        }
    }

    /// The text of parameter `name`.
    ///
    /// # Panics
    /// If there is no such text.
    pub fn text(&self, name: &str) -> &str {
        match self.0.get(name) {
            Some(Value::Text(text)) => text,
            other => panic!("parameter {name} is {other:?}, not a text"),
        }
    }

    /// The rows of parameter `name`, each as long as its columns.
    ///
    /// # Panics
    /// If there are no such rows.
    pub fn rows(&self, name: &str) -> &[Vec<f64>] {
        match self.0.get(name) {
            Some(Value::Rows(rows)) => rows,
            other => panic!("parameter {name} is {other:?}, not rows of numbers"),
        }
    }

    /// All values by name, in alphabetical order.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &Value)> + '_ {
        self.0.iter().map(|(name, value)| (*name, value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_complete() {
        let parameters = [
            Parameter {
                name: "peaks",
                meaning: "",
                domain: Domain::Whole { default: 7, min: 1, max: 12 },
            },
            Parameter {
                name: "form",
                meaning: "",
                domain: Domain::Choice { words: &["normalised", "printed"] },
            },
        ];
        let mut values = Values::defaults(&parameters);
        assert_eq!((values.whole("peaks"), values.word("form")), (7, "normalised"));
        values.set("peaks", Value::Number(3.0));
        assert_eq!(values.whole("peaks"), 3);
    }
}
