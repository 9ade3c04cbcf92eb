//! The budget: which methods' errors are shared out among their parts.

use super::item::Item;
use super::reader::Reader;
use super::suggest::{all_of, nearest};
use super::sweep::SweepSpec;
use crate::lobe::Shading;

/// Which errors are shared out, and how.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BudgetSpec {
    /// Indices of the methods in the sweep, rising.
    pub methods: Vec<usize>,
    /// Points a pixel that the truth is found from, a power of two.
    pub points: u32,
}

/// What a budget is checked against.
pub(super) struct Surroundings<'a> {
    pub sweep: &'a SweepSpec,
    pub shading: Shading,
    pub environment: bool,
    pub moves: bool,
}

impl BudgetSpec {
    pub(super) fn read(reader: &Reader, around: &Surroundings) -> Self {
        if let Some((message, help)) = around.refusal() {
            reader.error(message.to_owned(), Some(help.to_owned()));
        }
        let labels: Vec<&str> = around.sweep.methods.iter().map(|m| m.label.as_str()).collect();
        let listed = reader.item("methods").map(|list| {
            let mut found =
                list.list("labels of methods of the sweep", |item| label(item, &labels));
            found.sort_unstable();
            found
        });
        let points = reader.item("points").and_then(|item| item.power_of_two(64, 65536));
        Self {
            methods: listed.unwrap_or_else(|| (0..labels.len()).collect()),
            points: points.unwrap_or(1024),
        }
    }
}

/// The index of the method that an item names.
fn label(item: &Item, labels: &[&str]) -> Option<usize> {
    let text = item.text()?;
    let found = labels.iter().position(|label| *label == text);
    if found.is_none() && !labels.is_empty() {
        let names: Vec<String> = labels.iter().map(|label| format!("\"{label}\"")).collect();
        let all = format!("the sweep has {}", all_of(&names));
        let help = nearest(text, labels).map_or(all, |near| format!("did you mean \"{near}\"?"));
        item.error(format!("the sweep has no method \"{text}\""), Some(help));
    }
    found
}

impl Surroundings<'_> {
    /// Why there can be no budget here, and what to do.
    fn refusal(&self) -> Option<(&'static str, &'static str)> {
        if self.environment {
            return Some((
                "no budget can be drawn up under an environment, which lights each lobe from all sides",
                "leave out [budget], or choose another light",
            ));
        }
        if self.shading == Shading::Phong {
            return Some((
                "no budget can be drawn up of Phong\u{2019}s highlights, which look at no half vector",
                "leave out [budget], or choose another shading",
            ));
        }
        let still = "leave out [budget] or [motion]";
        self.moves.then_some(("no budget can be drawn up of things that move", still))
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::Spec;

    fn read(rest: &str) -> Result<Spec, String> {
        let sweep = "[sweep]\ntexture = [\"twill\"]\nmethod = [\"averaged\", \"lean\"]\n";
        let path = Path::new("a.toml");
        Spec::parse(&format!("{sweep}{rest}"), path).map_err(|error| error.to_string())
    }

    #[test]
    fn an_empty_table_asks_for_all_methods() {
        assert_eq!(read("").unwrap().budget, None);
        let budget = read("[budget]").unwrap().budget.unwrap();
        assert_eq!((budget.methods, budget.points), (vec![0, 1], 1024));
        let budget = read("[budget]\nmethods = [\"lean\"]\npoints = 64").unwrap().budget.unwrap();
        assert_eq!((budget.methods, budget.points), (vec![1], 64));
    }

    #[test]
    fn what_cannot_be_is_told() {
        let cases = [
            ("[budget]\nmethods = [\"leen\"]", "did you mean \"lean\"?"),
            ("[budget]\nmethods = []", "a list of labels of methods of the sweep"),
            ("[budget]\npoints = 100", "a power of two from 64 to 65536"),
            ("[budget]\nwhat = 1", "unknown key `what`"),
            ("[light]\nkind = \"environment\"\n[budget]", "under an environment"),
            ("[material]\nshading = \"phong\"\n[budget]", "half vector"),
            ("[motion]\n[budget]", "things that move"),
        ];
        for (text, want) in cases {
            let error = read(text).unwrap_err();
            assert!(error.contains(want), "{text}: {error}");
        }
    }
}
