//! ARCHITECTURE.md names what there is. (tests/tidy.rs holds modules to their floors.)

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

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

#[test]
fn every_module_has_a_floor() {
    assert_eq!(floors().into_keys().collect::<BTreeSet<_>>(), modules());
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
