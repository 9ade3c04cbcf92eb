//! The house in order: floors, sizes, and that what is there is told of.

use std::fs;
use std::path::{Path, PathBuf};

/// The modules of each floor, from the lowest. A module may use its own floor and those below.
const FLOORS: [&[&str]; 9] = [
    &["geometry", "parameter", "file"],
    &["texture", "lobe"],
    &["pattern", "surface", "fit"],
    &["method", "light"],
    &["render", "metric"],
    &["scene"],
    &["experiment"],
    &["report"],
    &["cli", "tui"],
];

fn floor(module: &str) -> usize {
    let floor = FLOORS.iter().position(|modules| modules.contains(&module));
    floor.unwrap_or_else(|| panic!("module `{module}` is on no floor: give it one here"))
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every file of this ending under a folder, with its text.
fn files(folder: &str, ending: &str) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == ending) {
                let text = fs::read_to_string(&path).unwrap();
                found.push((path.strip_prefix(root()).unwrap().to_owned(), text));
            }
        }
    }
    found.sort();
    found
}

/// The module of `src/` that a file belongs to; None for the crate's own two.
fn module(path: &Path) -> Option<String> {
    let first = path.components().nth(1)?.as_os_str().to_string_lossy().into_owned();
    let name = first.trim_end_matches(".rs").to_owned();
    (!["lib", "main"].contains(&name.as_str())).then_some(name)
}

/// The modules that a text names after `crate::`, alone or in braces. Comments do not count.
fn used(text: &str) -> Vec<String> {
    let code: String = text.lines().filter(|l| !l.trim_start().starts_with("//")).collect();
    let mut names = Vec::new();
    for rest in code.split("crate::").skip(1) {
        let list = match rest.strip_prefix('{') {
            Some(inner) => inner.split('}').next().unwrap_or(""),
            None => rest.split([';', ',']).next().unwrap_or(""),
        };
        for part in list.split(',') {
            let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
            names.push(part.trim().chars().take_while(|&c| is_name(c)).collect());
        }
    }
    names.retain(|name: &String| !name.is_empty());
    names
}

#[test]
fn no_module_looks_up() {
    let mut wrong = Vec::new();
    for (path, text) in files("src", "rs") {
        let Some(of) = module(&path) else { continue };
        for used in used(&text).iter().filter(|used| is_module(used)) {
            if floor(used) > floor(&of) {
                wrong.push(format!("{} uses {used}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "an upper floor is used from below:\n{}", wrong.join("\n"));
}

fn is_module(name: &str) -> bool {
    root().join("src").join(name).is_dir() || root().join(format!("src/{name}.rs")).is_file()
}

#[test]
fn braces_and_paths_are_both_seen() {
    let text = "use crate::{method, pattern::x};\nuse crate::scene::{A, B};\n// crate::cli\n";
    assert_eq!(used(text), ["method", "pattern", "scene"]);
}

#[test]
fn every_module_has_a_floor_and_a_file_is_read_in_one_sitting() {
    for (path, text) in files("src", "rs") {
        if let Some(module) = module(&path) {
            floor(&module);
        }
        let lines = text.lines().count();
        assert!(lines <= 500, "{}: {lines} lines; divide it", path.display());
    }
}

#[test]
fn the_map_shows_every_module() {
    let map = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md");
    for module in FLOORS.iter().flat_map(|modules| *modules).filter(|name| is_module(name)) {
        assert!(map.contains(&format!("`{module}")), "ARCHITECTURE.md does not show `{module}`");
    }
}

#[test]
fn every_experiment_is_told_of() {
    let mut told = fs::read_to_string(root().join("README.md")).expect("README.md");
    told.extend(files("docs", "md").into_iter().map(|(_, text)| text));
    for (path, _) in files("experiments", "toml") {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        assert!(told.contains(&format!("`{name}`")), "neither README nor docs tell of `{name}`");
    }
}
