//! Tests of reports that a run wrote, and of what becomes of them.

use std::path::Path;

use super::*;
use crate::experiment::runner::unwatched;
use crate::experiment::spec::{Experiment, Spec};
use crate::job::{self, Control};

const SPEC: &str = r#"
title = "A_b"
seed = 5
[image]
width = 16
height = 12
[reference]
spp = 64
replicates = 2
[sweep]
texture = ["gaussian"]
method = ["unfiltered", "averaged"]
spp = [1]
unfiltered_spp = [1, 4]
texels_per_pixel = [2.0]
[texture.gaussian]
pattern = "gaussian"
width = 16
height = 16
"#;

/// A folder with the report of a small experiment in `small/`.
fn written() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let spec = Spec::parse(SPEC, Path::new("small.toml")).unwrap();
    let experiment = Experiment::Sweep(Box::new(spec));
    job::run(&experiment, &folder.path().join("small"), &Control::default(), &unwatched()).unwrap();
    folder
}

#[test]
fn a_whole_report_is_read_without_a_problem_and_a_damaged_one_as_far_as_it_goes() {
    let root = written();
    let folder = root.path().join("small");
    let listed = reports(root.path());
    assert_eq!(listed.len(), 1);
    assert_eq!((listed[0].name.as_str(), listed[0].kind), ("small", Kind::Sweep));
    assert!(listed[0].written.is_some() && !listed[0].lead.is_empty());
    assert_eq!(listed[0].problems, [""; 0]);

    let opened = open(&folder);
    assert_eq!(opened.problems, [""; 0]);
    assert_eq!(opened.title, "A_b");
    let labels: Vec<_> = opened.methods.iter().map(|(label, _)| label.as_str()).collect();
    assert_eq!(labels, ["unfiltered", "averaged"]);
    let images: Vec<_> =
        opened.scenes[0].images.iter().map(|i| (i.method.as_str(), i.spp)).collect();
    assert_eq!(images, [("unfiltered", 1), ("unfiltered", 4), ("averaged", 1)]);
    assert!(opened.scenes[0].reference.as_ref().unwrap().is_file() && !opened.plots.is_empty());
    let count = |metric: &str| opened.rows.iter().filter(|row| row.metric == metric).count();
    assert_eq!([count("rmse"), count("ns_per_pixel"), count("ndf_l1")], [4, 3, 2]);
    let slug = &opened.scenes[0].slug;
    assert!(
        opened.rows.iter().filter(|row| row.metric == "ns_per_pixel").all(|row| row.scene == *slug)
    );

    // Half a file of figures: the table's, and the images that are there.
    let json = std::fs::read(folder.join("metrics.json")).unwrap();
    std::fs::write(folder.join("metrics.json"), &json[..json.len() / 2]).unwrap();
    assert_eq!(reports(root.path())[0].problems, ["metrics.json breaks off"]);
    let half = open(&folder);
    assert!(half.problems[0].starts_with("metrics.json cannot be read"), "{:?}", half.problems);
    assert_eq!((half.rows.len(), half.title.as_str()), (opened.rows.len(), "A_b"));
    let mut paths: Vec<_> = half.scenes[0].images.iter().map(|image| &image.path).collect();
    let mut before: Vec<_> = opened.scenes[0].images.iter().map(|image| &image.path).collect();
    paths.sort();
    before.sort();
    assert_eq!(paths, before);

    // No images.
    std::fs::write(folder.join("metrics.json"), &json).unwrap();
    std::fs::remove_dir_all(folder.join("images")).unwrap();
    assert_eq!(
        open(&folder).problems,
        ["4 images are missing: run the experiment again to have them"]
    );
    assert_eq!(reports(root.path())[0].problems, ["the folder images is missing"]);

    // No figures, no report.
    for name in ["metrics.json", "metrics.csv", "report.md"] {
        std::fs::remove_file(folder.join(name)).unwrap();
    }
    assert_eq!(open(&folder).problems, ["metrics.json is missing", "metrics.csv is missing"]);
    let begun = &reports(root.path())[0];
    assert!(begun.written.is_none() && begun.problems[0].starts_with("no report yet"));
}

#[test]
fn a_papers_rows_have_their_claims_and_pictures() {
    let root = tempfile::tempdir().unwrap();
    let folder = root.path().join("blinn-1978");
    let put = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    let rows: Vec<_> = crate::evidence::papers()[0].rows.iter().map(|row| row.name).collect();
    let (first, second) = (rows[0], rows[1]);
    put(
        "evidence.csv",
        &format!(
            "row,claim,paper,here,verdict,rule,because\n{second},\"a, b\",1,2,differs,off by 1,why\n{second},c,1,1,reproduced,,\n{second},d,1,1,perhaps,,\n"
        ),
    );
    put("evidence.json", "{}");
    put("report.md", "# B\n\n**1 differs.**\n");
    put(&format!("plots/{first}-across.png"), "");
    put(&format!("images/{second}/panel.exr"), "");
    put("flat/report.md", "# F\n\n## Answer\n\nYes.\n");
    put("flat/metrics.json", "{}");
    let listed = reports(root.path());
    let names: Vec<_> = listed.iter().map(|report| (report.name.as_str(), report.kind)).collect();
    assert_eq!(names, [("blinn-1978", Kind::Paper), ("blinn-1978/flat", Kind::Sweep)]);
    assert_eq!(listed[0].lead, ["1 differs."]);
    let opened = open(&folder);
    let shown: Vec<_> = opened.paper.iter().map(|row| row.name.as_str()).collect();
    assert_eq!((opened.kind, shown), (Kind::Paper, vec![first, second]));
    assert_eq!(opened.paper[0].plots[0].0, "across");
    assert_eq!(opened.paper[1].images[0].0, "panel");
    assert_eq!(opened.paper[1].claims[0].what, "a, b");
    assert_eq!(opened.paper[1].verdict(), crate::evidence::Verdict::Differs);
    assert!(!opened.paper[1].title.is_empty());
    assert!(opened.problems[0].contains("perhaps"));
}

#[test]
fn nothing_is_no_panic() {
    let root = tempfile::tempdir().unwrap();
    assert!(reports(&root.path().join("none")).is_empty());
    assert!(reports(root.path()).is_empty());
    assert_eq!(open(&root.path().join("none")).problems.len(), 1);
}
