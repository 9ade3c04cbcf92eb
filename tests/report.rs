//! From a spec to a report: what it links to is there, and what it says follows from `metrics.csv`.
#![allow(clippy::disallowed_methods, reason = "tests compare numbers within tolerances")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use wrinkle::experiment::runner::{self, Outcome};
use wrinkle::experiment::spec::Spec;
use wrinkle::report;
use wrinkle::scene::Halt;

const SPEC: &str = r#"
title = "Tiny"
question = "Does the report say what was measured?"
seed = 3

[image]
width = 24
height = 16

[material]
lobe = "blinn-phong"
exponent = 40.0

[reference]
spp = 256

[sweep]
texture = ["weave", "bumps"]
method = ["unfiltered", "averaged", "schilling-anisotropic", "schilling-anisotropic-printed"]
spp = [1, 4]
texels_per_pixel = [2.0, 8.0]

[texture.weave]
pattern = "twill"
width = 16
height = 16

[texture.bumps]
pattern = "gaussian"
width = 16
height = 16
"#;

fn run(folder: &Path) -> Vec<PathBuf> {
    let spec = Spec::parse(SPEC, Path::new("tiny.toml")).unwrap();
    let halt = Halt(Arc::new(AtomicBool::new(false)));
    let outcome = runner::run(&spec, folder, &halt, &runner::unwatched()).unwrap();
    let Outcome::Finished(found) = outcome else { panic!("nobody halted the run") };
    report::write(&found.0, &found.1, folder).unwrap()
}

/// RMSE at one sample a pixel: by texture and scale, then by method.
type Errors = BTreeMap<(String, String), BTreeMap<String, f64>>;

fn errors(folder: &Path) -> Errors {
    let mut reader = csv::Reader::from_path(folder.join("metrics.csv")).unwrap();
    let heads = reader.headers().unwrap().clone();
    let place = |name: &str| heads.iter().position(|head| head == name).unwrap();
    let (texture, scale, method) = (place("texture"), place("texels_per_pixel"), place("method"));
    let (spp, metric, value) = (place("spp"), place("metric"), place("value"));
    let mut errors = Errors::new();
    for row in reader.records().map(Result::unwrap) {
        if &row[metric] == "rmse" && &row[spp] == "1" {
            let of_scene = errors.entry((row[texture].into(), row[scale].into())).or_default();
            of_scene.insert(row[method].into(), row[value].parse().unwrap());
        }
    }
    errors
}

/// The cells of the Markdown table whose head begins with `first`, row by row.
fn table(report: &str, first: &str) -> Vec<Vec<String>> {
    let head = report.find(&format!("| {first} |")).unwrap_or_else(|| panic!("no table {first}"));
    let lines = report[head..].lines().take_while(|line| line.starts_with('|')).skip(2);
    let cells =
        |line: &str| line.trim_matches('|').split('|').map(|c| c.trim().to_owned()).collect();
    lines.map(cells).collect()
}

fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    if percent < 9.95 { format!("{percent:.1}\u{a0}%") } else { format!("{percent:.0}\u{a0}%") }
}

fn left<'a>(scenes: impl Iterator<Item = &'a BTreeMap<String, f64>>, method: &str) -> f64 {
    let logs: Vec<f64> = scenes.map(|s| (s[method] / s["unfiltered"]).ln()).collect();
    (logs.iter().sum::<f64>() / logs.len() as f64).exp()
}

#[test]
fn a_report_links_to_what_is_there_and_says_what_was_measured() {
    let folder = tempfile::tempdir().unwrap();
    let written = run(folder.path());
    assert!(written.iter().all(|file| file.is_file()));
    let markdown = std::fs::read_to_string(folder.path().join("report.md")).unwrap();
    let html = std::fs::read_to_string(folder.path().join("report.html")).unwrap();

    // Every link of both reports.
    let links = markdown.split("](").skip(1).map(|rest| rest.split(')').next().unwrap());
    let anchors = html.split("href=\"").skip(1).map(|rest| rest.split('"').next().unwrap());
    // The page writes a slash as a character reference.
    let files = links.chain(anchors).map(|link| link.replace("&#x2f;", "/"));
    let files: Vec<String> = files.filter(|link| !link.starts_with('#')).collect();
    assert!(files.iter().filter(|file| file.ends_with(".exr")).count() > 20);
    for file in files {
        assert!(folder.path().join(&file).is_file(), "{file}");
    }

    // The choice at each scale, from the errors alone.
    let errors = errors(folder.path());
    assert_eq!(errors.len(), 4);
    let filters = ["averaged", "schilling-anisotropic", "schilling-anisotropic-printed"];
    for (row, scale) in table(&markdown, "Scale").iter().zip(["2", "8"]) {
        assert!(row[0].starts_with(scale), "{row:?}");
        let of_scale = || errors.iter().filter(|(key, _)| key.1 == scale).map(|(_, found)| found);
        let mut ranked = filters.map(|method| (left(of_scale(), method), method));
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert!(row[1].contains(ranked[0].1), "{row:?}");
        assert_eq!(row[2], percent(ranked[0].0));
        assert!(row[5].contains(&percent(ranked[1].0)), "{row:?}");
    }

    // What is left over all scenes, method by method.
    let ranking = table(&markdown, "Method");
    for method in filters {
        let row = ranking.iter().find(|row| row[0].trim_end_matches(" †") == method).unwrap();
        assert_eq!(row[4], percent(left(errors.values(), method)), "{method}");
        let farther = errors.values().filter(|s| s[method] > s["unfiltered"]).count();
        assert_eq!(row[5], format!("{farther} of 4"), "{method}");
    }

    // What normalising is worth.
    let normalising = table(&markdown, "Normalised form");
    let ratio = |s: &BTreeMap<String, f64>| {
        (s["schilling-anisotropic-printed"] / s["schilling-anisotropic"]).ln()
    };
    let mean = (errors.values().map(ratio).sum::<f64>() / 4.0).exp();
    assert_eq!(normalising[0][2], format!("{mean:.1}"));
}
