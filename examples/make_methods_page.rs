//! Writes docs/methods.md from the registry: `cargo run --example make_methods_page`. A test holds the
//! page to it.

use std::fmt::Write;

use wrinkle::lobe::BaseLobe;
use wrinkle::method::{Entry, entries};
use wrinkle::parameter::{Domain, Parameter, Values, row_form};

const HEAD: &str = "# Methods

What the program can filter with, in the order reports show them. This page is written from the method
cards in `src/method/` by `cargo run --example make_methods_page`; `wrinkle list` prints a part of it.

*Keeps energy* means that the lobes of a footprint send as much light as its normals do; forms printed
without a normalisation do not. *Keeps roughness* means that bumps too small to see widen the lobe.
*Base lobes* says how near a method comes to the surface's own lobe where a footprint holds a single
normal: the total variation distance it claims to stay under at the default widths, 0 for the same lobe.
";

/// The base lobes at their default widths (docs/experiments.md).
const BASES: [BaseLobe; 3] = [
    BaseLobe::BlinnPhong { exponent: 60.0 },
    BaseLobe::Beckmann { alpha: 0.2 },
    BaseLobe::Ggx { alpha: 0.2 },
];

/// The page.
pub fn page() -> Result<String, std::fmt::Error> {
    let mut page = String::from(HEAD);
    for entry in entries() {
        section(&mut page, &entry)?;
    }
    Ok(page)
}

fn section(page: &mut String, entry: &Entry) -> std::fmt::Result {
    let card = entry.card;
    let yes = |is: bool| if is { "yes" } else { "no" };
    writeln!(page, "\n## `{}`\n\n{}\n", card.name, card.summary)?;
    writeln!(page, "| | |\n|---|---|")?;
    writeln!(page, "| source | {} |", cell(card.source))?;
    writeln!(page, "| multiple surface | {} |", cell(card.formula))?;
    writeln!(page, "| limits | {} |", cell(card.limits))?;
    writeln!(page, "| keeps energy | {} |", yes(card.normalised))?;
    writeln!(page, "| keeps roughness | {} |", yes(card.keeps_roughness))?;
    writeln!(page, "| base lobes | {} |", cell(&base_lobes(entry)))?;
    if !entry.parameters.is_empty() {
        writeln!(page, "\n| option | values | default | meaning |\n|---|---|---|---|")?;
        for Parameter { name, meaning, domain } in entry.parameters {
            let (default, values) = (domain.default(), values(domain));
            writeln!(page, "| `{name}` | {values} | {default} | {} |", cell(meaning))?;
        }
    }
    Ok(())
}

fn base_lobes(entry: &Entry) -> String {
    let method = (entry.build)(&Values::defaults(entry.parameters));
    let each = BASES.map(|base| match method.base_error(&base) {
        Ok(error) => format!("{} {:.2}", base.name(), error),
        Err(refusal) => format!("{} none: {refusal}", base.name()),
    });
    each.join("; ")
}

fn values(domain: &Domain) -> String {
    match domain {
        Domain::Real { min, max, .. } => format!("number, [{min}, {max}]"),
        Domain::Whole { min, max, .. } => format!("whole number, [{min}, {max}]"),
        Domain::Choice { words } => words.join(", "),
        Domain::Text { .. } => "text".into(),
        Domain::Rows { columns, most, .. } => format!("1 to {most} rows {}", row_form(columns)),
    }
}

/// Text that may hold a bar, which would end a cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

#[allow(dead_code, reason = "tests include this file")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/methods.md");
    std::fs::write(&path, page()?)?;
    println!("{}", path.display());
    Ok(())
}
