//! Figure 5: the single-pass form, a mipmapped texture of indices, and the ringing it is said to have.

use std::sync::Arc;
use std::time::Instant;

use super::common::{apart, isotropic, maps, mean, pictures, shot, synthesis, view};
use crate::evidence::{
    Axis, Chart, Claim, Drawing, Exhibit, Figure, Halted, Panel, Row, Series, Table, Task,
};
use crate::lobe::{BaseLobe, MultipleSurface};
use crate::method::kautz::SinglePass;
use crate::method::{Prefiltered, Silent, brute_force};
use crate::render::{Camera, View, direction};
use crate::surface::{Shape, teapot_mesh};
use crate::synthesis::{Bits, Synthesis, octaves_for};
use crate::texture::Footprint;

/// The row.
pub const ROW: Row = Row {
    name: "kautz-f5",
    title: "A teapot of some 16,000 triangles with isotropic distributions, indices from a mipmapped texture of noise",
    parts: &[],
    parameters: &[],
    secs: 8.0,
    make,
};

const PIXELS: [usize; 2] = [280, 210];
/// Texels a side of the noise texture, a tile of one scene unit, and lattice cells of its first octave.
const TEXELS: usize = 256;
const CELLS: u32 = 8;
/// Cells along the side of each of 32 patches.
const MESH: usize = 16;
/// Entries of the one-dimensional texture that an isotropic NDF is stored in.
const ENTRIES: usize = 256;
/// Samples a pixel of pictures that alias no more.
const MANY: u32 = 64;

struct Pass {
    label: &'static str,
    bits: Bits,
    radial: Option<usize>,
}

const PASSES: [Pass; 4] = [
    Pass { label: "unrounded", bits: Bits::Float, radial: None },
    Pass { label: "16 bits", bits: Bits::Sixteen, radial: None },
    Pass { label: "8 bits", bits: Bits::Eight, radial: None },
    Pass { label: "unrounded, NDF of 256 entries", bits: Bits::Float, radial: Some(ENTRIES) },
];

fn seen(shape: &Shape) -> View {
    let camera = Camera::orbiting(4.6, 22.0, -70.0, 20.0, PIXELS[0], PIXELS[1]);
    view(camera, shape.clone(), direction(50.0, -50.0))
}

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let mesh = teapot_mesh(MESH);
    let triangles = mesh.triangles();
    let view = seen(&Shape::Mesh(mesh).tiled(1.0, 1.0));
    let mut exhibit = ROW.exhibit();
    let head = [
        "exponent of the NDF",
        "indices",
        "RMS difference from unrounded, over the mean",
        "its greatest, over the picture's greatest",
    ];
    let mut rounding =
        Table::new("rounding", "What rounding does to pictures of one sample a pixel.", &head);
    let (mut panels, mut found, mut looked) = (vec![], vec![], vec![]);
    for exponent in [12.0, 100.0] {
        let of = synthesis(isotropic(exponent), CELLS, task.seed);
        let passes = PASSES.map(|pass| pass.of(&of));
        let exact = shot(&view, &passes[0], 1, task)?;
        let greatest = exact.pixels().iter().fold(0.0f32, |m, p| m.max(*p));
        for (pass, built) in PASSES.iter().zip(&passes).skip(1) {
            let film = shot(&view, built, 1, task)?;
            let pairs = film.pixels().iter().zip(exact.pixels());
            let most = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max) / greatest;
            let rms = apart(&film, &exact);
            rounding.push(vec![
                exponent.into(),
                pass.label.into(),
                rms.into(),
                f64::from(most).into(),
            ]);
            found.push((rms, f64::from(most)));
            if pass.bits == Bits::Eight {
                let name = format!("eight-{exponent}");
                panels.push(Panel::new(
                    &name,
                    format!("8 bits, exponent {exponent}"),
                    Arc::new(film),
                ));
            }
        }
        looked.push(aliasing(&view, &of, &passes[0], task)?);
        let name = format!("unrounded-{exponent}");
        panels.push(Panel::new(&name, format!("unrounded, exponent {exponent}"), Arc::new(exact)));
        exhibit.timed.tables.push(times(&view, &passes, exponent, task)?);
    }
    exhibit.claims = claims(triangles, &found, &looked);
    exhibit.tables = vec![rounding, aliasing_table(&looked)];
    let ndfs = [isotropic(12.0), isotropic(100.0)];
    exhibit.figures = vec![
        maps(
            "ndfs",
            "Both distributions.",
            &[("exponent 12", &ndfs[0]), ("exponent 100", &ndfs[1])],
        ),
        pictures("teapots", "One sample a pixel, indices of 8 bits and unrounded.", panels),
        rings(&synthesis(isotropic(100.0), CELLS, task.seed)),
    ];
    exhibit.remarks = vec![
        "Rounded are the stored indices and again the filtered ones, which then look up the nearest entry of the table, as \
         between stages of such hardware. The paper suspects rounding and is \"not entirely sure\"."
            .into(),
    ];
    Ok(exhibit)
}

impl Pass {
    fn of(&self, synthesis: &Arc<Synthesis>) -> SinglePass {
        let octaves = octaves_for([TEXELS; 2], [CELLS; 2]);
        SinglePass::new(Arc::clone(synthesis), TEXELS, octaves, self.bits, self.radial)
    }
}

/// One sample a pixel beside many of its footprint: RMS over the mean, of the single pass, and of the same bumps as a
/// normal map of their own texels that is not filtered.
fn aliasing(
    view: &View,
    synthesis: &Arc<Synthesis>,
    pass: &SinglePass,
    task: &Task,
) -> Result<[f64; 2], Halted> {
    let octaves = octaves_for([TEXELS; 2], [CELLS; 2]);
    let map = Arc::new(synthesis.bake(TEXELS, TEXELS, octaves));
    let base = BaseLobe::BlinnPhong { exponent: 100.0 };
    let bare = brute_force().prefilter(&map, &base, &Silent).map_err(|_| Halted)?;
    let of = |bumps: &dyn Prefiltered| -> Result<f64, Halted> {
        Ok(apart(&shot(view, bumps, 1, task)?, &shot(view, &Whole(bumps), MANY, task)?))
    };
    Ok([of(pass)?, of(bare.as_ref())?])
}

/// Bumps whose many samples a pixel each have the footprint of the whole pixel: what they differ by is what aliases.
struct Whole<'a>(&'a dyn Prefiltered);

impl Prefiltered for Whole<'_> {
    fn bytes(&self) -> usize {
        self.0.bytes()
    }

    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        let side = f64::from(MANY).sqrt() as f32;
        let [along_x, along_y] = [at.along_x, at.along_y].map(|axis| axis.map(|c| c * side));
        self.0.lobes_at(&Footprint { along_x, along_y, ..*at })
    }
}

fn aliasing_table(looked: &[[f64; 2]]) -> Table {
    let caption = "One sample at a pixel's centre beside 64 spread over it, each filtered as widely: RMS over the mean.";
    let head = ["exponent of the NDF", "filtered indices", "an unfiltered normal map"];
    let mut table = Table::new("aliasing", caption, &head);
    for (exponent, [pass, bare]) in [12.0, 100.0].into_iter().zip(looked) {
        table.push(vec![exponent.into(), (*pass).into(), (*bare).into()]);
    }
    table
}

fn claims(triangles: usize, found: &[(f64, f64)], looked: &[[f64; 2]]) -> Vec<Claim> {
    // Of each exponent: 16 bits, 8 bits, the small texture.
    let of = |pass: usize| [found[pass].1, found[pass + 3].1];
    let ([_, sixteen], [_, eight], [_, radial]) = (of(0), of(1), of(2));
    vec![
        Claim::near("triangles of the teapot", 17_000.0, triangles as f64, 0.1),
        Claim::shown(
            "greatest difference that indices of 8 bits make, over the picture's greatest, exponent 100",
            "it is sometimes possible to see some ringing, probably due to quantization errors (§6)",
            eight,
            "above 1/100: steps that are seen",
            eight > 0.01,
        ),
        Claim::at_most(
            "the same of 16 bits",
            "it does not occur in the software renderings (§6)",
            0.01,
            sixteen,
        ),
        Claim::shown(
            "the same of an NDF stored in 256 entries over n·h, indices unrounded",
            "not suspected in print",
            radial,
            "below that of 8 bits: not the first cause",
            radial < eight,
        ),
        Claim::shown(
            "one sample beside 64, RMS over mean: filtered indices, and an unfiltered map, exponent 100",
            "almost aliasing free [...] the filtered indices are used for the lookup (§6)",
            format!("{:.3}, {:.3}", looked[1][0], looked[1][1]),
            "filtered indices leave less than half",
            looked[1][0] < 0.5 * looked[1][1],
        )
        .because(
            "a narrow distribution flashes on bumps that are only two pixels long; with a wide one, exponent 12, far less \
             is left",
        ),
        Claim::not_applicable(
            "frames a second",
            "about 30 on a GeForce 3",
            "times vary from run to run: they are in costs.md",
        ),
    ]
}

fn times(
    view: &View,
    passes: &[SinglePass; 4],
    exponent: f64,
    task: &Task,
) -> Result<Table, Halted> {
    let name = format!("frames-{exponent}");
    let caption = format!("Time of a frame of one sample a pixel, all cores, exponent {exponent}.");
    let mut table = Table::new(&name, caption, &["indices", "milliseconds a frame"]);
    for (pass, built) in PASSES.iter().zip(passes) {
        let start = Instant::now();
        mean(&shot(view, built, 1, task)?);
        table.push(vec![pass.label.into(), (1e3 * start.elapsed().as_secs_f64()).into()]);
    }
    Ok(table)
}

/// Radiance along a line across a bump, seen so near that indices of 8 bits step.
fn rings(synthesis: &Arc<Synthesis>) -> Figure {
    use crate::lobe::Spread;
    const STEPS: usize = 600;
    let series = PASSES[..3].iter().map(|pass| {
        let built = pass.of(synthesis);
        let at = |k: usize| {
            let u = 0.3 + 0.08 * k as f32 / STEPS as f32;
            let surface = built.lobes_at(&Footprint { u, v: 0.4, ..Footprint::default() });
            let radiance: f32 = surface.lobes().iter().map(|l| l.density([0.1, 0.0, 0.995])).sum();
            [f64::from(u), f64::from(radiance)]
        };
        Series { label: pass.label.into(), points: (0..STEPS).map(at).collect(), joined: true }
    });
    let chart = Chart {
        x: Axis::linear("u, tiles"),
        y: Axis::linear("D at one half vector"),
        series: series.collect(),
    };
    let caption = "Along a line of the surface, 20 texels of the noise long, exponent 100: what 8 bits leave of a smooth curve.";
    Figure::new("rings", caption, Drawing::Chart(chart))
}
