//! Things that move: frames are what they say, runs go on where they stopped, files have the same bytes.

mod common;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use wrinkle::experiment::results::Results;
use wrinkle::experiment::runner::{Outcome, RunEvent, Watcher, run, unwatched};
use wrinkle::experiment::spec::Spec;
use wrinkle::metric;
use wrinkle::report;
use wrinkle::scene::Halt;

fn spec(text: &str) -> Spec {
    Spec::parse(text, Path::new("moving.toml")).unwrap_or_else(|error| panic!("{error}"))
}

const SPHERE: &str = r#"
seed = 3
[image]
width = 24
height = 20
[surface]
shape = "sphere"
[material]
exponent = 30.0
[reference]
spp = 1024
replicates = 4
[sweep]
texture = ["gaussian"]
method = ["unfiltered", "averaged", "lean"]
spp = [1]
unfiltered_spp = [1, 4]
texels_per_pixel = [4.0]
"#;

fn finished(spec: &Spec, folder: &Path) -> Results {
    match run(spec, folder, &Halt::default(), &unwatched()).unwrap() {
        Outcome::Finished(found) => found.0,
        Outcome::Halted => panic!("nobody halted it"),
    }
}

fn turning(more: &str) -> Spec {
    spec(&format!("{SPHERE}[motion]\n{more}"))
}

#[test]
fn a_sequence_has_its_frames_and_figures() {
    let folder = tempfile::tempdir().unwrap();
    let spec = turning("frames = 3\ndegrees = 4\n");
    let results = finished(&spec, folder.path());
    let slugs: Vec<&str> = results.scenes.iter().map(|scene| scene.slug.as_str()).collect();
    assert_eq!(
        slugs,
        ["gaussian-4-texels-f001", "gaussian-4-texels-f002", "gaussian-4-texels-f003"]
    );
    let frames: Vec<_> = results.scenes.iter().map(|scene| scene.key.frame).collect();
    assert_eq!(frames, [Some(1), Some(2), Some(3)]);
    let [sequence] = results.sequences.as_slice() else { panic!("one sequence") };
    assert_eq!(sequence.slug, "gaussian-4-texels");
    let trials: Vec<_> = sequence.trials.iter().map(|t| (t.method.as_str(), t.spp)).collect();
    assert_eq!(trials, [("unfiltered", 1), ("unfiltered", 4), ("averaged", 1), ("lean", 1)]);
    // Bumps that no filter holds back sparkle, and each method's figure is that of its films.
    let flicker = |method| sequence.flicker(method, 1).unwrap().ratio().unwrap();
    assert!(flicker("unfiltered") > 1.5 * flicker("lean"), "{}", flicker("unfiltered"));
    let films: Vec<_> = results.scenes.iter().map(|s| &*s.trials[0].film).collect();
    let map = metric::flicker_map(&films).unwrap();
    let mean = map.pixels().iter().map(|p| f64::from(*p)).sum::<f64>() / map.pixels().len() as f64;
    assert!((mean / sequence.trials[0].flicker.mean.change - 1.0).abs() < 1e-6);
    // The first frame's trials are those of the scene at rest.
    let still = finished(&self::spec(SPHERE), tempfile::tempdir().unwrap().path());
    let (moved, rest) = (&results.scenes[0].trials, &still.scenes[0].trials);
    assert!(moved.iter().zip(rest).all(|(a, b)| a.film == b.film));
    assert_eq!(results.scenes[0].reference.film, still.scenes[0].reference.film);
}

/// The films of a method, frame by frame.
fn films<'a>(results: &'a Results, method: &str) -> Vec<&'a [f32]> {
    let of = |scene: &'a wrinkle::experiment::results::SceneResult| {
        scene.trials.iter().find(|t| t.method == method && t.spp == 1).unwrap().film.pixels()
    };
    results.scenes.iter().map(of).collect()
}

#[test]
fn turning_the_object_is_turning_all_else_the_other_way() {
    // Two degrees of the object about the vertical are minus two of camera and light.
    let turned =
        finished(&turning("frames = 2\ndegrees = 2\n"), tempfile::tempdir().unwrap().path());
    let text =
        SPHERE.replace("[material]", "[camera]\nazimuth = -92\n[light]\nazimuth = 88\n[material]");
    let other = finished(&spec(&text), tempfile::tempdir().unwrap().path());
    let (a, b) = (films(&turned, "lean")[1], films(&other, "lean")[0]);
    // The tiling is that of the first frame, which sees the sphere from elsewhere: so does the still one, as a
    // sphere rounds its tiling.
    let largest = b.iter().fold(0.0f32, |most, v| most.max(*v));
    let apart = a.iter().zip(b).fold(0.0f32, |most, (a, b)| most.max((a - b).abs()));
    assert!(apart < 1e-3 * largest, "{apart} of {largest}");
}

#[test]
fn an_approach_halves_what_a_pixel_covers() {
    let text = SPHERE.replace("shape = \"sphere\"", "shape = \"plane\"");
    let text = format!("{text}[motion]\nkind = \"approach\"\nfrom = 8\nto = 2\nframes = 3\n");
    let results = finished(&spec(&text), tempfile::tempdir().unwrap().path());
    let keys: Vec<_> =
        results.scenes.iter().map(|s| (s.key.distance, s.key.texels_per_pixel)).collect();
    // A pixel beside the centre tells: on a plane that is seen aslant it covers a little less.
    for ((distance, texels), (far, wide)) in keys.iter().zip([(8.0, 4.0), (4.0, 2.0), (2.0, 1.0)]) {
        assert!((distance / far - 1.0f64).abs() < 1e-12, "{keys:?}");
        assert!((texels / wide - 1.0f64).abs() < 0.03, "{keys:?}");
        assert!((texels * 8.0 / (distance * keys[0].1) - 1.0).abs() < 1e-3, "{keys:?}");
    }
}

#[test]
fn an_environment_turns_with_the_light() {
    let text = SPHERE.replace(
        "[material]",
        "[light]\nkind = \"environment\"\nmap = \"moon\"\nwidth = 64\n[material]",
    );
    let moved = format!("{text}[motion]\nkind = \"light\"\ndegrees = 30\nframes = 2\n");
    let moved = finished(&spec(&moved), tempfile::tempdir().unwrap().path());
    let rotated = text.replace("width = 64", "width = 64\nrotation = 30");
    let rotated = finished(&spec(&rotated), tempfile::tempdir().unwrap().path());
    assert_eq!(films(&moved, "lean")[1], films(&rotated, "lean")[0]);
}

#[test]
fn an_interrupted_run_goes_on_at_its_frame_and_ends_the_same() {
    let spec = turning("frames = 4\ndegrees = 4\n");
    let (whole, parts) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let finish = |folder: &Path, halt: &Halt, watch: &Watcher| match run(&spec, folder, halt, watch)
        .unwrap()
    {
        Outcome::Finished(found) => {
            report::write(&found.0, &found.1, folder).unwrap();
            true
        }
        Outcome::Halted => false,
    };
    assert!(finish(whole.path(), &Halt::default(), &unwatched()));
    // Halted in the second frame.
    let halt = Halt(Arc::new(AtomicBool::new(false)));
    let stop = Arc::clone(&halt.0);
    let watch: Watcher = Arc::new(move |event| {
        if matches!(&event, RunEvent::Scored { scene, .. } if scene.ends_with("f002")) {
            stop.store(true, Ordering::Relaxed);
        }
    });
    assert!(!finish(parts.path(), &halt, &watch));
    let (fresh, kept) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicUsize::new(0)));
    let (new, old) = (Arc::clone(&fresh), Arc::clone(&kept));
    let watch: Watcher = Arc::new(move |event| match event {
        RunEvent::Scored { kept: false, .. } => {
            new.fetch_add(1, Ordering::Relaxed);
        }
        RunEvent::Advanced { kept: true, work } if work > 0.0 => {
            old.fetch_add(1, Ordering::Relaxed);
        }
        _ => {}
    });
    assert!(finish(parts.path(), &Halt::default(), &watch));
    // Of 16 trials, 5 were done: the first frame's, and one of the second.
    assert_eq!(fresh.load(Ordering::Relaxed), 11);
    assert!(kept.load(Ordering::Relaxed) >= 5);
    common::assert_same(whole.path(), parts.path());
}
