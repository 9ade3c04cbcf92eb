//! A reference is sampled until it tells methods apart, or may not go on; and that too gives the same bytes after any
//! interruption.

mod common;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use common::assert_same;
use wrinkle::experiment::results::Results;
use wrinkle::experiment::runner::{RunEvent, Watcher, unwatched};
use wrinkle::experiment::spec::{Experiment, Spec};
use wrinkle::job::{Control, Ending, Found, run};
use wrinkle::metric::Lead;

/// Four filters near each other before a reference of few samples.
const EXPERIMENT: &str = r#"
seed = 3
[image]
width = 24
height = 16
[reference]
spp = 4
replicates = 2
most = MOST
gap = GAP
[sweep]
texture = ["hills"]
method = ["unfiltered", "averaged", "schilling-anisotropic", "toksvig", "lean"]
spp = [1]
unfiltered_spp = [1]
texels_per_pixel = [2.0, 8.0]
[texture.hills]
pattern = "gaussian"
width = 32
height = 32
"#;

fn experiment(most: u32, gap: f64) -> Experiment {
    let text = EXPERIMENT.replace("MOST", &most.to_string()).replace("GAP", &gap.to_string());
    Experiment::Sweep(Box::new(Spec::parse(&text, Path::new("settling.toml")).unwrap()))
}

fn finish(experiment: &Experiment, folder: &Path, watch: &Watcher) -> Results {
    match run(experiment, folder, &Control::default(), watch).unwrap() {
        Ending::Done(done) => match done.found {
            Found::Sweep(results) => *results,
            Found::Paper(_) => panic!("a sweep"),
        },
        Ending::Halted => panic!("nobody halted it"),
    }
}

/// Whether a scene's reference leaves nothing open about who is nearest.
fn is_settled(results: &Results, scene: usize) -> bool {
    let scene = &results.scenes[scene];
    let of = &scene.reference;
    let lead = |near, far| Lead::of(near, far, &of.film, &of.variance, of.gap);
    let films: Vec<_> = scene.trials.iter().map(|trial| &*trial.film).collect();
    let nearest = films
        .iter()
        .copied()
        .reduce(|near, film| if lead(near, film).difference < 0.0 { film } else { near })
        .unwrap();
    films.iter().all(|film| lead(nearest, film).is_resolved())
}

#[test]
fn a_reference_is_sampled_until_it_tells_methods_apart() {
    let folders = [(); 3].map(|()| tempfile::tempdir().unwrap());
    let counts = |results: &Results| -> Vec<u32> {
        results.scenes.iter().map(|scene| scene.reference.spp).collect()
    };
    // Not allowed to: it is left open.
    let held = finish(&experiment(4, 0.01), folders[0].path(), &unwatched());
    assert_eq!(counts(&held), [4, 4]);
    assert!(!is_settled(&held, 0) || !is_settled(&held, 1));
    // Allowed to: no more than it takes.
    let free = finish(&experiment(1024, 0.01), folders[1].path(), &unwatched());
    for (scene, spp) in counts(&free).into_iter().enumerate() {
        assert!(is_settled(&free, scene) && spp < 1024, "{spp}");
        assert!(spp == 4 || !is_settled(&held, scene), "it was settled before");
    }
    assert!(counts(&free).iter().any(|&spp| spp > 4));
    // A wide gap is soon told.
    let wide = finish(&experiment(1024, 1.0), folders[2].path(), &unwatched());
    assert!(counts(&wide).iter().zip(counts(&free)).all(|(wide, free)| *wide <= free));
}

#[test]
fn a_run_halted_at_every_fourth_piece_goes_on_to_the_same_bytes() {
    let spec = experiment(1024, 0.01);
    let whole = tempfile::tempdir().unwrap();
    let pieces = Arc::new(AtomicUsize::new(0));
    let counting = Arc::clone(&pieces);
    let watch: Watcher = Arc::new(move |event| {
        if matches!(event, RunEvent::Working { .. }) {
            counting.fetch_add(1, Ordering::Relaxed);
        }
    });
    let first = finish(&spec, whole.path(), &watch);
    assert!(first.scenes.iter().any(|scene| scene.reference.spp > 4), "it went on");
    let pieces = pieces.load(Ordering::Relaxed);
    for halted_at in (1..pieces).step_by(4) {
        let folder = tempfile::tempdir().unwrap();
        let control = Control::default();
        let (halting, piece) = (control.clone(), AtomicUsize::new(0));
        let watch: Watcher = Arc::new(move |event| {
            let begins = matches!(event, RunEvent::Working { .. });
            if begins && piece.fetch_add(1, Ordering::Relaxed) + 1 == halted_at {
                halting.halt();
            }
        });
        let ending = run(&spec, folder.path(), &control, &watch).unwrap();
        assert!(matches!(ending, Ending::Halted), "at piece {halted_at} of {pieces}");
        finish(&spec, folder.path(), &unwatched());
        assert_same(whole.path(), folder.path());
    }
}

#[test]
fn fewer_methods_take_up_no_more_samples_than_they_need() {
    let (folder, fresh) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    finish(&experiment(1024, 0.01), folder.path(), &unwatched());
    let fewer = experiment(1024, 1.0);
    finish(&fewer, folder.path(), &unwatched());
    finish(&fewer, fresh.path(), &unwatched());
    assert_same(folder.path(), fresh.path());
}
