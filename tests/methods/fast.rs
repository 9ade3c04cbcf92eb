//! Fournier's fast mode, held to the paper's: how far each is from the true distributions.

use std::f64::consts::TAU;
use std::sync::Arc;

use wrinkle::geometry::{HemisphereGrid, Vec3};
use wrinkle::lobe::BaseLobe;
use wrinkle::method::fournier::{Fournier, Mode};
use wrinkle::method::{Method, Prefiltered, Silent};
use wrinkle::metric::total_variation;
use wrinkle::parameter::Values;
use wrinkle::pattern;
use wrinkle::texture::{NormalMap, level_sizes, tap_weights};

use super::fixture::centres;

const EXPONENT: f64 = 60.0;

/// A pattern with its defaults.
fn map(name: &str, side: usize) -> Arc<NormalMap> {
    let entry = pattern::find(name).expect("a registered pattern");
    Arc::new((entry.build)(side, side, &Values::defaults(entry.parameters), 1).normals)
}

fn prefiltered(mode: Mode, map: &Arc<NormalMap>) -> Box<dyn Prefiltered> {
    let method = Fournier { mode, ..Fournier::default() };
    method.prefilter(map, &BaseLobe::BlinnPhong { exponent: EXPONENT }, &Silent).unwrap()
}

/// The density of the normals under each cell of a level, direction by direction.
fn truths(grid: &HemisphereGrid, map: &NormalMap, level: usize) -> Vec<Vec<f32>> {
    let (width, height) = level_sizes(map.width(), map.height())[level];
    let lobe = |n: Vec3, h: Vec3| (EXPONENT + 2.0) / TAU * h.dot(&n).max(0.0).powf(EXPONENT);
    let cells = (0..height).flat_map(|j| (0..width).map(move |i| (i, j)));
    let truth = |(i, j): (usize, usize)| {
        let mut density = vec![0.0; grid.samples().len()];
        for (y, down) in tap_weights(map.height(), height, j) {
            for (x, across) in tap_weights(map.width(), width, i) {
                let [nx, ny, nz, w] = map.texel(x, y).map(f64::from);
                for (sum, sample) in density.iter_mut().zip(grid.samples()) {
                    *sum += across * down * w * lobe(Vec3::new(nx, ny, nz), sample.direction);
                }
            }
        }
        density.into_iter().map(|d| d as f32).collect()
    };
    cells.map(truth).collect()
}

/// The mean over a level's cells of the distance to the truth.
fn distance(
    grid: &HemisphereGrid,
    filtered: &dyn Prefiltered,
    map: &NormalMap,
    level: usize,
    truths: &[Vec<f32>],
) -> f64 {
    let cells = centres(map, level);
    let apart = cells.iter().zip(truths).map(|(at, truth)| {
        let surface = filtered.lobes_at(at);
        let h = grid.samples().iter().map(|s| s.direction);
        let density: Vec<f32> =
            h.map(|d| surface.density([d.x, d.y, d.z].map(|c| c as f32))).collect();
        total_variation(grid, &density, truth)
    });
    apart.sum::<f64>() / cells.len() as f64
}

#[test]
fn the_fast_mode_is_nearly_as_close_to_the_truth_as_the_papers() {
    let grid = HemisphereGrid::new(36, 144);
    for name in ["waves", "gaussian", "bricks", "twill", "hemispheres"] {
        let map = map(name, 32);
        let [paper, fast] = [Mode::Paper, Mode::Fast].map(|mode| prefiltered(mode, &map));
        for level in 2..=5 {
            let truths = truths(&grid, &map, level);
            let [paper, fast] =
                [&paper, &fast].map(|f| distance(&grid, f.as_ref(), &map, level, &truths));
            println!("{name} {level}: paper {paper:.4}, fast {fast:.4}, {:.2}", fast / paper);
        }
    }
}
