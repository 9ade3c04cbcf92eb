use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, mpsc};

use super::*;
use crate::experiment::runner::unwatched;

const SPEC: &str = r#"
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
texels_per_pixel = [2.0, 8.0]
[texture.gaussian]
pattern = "gaussian"
width = 16
height = 16
"#;

fn experiment() -> Experiment {
    Experiment::Sweep(Box::new(Spec::parse(SPEC, Path::new("small.toml")).unwrap()))
}

fn is_done(ending: Result<Ending, JobError>) -> bool {
    matches!(ending.unwrap(), Ending::Done(_))
}

/// The bytes of all files of a report, costs and state aside.
fn bytes(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() && name != ".state" {
            let within = bytes(&path).into_iter();
            found.extend(within.map(|(file, bytes)| (Path::new(&name).join(file), bytes)));
        } else if path.is_file() && !name.starts_with("costs.") {
            found.insert(name.into(), std::fs::read(path).unwrap());
        }
    }
    found
}

/// Trials told of, as (fresh, kept).
fn scored(folder: &Path) -> (usize, usize) {
    let count = Arc::new([AtomicUsize::new(0), AtomicUsize::new(0)]);
    let counted = Arc::clone(&count);
    let watch: Watcher = Arc::new(move |event| {
        if let RunEvent::Scored { kept, scores, .. } = event {
            assert!(scores.iter().any(|score| score.metric == "rmse"));
            counted[usize::from(kept)].fetch_add(1, Ordering::Relaxed);
        }
    });
    assert!(is_done(run(&experiment(), folder, &Control::default(), &watch)));
    (count[0].load(Ordering::Relaxed), count[1].load(Ordering::Relaxed))
}

/// Runs with the gate shut at the `piece`-th piece of work; once it waits, `then` is done to it. What
/// was told after that, and whether it was finished.
fn paused_at(piece: usize, folder: &Path, then: fn(&Control)) -> (Vec<RunEvent>, bool) {
    let control = Control::default();
    let (told, heard) = mpsc::channel();
    let (pieces, after) = (AtomicUsize::new(0), Arc::new(Mutex::new(None)));
    let (shutting, telling) = (control.clone(), Arc::clone(&after));
    let watch: Watcher = Arc::new(move |event| {
        if matches!(event, RunEvent::Working { .. })
            && pieces.fetch_add(1, Ordering::Relaxed) + 2 == piece
        {
            shutting.gate.shut();
        }
        let mut after = telling.lock().unwrap();
        if event == RunEvent::Paused {
            *after = Some(Vec::new());
            told.send(()).unwrap();
        } else if let Some(after) = after.as_mut() {
            after.push(event);
        }
    });
    let done = std::thread::scope(|scope| {
        let run = scope.spawn(|| run(&experiment(), folder, &control, &watch));
        heard.recv().unwrap();
        then(&control);
        is_done(run.join().unwrap())
    });
    let after = after.lock().unwrap().take().unwrap();
    (after, done)
}

#[test]
fn a_paused_job_goes_on_and_writes_the_same_bytes() {
    let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let [whole, paused] = folders.each_ref().map(tempfile::TempDir::path);
    assert!(is_done(run(&experiment(), whole, &Control::default(), &unwatched())));
    let (after, done) = paused_at(4, paused, |control| control.gate.open());
    assert!(done);
    assert_eq!(after[0], RunEvent::Resumed);
    assert!(matches!(after[1], RunEvent::Working { .. }));
    assert!(bytes(whole) == bytes(paused));
}

#[test]
fn a_job_halted_while_it_waits_begins_no_piece_and_keeps_what_is_done() {
    let folder = tempfile::tempdir().unwrap();
    for halt in [
        Control::halt,
        // As a signal does it, which knows of no gate.
        |control: &Control| control.halt.0.store(true, Ordering::Relaxed),
    ] {
        let (after, done) = paused_at(4, folder.path(), halt);
        assert!(!done);
        assert_eq!(after, []);
    }
    let (fresh, kept) = scored(folder.path());
    assert_eq!(fresh + kept, 6);
    assert!(kept >= 1, "{fresh} fresh, {kept} kept");
}

#[test]
fn what_was_kept_is_told_again() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(scored(folder.path()), (6, 0));
    assert_eq!(scored(folder.path()), (0, 6));
    let told = Arc::new(Mutex::new(Vec::new()));
    let telling = Arc::clone(&told);
    let watch: Watcher = Arc::new(move |event| telling.lock().unwrap().push(event));
    assert!(is_done(run(&experiment(), folder.path(), &Control::default(), &watch)));
    let told = told.lock().unwrap();
    let count = |what: fn(&RunEvent) -> bool| told.iter().filter(|event| what(event)).count();
    assert_eq!(
        count(|event| matches!(event, RunEvent::Probed { distances, .. } if distances.len() == 2)),
        2
    );
    assert_eq!(count(|event| matches!(event, RunEvent::Converged { rmse, .. } if *rmse > 0.0)), 2);
    assert_eq!(count(|event| matches!(event, RunEvent::Scene { number: 2, of: 2, .. })), 1);
    assert_eq!(count(|event| matches!(event, RunEvent::Reporting)), 1);
}

#[test]
fn two_jobs_do_not_share_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    let _lock = Lock::take(folder.path()).unwrap();
    let refused = run(&experiment(), folder.path(), &Control::default(), &unwatched());
    assert!(matches!(refused, Err(JobError::Folder(LockError::Taken { .. }))));
}

#[test]
fn names_come_in_order_and_only_of_experiments() {
    let folder = tempfile::tempdir().unwrap();
    for file in ["b.toml", "a.toml", "notes.md"] {
        std::fs::write(folder.path().join(file), "").unwrap();
    }
    assert_eq!(names_in(folder.path()), ["a", "b"]);
    assert!(names_in(&folder.path().join("none")).is_empty());
}
