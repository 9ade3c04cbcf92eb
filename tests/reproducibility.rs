//! The same experiment gives the same bytes: at any number of threads, after any interruption, after
//! damage, and in any build of the program.

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use std::time::Duration;

use common::{
    assert_same, files_under, output, records, repository, trials_kept, wrinkle, written,
};

/// Small, but long enough to be interrupted: two textures, a fit, a lobe that it refuses.
const EXPERIMENT: &str = r#"
seed = 7
[image]
width = 40
height = 30
[reference]
spp = 256
[sweep]
texture = ["weave", "hills"]
method = ["unfiltered", "fournier", "schilling-anisotropic"]
spp = [1, 4]
texels_per_pixel = [3.0]
lobe = [{ lobe = "blinn-phong", exponent = 40.0 }, { lobe = "ggx", alpha = 0.3 }]
[texture.weave]
pattern = "twill"
width = 16
height = 16
[texture.hills]
pattern = "gaussian"
width = 24
height = 16
"#;

/// A folder with the experiment, and where its results go.
struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("trial.toml"), EXPERIMENT).unwrap();
        Self { folder }
    }

    fn results(&self, out: &str) -> PathBuf {
        self.folder.path().join(out).join("trial")
    }

    /// Runs the experiment to its end; where the results are.
    fn run(&self, out: &str, more: &[&str]) -> PathBuf {
        let args = [&["run", "trial.toml", "--out", out], more].concat();
        let done = output(self.folder.path(), &args);
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        self.results(out)
    }

    /// Starts the experiment and sends it a signal when its first trial is kept. The exit code, and
    /// what it said.
    fn interrupt(&self, out: &str, signal: &str) -> (Option<i32>, String) {
        let args = ["run", "trial.toml", "--out", out];
        let mut run = wrinkle(self.folder.path(), &args);
        let mut run = run.stderr(std::process::Stdio::piped()).spawn().unwrap();
        while trials_kept(&self.results(out)) == 0 {
            assert!(run.try_wait().unwrap().is_none(), "it ended before it kept a trial");
            std::thread::sleep(Duration::from_millis(2));
        }
        let id = run.id().to_string();
        assert!(Command::new("kill").args([signal, &id]).status().unwrap().success());
        let ended = run.wait_with_output().unwrap();
        (ended.status.code(), String::from_utf8_lossy(&ended.stderr).into_owned())
    }
}

/// The results of a run that nothing disturbed.
static WHOLE: LazyLock<(Bench, PathBuf)> = LazyLock::new(|| {
    let bench = Bench::new();
    let results = bench.run("whole", &[]);
    (bench, results)
});

fn whole() -> &'static Path {
    &WHOLE.1
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let bench = Bench::new();
    for threads in ["1", "2", "7"] {
        assert_same(whole(), &bench.run(threads, &["--threads", threads]));
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_keeps_what_is_finished_and_goes_on() {
    let bench = Bench::new();
    let (code, said) = bench.interrupt("halted", "-INT");
    assert_eq!(code, Some(130), "{said}");
    assert!(said.contains("interrupted") && said.contains("the same command goes on"), "{said}");
    let halted = bench.results("halted");
    assert!(trials_kept(&halted) < trials_kept(whole()), "it was halted in the middle");
    let before = written(&halted.join("images"));
    bench.run("halted", &[]);
    assert_same(whole(), &halted);
    let after = written(&halted.join("images"));
    let untouched = before.iter().filter(|file| after.contains(file)).count();
    assert_eq!(untouched, before.len(), "what was finished is not made again");
}

#[cfg(unix)]
#[test]
fn a_killed_run_goes_on() {
    let bench = Bench::new();
    let (code, _) = bench.interrupt("killed", "-KILL");
    assert_eq!(code, None, "it was killed");
    let killed = bench.results("killed");
    // What a kill in the middle of a write leaves.
    fs::write(killed.join("images/.writing-x"), b"half").unwrap();
    bench.run("killed", &[]);
    assert_same(whole(), &killed);
}

#[test]
fn what_is_damaged_is_made_again_and_nothing_else_is() {
    let bench = Bench::new();
    let hurt = bench.run("hurt", &[]);
    let images = files_under(&hurt.join("images"));
    let exr: Vec<_> = images.iter().filter(|p| p.extension().is_some_and(|e| e == "exr")).collect();
    let kept = records(&hurt);
    let record = |end: &str| &kept.iter().find(|(_, of)| of.ends_with(end)).unwrap().0;
    fs::write(exr[0], b"no image").unwrap();
    fs::copy(exr[2], exr[1]).unwrap(); // A good image, but another's.
    fs::remove_file(exr[3]).unwrap(); // Its film is still kept: it is only shown again.
    fs::write(record("-4spp"), b"{\"format\":").unwrap();
    fs::write(record("/probes"), b"").unwrap();
    fs::remove_file(record("/reference")).unwrap();
    let before = written(&hurt.join("images"));
    bench.run("hurt", &[]);
    assert_same(whole(), &hurt);
    let after = written(&hurt.join("images"));
    let is_exr = |path: &Path| path.extension().is_some_and(|e| e == "exr");
    let again = after.iter().filter(|file| is_exr(&file.0) && !before.contains(file));
    let again: Vec<&Path> = again.map(|file| file.0.as_path()).collect();
    // The one that was removed is shown again. Those whose record alone was hurt came out the same: their films stayed.
    let hurt = [exr[0], exr[1], exr[3]].map(PathBuf::as_path);
    assert_eq!(again, hurt, "images made or shown again");
}

/// Every film that is kept, by its bytes' name, and when it was written.
fn films(results: &Path) -> Vec<(PathBuf, std::time::SystemTime)> {
    written(&results.join(".state/films"))
}

#[test]
fn a_changed_experiment_takes_up_only_what_did_not_change() {
    let bench = Bench::new();
    let folder = bench.run("changed", &[]);
    let (first, before) = (films(&folder), records(&folder));
    let changed = EXPERIMENT.replace("spp = [1, 4]", "spp = [1, 2]");
    fs::write(bench.folder.path().join("trial.toml"), changed).unwrap();
    bench.run("changed", &[]);
    let second = films(&folder);
    assert!(first.iter().all(|film| second.contains(film)), "what was there is as it was");
    let new: Vec<_> = records(&folder).into_iter().filter(|one| !before.contains(one)).collect();
    let rendered: Vec<_> = new.iter().filter(|(_, of)| of.ends_with("spp")).collect();
    assert!(!rendered.is_empty());
    // Brute force goes on from the largest count, four times more again and again.
    let wanted = |of: &str| of.ends_with("-2spp") || of.ends_with("unfiltered-8spp");
    assert!(rendered.iter().all(|(_, of)| wanted(of)), "{rendered:?}");
    // Images and plots of the first run, which are not this one's, are gone.
    assert_same(&folder, &bench.run("fresh", &[]));
}

/// The same experiment under other names: nothing that was computed depends on them.
#[test]
fn what_is_renamed_or_taken_out_and_in_again_is_not_computed_again() {
    let bench = Bench::new();
    let folder = bench.run("names", &[]);
    let (films_before, trials) = (films(&folder), trials_kept(&folder));
    let renamed = EXPERIMENT
        .replace("weave", "linen")
        .replace("\"fournier\"", "\"peaks\"")
        .replace("[texture.linen]", "[method.peaks]\nuse = \"fournier\"\n[texture.linen]");
    let without = EXPERIMENT.replace("\"weave\", ", "");
    for text in [renamed.as_str(), without.as_str(), EXPERIMENT] {
        fs::write(bench.folder.path().join("trial.toml"), text).unwrap();
        bench.run("names", &[]);
        assert_eq!((films(&folder), trials_kept(&folder)), (films_before.clone(), trials));
        assert_same(&folder, &bench.run("fresh", &[]));
    }
}

/// The prefiltered maps that a run keeps.
fn prefilters(results: &Path) -> Vec<PathBuf> {
    let kept = files_under(&results.join(".state/prefilters"));
    kept.into_iter().filter(|path| path.extension().is_some_and(|e| e == "prefilter")).collect()
}

/// Another camera and other samples: nothing of the first run's images serves, its pyramids do.
const ELSEWHERE: [(&str, &str); 2] =
    [("spp = [1, 4]", "spp = [2]"), ("[reference]", "[camera]\nelevation = 50.0\n[reference]")];

fn elsewhere() -> String {
    ELSEWHERE.iter().fold(EXPERIMENT.to_owned(), |text, (from, to)| text.replace(from, to))
}

fn metrics(results: &Path) -> Vec<u8> {
    fs::read(results.join("metrics.csv")).unwrap()
}

#[test]
fn prefiltered_maps_are_taken_from_an_earlier_run() {
    let bench = Bench::new();
    let folder = bench.run("moved", &[]);
    let before = written(&folder.join(".state/prefilters"));
    assert_eq!(before.len(), 2, "a pyramid for each texture, none for the lobe that is refused");
    // Seconds as the first run measured them stand in the file: write some that no run has.
    for path in prefilters(&folder) {
        let mut file = fs::read(&path).unwrap();
        file.truncate(file.len() - 32);
        file[44..52].copy_from_slice(&1234.5f64.to_le_bytes());
        let digest = blake3::hash(&file);
        file.extend(digest.as_bytes());
        fs::write(&path, file).unwrap();
    }
    let before = written(&folder.join(".state/prefilters"));
    fs::write(bench.folder.path().join("trial.toml"), elsewhere()).unwrap();
    bench.run("moved", &[]);
    assert_eq!(written(&folder.join(".state/prefilters")), before, "they are not built again");
    let costs = fs::read_to_string(folder.join("costs.csv")).unwrap();
    let built = costs.lines().filter(|line| line.contains("fournier") && line.contains("1234.5"));
    assert_eq!(built.count(), 2, "the cost is that of the build: {costs}");
    assert!(metrics(&folder) == metrics(&bench.run("fresh", &[])));
}

#[test]
fn a_damaged_prefiltered_map_is_told_of_and_replaced() {
    let bench = Bench::new();
    let folder = bench.run("hurt", &[]);
    let good: Vec<Vec<u8>> = prefilters(&folder).iter().map(|p| fs::read(p).unwrap()).collect();
    let kept = prefilters(&folder);
    let mut flipped = good[0].clone();
    flipped[good[0].len() / 2] ^= 4;
    fs::write(&kept[0], flipped).unwrap();
    fs::write(&kept[1], &good[1][..good[1].len() / 2]).unwrap();
    fs::write(bench.folder.path().join("trial.toml"), elsewhere()).unwrap();
    let args = ["run", "trial.toml", "--out", "hurt"];
    let done = output(bench.folder.path(), &args);
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{said}");
    let told: Vec<&str> = said.lines().filter(|l| l.contains("is not usable")).collect();
    assert_eq!(told.len(), 2, "{said}");
    assert!(told.iter().all(|l| l.contains(".prefilter") && l.contains("built again")), "{said}");
    // The same again, but for the seconds and the digest of it all.
    for (path, good) in kept.iter().zip(&good) {
        let again = fs::read(path).unwrap();
        let peaks = |file: &[u8]| file[52..file.len() - 32].to_vec();
        assert!(peaks(&again) == peaks(good));
    }
    assert!(metrics(&folder) == metrics(&bench.run("fresh", &[])));
}

/// The committed report was written by the release build; this is another.
#[test]
fn the_committed_report_is_what_this_build_writes() {
    let committed = repository().join("reports/quick");
    assert!(committed.is_dir(), "make it: cargo run --release -- run quick");
    let out = tempfile::tempdir().unwrap();
    let args = ["run", "quick", "--out", out.path().to_str().unwrap()];
    let done = output(repository(), &args);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    assert_same(&committed, &out.path().join("quick"));
}
