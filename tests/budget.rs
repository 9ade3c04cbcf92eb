//! Budgets of errors: what is right in a method is not blamed, what it lacks is.

mod common;

use std::path::Path;

use wrinkle::experiment::results::{Results, SceneResult};
use wrinkle::experiment::runner::{Outcome, run, unwatched};
use wrinkle::experiment::spec::Spec;
use wrinkle::render::Part;
use wrinkle::scene::{Balance, Halt};

const START: &str = r#"
seed = 5
[image]
width = 20
height = 14
[camera]
elevation = 50.0
fov = 16.0
[material]
exponent = 40.0
[budget]
points = 256
[texture.gaussian]
pattern = "gaussian"
width = 64
height = 64
"#;

fn finished(rest: &str, folder: &Path) -> Results {
    let spec = Spec::parse(&format!("{START}{rest}"), Path::new("shared.toml"));
    let spec = spec.unwrap_or_else(|error| panic!("{error}"));
    match run(&spec, folder, &Halt::default(), &unwatched()).unwrap() {
        Outcome::Finished(found) => found.0,
        Outcome::Halted => panic!("nobody halted it"),
    }
}

fn of(rest: &str) -> Results {
    let folder = tempfile::tempdir().unwrap();
    finished(rest, folder.path())
}

fn balance<'a>(scene: &'a SceneResult, method: &str) -> &'a Balance {
    let found = scene.budgets.iter().find(|budget| budget.method == method);
    &found.unwrap_or_else(|| panic!("no budget of {method}")).balance
}

/// The shares of some parts, added up.
fn share(balance: &Balance, parts: &[Part]) -> f64 {
    let shares = balance.entries.iter().zip(balance.shares());
    shares.filter(|(entry, _)| parts.contains(&entry.part)).map(|(_, share)| share).sum()
}

const PLAIN: &str = r#"
[reference]
spp = 1024
[sweep]
texture = ["gaussian", "brushed"]
method = ["unfiltered", "averaged", "toksvig", "schilling-anisotropic", "lean"]
lookup = ["trilinear", "exact"]
spp = [1]
unfiltered_spp = [1]
texels_per_pixel = [8.0]
"#;

#[test]
fn what_a_method_has_right_is_not_blamed_and_what_it_lacks_is() {
    let results = of(PLAIN);
    let [gaussian, brushed] = &results.scenes[..] else { panic!("two scenes") };
    for scene in [gaussian, brushed] {
        assert_eq!(scene.budgets.len(), results.methods.len());
        for budget in &scene.budgets {
            let (label, balance) = (&budget.method, &budget.balance);
            let sum: f64 = balance.shares().iter().sum();
            assert!((sum - 1.0).abs() < 1e-12, "{label}: {sum}");
            // The whole is the error of the method's own image.
            let trial = scene.trials.iter().find(|t| t.method == *label && t.spp == 1).unwrap();
            let rmse = trial.score("rmse").unwrap();
            assert!((balance.whole.sqrt() / rmse - 1.0).abs() < 1e-9, "{label}");
            // What is left is noise, that of 256 points and of the reference.
            let noise = balance.entries.last().unwrap().left.sqrt();
            assert!(noise < 12.0 * scene.reference.rmse, "{label}: {noise}");
        }
    }
    // Slopes that are Gaussian, in a lobe of their mean and covariance: both are right already.
    let moments = [Part::Energy, Part::Direction, Part::Width, Part::Anisotropy];
    for label in ["lean-exact", "schilling-anisotropic-exact"] {
        for part in moments {
            let balance = balance(gaussian, label);
            let moved = share(balance, &[part]) * balance.whole;
            let averaged = self::balance(gaussian, "averaged-exact").whole;
            assert!(moved.abs() < 0.01 * averaged, "{label} {part:?}: {moved} of {averaged}");
        }
    }
    // A round lobe as wide as the length of the mean normal asks for lacks the anisotropy of scratches, a smoothed
    // surface its width.
    let round = balance(brushed, "toksvig-exact");
    assert_eq!(round.greatest().unwrap().0, Part::Anisotropy);
    assert!(share(round, &[Part::Anisotropy]) > 0.5, "{:?}", round.shares());
    let smooth = balance(gaussian, "averaged-exact");
    assert_eq!(smooth.greatest().unwrap().0, Part::Width);
    assert!(share(smooth, &[Part::Width]) > 0.8, "{:?}", smooth.shares());
    let nothing = |label: &str| balance(gaussian, label).entries[0].nothing.clone();
    assert_eq!(nothing("unfiltered").unwrap(), "it looks at no footprint");
    assert_eq!(nothing("lean-exact").unwrap(), "its lookup is the exact one");
    assert_eq!(nothing("lean"), None);
    // With the lookup replaced both ways are one.
    let left = |label: &str| balance(gaussian, label).entries[1].left;
    assert!((left("lean") / left("lean-exact") - 1.0).abs() < 1e-9);
}

const SHADOWS: &str = r#"
[light]
elevation = 15.0
[reference]
spp = 256
truth = "masked"
[sweep]
texture = ["twill"]
method = ["lean", "fournier-fast", "fournier-shadowed"]
spp = [1]
texels_per_pixel = [4.0]
[method.fournier-fast]
use = "fournier"
mode = "fast"
[method.fournier-shadowed]
use = "fournier"
mode = "fast"
shadowing = "printed"
"#;

#[test]
fn shadows_are_the_last_part() {
    let folder = tempfile::tempdir().unwrap();
    let results = finished(SHADOWS, folder.path());
    let scene = &results.scenes[0];
    let shadowing = |label: &str| {
        let balance = balance(scene, label);
        assert!(balance.entries.iter().all(|entry| entry.nothing.is_none()), "{label}");
        assert_eq!(balance.entries.last().unwrap().left, 0.0, "all of the truth is in");
        share(balance, &[Part::Shadowing]) * balance.whole
    };
    // Without shadows of their own, methods end at the same image of the bumps.
    assert_eq!(shadowing("lean"), shadowing("fournier-fast"));
    assert!(shadowing("lean") > 0.0);
    // A later run takes the budgets up as they were.
    let again = finished(SHADOWS, folder.path());
    assert_eq!(again.scenes[0].budgets, scene.budgets);
}
