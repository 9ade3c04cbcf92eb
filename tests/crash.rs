//! Runs that are killed, halted, out of room or not alone: nothing that was finished is lost or made again, nothing is
//! mixed, and the run that ends it all writes the bytes of a run that nothing disturbed. Done many times over.
#![cfg(unix)]

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::LazyLock;
use std::time::Duration;

use common::{assert_same, files_under, output, records, wrinkle, written};

/// Small: a run takes about a second. One scene: a reference, 3 trials and their scores, probes, 2 prefilters.
const EXPERIMENT: &str = r#"
seed = 5
[image]
width = 8
height = 6
[reference]
spp = 64
replicates = 2
[sweep]
texture = ["hills"]
method = ["unfiltered", "averaged"]
spp = [1]
unfiltered_spp = [1, 4]
texels_per_pixel = [3.0]
[texture.hills]
pattern = "gaussian"
width = 8
height = 8
"#;

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

    fn results(&self) -> PathBuf {
        self.path().join("reports/trial")
    }

    fn start(&self) -> Child {
        let mut run = wrinkle(self.path(), &["run", "trial.toml"]);
        run.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    }

    /// Runs it to its end; what is kept by then was not made again, and all bytes are those of [`whole`].
    fn finish(&self) {
        let before = written(&self.results().join(".state/films"));
        let whole_records = records_whole(&self.results());
        let done = output(self.path(), &["run", "trial.toml"]);
        assert!(done.status.success(), "{}", said(&done));
        assert_same(whole(), &self.results());
        let after = written(&self.results().join(".state/films"));
        let again: Vec<_> =
            before.iter().filter(|film| is_kept(&film.0) && !after.contains(film)).collect();
        assert!(again.is_empty(), "made again: {again:?}");
        let after = records_whole(&self.results());
        assert!(
            whole_records.iter().all(|record| after.contains(record)),
            "a record was made again"
        );
        let left = files_under(&self.results());
        let half: Vec<_> = left.iter().filter(|path| !is_kept(path)).collect();
        assert!(half.is_empty(), "half-written files stay: {half:?}");
    }
}

fn is_kept(path: &Path) -> bool {
    !path.file_name().unwrap().to_string_lossy().starts_with(".writing-")
}

/// The records of trials, scores and probes, what each is called, and when it was written. (Records of prefilters are
/// written whenever one is built, and those of a reference again if the kill came between its two films.)
fn records_whole(results: &Path) -> Vec<(PathBuf, String, std::time::SystemTime)> {
    let time = |path: &Path| fs::metadata(path).unwrap().modified().unwrap();
    let all = records(results).into_iter().filter(|(path, of)| {
        is_kept(path) && ["spp", "-scores", "probes"].iter().any(|end| of.ends_with(end))
    });
    all.map(|(path, of)| (path.clone(), of, time(&path))).collect()
}

fn said(done: &Output) -> String {
    String::from_utf8_lossy(&done.stderr).into_owned()
}

/// The results of a run that nothing disturbed.
static WHOLE: LazyLock<(Bench, PathBuf)> = LazyLock::new(|| {
    let bench = Bench::new();
    let done = output(bench.path(), &["run", "trial.toml"]);
    assert!(done.status.success(), "{}", said(&done));
    let results = bench.results();
    (bench, results)
});

fn whole() -> &'static Path {
    &WHOLE.1
}

/// Waits until a run has kept this many records, or has ended; whether it still runs.
fn wait_for(run: &mut Child, results: &Path, count: usize) -> bool {
    while records(results).len() < count {
        if run.try_wait().unwrap().is_some() {
            return false;
        }
        std::thread::sleep(Duration::from_micros(200));
    }
    run.try_wait().unwrap().is_none()
}

fn signal(run: &Child, name: &str) {
    let id = run.id().to_string();
    assert!(Command::new("kill").args([name, &id]).status().unwrap().success());
}

/// 20 kills, each in a folder of its own: from the first moment on, one after each record, and into the report.
#[test]
fn killed_at_any_moment_a_run_goes_on() {
    let all = records(whole()).len();
    let mut killed = 0;
    for moment in 0..20 {
        let bench = Bench::new();
        let mut run = bench.start();
        let runs = wait_for(&mut run, &bench.results(), moment.min(all));
        // Into the next piece of work, or the report.
        std::thread::sleep(Duration::from_micros(700 * (moment as u64 % 5)));
        run.kill().unwrap();
        killed += usize::from(runs);
        run.wait().unwrap();
        bench.finish();
    }
    assert!(killed >= 10, "only {killed} of 20 were killed before their end");
}

/// One folder, one run after another, each killed once it has kept something new.
#[test]
fn killed_again_and_again_it_still_gets_on() {
    let bench = Bench::new();
    let all = records(whole()).len();
    let mut kills = 0;
    loop {
        let before = records(&bench.results()).len();
        if before >= all || kills > all {
            break;
        }
        let mut run = bench.start();
        wait_for(&mut run, &bench.results(), before + 1);
        let _ = run.kill();
        run.wait().unwrap();
        kills += 1;
        assert!(records(&bench.results()).len() > before, "kill {kills} lost a record");
    }
    assert!(kills >= 3, "{kills} kills");
    bench.finish();
}

/// 4 moments, each signal.
#[test]
fn signals_end_a_run_in_order() {
    for (name, moment) in [("-INT", 1), ("-TERM", 3), ("-TERM", 6), ("-INT", 9)] {
        let bench = Bench::new();
        let mut run = bench.start();
        let runs = wait_for(&mut run, &bench.results(), moment);
        if runs {
            signal(&run, name);
        }
        let done = run.wait_with_output().unwrap();
        let code = done.status.code();
        // It may have been about to end.
        assert!(code == Some(130) || code == Some(0), "{name}: {code:?} {}", said(&done));
        if code == Some(130) {
            assert!(said(&done).contains("the same command goes on"), "{}", said(&done));
        }
        bench.finish();
    }
}

/// 8 limits on the size of a file, from one that no record fits in to one that only the page exceeds.
#[test]
fn files_that_cannot_be_written_are_named_and_the_rest_is_kept() {
    let bench = Bench::new();
    let mut failed = 0;
    for blocks in [0, 1, 2, 4, 16, 48, 96, 192] {
        // Ignored, the signal leaves an error, as that of a full disk.
        let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" run trial.toml");
        let run = Command::new("sh")
            .current_dir(bench.path())
            .args(["-c", &script, env!("CARGO_BIN_EXE_wrinkle")])
            .output()
            .unwrap();
        if run.status.code() == Some(0) {
            continue;
        }
        failed += 1;
        told_of_no_room(&run);
    }
    assert!(failed >= 3, "{failed} runs failed");
    bench.finish();
}

/// What a run says that finds no room: one message, that names the file and says what to do.
fn told_of_no_room(run: &Output) {
    let said = said(run);
    assert_eq!(run.status.code(), Some(1), "{said}");
    let errors: Vec<_> = said.lines().filter(|line| !line.starts_with("note: ")).collect();
    assert_eq!(errors.len(), 1, "{said}");
    assert!(errors[0].starts_with("error: ") && errors[0].contains("cannot write"), "{said}");
    assert!(errors[0].contains("reports/trial"), "{said}");
    assert!(!said.contains(".writing-"), "{said}");
}

/// A small file system of its own; only root can have one.
struct Disk(PathBuf);

impl Disk {
    fn mount(at: &Path, size: &str) -> Option<Self> {
        fs::create_dir_all(at).unwrap();
        let options = format!("size={size}");
        let done =
            Command::new("mount").args(["-t", "tmpfs", "-o", &options, "tmpfs"]).arg(at).output();
        let mounted = done.is_ok_and(|done| done.status.success());
        if !mounted {
            eprintln!(
                "NOT TESTED: a file system that is full or read-only, which only root can mount"
            );
        }
        mounted.then(|| Self(at.to_owned()))
    }

    fn remount(&self, options: &str) {
        let options = format!("remount,{options}");
        let done = Command::new("mount").args(["-o", &options]).arg(&self.0).status().unwrap();
        assert!(done.success());
    }
}

impl Drop for Disk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(&self.0).status();
    }
}

/// 7 sizes of a disk, from one that takes not even the first record.
#[test]
fn a_full_disk_loses_nothing() {
    let bench = Bench::new();
    let Some(disk) = Disk::mount(&bench.path().join("reports"), "8k") else { return };
    let mut failed = 0;
    for size in ["8k", "16k", "32k", "64k", "96k", "128k", "192k"] {
        disk.remount(&format!("size={size}"));
        let before = records_whole(&bench.results());
        let run = output(bench.path(), &["run", "trial.toml"]);
        let after = records_whole(&bench.results());
        assert!(before.iter().all(|record| after.contains(record)));
        if !run.status.success() {
            failed += 1;
            told_of_no_room(&run);
        }
    }
    assert!(failed >= 3, "{failed} runs failed");
    disk.remount("size=64m");
    bench.finish();
}

#[test]
fn a_folder_that_cannot_be_written_is_named() {
    let bench = Bench::new();
    let Some(disk) = Disk::mount(&bench.path().join("reports"), "64m") else { return };
    disk.remount("ro");
    let run = output(bench.path(), &["run", "trial.toml"]);
    told_of_no_room(&run);
    assert!(said(&run).contains("Read-only"), "{}", said(&run));
    disk.remount("rw");
    bench.finish();
}

/// 6 times, 4 runs at the same instant in one folder.
#[test]
fn of_several_runs_in_one_folder_one_works_and_the_others_say_so() {
    for _ in 0..6 {
        let bench = Bench::new();
        let runs: Vec<Child> = (0..4).map(|_| bench.start()).collect();
        let ended: Vec<Output> =
            runs.into_iter().map(|run| run.wait_with_output().unwrap()).collect();
        assert!(ended.iter().any(|run| run.status.success()));
        for run in ended.iter().filter(|run| !run.status.success()) {
            assert_eq!(run.status.code(), Some(1), "{}", said(run));
            assert!(said(run).contains("another run is writing to"), "{}", said(run));
        }
        assert_same(whole(), &bench.results());
        // The lock went with whoever had it.
        bench.finish();
    }
}
