//! The cost table of §3: four scenes without a texture, unfiltered, filtered and supersampled.

use std::sync::Arc;
use std::time::Instant;

use crate::experiment::preview::{Wish, stage_one};
use crate::method::{self, Prefiltered, Silent};
use crate::render::{PixelSampler, render};
use crate::scene::StagedScene;
use crate::texture::{NormalMap, Wrap};

use super::super::{Claim, Exhibit, Halted, Quantity, Row, Table, Task};

/// The row.
pub const ROW: Row = Row {
    name: "fournier-t1",
    title: "What filtering costs: four scenes without a texture, unfiltered, filtered, supersampled",
    parts: &["cylinder-on-plane", "sphere-on-plane", "sphere-on-sphere", "denim-on-plane"],
    parameters: &[],
    secs: 8.0,
    make,
};

/// The paper's times, seconds: no texture, unfiltered, filtered, supersampled; 512 × 512 pixels.
const IN_1992: [[f64; 4]; 4] = [
    [63.0, 210.0, 458.0, 3159.0],
    [63.0, 182.0, 339.0, 2774.0],
    [45.0, 97.0, 150.0, 1603.0],
    [63.0, 214.0, 514.0, 3186.0],
];

/// Renderings timed of each; the fastest counts, as nothing but disturbance makes one slower.
const TIMES: usize = 3;

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let mut exhibit = ROW.exhibit();
    let head = ["scene", "no texture, s", "unfiltered, s", "filtered, s", "supersampled, s"];
    let ratios = ["filtered : unfiltered", "in 1992", "supersampled : unfiltered", "in 1992"];
    let head: Vec<&str> = head.into_iter().chain(ratios).collect();
    let caption =
        "Time of an image today, all cores, the fastest of three, and the paper's ratios (§3).";
    let mut table = Table::new("costs", caption, &head);
    for (part, in_1992) in ROW.parts.iter().zip(IN_1992) {
        let part = task.part(part);
        let wish = Wish { texture: None, texels_per_pixel: None, spp: 1, frame: 0 };
        // The part has run, so its texture is there.
        let Ok(staged) = stage_one(&part.spec, &wish) else { continue };
        let today = times(&staged, task)?;
        let [filtered, supersampled] = [today[2] / today[1], today[3] / today[1]];
        let then = [in_1992[2] / in_1992[1], in_1992[3] / in_1992[1]];
        let mut row: Vec<Quantity> = vec![part.results.title.as_str().into()];
        row.extend(today.map(Quantity::from));
        row.extend([filtered, then[0], supersampled, then[1]].map(Quantity::from));
        table.push(row);
        let of = |what: &str| format!("{}: cost of {what}, of unfiltered's", part.results.title);
        let claim = |what: &str, paper: f64, here: f64| {
            let within = here <= 1.5 * paper && here >= paper / 1.5;
            Claim::shown(of(what), paper, here, "within a factor of 1.5", within)
        };
        exhibit.timed.claims.push(claim("filtered", then[0], filtered).because(
            "an unfiltered sample is far cheaper beside the rest of a renderer today: its loop is vector code, while \
             up to 56 peaks are looked up one by one",
        ));
        exhibit.timed.claims.push(claim("16 samples", then[1], supersampled));
    }
    exhibit.timed.tables.push(table);
    exhibit.claims.push(Claim::not_applicable(
        "cost of filtering and of supersampling, of unfiltered's",
        "2.2, 1.9, 1.5 and 2.4; 15.0, 15.2, 16.5 and 14.9",
        "times vary from run to run: today's ratios and their verdicts are in costs.md",
    ));
    Ok(exhibit)
}

/// Seconds without a texture, unfiltered, filtered and with 16 samples.
fn times(staged: &StagedScene, task: &Task) -> Result<[f64; 4], Halted> {
    let base = &staged.material.base;
    let flat = Arc::new(NormalMap::new(1, 1, Wrap::Repeat, vec![[0.0, 0.0, 1.0, 1.0]]));
    let ready = |method: &str, map| -> Result<Box<dyn Prefiltered>, Halted> {
        let method = method::build(method).expect("a method of the program's own");
        method.prefilter(map, base, &Silent).map_err(|_| Halted)
    };
    let unfiltered = ready("unfiltered", &staged.map)?;
    let (plain, filtered) = (ready("unfiltered", &flat)?, ready("fournier", &staged.map)?);
    let time = |map: &dyn Prefiltered, spp: u32| -> Result<f64, Halted> {
        let sampler = PixelSampler::new(spp);
        let mut fastest = f64::INFINITY;
        for _ in 0..TIMES {
            let start = Instant::now();
            render(&staged.view, map, &sampler, task.seed, 0, &|| task.progress.cancelled())?;
            fastest = fastest.min(start.elapsed().as_secs_f64());
        }
        Ok(fastest)
    };
    Ok([
        time(plain.as_ref(), 1)?,
        time(unfiltered.as_ref(), 1)?,
        time(filtered.as_ref(), 1)?,
        time(unfiltered.as_ref(), 16)?,
    ])
}
