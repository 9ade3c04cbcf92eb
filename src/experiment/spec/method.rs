//! Methods: a filter with its options, under a label.

use super::catalogue::Catalogue;
use super::reader::Reader;
use super::values::read_values;
use crate::method::{self, Method};
use crate::parameter::Values;

/// A method of the sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodSpec {
    /// Its label in this experiment: letters, digits, `-` and `_`.
    pub label: String,
    /// The method's name in [`crate::method::entries`].
    pub name: &'static str,
    /// Its options.
    pub values: Values,
}

impl MethodSpec {
    /// The method with these options.
    ///
    /// # Panics
    /// If the name is not in the registry: a spec that was read names what is.
    pub fn build(&self) -> Box<dyn Method> {
        let entry = method::find(self.name).expect("the spec names registered methods");
        (entry.build)(&self.values)
    }

    /// A method with its defaults, labelled with its name.
    pub(super) fn plain(catalogue: &Catalogue, method: &str) -> Option<Self> {
        let entry = catalogue.method(method)?;
        let values = Values::defaults(entry.parameters);
        Some(Self { label: method.to_owned(), name: entry.card.name, values })
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
        Some(Self { label: label.to_owned(), name: entry.card.name, values })
    }
}
