//! Figure 1: a sphere at four levels of detail, from one NDF.

use std::sync::Arc;

use super::common::{ALL, anisotropic, apart, maps, pictures, shot, synthesis, view, with_diffuse};
use crate::evidence::{Claim, Exhibit, Halted, Panel, Row, Table, Task};
use crate::lobe::{MultipleSurface, SampledLobe};
use crate::method::Prefiltered;
use crate::method::kautz::Synthesised;
use crate::render::{Camera, View, direction};
use crate::surface::{Shape, Sphere};
use crate::texture::Footprint;

/// The row.
pub const ROW: Row = Row {
    name: "kautz-f1",
    title: "A sphere at four levels of detail, bumps and shading from one distribution of normals",
    parts: &[],
    parameters: &[],
    secs: 2.0,
    make,
};

/// Distances of the camera from the middle of the sphere of radius 1.
const DISTANCES: [f64; 4] = [8.0, 3.0, 1.6, 1.15];
const PIXELS: usize = 176;
/// Lattice cells a tile of about a unit: less than a pixel each from furthest away.
const CELLS: u32 = 96;
/// Samples a pixel: edges are to be smooth.
const SPP: u32 = 4;

fn seen(distance: f64) -> View {
    let camera = Camera::orbiting(distance, 20.0, -90.0, 18.0, PIXELS, PIXELS);
    view(camera, Shape::Sphere(Sphere::new()).tiled(1.0, 1.0), direction(38.0, -75.0))
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let synthesis = synthesis(anisotropic(), CELLS, task.seed);
    let ndf = with_diffuse(&synthesis.ndf);
    let bumps = Synthesised::new(Arc::clone(&synthesis), ALL).shaded_by(Arc::clone(&ndf));
    let smooth = Smooth(SampledLobe::new(
        Arc::clone(&ndf),
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        1.0,
        ndf.slope_covariance(),
    ));
    let head = [
        "distance",
        "octaves at the middle",
        "differs from the sphere without bumps, RMS over mean",
    ];
    let mut table = Table::new("levels", "What is seen at each distance.", &head);
    let (mut panels, mut found) = (vec![], vec![]);
    for distance in DISTANCES {
        let view = seen(distance);
        let film = shot(&view, &bumps, SPP, task)?;
        let bare = shot(&view, &smooth, SPP, task)?;
        let octaves = octaves(&view, &synthesis);
        let differs = apart(&film, &bare);
        found.push((octaves, differs));
        table.push(vec![distance.into(), octaves.into(), differs.into()]);
        let label = format!("distance {distance}");
        panels.push(
            Panel::new(&format!("at-{distance}"), label, Arc::new(film))
                .remarked(format!("{octaves:.1} octaves")),
        );
    }
    let mut exhibit = ROW.exhibit();
    exhibit.claims = claims(&found);
    exhibit.tables = vec![table];
    exhibit.figures = vec![
        maps("ndf", "The distribution on the (x, y) map.", &[("NDF", &synthesis.ndf)]),
        pictures("sphere", "The sphere, from far to near, under one light.", panels),
    ];
    exhibit.remarks = vec![
        "The paper's distribution, object and camera are not printed. Octaves are chosen by what a pixel covers, which is \
         distance where a surface faces the eye; at the sphere's rim there are fewer. Shading has a diffuse part in the \
         NDF (§6), bumps have none."
            .into(),
    ];
    Ok(exhibit)
}

fn claims(found: &[(f64, f64)]) -> Vec<Claim> {
    let rising = found.windows(2).all(|pair| pair[1].0 > pair[0].0);
    vec![
        Claim::at_most(
            "difference of the furthest sphere from one without bumps, RMS over mean",
            "no individual bumps should be visible (§3.3)",
            0.02,
            found[0].1,
        ),
        Claim::shown(
            "octaves at the middle from far to near",
            "the closer you get the more octaves should be added (§3.3)",
            found.iter().map(|f| format!("{:.1}", f.0)).collect::<Vec<_>>().join(", "),
            "rising",
            rising,
        ),
        Claim::shown(
            "difference of the nearest sphere from one without bumps, RMS over mean",
            "more detail will become visible (§3.3)",
            found[found.len() - 1].1,
            "above 0.1",
            found[found.len() - 1].1 > 0.1,
        ),
        Claim::not_applicable(
            "likeness to Figure 1",
            "pictures",
            "its distribution and camera are not printed",
        ),
    ]
}

/// Octaves that the middle pixel shows.
fn octaves(view: &View, synthesis: &crate::synthesis::Synthesis) -> f64 {
    let middle = PIXELS as f64 / 2.0;
    let Some(at) = view.footprint(middle, middle) else { return 0.0 };
    let length = |[u, v]: [f32; 2]| f64::from(u * u + v * v).sqrt();
    // As a sample of a pixel of several.
    let along = length(at.along_x).max(length(at.along_y)) / f64::from(SPP).sqrt();
    synthesis.octaves_seen(along, ALL)
}

/// The NDF about the surface's own normal.
struct Smooth(SampledLobe);

impl Prefiltered for Smooth {
    fn bytes(&self) -> usize {
        0
    }

    fn lobes_at(&self, _: &Footprint) -> MultipleSurface {
        [self.0.clone()].into_iter().collect()
    }
}
