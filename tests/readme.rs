//! The README's picture and findings are those of a run.

#[path = "../examples/readme/main.rs"]
mod readme;

use std::path::Path;

#[test]
fn the_readme_shows_what_a_run_finds() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let scratch = tempfile::tempdir().unwrap();
    let results = readme::results(root, scratch.path()).unwrap();
    let text = std::fs::read_to_string(root.join("README.md")).unwrap();
    let filled = readme::filled(&text, &readme::found(&results).unwrap()).unwrap();
    assert!(text == filled, "README.md is stale: cargo run --release --example readme");
    for (name, png) in readme::pictures(&results).unwrap() {
        let stored = std::fs::read(root.join("docs/images").join(&name)).unwrap();
        assert!(stored == png, "{name} is stale: cargo run --release --example readme");
    }
}

#[test]
fn every_method_is_in_the_readme() {
    let text = std::fs::read_to_string("README.md").unwrap();
    let (_, table) = text.split_once("## Methods").unwrap();
    let (table, _) = table.split_once("\n## ").unwrap();
    let mut named: Vec<&str> = Vec::new();
    for row in table.lines().filter(|line| line.starts_with("| `")) {
        let names = row.split('|').nth(1).unwrap();
        named.extend(names.split('`').skip(1).step_by(2));
    }
    let mut known: Vec<_> = wrinkle::method::entries().iter().map(|e| e.card.name).collect();
    named.sort_unstable();
    known.sort_unstable();
    assert_eq!(named, known);
}

#[test]
fn the_readmes_experiment_can_be_read() {
    use wrinkle::experiment::spec::Spec;
    let text = std::fs::read_to_string("README.md").unwrap();
    let (_, rest) = text.split_once("```toml\n").unwrap();
    let (toml, _) = rest.split_once("```").unwrap();
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy("data/bricks.png", folder.path().join("my_normals.png")).unwrap();
    let path = folder.path().join("mine.toml");
    Spec::parse(toml, &path).unwrap_or_else(|error| panic!("{error}"));
}
