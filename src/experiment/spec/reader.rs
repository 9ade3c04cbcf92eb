//! A table of a spec, read key by key.
//!
//! A reader remembers the keys it was asked for. A key of the table that nobody asked for is an error
//! that names those that would have been right, so the list of valid keys is nowhere written twice.

use std::cell::{Cell, RefCell};
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::item::Item;
use super::limits::Limits;
use super::log::Log;
use super::suggest::{all_of, nearest};

/// A table that may be absent, in which case every key has its default.
pub(super) struct Reader<'a> {
    log: &'a Log<'a>,
    table: Option<&'a DeTable<'a>>,
    /// What messages call it, such as `[image]`.
    name: String,
    /// The heading of the manual that has its keys.
    heading: &'static str,
    /// Where a missing key is reported.
    span: Range<usize>,
    asked: RefCell<Vec<&'static str>>,
    /// Whether keys nobody asked for are let pass.
    forgiving: Cell<bool>,
}

impl<'a> Reader<'a> {
    /// Reads `table` with `read`, then logs the keys it did not ask for.
    pub fn read<T>(
        log: &'a Log<'a>,
        (name, heading): (String, &'static str),
        span: Range<usize>,
        table: Option<&'a DeTable<'a>>,
        read: impl FnOnce(&Reader<'a>) -> T,
    ) -> T {
        let (asked, forgiving) = (RefCell::default(), Cell::new(false));
        let reader = Self { log, table, name, heading, span, asked, forgiving };
        let value = read(&reader);
        reader.report_strangers();
        value
    }

    /// Reads the table under `key`, which may be absent.
    pub fn section<T>(
        &self,
        key: &'static str,
        heading: &'static str,
        read: impl FnOnce(&Reader<'a>) -> T,
    ) -> T {
        let item = self.item(key);
        let span = item.as_ref().map_or_else(|| self.log.end(), Item::span);
        let table = item.as_ref().and_then(Item::table);
        Reader::read(self.log, (format!("[{key}]"), heading), span, table, |reader| {
            // What is no table lacks all keys, which need not be said.
            reader.forgiving.set(item.is_some() && table.is_none());
            read(reader)
        })
    }

    /// Reads every table under `key`, with its name and the item it is.
    pub fn each_table<T>(
        &self,
        key: &'static str,
        heading: &'static str,
        read: impl Fn(&'a str, &Reader<'a>) -> T,
    ) -> Vec<T> {
        let tables = self.item(key).and_then(|item| item.table()).into_iter().flatten();
        let one = |(word, value): (&'a Spanned<DeString<'a>>, &'a Spanned<DeValue<'a>>)| {
            let name: &'a str = word.get_ref();
            if !is_plain(name) {
                let help = "names become parts of file names: use letters, digits, `-` and `_`";
                let message = format!("\"{name}\" cannot be a name");
                self.log.error(word.span(), message, Some(help.to_owned()));
            }
            let item = Item::new(self.log, format!("`{key}.{name}`"), value);
            let title = (format!("[{key}.{name}]"), heading);
            item.table().map(|table| {
                Reader::read(self.log, title, item.span(), Some(table), |r| read(name, r))
            })
        };
        tables.filter_map(one).collect()
    }

    /// The log.
    pub fn log(&self) -> &'a Log<'a> {
        self.log
    }

    /// What messages call the table.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The value of a key that the manual lists.
    pub fn item(&self, key: &'static str) -> Option<Item<'a>> {
        self.log.looked_for(self.heading, key);
        self.option(key)
    }

    /// The value of a key that the manual does not list: an option of a pattern or method.
    pub fn option(&self, key: &'static str) -> Option<Item<'a>> {
        let mut asked = self.asked.borrow_mut();
        if !asked.contains(&key) {
            asked.push(key);
        }
        let value = self.table?.get(key)?;
        Some(Item::new(self.log, format!("`{key}`"), value))
    }

    /// The value of a key that must be there.
    pub fn required(&self, key: &'static str, expected: &str) -> Option<Item<'a>> {
        let item = self.item(key);
        if item.is_none() && !self.forgiving.get() {
            let message = format!("{} needs the key `{key}`: {expected}", self.name);
            self.log.error(self.span.clone(), message, None);
        }
        item
    }

    /// Logs something wrong with the table as a whole.
    pub fn error(&self, message: String, help: Option<String>) {
        if !self.forgiving.get() {
            self.log.error(self.span.clone(), message, help);
        }
    }

    /// A number within limits.
    pub fn real(&self, key: &'static str, default: f64, limits: Limits) -> f64 {
        self.item(key).and_then(|item| item.real(limits)).unwrap_or(default)
    }

    /// A whole number from `min` to `max`.
    pub fn whole(&self, key: &'static str, default: u64, min: u64, max: u64) -> u64 {
        self.item(key).and_then(|item| item.whole(min, max)).unwrap_or(default)
    }

    /// One of a few words; the first is the default. If it is none of them, what other keys the table
    /// may have is not known, so all are let pass.
    pub fn choice<T: Copy>(&self, key: &'static str, choices: &[(&'static str, T)]) -> T {
        let default = choices[0].1;
        self.item(key).map_or(default, |item| {
            item.choice(choices).unwrap_or_else(|| {
                self.forgive();
                default
            })
        })
    }

    /// From here on, lets pass keys nobody asked for and keys that are missing.
    pub fn forgive(&self) {
        self.forgiving.set(true);
    }

    fn report_strangers(&self) {
        let asked = self.asked.borrow();
        let strangers = self.table.into_iter().flat_map(|table| table.keys());
        for key in strangers.filter(|key| !asked.contains(&key.get_ref().as_ref())) {
            if self.forgiving.get() {
                continue;
            }
            let names: Vec<String> = asked.iter().map(|key| format!("`{key}`")).collect();
            let valid = match names.as_slice() {
                [only] => format!("the only key of {} is {only}", self.name),
                names => format!("the keys of {} are {}", self.name, all_of(names)),
            };
            let help = match nearest(key.get_ref(), &asked) {
                Some(near) => format!("did you mean `{near}`? {}", capital(&valid)),
                None => valid,
            };
            let message = format!("unknown key `{}` in {}", key.get_ref(), self.name);
            self.log.error(key.span(), message, Some(help));
        }
    }
}

/// Whether a name can be part of a file's name anywhere.
fn is_plain(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    (1..=64).contains(&name.len()) && name.chars().all(plain)
}

fn capital(sentence: &str) -> String {
    sentence.replacen('t', "T", 1)
}
