//! `wrinkle list`: what there is.

use std::io::Write;

use serde_json::{Value as Json, json};

use super::Exit;
use super::args::ListArgs;
use super::exit::Failure;
use crate::light::environment::maps;
use crate::parameter::{Card, Domain, Parameter};
use crate::{job, lobe, method, pattern};

/// Surfaces, with what they are.
const SURFACES: [(&str, &str); 9] = [
    ("plane", "the plane z = 0, tiled without end"),
    ("sphere", "the unit sphere, u along longitude and v along latitude"),
    ("drapery", "a coarse cloth that hangs in folds, u across them and v up"),
    ("wavy-sphere", "a sphere whose radius ripples, as a mesh of as many cells as asked for"),
    ("teapot", "Newell's teapot of 32 Bézier patches, u around its parts and v along them"),
    ("bent-patch", "a flat patch with one corner bent back, seen from both sides"),
    ("cylinder", "the cylinder of radius 1 and height 2, without lids, u around and v up"),
    ("ribbon", "a strip that waves, u along it and v up"),
    ("mesh", "the triangles of an OBJ, glTF or GLB file, with its texture coordinates"),
];

/// Prints experiments, methods, patterns, surfaces, environments and multiple surfaces.
pub(super) fn list(args: &ListArgs, out: &mut dyn Write) -> Result<Exit, Failure> {
    if args.json {
        writeln!(out, "{:#}", as_json())?;
    } else {
        for (i, (heading, rows)) in sections().into_iter().enumerate() {
            if i > 0 {
                writeln!(out)?;
            }
            let bold = anstyle::Style::new().bold();
            writeln!(out, "{bold}{heading}{bold:#}")?;
            let widest = rows.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
            for (name, what) in rows {
                writeln!(out, "  {name:widest$}  {what}")?;
            }
        }
    }
    Ok(Exit::Done)
}

fn sections() -> [(&'static str, Vec<(String, String)>); 6] {
    let experiments = job::names()
        .into_iter()
        .map(|name| {
            let loaded = job::load(&name);
            let what = loaded.map_or("has errors: run it to see them".into(), |e| e.title().into());
            (name, what)
        })
        .collect();
    let methods =
        method::entries().into_iter().map(|e| (e.card.name.into(), e.card.summary.into()));
    let patterns =
        pattern::entries().into_iter().map(|e| (e.card.name.into(), e.card.summary.into()));
    let surfaces = SURFACES.into_iter().map(|(name, what)| (name.into(), what.into()));
    let environments =
        maps::entries().into_iter().map(|e| (e.card.name.into(), e.card.summary.into()));
    let multiple = lobe::named().iter().map(|s| (s.name.into(), s.meaning.into()));
    [
        ("Experiments (wrinkle run NAME)", experiments),
        ("Methods", methods.collect()),
        ("Patterns", patterns.collect()),
        ("Surfaces", surfaces.collect()),
        ("Environments", environments.collect()),
        ("Multiple surfaces (wrinkle lobes NAME, wrinkle render NAME)", multiple.collect()),
    ]
}

fn as_json() -> Json {
    let methods: Vec<Json> = method::entries()
        .iter()
        .map(|e| {
            json!({
                "name": e.card.name, "source": e.card.source, "summary": e.card.summary,
                "formula": e.card.formula, "limits": e.card.limits,
                "parameters": parameters(e.parameters),
            })
        })
        .collect();
    let patterns: Vec<Json> =
        pattern::entries().iter().map(|e| card(&e.card, e.parameters)).collect();
    let surfaces: Vec<Json> =
        SURFACES.iter().map(|(name, what)| json!({ "name": name, "summary": what })).collect();
    let environments: Vec<Json> =
        maps::entries().iter().map(|e| card(&e.card, e.parameters)).collect();
    let multiple: Vec<Json> = lobe::named()
        .iter()
        .map(|s| json!({ "name": s.name, "source": s.source, "summary": s.meaning }))
        .collect();
    json!({
        "experiments": job::names(),
        "methods": methods,
        "patterns": patterns,
        "surfaces": surfaces,
        "environments": environments,
        "multiple_surfaces": multiple,
    })
}

/// A pattern or an environment as JSON.
fn card(card: &Card, options: &[Parameter]) -> Json {
    json!({
        "name": card.name, "source": card.source, "summary": card.summary,
        "parameters": parameters(options),
    })
}

fn parameters(list: &[Parameter]) -> Vec<Json> {
    list.iter()
        .map(|p| {
            let domain = match p.domain {
                Domain::Real { default, min, max } => {
                    json!({ "type": "real", "default": default, "min": min, "max": max })
                }
                Domain::Whole { default, min, max } => {
                    json!({ "type": "whole", "default": default, "min": min, "max": max })
                }
                Domain::Choice { words } => {
                    json!({ "type": "choice", "default": words[0], "choices": words })
                }
                Domain::Text { default, .. } => json!({ "type": "text", "default": default }),
                Domain::Rows { columns, default, most } => {
                    let columns: Vec<Json> = columns
                        .iter()
                        .map(|c| json!({ "name": c.name, "min": c.min, "max": c.max, "whole": c.whole }))
                        .collect();
                    json!({ "type": "rows", "default": default, "columns": columns, "most": most })
                }
            };
            json!({ "name": p.name, "meaning": p.meaning, "domain": domain })
        })
        .collect()
}
