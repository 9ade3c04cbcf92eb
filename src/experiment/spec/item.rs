//! A value of a spec, read as the type it should have.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::limits::Limits;
use super::log::Log;
use super::suggest::{any_of, nearest};

/// A value in the text. Every reading returns `None` after it has logged what is wrong.
#[derive(Clone)]
pub(super) struct Item<'a> {
    log: &'a Log<'a>,
    /// What messages call it: the key in backquotes.
    place: String,
    value: &'a Spanned<DeValue<'a>>,
}

impl<'a> Item<'a> {
    /// A value that messages call `place`.
    pub fn new(log: &'a Log<'a>, place: String, value: &'a Spanned<DeValue<'a>>) -> Self {
        Self { log, place, value }
    }

    /// Where it stands.
    pub fn span(&self) -> Range<usize> {
        self.value.span()
    }

    /// Logs that this value is wrong, in words of the caller's.
    pub fn error(&self, message: String, help: Option<String>) {
        self.log.error(self.span(), message, help);
    }

    /// Logs that this value is not `expected`.
    fn mismatch<T>(&self, expected: &str, help: Option<String>) -> Option<T> {
        self.error(format!("{} must be {expected}, not {}", self.place, self.found()), help);
        None
    }

    /// The value as written, if it is short enough to repeat; else its type.
    fn found(&self) -> String {
        match self.value.get_ref() {
            DeValue::Array(list) if list.is_empty() => "an empty list".to_owned(),
            DeValue::Array(_) => "a list".to_owned(),
            DeValue::Table(_) => "a table".to_owned(),
            DeValue::String(text) if text.contains('\n') => "a text of several lines".to_owned(),
            _ => self.log.slice(self.span()).to_owned(),
        }
    }

    /// A text.
    pub fn text(&self) -> Option<&'a str> {
        match self.value.get_ref() {
            DeValue::String(text) => Some(text),
            _ => self.mismatch("a text in quotes", None),
        }
    }

    /// A number within limits.
    pub fn real(&self, limits: Limits) -> Option<f64> {
        let number = match self.value.get_ref() {
            DeValue::Float(float) => float.as_str().parse().ok(),
            DeValue::Integer(_) => self.integer().map(|i| i as f64),
            _ => None,
        };
        number
            .filter(|x| limits.contain(*x))
            .or_else(|| self.mismatch(&format!("a number {limits}"), None))
    }

    /// A whole number from `min` to `max`.
    pub fn whole(&self, min: u64, max: u64) -> Option<u64> {
        self.integer_in(min, max)
            .or_else(|| self.mismatch(&format!("a whole number from {min} to {max}"), None))
    }

    /// A power of two from `min` to `max`.
    pub fn power_of_two(&self, min: u32, max: u32) -> Option<u32> {
        self.integer_in(min.into(), max.into())
            .and_then(|i| u32::try_from(i).ok())
            .filter(|i| i.is_power_of_two())
            .or_else(|| self.mismatch(&format!("a power of two from {min} to {max}"), None))
    }

    fn integer_in(&self, min: u64, max: u64) -> Option<u64> {
        let integer = u64::try_from(self.integer()?).ok()?;
        (min..=max).contains(&integer).then_some(integer)
    }

    fn integer(&self) -> Option<i128> {
        let integer = self.value.get_ref().as_integer()?;
        i128::from_str_radix(integer.as_str(), integer.radix()).ok()
    }

    /// One of a few words, and what it stands for.
    pub fn choice<T: Copy>(&self, choices: &[(&'static str, T)]) -> Option<T> {
        let words: Vec<&str> = choices.iter().map(|(word, _)| *word).collect();
        let quoted: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
        let DeValue::String(text) = self.value.get_ref() else {
            return self.mismatch(&any_of(&quoted), None);
        };
        choices.iter().find(|(word, _)| word == text).map(|(_, choice)| *choice).or_else(|| {
            let help = nearest(text, &words).map(|word| format!("did you mean \"{word}\"?"));
            self.mismatch(&any_of(&quoted), help)
        })
    }

    /// A table.
    pub fn table(&self) -> Option<&'a DeTable<'a>> {
        match self.value.get_ref() {
            DeValue::Table(table) => Some(table),
            _ => self.mismatch("a table", None),
        }
    }

    /// The same value, called otherwise in messages.
    pub fn called(&self, place: String) -> Self {
        Self { place, ..self.clone() }
    }

    /// A whole number from `min` to `max`, which may be negative.
    pub fn integer_from(&self, min: i64, max: i64) -> Option<i64> {
        let whole = self.integer().and_then(|i| i64::try_from(i).ok());
        whole
            .filter(|i| (min..=max).contains(i))
            .or_else(|| self.mismatch(&format!("a whole number from {min} to {max}"), None))
    }

    /// The values of a list that has a number of them within `count`.
    pub fn members(
        &self,
        count: std::ops::RangeInclusive<usize>,
        expected: &str,
    ) -> Option<Vec<Item<'a>>> {
        match self.value.get_ref() {
            DeValue::Array(list) if count.contains(&list.len()) => {
                Some(list.iter().map(|value| self.member(value)).collect())
            }
            _ => self.mismatch(expected, None),
        }
    }

    /// Exactly `N` values, such as the coordinates of a point.
    pub fn tuple<const N: usize>(&self, expected: &str) -> Option<[Item<'a>; N]> {
        self.members(N..=N, expected)?.try_into().ok()
    }

    /// A point or vector, each coordinate from −10⁶ to 10⁶. All three are read before any is missed, so that
    /// all errors are told.
    pub fn point(&self) -> Option<[f64; 3]> {
        let coordinate = Limits::from_to(-1e6, 1e6);
        let [x, y, z] = self.tuple("three numbers, [x, y, z]")?.map(|c| c.real(coordinate));
        Some([x?, y?, z?])
    }

    /// A list of at least one value, each read by `read`, no two the same. What cannot be read is
    /// left out, once logged.
    pub fn list<T: PartialEq>(
        &self,
        expected: &str,
        read: impl Fn(&Item<'a>) -> Option<T>,
    ) -> Vec<T> {
        let mut values: Vec<T> = Vec::new();
        match self.value.get_ref() {
            DeValue::Array(list) if !list.is_empty() => {
                for item in list.iter().map(|value| self.member(value)) {
                    match read(&item) {
                        Some(value) if values.contains(&value) => item.repeated(&self.place),
                        value => values.extend(value),
                    }
                }
            }
            _ => self.mismatch(&format!("a list of {expected}"), None).unwrap_or_default(),
        }
        values
    }

    fn repeated(&self, list: &str) {
        let help = "list each only once".to_owned();
        self.error(format!("{} is in {list} twice", self.found()), Some(help));
    }

    fn member(&self, value: &'a Spanned<DeValue<'a>>) -> Item<'a> {
        Item::new(self.log, format!("each of {}", self.place.trim_start_matches("each of ")), value)
    }
}
