//! Figure 11: frames of a turning sphere.

use std::sync::Arc;

use crate::evidence::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Images, Panel, Row, Series, Table, Task,
};
use crate::experiment::sequence::Sequence;

/// The row.
pub const ROW: Row = Row {
    name: "blinn-f11",
    title: "A bump-mapped sphere that turns: frames, and the flicker of each way beside the truth's",
    parts: &["turning"],
    parameters: &[],
    secs: 0.5,
    make,
};

/// Ways that are shown: label, method, samples a pixel.
const SHOWN: [(&str, &str, u32); 3] = [
    ("unfiltered", "unfiltered", 1),
    ("table averaged", "averaged", 1),
    ("16 samples", "unfiltered", 16),
];
/// Frames that are shown.
const FRAMES: usize = 3;

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let part = task.part(ROW.parts[0]);
    let mut exhibit = ROW.exhibit();
    for sequence in &part.results.sequences {
        one(sequence, sequence.of(&part.results.scenes), &mut exhibit);
    }
    exhibit.claims.push(Claim::not_applicable(
        "likeness to Figure 11",
        "frames of a film",
        "its object and camera are not printed",
    ));
    Ok(exhibit)
}

fn one(
    sequence: &Sequence,
    frames: &[crate::experiment::results::SceneResult],
    exhibit: &mut Exhibit,
) {
    let head = ["way", "change a frame", "of the truth's", "change of its error, of the truth's"];
    let caption = "Mean change of a pixel from frame to frame.";
    let mut table = Table::new(&format!("flicker-{}", sequence.slug), caption, &head);
    let truth = sequence.truth_change;
    table.push(vec!["the truth".into(), truth.into(), 1.0.into(), 0.0.into()]);
    let mut errors = Vec::new();
    let mut series = Vec::new();
    for (label, method, spp) in SHOWN {
        let Some(flicker) = sequence.flicker(method, spp) else { continue };
        let mean = &flicker.mean;
        table.push(vec![
            label.into(),
            mean.change.into(),
            (mean.change / truth).into(),
            (mean.error_change / truth).into(),
        ]);
        errors.push(mean.error_change / truth);
        let points = flicker.steps.iter().enumerate();
        let points = points.map(|(t, s)| [t as f64 + 1.5, s.error_change / truth]).collect();
        series.push(Series { label: label.into(), points, joined: true });
    }
    let [Some(unfiltered), Some(averaged)] = [errors.first().copied(), errors.get(1).copied()]
    else {
        return exhibit.claims.push(Claim::not_applicable("flicker", "", "the sweep lacks a way"));
    };
    exhibit.claims.push(Claim::shown(
        format!("flicker of the averaged table's error, of that unfiltered, {}", sequence.slug),
        "filtering reduces the more offensive artifacts (§5), and “a useful test is to see how well the objects look \
         as they move” (§6)",
        averaged / unfiltered,
        "below 1",
        averaged < unfiltered,
    ));
    exhibit.tables.push(table);
    let chart = Chart {
        x: Axis::linear("between frames"),
        y: Axis::linear("change of the error, of the truth's change"),
        series,
    };
    let caption = "What flickers: the change of each image's error from frame to frame.";
    exhibit.figures.push(Figure::new(
        &format!("flicker-{}", sequence.slug),
        caption,
        Drawing::Chart(chart),
    ));
    exhibit.figures.push(film_strip(sequence, frames));
}

fn film_strip(sequence: &Sequence, frames: &[crate::experiment::results::SceneResult]) -> Figure {
    let chosen: Vec<usize> =
        (0..FRAMES).map(|k| k * frames.len().saturating_sub(1) / (FRAMES - 1)).collect();
    let mut panels = Vec::new();
    for &t in &chosen {
        let name = format!("{}-truth", frames[t].slug);
        let label = format!("frame {}, converged", t + 1);
        panels.push(Panel::new(&name, label, Arc::clone(&frames[t].reference.film)));
    }
    for (label, method, spp) in SHOWN {
        for &t in &chosen {
            let trial = frames[t].trials.iter().find(|x| x.method == method && x.spp == spp);
            let Some(trial) = trial else { continue };
            let name = format!("{}-{method}-{spp}", frames[t].slug);
            panels.push(Panel::new(&name, label, Arc::clone(&trial.film)));
        }
    }
    let images = Images { panels, white: None, reference: None, across: FRAMES };
    let caption = "First, middle and last frame.";
    Figure::new(&format!("frames-{}", sequence.slug), caption, Drawing::Images(images))
}
