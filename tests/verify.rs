//! `wrinkle verify`: what is the same is said to be, and what differs is told, where and by how much.

mod common;

use std::fs;
use std::path::Path;

use common::{files_under, output};
use serde_json::Value;

/// A spec that runs in no time, with an image file.
const EXPERIMENT: &str = r#"
[image]
width = 8
height = 6
[reference]
spp = 16
replicates = 2
[sweep]
texture = ["t", "picture"]
method = ["averaged", "unfiltered"]
spp = [1]
unfiltered_spp = [1]
texels_per_pixel = [2.0]
[texture.t]
pattern = "waves"
width = 8
height = 8
[texture.picture]
file = "maps/bumps.png"
kind = "normal"
"#;

struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    /// A folder with an experiment, its map, and its report.
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let bench = Self { folder };
        for folder in ["experiments/maps", "reports"] {
            fs::create_dir_all(bench.path().join(folder)).unwrap();
        }
        fs::write(bench.path().join("experiments/tiny.toml"), EXPERIMENT).unwrap();
        let map = ["bake", "ggx:0.3", "--size", "16x16", "--out", "experiments/maps/bumps.png"];
        assert_eq!(bench.say(&map).0, 0);
        assert_eq!(bench.say(&["run", "tiny"]).0, 0);
        bench
    }

    fn path(&self) -> &Path {
        self.folder.path()
    }

    fn report(&self, file: &str) -> std::path::PathBuf {
        self.path().join("reports/tiny").join(file)
    }

    /// The exit code and what was said on both streams.
    fn say(&self, args: &[&str]) -> (i32, String, String) {
        let done = output(self.path(), args);
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (done.status.code().unwrap(), text(done.stdout), text(done.stderr))
    }

    /// The differences found, by file.
    fn differences(&self) -> Vec<(String, String)> {
        let (code, said, _) = self.say(&["verify", "--json"]);
        let told: Value = serde_json::from_str(&said).unwrap();
        let report = &told["reports"][0];
        assert_eq!((code, &report["same"]), (1, &Value::Bool(false)));
        let text = |value: &Value| value.as_str().unwrap().to_owned();
        let all = report["differences"].as_array().unwrap().iter();
        all.map(|found| (text(&found["file"]), text(&found["difference"]))).collect()
    }
}

#[test]
fn a_report_that_was_not_touched_is_the_same() {
    let bench = Bench::new();
    let before = files_under(bench.path());
    let (code, said, wrong) = bench.say(&["verify"]);
    assert_eq!((code, wrong.as_str()), (0, ""));
    assert!(said.starts_with("same     tiny: ") && said.ends_with(" files\n"), "{said}");
    assert_eq!(files_under(bench.path()), before, "nothing is left behind");
    // Costs are no part of it, nor what a run keeps for itself.
    fs::write(bench.report("costs.csv"), "other").unwrap();
    fs::remove_dir_all(bench.report(".state")).unwrap();
    assert_eq!(bench.say(&["verify", "tiny"]).0, 0);
    assert_eq!(bench.say(&["verify", "experiments/tiny.toml", "--out", "reports"]).0, 0);
}

#[test]
fn every_kind_of_difference_is_told() {
    let bench = Bench::new();
    let edit = |file: &str, from: &str, to: &str| {
        let text = fs::read_to_string(bench.report(file)).unwrap();
        assert!(text.contains(from), "{file}");
        fs::write(bench.report(file), text.replacen(from, to, 1)).unwrap();
    };
    edit("metrics.csv", "t,plane", "t,sphere");
    edit("report.md", "# ", "## ");
    edit("metrics.json", "\"seed\": 1", "\"seed\": 2");
    let images = files_under(&bench.report("images"));
    let exr: Vec<_> = images.iter().filter(|path| path.ends_with("reference.exr")).collect();
    let png = images.iter().find(|path| path.extension().is_some_and(|e| e == "png")).unwrap();
    let other = exr[1].with_file_name("averaged-1spp.exr");
    fs::remove_file(exr[0]).unwrap();
    fs::remove_file(exr[1]).unwrap();
    fs::copy(other, exr[1]).unwrap();
    let mut picture = image::open(png).unwrap().to_rgba8();
    picture.put_pixel(3, 2, image::Rgba([1, 2, 3, 255]));
    image::DynamicImage::from(picture).to_rgb8().save(png).unwrap();
    fs::write(bench.report("plots/mine.txt"), "a note").unwrap();
    let found = bench.differences();
    let of = |end: &str| {
        let one = found.iter().find(|(file, _)| file.ends_with(end));
        &one.unwrap_or_else(|| panic!("{end}: {found:?}")).1
    };
    assert!(of("metrics.json").starts_with(".seed: `2` recorded, `1` again"), "{found:?}");
    assert!(of("report.md").starts_with("line 1, column 2: "), "{found:?}");
    assert!(of("mine.txt").starts_with("is not written again"), "{found:?}");
    assert!(
        found.iter().any(|(file, what)| file.ends_with("reference.exr") && what == "is missing")
    );
    let exr = found.iter().find(|(_, what)| what.contains("units in the last place"));
    assert!(exr.is_some_and(|(file, _)| file.ends_with("reference.exr")), "{found:?}");
    let (code, said, _) = bench.say(&["verify"]);
    assert_eq!(code, 1);
    assert!(
        said.starts_with("differs  tiny: ") && said.contains("\n  metrics.json: .seed"),
        "{said}"
    );
}

#[test]
fn the_experiment_of_the_report_is_run_not_the_one_of_the_day() {
    let bench = Bench::new();
    let file = bench.path().join("experiments/tiny.toml");
    fs::write(&file, EXPERIMENT.replace("spp = 16", "spp = 32")).unwrap();
    let (code, said, _) = bench.say(&["verify"]);
    assert!(said.contains("tiny.toml was changed since"), "{said}");
    assert_eq!(code, 0, "{said}");
    fs::remove_file(&file).unwrap();
    let (code, said, _) = bench.say(&["verify"]);
    assert!(said.contains("the experiment's file is not here"), "{said}");
    assert_eq!(code, 0, "{said}");
    // Its map is gone: the report cannot be had again.
    fs::remove_file(bench.path().join("experiments/maps/bumps.png")).unwrap();
    let (code, said, _) = bench.say(&["verify"]);
    assert!(said.starts_with("failed   tiny: reports/tiny/metrics.json: "), "{said}");
    assert!(said.contains("there is no file experiments/maps/bumps.png"), "{said}");
    assert_eq!(code, 1);
}

#[test]
fn what_is_no_report_is_named() {
    let bench = Bench::new();
    let (code, _, wrong) = bench.say(&["verify", "nosuch"]);
    assert_eq!(code, 2);
    assert!(wrong.contains("there is no report in reports/nosuch"), "{wrong}");
    let (code, _, wrong) = bench.say(&["verify", "--out", "empty"]);
    assert_eq!(code, 2);
    assert!(wrong.contains("there is no report in empty"), "{wrong}");
    fs::write(bench.report("metrics.json"), r#"{"format": 99, "experiment": "tiny", "spec": ""}"#)
        .unwrap();
    let (code, said, _) = bench.say(&["verify"]);
    assert_eq!(code, 1);
    assert!(
        said.contains("written by a newer wrinkle, format 99; this one reads up to 2"),
        "{said}"
    );
}
