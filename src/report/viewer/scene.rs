//! The viewer of a scene: its reference, each method as it is compared, then brute force at more samples.

use super::{Image, Images, Viewer};
use crate::experiment::results::{Results, SceneResult, TrialResult};
use crate::metric::equivalent_samples;
use crate::report::contest::{BRUTE_FORCE, DECIDES, brute_force_curve};
use crate::report::phrase;
use crate::report::sheet::Frames;
use crate::report::source::{Lines, Source};

/// The viewer of a scene whose contact sheet is `frames`, with methods at `spp` samples a pixel; and how many of its
/// images are on that sheet too.
pub fn viewer(
    results: &Results,
    lines: &Lines,
    scene: &SceneResult,
    frames: &Frames,
    spp: u32,
) -> (Option<Viewer>, usize) {
    let brute = results.methods.iter().find(|m| m.name == BRUTE_FORCE);
    let brute = brute.map_or("", |method| method.label.as_str());
    let (compared, others): (Vec<&TrialResult>, Vec<_>) =
        scene.trials.iter().partition(|trial| trial.spp == spp);
    let more: Vec<_> = others.into_iter().filter(|trial| trial.method == brute).collect();
    let line = |source| lines.line(&source).map_or_else(String::new, |line| line.to_string());
    let lines: Vec<String> = compared
        .iter()
        .chain(&more)
        .map(|trial| line(Source::of(scene, &trial.method, Some(trial.spp), DECIDES)))
        .collect();
    let mut images = vec![Image {
        label: "reference".into(),
        remark: frames.frames[0].remark.clone(),
        lines: String::new(),
        films: vec![&scene.reference.film],
        prints: Vec::new(),
    }];
    let curve = brute_force_curve(results, scene);
    let shown = compared.iter().zip(&frames.frames[1..]).map(|(trial, frame)| Image {
        label: trial.method.clone(),
        remark: if trial.method == brute {
            frame.remark.clone()
        } else {
            worth(&frame.remark, trial, &curve)
        },
        lines: String::new(),
        films: vec![&trial.film],
        prints: Vec::new(),
    });
    images.extend(shown);
    let count = images.len();
    images.extend(more.iter().map(|trial| Image {
        label: format!("{}, {} spp", trial.method, trial.spp),
        remark: error(trial),
        lines: String::new(),
        films: vec![&trial.film],
        prints: Vec::new(),
    }));
    for (image, line) in images[1..].iter_mut().zip(lines) {
        image.lines = line;
    }
    let normalised = |label: &str| results.methods.iter().any(|m| m.label == label && m.normalised);
    let telling = (0..count).filter(|i| *i == 0 || normalised(&images[*i].label)).collect();
    let viewer = Viewer::of(&Images {
        reference: Some(0),
        against: images.iter().position(|image| image.label == brute).unwrap_or(0),
        telling,
        white: frames.white,
        full: frames.full,
        motion: None,
        images,
    });
    (viewer, count)
}

/// A remark with the brute-force samples that the image is worth.
fn worth(remark: &str, trial: &TrialResult, curve: &[(u32, f64)]) -> String {
    let found = trial.score(DECIDES).and_then(|error| equivalent_samples(curve, error));
    found.map_or_else(
        || remark.to_owned(),
        |worth| format!("{remark}, worth {}\u{a0}spp", phrase::samples_short(worth)),
    )
}

fn error(trial: &TrialResult) -> String {
    trial.score(DECIDES).map_or_else(String::new, |e| format!("RMSE {}", phrase::number(e)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{fixture, sheet};

    #[test]
    fn methods_come_before_brute_force_at_more_samples() {
        let results = fixture::results();
        let scene = &results.scenes[1];
        let frames = sheet::frames(scene, 1);
        let (viewer, count) = viewer(&results, &Lines::of(&results), scene, &frames, 1);
        let viewer = viewer.unwrap();
        assert_eq!((count, viewer.len()), (7, 11));
        let labels = viewer.labels();
        assert_eq!(labels[..2], ["reference", "unfiltered"]);
        assert_eq!(labels[7..], [4, 16, 64, 256].map(|n| format!("unfiltered, {n} spp")));
    }
}
