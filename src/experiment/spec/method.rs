//! Methods: a filter with its options, under a label.

use super::catalogue::Catalogue;
use super::item::Item;
use super::reader::Reader;
use super::values::read_values;
use crate::method::{self, Method};
use crate::parameter::Values;
use crate::texture::Lookup;

/// A method of the sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodSpec {
    /// Its label in this experiment: letters, digits, `-` and `_`.
    pub label: String,
    /// The method's name in [`crate::method::entries`].
    pub name: &'static str,
    /// Its options.
    pub values: Values,
    /// How it looks up what lies under a footprint.
    pub lookup: Lookup,
}

/// The words for lookups.
pub(super) const LOOKUPS: [(&str, Lookup); 4] = [
    ("trilinear", Lookup::Trilinear),
    ("anisotropic", Lookup::Anisotropic),
    ("ewa", Lookup::Ewa),
    ("exact", Lookup::Exact),
];

impl MethodSpec {
    /// The method with these options.
    ///
    /// # Panics
    /// If the name is not in the registry: a spec that was read names what is.
    pub fn build(&self) -> Box<dyn Method> {
        let entry = method::find(self.name).expect("the spec names registered methods");
        (entry.build)(&self.values)
    }

    /// Whether it is the same filter, if perhaps by another lookup.
    pub fn same_filter(&self, other: &Self) -> bool {
        self.name == other.name && self.values == other.values
    }

    /// A method with its defaults, labelled with its name.
    pub(super) fn plain(catalogue: &Catalogue, method: &str) -> Option<Self> {
        let entry = catalogue.method(method)?;
        let values = Values::defaults(entry.parameters);
        let (label, lookup) = (method.to_owned(), Lookup::default());
        Some(Self { label, name: entry.card.name, values, lookup })
    }

    /// The method by another lookup, labelled so; `None` if it looks at no footprint, and so has none.
    /// Logs, at `item`, if it has lookups but not this one.
    pub(super) fn by(&self, lookup: Lookup, item: &Item) -> Option<Self> {
        let takes = self.build().lookups();
        if takes.is_empty() {
            return None;
        }
        self.check(lookup, item);
        let label = match lookup {
            Lookup::Trilinear => self.label.clone(),
            other => format!("{}-{}", self.label, other.name()),
        };
        Some(Self { label, lookup, ..self.clone() })
    }

    /// Logs, at `item`, if the method does not take this lookup.
    fn check(&self, lookup: Lookup, item: &Item) {
        let takes = self.build().lookups();
        if takes.contains(&lookup) {
            return;
        }
        let names: Vec<&str> = takes.iter().map(|lookup| lookup.name()).collect();
        let (label, name) = (&self.label, lookup.name());
        let (message, help) = match names.as_slice() {
            [] => (format!("`{label}` looks at no footprint: it has no lookup"), None),
            names => (
                format!("`{label}` has no {name} lookup with these options"),
                Some(format!("it has {}", names.join(", "))),
            ),
        };
        item.error(message, help);
    }

    /// Reads a `[method.LABEL]` table. `None` if it does not say what it is; that is logged.
    pub(super) fn read(label: &str, reader: &Reader, catalogue: &Catalogue) -> Option<Self> {
        let item = reader.required("use", "the name of a method");
        let entry = item.and_then(|item| catalogue.need_method(item.text()?, &item));
        let Some(entry) = entry else {
            reader.forgive();
            return None;
        };
        let values = read_values(reader, entry.parameters);
        let item = reader.item("lookup");
        let lookup = item.as_ref().and_then(|item| item.choice(&LOOKUPS));
        let (label, name) = (label.to_owned(), entry.card.name);
        let method = Self { label, name, values, lookup: lookup.unwrap_or_default() };
        if let (Some(item), Some(lookup)) = (&item, lookup) {
            method.check(lookup, item);
        }
        Some(method)
    }
}
