//! Figure 4: a teapot with an anisotropic NDF at three distances, and with normals that do not follow it.

use std::sync::Arc;

use super::common::{ALL, anisotropic, maps, mean, pictures, shot, synthesis, view, with_diffuse};
use crate::evidence::{Claim, Exhibit, Halted, Panel, Row, Table, Task};
use crate::lobe::NdfImage;
use crate::method::kautz::Synthesised;
use crate::render::{Camera, Film, View, direction};
use crate::surface::{Shape, teapot};

/// The row.
pub const ROW: Row = Row {
    name: "kautz-f4",
    title: "A teapot with an anisotropic distribution at three distances, and with uniformly distributed normals",
    parts: &[],
    parameters: &[],
    secs: 6.0,
    make,
};

/// Distances of the camera from the teapot's middle; its body reaches to 0.6.
const DISTANCES: [f64; 3] = [5.0, 2.4, 1.3];
const PIXELS: [usize; 2] = [240, 180];
/// Lattice cells a scene unit: about a pixel each from furthest away.
const CELLS: u32 = 64;
const SPP: u32 = 4;

fn seen(shape: &Shape, distance: f64) -> View {
    let [width, height] = PIXELS;
    let camera = Camera::orbiting(distance, 22.0, -70.0, 22.0, width, height);
    view(camera, shape.clone(), direction(50.0, -50.0))
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let teapot = Shape::Patches(teapot()).tiled(1.0, 1.0);
    let of = synthesis(anisotropic(), CELLS, task.seed);
    let even = NdfImage::from_fn(64, |_| 1.0).expect("a disc has density");
    let uniform = synthesis(even, CELLS, task.seed);
    let ndf = with_diffuse(&of.ndf);
    let bumps = Synthesised::new(Arc::clone(&of), ALL).shaded_by(Arc::clone(&ndf));
    let wrong = Synthesised::new(uniform, ALL).shaded_by(Arc::clone(&ndf));
    let smooth = Synthesised::new(Arc::clone(&of), 0.0).shaded_by(ndf);
    let mut panels = vec![];
    let head = [
        "distance",
        "normals",
        "mean radiance of that without bumps",
        "correlation with that without bumps",
    ];
    let caption =
        "Pictures beside the same without bumps, both averaged over blocks of 12 × 12 pixels.";
    let mut table = Table::new("looks", caption, &head);
    let mut found = vec![];
    for distance in DISTANCES {
        let view = seen(&teapot, distance);
        let bare = shot(&view, &smooth, SPP, task)?;
        for (label, ndf) in [("of the NDF", &bumps), ("uniform", &wrong)] {
            let film = shot(&view, ndf, SPP, task)?;
            let (brightness, alike) = (mean(&film) / mean(&bare), correlation(&film, &bare));
            table.push(vec![distance.into(), label.into(), brightness.into(), alike.into()]);
            found.push((brightness, alike));
            if label == "of the NDF" || distance == DISTANCES[2] {
                let name = format!("{}-{distance}", label.replace(' ', "-"));
                let label = format!("normals {label}, distance {distance}");
                panels.push(Panel::new(&name, label, Arc::new(film)));
            }
        }
    }
    let mut exhibit = ROW.exhibit();
    exhibit.claims = claims(&found);
    exhibit.tables = vec![table];
    exhibit.figures = vec![
        maps("ndf", "The distribution on the (x, y) map.", &[("NDF", &of.ndf)]),
        pictures(
            "teapots",
            "A teapot at three distances, and at the nearest with uniform normals.",
            panels,
        ),
    ];
    exhibit.remarks = vec![
        "Uniform is read as even over the (x, y) map. The paper's NDF and cameras are not printed."
            .into(),
    ];
    Ok(exhibit)
}

fn claims(found: &[(f64, f64)]) -> Vec<Claim> {
    let [own, uniform] = [found[4], found[5]];
    let far = found[0];
    vec![
        Claim::shown(
            "correlation with the teapot without bumps, furthest away",
            "no bumps from far away (§5.1)",
            far.1,
            "above 0.99",
            far.1 > 0.99,
        ),
        Claim::shown(
            "the same at the nearest, normals of the NDF and uniform normals",
            "what happens if the normals are distributed uniformly and not according to the NDF (§6)",
            format!("{:.2}, {:.2}", own.1, uniform.1),
            "uniform normals keep less of the look: below the NDF's by 0.1 or more",
            uniform.1 < own.1 - 0.1,
        ),
        Claim::shown(
            "mean radiance at the nearest, of that without bumps",
            "the shading is consistent when displayed at different distances (abstract)",
            own.0,
            "within 10 % of 1",
            (own.0 - 1.0).abs() <= 0.1,
        )
        .because(
            "bumps that follow the NDF are shaded by it once more: the look widens; kautz-z has that, and a reading that keeps \
             the look",
        ),
        Claim::not_applicable(
            "likeness to Figure 4",
            "pictures",
            "its NDF and cameras are not printed",
        ),
    ]
}

/// Pearson's correlation of two films averaged over blocks.
fn correlation(a: &Film, b: &Film) -> f64 {
    const BLOCK: usize = 12;
    let blocks = |film: &Film| -> Vec<f64> {
        let (across, down) = (film.width() / BLOCK, film.height() / BLOCK);
        (0..across * down)
            .map(|k| {
                let (x, y) = (k % across * BLOCK, k / across * BLOCK);
                let pixel =
                    |p: usize| film.pixels()[(y + p / BLOCK) * film.width() + x + p % BLOCK];
                (0..BLOCK * BLOCK).map(|p| f64::from(pixel(p))).sum::<f64>()
            })
            .collect()
    };
    let (a, b) = (blocks(a), blocks(b));
    let n = a.len() as f64;
    let [ma, mb] = [&a, &b].map(|v| v.iter().sum::<f64>() / n);
    let covariance = |u: &[f64], mu: f64, v: &[f64], mv: f64| -> f64 {
        u.iter().zip(v).map(|(x, y)| (x - mu) * (y - mv)).sum()
    };
    covariance(&a, ma, &b, mb) / (covariance(&a, ma, &a, ma) * covariance(&b, mb, &b, mb)).sqrt()
}
