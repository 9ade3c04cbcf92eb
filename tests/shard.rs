//! Shards of an experiment, merged, give the report of one run, byte for byte; and what cannot be merged is told.

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::time::Duration;

use common::{assert_same, output, records, trials_kept, wrinkle, written};

/// Two still textures under two lobes at two scales: eight scenes.
const EXPERIMENT: &str = r#"
seed = 11
[image]
width = 8
height = 6
[reference]
spp = 64
replicates = 2
[sweep]
texture = ["weave", "hills"]
method = ["unfiltered", "averaged"]
spp = [1]
unfiltered_spp = [1]
texels_per_pixel = [2.0, 5.0]
lobe = [{ lobe = "blinn-phong", exponent = 40.0 }, { lobe = "ggx", alpha = 0.3 }]
[texture.weave]
pattern = "twill"
width = 8
height = 8
[texture.hills]
pattern = "gaussian"
width = 8
height = 8
"#;

const SCENES: usize = 8;

struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("trial.toml"), EXPERIMENT).unwrap();
        Self { folder }
    }

    fn path(&self) -> &Path {
        self.folder.path()
    }

    fn results(&self, out: &str) -> PathBuf {
        self.path().join(out).join("trial")
    }

    /// Runs the program, which succeeds; what it says.
    fn run(&self, args: &[&str]) -> String {
        let done = output(self.path(), args);
        assert!(done.status.success(), "{args:?}: {}", String::from_utf8_lossy(&done.stderr));
        String::from_utf8(done.stdout).unwrap()
    }

    /// Runs a shard; what it says.
    fn shard(&self, share: &str, out: &str) -> String {
        self.run(&["run", "trial.toml", "--shard", share, "--out", out])
    }

    /// Merges; the results.
    fn merge(&self, out: &str) -> PathBuf {
        self.run(&["merge", "trial.toml", "--out", out]);
        self.results(out)
    }

    /// Fails to merge: the exit code and the message.
    fn refused(&self, out: &str) -> (Option<i32>, String) {
        let done = output(self.path(), &["merge", "trial.toml", "--out", out]);
        assert!(!self.results(out).join("metrics.csv").exists(), "no report is written");
        (done.status.code(), String::from_utf8(done.stderr).unwrap())
    }
}

/// The results of one run of it all.
static WHOLE: LazyLock<(Bench, PathBuf)> = LazyLock::new(|| {
    let bench = Bench::new();
    bench.run(&["run", "trial.toml"]);
    let results = bench.results("reports");
    (bench, results)
});

fn whole() -> &'static Path {
    &WHOLE.1
}

#[test]
fn any_number_of_shards_in_any_order_merge_to_the_same_bytes() {
    // More than scenes, too.
    for of in [1, 2, 3, SCENES + 3] {
        let bench = Bench::new();
        for number in (1..=of).rev() {
            bench.shard(&format!("{number}/{of}"), "reports");
            assert!(!bench.results("reports").join("metrics.csv").exists());
        }
        assert_same(whole(), &bench.merge("reports"));
        let images = written(&bench.results("reports").join("images"));
        // Again, and nothing is made again.
        assert_same(whole(), &bench.merge("reports"));
        let exr = |path: &Path| path.extension().is_some_and(|e| e == "exr");
        let again = written(&bench.results("reports").join("images"));
        assert!(images.iter().filter(|f| exr(&f.0)).all(|image| again.contains(image)));
    }
}

#[test]
fn shards_have_all_scenes_once_and_say_what_to_do_next() {
    let bench = Bench::new();
    let said = bench.shard("1/2", "out");
    assert!(said.starts_with("trial 1/2: done, 4 scenes\n"), "{said}");
    assert!(
        said.ends_with("when all 2 shards are: wrinkle merge trial.toml --out out\n"),
        "{said}"
    );
    let args = ["run", "trial.toml", "--shard", "2/2", "--out", "out", "--json"];
    let told: serde_json::Value = serde_json::from_str(&bench.run(&args)).unwrap();
    assert_eq!(told["shards"][0]["scenes"], 4);
    let kept = |number: u32| {
        let folder = bench.results("out").join(format!(".shards/{number}-of-2"));
        let references = records(&folder).into_iter().filter(|(_, of)| of.ends_with("/reference"));
        references.map(|(path, _)| path.file_name().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let (one, two) = (kept(1), kept(2));
    assert_eq!((one.len(), two.len()), (4, 4));
    assert!(one.iter().all(|scene| !two.contains(scene)));
}

#[test]
fn shards_of_several_machines_are_merged() {
    let bench = Bench::new();
    for (share, out) in [("1/3", "one"), ("2/3", "two/reports"), ("3/3", "three")] {
        bench.shard(share, out);
    }
    // A folder of reports, an experiment's folder in it, and a shard's own.
    let from = ["one", "two/reports/trial", "three/trial/.shards/3-of-3"];
    let mut args = vec!["merge", "trial.toml", "--out", "merged"];
    from.iter().for_each(|folder| args.extend(["--from", folder]));
    bench.run(&args);
    assert_same(whole(), &bench.results("merged"));
}

#[cfg(unix)]
#[test]
fn a_shard_that_dies_is_run_again() {
    let bench = Bench::new();
    bench.shard("2/2", "reports");
    let args = ["run", "trial.toml", "--shard", "1/2"];
    let mut run = wrinkle(bench.path(), &args).spawn().unwrap();
    let folder = bench.results("reports").join(".shards/1-of-2");
    while trials_kept(&folder) == 0 {
        assert!(run.try_wait().unwrap().is_none(), "it ended before it kept a trial");
        std::thread::sleep(Duration::from_millis(1));
    }
    run.kill().unwrap();
    run.wait().unwrap();
    let (code, message) = bench.refused("reports");
    assert_eq!(code, Some(1));
    assert!(message.contains("1 shard of `trial` is not finished"), "{message}");
    assert!(message.contains("wrinkle run trial --shard 1/2"), "{message}");
    let kept = written(&folder.join(".state/films"));
    bench.shard("1/2", "reports");
    let again = written(&folder.join(".state/films"));
    assert!(kept.iter().all(|film| again.contains(film)), "what was finished is not made again");
    assert_same(whole(), &bench.merge("reports"));
}

#[test]
fn what_cannot_be_merged_is_told() {
    let bench = Bench::new();
    let (code, message) = bench.refused("reports");
    assert_eq!(code, Some(2));
    assert!(message.contains("there are no shards of `trial` in reports"), "{message}");
    for share in ["1/4", "3/4"] {
        bench.shard(share, "reports");
    }
    let (code, message) = bench.refused("reports");
    assert_eq!(code, Some(1));
    assert!(message.contains("2 shards of `trial` are not finished"), "{message}");
    assert!(message.contains("--shard 2/4") && message.contains("--shard 4/4"), "{message}");
    for share in ["2/4", "4/4"] {
        bench.shard(share, "reports");
    }
    // Another seed: another experiment.
    let other = EXPERIMENT.replace("seed = 11", "seed = 12");
    fs::write(bench.path().join("trial.toml"), other).unwrap();
    let message = bench.refused("reports").1;
    assert!(message.contains("another version of the experiment's file"), "{message}");
    fs::write(bench.path().join("trial.toml"), EXPERIMENT).unwrap();
    // Another program.
    let manifest = bench.results("reports").join(".shards/2-of-4/.state/run.json");
    let text = fs::read_to_string(&manifest).unwrap();
    let program = &serde_json::from_str::<serde_json::Value>(&text).unwrap()["program"];
    fs::write(&manifest, text.replace(program.as_str().unwrap(), "0123")).unwrap();
    let message = bench.refused("reports").1;
    assert!(message.contains("2-of-4") && message.contains("another build"), "{message}");
    fs::write(&manifest, text.replace("\"format\": 1", "\"format\": 2")).unwrap();
    let message = bench.refused("reports").1;
    assert!(message.contains("written by a newer wrinkle, format 2"), "{message}");
    fs::write(&manifest, &text).unwrap();
    // A record that is gone, though its shard was finished.
    let shard = bench.results("reports").join(".shards/2-of-4");
    let (record, of) =
        records(&shard).into_iter().find(|(_, of)| of.ends_with("/reference")).unwrap();
    fs::remove_file(record).unwrap();
    let (code, message) = bench.refused("reports");
    let scene = of.strip_suffix("/reference").unwrap();
    assert_eq!(code, Some(1));
    assert!(message.contains(&format!("no shard has {scene}:")), "{message}");
    bench.shard("2/4", "reports");
    assert_same(whole(), &bench.merge("reports"));
}

#[test]
fn wrong_shares_are_refused() {
    let bench = Bench::new();
    for (share, told) in [("0/2", "whole number"), ("3/2", "no share 3 of 2"), ("2", "2/3")] {
        let done = output(bench.path(), &["run", "trial.toml", "--shard", share]);
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(done.status.code(), Some(2), "{said}");
        assert!(said.contains(told), "{said}");
    }
}
