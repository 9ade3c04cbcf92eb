//! Made-up evidence for tests and for the eye: every kind of drawing, and odd values. Nothing here was
//! measured.

use std::sync::Arc;

use crate::evidence::*;
use crate::geometry::HemisphereGrid;
use crate::lobe::{Shading, find_named, reflection};
use crate::render::Portrait;

/// A paper of six rows.
pub fn evidence() -> Evidence {
    Evidence {
        name: "fournier-1992".into(),
        title: "Fournier 1992, made again".into(),
        question: "What of the paper’s figures, tables and numbers comes out the same here?".into(),
        paper: "A. Fournier 1992, Filtering Normal Maps and Creating Multiple Surfaces, a technical report"
            .into(),
        spec: "title = \"Fournier 1992\"\nseed = 7\n".into(),
        seed: 7,
        exhibits: vec![fits(), pictures(), charts(), fields(), lobes(), photograph()],
        parts: vec![("cylinder".into(), "The cylinder on a plane".into())],
    }
}

/// Seconds by row.
pub fn secs() -> Vec<(String, f64)> {
    evidence().exhibits.iter().map(|e| (e.row.clone(), 1.5 * e.row.len() as f64)).collect()
}

fn fits() -> Exhibit {
    let velvet = |scale: f64| density("three-normals", scale);
    let original = velvet(1.0);
    let fit: Vec<f64> = original.iter().zip(density("silk", 0.02)).map(|(a, b)| a + b).collect();
    let residual = fit.iter().zip(&original).map(|(a, b)| b - a + 0.004).collect();
    let peaks: Vec<[f64; 3]> = vec![[0.6, 0.0, 0.8], [-0.6, 0.0, 0.8], [0.0, 0.0, 1.0]];
    let disc = |label: &str, remark: &str, density, peaks, own_scale| Disc {
        label: label.into(),
        remark: remark.into(),
        density,
        peaks,
        own_scale,
    };
    let discs = vec![
        disc("sphere, original", "1297 directions", original, vec![], false),
        disc("sphere, 7 peaks", "rms 3.1 %, maximum 4.4 %", fit, peaks, false),
        disc("residual", "", residual, vec![], true),
    ];
    Exhibit {
        row: "fournier-f3".into(),
        title: "Figure 3: distributions of normals and their fits".into(),
        claims: vec![
            Claim::count("fits of the sphere’s pyramid", 73, 73),
            Claim::count("of these with 7 peaks", 5, 9).because(
                "The optimiser here is another one: it stops later, and a fit that stops later needs fewer peaks.",
            ),
            Claim::at_most("rms of the residual, part of the original’s", "a few percent", 0.05, 0.031),
        ],
        figures: vec![Figure::new("fits", "Originals, fits and residuals at the top level.", Drawing::Discs(discs))],
        tables: vec![levels()],
        remarks: vec!["The weave of the denim is lost; a twill stands in.".into()],
        parts: vec!["cylinder".into()],
        timed: Timed {
            claims: vec![Claim::at_most("minutes to build the pyramid", "80", 80.0, 0.4)],
            tables: vec![levels()],
        },
    }
}

fn levels() -> Table {
    let mut table = Table::new("levels", "Fits by level", &["Level", "Cells", "Fits", "rms"]);
    table.push(vec!["32 × 32".into(), 1024usize.into(), 0usize.into(), f64::NAN.into()]);
    table.push(vec!["16 × 16".into(), 256usize.into(), 52usize.into(), 0.012_345.into()]);
    table.push(vec!["1 × 1".into(), 1usize.into(), 1usize.into(), 0.031.into()]);
    table
}

fn density(name: &str, scale: f64) -> Vec<f64> {
    let surface = find_named(name).unwrap().surface();
    let grid = HemisphereGrid::fournier();
    let at = |w: crate::geometry::Vec3| surface.density([w.x as f32, w.y as f32, w.z as f32]);
    grid.samples().iter().map(|s| scale * f64::from(at(s.direction))).collect()
}

fn pictures() -> Exhibit {
    let portrait = Portrait { spp: 4, ..Portrait::sphere(128, 128) };
    let film = |name: &str| Arc::new(portrait.of(find_named(name).unwrap().surface()));
    let panels = vec![
        Panel::new("supersampled", "supersampled", film("three-normals")).remarked("256 samples"),
        Panel::new("filtered", "filtered", film("anisotropic")).remarked("1 sample, RMSE 0.011"),
        Panel::new("unfiltered", "unfiltered", film("velvet")).remarked("1 sample, RMSE 0.09"),
    ];
    let images = Images { panels: panels.clone(), white: None, reference: Some(0), across: 3 };
    let alone = Images { panels, white: Some(0.5), reference: None, across: 2 };
    Exhibit {
        row: "fournier-f9".into(),
        title: "Figure 9: a sphere".into(),
        claims: vec![Claim::shown(
            "filtering comes closer than one sample",
            "seen in print",
            "0.12 of the error",
            "RMSE below half of the unfiltered one’s",
            true,
        )],
        figures: vec![
            Figure::new("spheres", "The sphere three ways.", Drawing::Images(images)),
            Figure::new("alone", "The same without errors.", Drawing::Images(alone)),
        ],
        ..Exhibit::default()
    }
}

fn charts() -> Exhibit {
    let curve = |label: &str, power: f64| Series {
        label: label.into(),
        points: (1..=7).map(|n| [f64::from(n), 0.5 * f64::from(n).powf(-power)]).collect(),
        joined: true,
    };
    let peaks = Chart {
        x: Axis::linear("peaks"),
        y: Axis::log("rms of the residual, part of the original’s"),
        series: vec![curve("hemisphere", 2.0), curve("cylinder", 1.2), curve("twill", 0.8)],
    };
    let at = |i: i32, turn: f64| f64::from(i).mul_add(turn, 0.1).fract();
    let cloud = |label: &str, turn: f64| Series {
        label: label.into(),
        points: (0..60).map(|i| [at(i, turn), at(i * i, 0.37) * turn - 0.2]).collect(),
        joined: false,
    };
    let line = Series { label: "y = x".into(), points: vec![[0.0, 0.0], [1.0, 1.0]], joined: true };
    let scatter = Chart {
        x: Axis::linear("slope measured"),
        y: Axis::linear("slope filtered"),
        series: vec![cloud("along x", 0.618), cloud("along y", 0.414), line],
    };
    Exhibit {
        row: "fournier-peaks".into(),
        title: "How many peaks are enough".into(),
        claims: vec![Claim::near("peaks for a hemisphere", 7.0, f64::NAN, 0.1)],
        figures: vec![
            Figure::new("peaks", "Error against peaks.", Drawing::Chart(peaks)),
            Figure::new("scatter", "Slopes.", Drawing::Chart(scatter)),
        ],
        ..Exhibit::default()
    }
}

fn fields() -> Exhibit {
    let field = |label: &str, f: &dyn Fn(f64, f64) -> f64| Field {
        label: label.into(),
        width: 32,
        values: (0..32 * 24)
            .map(|i| f(f64::from(i % 32) / 32.0, f64::from(i / 32) / 24.0))
            .collect(),
    };
    let left = field("horizon to the left", &|x, y| x * y);
    let right = field("horizon to the right", &|x, y| if x > 0.9 { f64::NAN } else { 0.5 - x * y });
    let positive = vec![left.clone(), field("heights", &|x, y| 0.2 + x * x + y)];
    Exhibit {
        row: "fournier-f12".into(),
        title: "Figure 12: horizon slopes at texels".into(),
        figures: vec![
            Figure::new("slopes", "Slopes of the horizon.", Drawing::Fields(vec![left, right])),
            Figure::new("heights", "Heights.", Drawing::Fields(positive)),
        ],
        ..Exhibit::default()
    }
}

fn lobes() -> Exhibit {
    let plot = |name: &str, azimuth: f64| {
        let surface = find_named(name).unwrap().surface();
        let reflection = |incidence: f64| Reflection {
            incidence,
            exits: reflection(&surface, Shading::Ndf, incidence, azimuth),
        };
        LobePlot {
            label: name.into(),
            azimuth,
            reflections: [0.0, 30.0, 60.0].map(reflection).into(),
        }
    };
    let plots = vec![plot("three-normals", 0.0), plot("three-normals", 90.0), plot("velvet", 0.0)];
    Exhibit {
        row: "fournier-brdf".into(),
        title: "The BRDF that a multiple surface implies".into(),
        figures: vec![Figure::new("lobes", "Reflection.", Drawing::Lobes(plots))],
        ..Exhibit::default()
    }
}

fn photograph() -> Exhibit {
    Exhibit {
        row: "fournier-f1".into(),
        title: "Figure 1: types of material".into(),
        claims: vec![Claim::not_applicable(
            "Figure 1",
            "photographs",
            "a photograph of real cloth",
        )],
        ..Exhibit::default()
    }
}
