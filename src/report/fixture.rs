//! A made-up experiment for tests: brute-force curves that fall as 1/√N, flat filters, smooth
//! highlights. Nothing here was measured.

use std::sync::Arc;

use crate::experiment::results::*;
use crate::experiment::sequence::sequences;
use crate::experiment::spec::{MotionKind, MotionSpec};
use crate::geometry::HemisphereGrid;
use crate::lobe::BaseLobe;
use crate::method::Truth;
use crate::metric;
use crate::render::Film;
use crate::texture::Lookup;

const SIDE: usize = 72;
pub const TEXTURES: [&str; 3] = ["bricks", "denim", "waves"];
pub const SCALES: [f64; 4] = [1.0, 4.0, 16.0, 64.0];

/// (label, name, normalised, error at one texel a pixel, growth with the scale's logarithm)
const METHODS: [(&str, &str, bool, f64, f64); 6] = [
    ("unfiltered", "unfiltered", true, 0.02, 0.060),
    ("averaged", "averaged", true, 0.018, 0.030),
    ("fournier", "fournier", true, 0.010, 0.004),
    ("schilling", "schilling", true, 0.012, 0.006),
    ("schilling-printed", "schilling", false, 0.030, 0.020),
    ("kautz", "kautz", true, 0.014, 0.003),
];

/// Three textures at four scales by six methods; `kautz` refuses waves.
pub fn results() -> Results {
    let scenes = TEXTURES
        .iter()
        .enumerate()
        .flat_map(|(t, texture)| SCALES.iter().map(move |scale| scene(t, texture, *scale)));
    Results {
        name: "quick".into(),
        title: "Five papers on one page".into(),
        question: "Which filter keeps the look of a bump map best, and where?".into(),
        spec: "name = \"quick\"\nseed = 7\n".into(),
        seed: 7,
        methods: METHODS.iter().map(method).collect(),
        textures: TEXTURES.iter().map(|name| texture(name)).collect(),
        scenes: scenes.collect(),
        motion: None,
        sequences: Vec::new(),
    }
}

/// The same things in six frames: the first texture and scale, its highlight wandering, each method's ripple with
/// or against it.
pub fn moving() -> Results {
    let mut results = results();
    let still = results.scenes[0].clone();
    let frame = |number: u32| {
        let mut scene = still.clone();
        scene.key.frame = Some(number + 1);
        scene.slug = format!("{}-f{:03}", still.slug, number + 1);
        let moved = |film: &Film, by: usize| {
            let turned = film.pixels().chunks(SIDE).flat_map(|row| {
                row.iter().cycle().skip(SIDE - by).take(SIDE).copied().collect::<Vec<_>>()
            });
            Arc::new(Film::new(SIDE, SIDE, turned.collect()))
        };
        scene.reference.film = moved(&scene.reference.film, number as usize);
        for (i, trial) in scene.trials.iter_mut().enumerate() {
            trial.film = moved(&trial.film, number as usize * (1 + i % 3) / 2);
        }
        scene
    };
    results.scenes = (0..6).map(frame).collect();
    results.motion =
        Some(MotionSpec { kind: MotionKind::Rotate { degrees: 30.0 }, frames: 6, fps: 10 });
    results.sequences = sequences(&results.scenes);
    results
}

/// Costs to go with [`results`].
pub fn costs() -> Costs {
    let results = results();
    let trials = results.scenes.iter().flat_map(|scene| {
        scene.trials.iter().map(|t| TrialCost {
            scene: scene.slug.clone(),
            method: t.method.clone(),
            spp: t.spp,
            ns_per_pixel: 50.0 * f64::from(t.spp) * (1.0 + t.method.len() as f64 / 8.0),
        })
    });
    let prefilters = TEXTURES.iter().flat_map(|texture| {
        METHODS.iter().map(|m| PrefilterCost {
            texture: (*texture).into(),
            method: m.0.into(),
            lobe: "blinn-phong".into(),
            parameter: 50.0,
            secs: 0.01 * m.0.len() as f64,
            bytes_per_texel: 8.0,
        })
    });
    Costs {
        trials: trials.collect(),
        prefilters: prefilters.collect(),
        total_secs: 12.5,
        threads: 2,
    }
}

fn method(&(label, name, normalised, ..): &(&str, &str, bool, f64, f64)) -> MethodInfo {
    MethodInfo {
        label: label.into(),
        name: name.into(),
        source: "Author 1997, A Title, §3".into(),
        summary: "Keeps the mean slope and its covariance.".into(),
        formula: "one elliptical lobe, Σ = K + I/s".into(),
        limits: "one lobe: two separate highlights become one".into(),
        normalised,
        options: if normalised { vec![] } else { vec!["form = printed".into()] },
        lookup: Some(Lookup::Trilinear),
    }
}

fn texture(name: &str) -> TextureInfo {
    let rgb = (0..64 * 64).map(|i| [(i % 64 * 4) as u8, (i / 64 * 4) as u8, 230]).collect();
    TextureInfo {
        name: name.into(),
        description: format!("pattern {name}, height 0.2"),
        width: 256,
        height: 256,
        notes: vec![],
        picture: Some(Arc::new(Picture { width: 64, height: 64, rgb })),
    }
}

fn scene(t: usize, texture: &str, scale: f64) -> SceneResult {
    let film = Arc::new(highlight(t, 0.0, 0.0));
    let refused = |label: &str| label == "kautz" && texture == "waves";
    let trials = METHODS.iter().enumerate().filter(|(_, m)| !refused(m.0)).flat_map(|(i, m)| {
        let counts: &[u32] = if m.0 == "unfiltered" { &[1, 4, 16, 64, 256] } else { &[1] };
        counts.iter().map(move |spp| trial(i, t, *spp, scale))
    });
    SceneResult {
        key: key(texture, scale),
        slug: format!("{texture}-{scale}"),
        sequence: format!("{texture}-{scale}"),
        reference: Reference {
            variance: vec![0.0004 * 0.0004; film.pixels().len()],
            film,
            spp: 4096,
            rmse: 0.0004,
            mean_error: 0.0002,
            truth: Truth::Bumps,
            gap: 0.01,
        },
        trials: trials.collect(),
        refusals: METHODS.iter().filter(|m| refused(m.0)).map(|m| refusal(m.0)).collect(),
        probes: if scale == 16.0 && t == 0 { vec![probe()] } else { vec![] },
        budgets: Vec::new(),
    }
}

fn key(texture: &str, scale: f64) -> SceneKey {
    SceneKey {
        texture: texture.into(),
        surface: "sphere".into(),
        light: "directional".into(),
        lobe: "blinn-phong".into(),
        parameter: 50.0,
        shading: "ndf".into(),
        texels_per_pixel: scale,
        distance: scale * 2.5,
        elevation: 40.0,
        frame: None,
    }
}

fn refusal(label: &str) -> RefusalInfo {
    RefusalInfo {
        method: label.into(),
        reason: "its table of normals holds one distribution for the whole map".into(),
    }
}

fn trial(i: usize, t: usize, spp: u32, scale: f64) -> TrialResult {
    let (label, _, _, base, growth) = METHODS[i];
    // Each texture favours another filter.
    let favour = if i == 2 + t { 0.6 } else { 1.0 + 0.1 * ((i + t) % 3) as f64 };
    let error = favour * (base + growth * scale.log2()) / f64::from(spp).sqrt();
    let film = highlight(t, error as f32, i as f32 + f32::from(spp as u16));
    let measured = metric::scores(&film, &highlight(t, 0.0, 0.0));
    let [mut rmse, relmse, ssim] = ["rmse", "relmse", "ssim"].map(|name| {
        let value = measured.iter().find(|(metric, _)| *metric == name).unwrap().1;
        Score { metric: name.into(), value, interval: None }
    });
    // As wide as three digits show in the smallest.
    rmse.interval = Some([rmse.value - 2e-5, rmse.value + 2e-5]);
    TrialResult {
        method: label.into(),
        spp,
        film: Arc::new(film),
        scores: vec![rmse, relmse, ssim],
    }
}

/// A shaded ball with a broken highlight; `error` adds a ripple.
fn highlight(t: usize, error: f32, phase: f32) -> Film {
    let at = |i: usize| (i as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0;
    let pixel = |i: usize| {
        let (x, y) = (at(i % SIDE), at(i / SIDE));
        let inside = x * x + y * y < 0.9;
        let (dx, dy) = (x + 0.25, y + 0.3);
        let stretch = [1.0, 2.0, 4.0][t];
        let lobe = (-9.0 * (dx * dx * stretch + dy * dy / stretch)).exp();
        let ripple = error * 3.0 * (x * 23.0 + phase).sin() * (y * 19.0 - phase).cos();
        if inside { (lobe + 0.02 + ripple).max(0.0) } else { 0.0 }
    };
    Film::new(SIDE, SIDE, (0..SIDE * SIDE).map(pixel).collect())
}

fn probe() -> Probe {
    let truth = density(&[[0.35, 0.1], [-0.35, 0.1], [0.0, -0.4]], 60.0);
    let methods = METHODS.iter().enumerate().map(|(i, m)| ProbedMethod {
        method: m.0.into(),
        density: density(&[[0.3, 0.1], [-0.3, 0.1]], 8.0 * (1.0 + i as f64)),
        peaks: vec![
            Peak { axis: [0.3, 0.1, 0.9487], density: 4.0 },
            Peak { axis: [-0.3, 0.1, 0.9487], density: 4.0 },
        ],
        l1: 0.5 / (1.0 + i as f64),
        kl: Some(0.8 / (1.0 + i as f64)),
        wasserstein: Some(0.2 / (1.0 + i as f64)),
    });
    Probe { pixel: [30, 41], texels_across: 16.0, truth, methods: methods.collect() }
}

/// A mixture of Blinn-Phong lobes about the normals above these points of the disc.
fn density(centres: &[[f64; 2]], exponent: f64) -> Vec<f32> {
    let lobe = BaseLobe::BlinnPhong { exponent };
    let grid = HemisphereGrid::fournier();
    let value = |w: crate::geometry::Vec3| {
        let about = centres.iter().map(|[x, y]| {
            let cos = w.x * x + w.y * y + w.z * (1.0 - x * x - y * y).sqrt();
            if cos > 0.0 { lobe.density(1.0 / (cos * cos) - 1.0) } else { 0.0 }
        });
        about.sum::<f64>() / centres.len() as f64
    };
    grid.samples().iter().map(|s| value(s.direction) as f32).collect()
}
