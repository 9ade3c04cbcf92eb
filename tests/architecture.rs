//! ARCHITECTURE.md names what there is, and no module uses a higher floor.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(name: &str) -> String {
    std::fs::read_to_string(root().join(name)).unwrap()
}

/// The floors of the table, by module.
fn floors() -> BTreeMap<String, u32> {
    let page = read("ARCHITECTURE.md");
    let rows = page.lines().filter_map(|line| {
        let mut cells = line.split('|').map(str::trim).skip(1);
        let floor = cells.next()?.parse().ok()?;
        Some((cells.next()?.trim_matches('`').to_owned(), floor))
    });
    rows.collect()
}

/// The modules of lib.rs.
fn modules() -> BTreeSet<String> {
    let lib = read("src/lib.rs");
    let named = lib.lines().filter_map(|l| l.strip_prefix("pub mod ")?.strip_suffix(';'));
    named.map(str::to_owned).collect()
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn every_module_has_a_floor() {
    assert_eq!(floors().into_keys().collect::<BTreeSet<_>>(), modules());
}

#[test]
fn no_module_uses_a_higher_floor() {
    let floors = floors();
    let mut files = Vec::new();
    sources(&root().join("src"), &mut files);
    for path in files {
        let inside = path.strip_prefix(root().join("src")).unwrap();
        let first = inside.iter().next().unwrap().to_str().unwrap().trim_end_matches(".rs");
        let Some(own) = floors.get(first) else { continue }; // lib.rs, main.rs
        let text = std::fs::read_to_string(&path).unwrap();
        // Tests may look wherever they like.
        let text = text.split("#[cfg(test)]").next().unwrap();
        if path.ends_with("tests.rs") {
            continue;
        }
        let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        for used in code.flat_map(|line| line.split("crate::").skip(1)) {
            let name: String =
                used.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            if let Some(floor) = floors.get(&name) {
                assert!(floor <= own, "{} uses `{name}`, a higher floor", inside.display());
            }
        }
    }
}

#[test]
fn every_file_it_names_exists() {
    let page = read("ARCHITECTURE.md");
    let (_, papers) = page.split_once("## Where is the paper?").unwrap();
    let named: Vec<&str> = papers.split('`').skip(1).step_by(2).collect();
    assert!(named.len() > 15);
    for name in named {
        assert!(root().join("src").join(name).exists(), "src/{name} is not there");
    }
}

#[test]
fn it_stays_short() {
    assert!(read("ARCHITECTURE.md").lines().count() <= 200);
}

#[test]
fn links_in_the_documents_lead_somewhere() {
    for page in ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"] {
        for link in read(page).split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let file = link.split('#').next().unwrap();
            if !file.is_empty() && !file.contains("://") {
                assert!(root().join(file).exists(), "{page}: {link}");
            }
        }
    }
}
