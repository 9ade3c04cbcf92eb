//! §6: what bump mapping costs.

use std::sync::Arc;
use std::time::Instant;

use super::common::{SIDE, table};
use crate::evidence::{Claim, Exhibit, Halted, Row, Table, Task};
use crate::geometry::{Kernel, vectorised};
use crate::lobe::round::{Phong, RoundLobe};
use crate::lobe::vector::tan_squared;
use crate::lobe::{BaseLobe, MultipleSurface, Shading};
use crate::method::{BATCH, Batch, Lane, Prefiltered, Silent, brute_force};
use crate::texture::{Footprint, Interpolation, NormalMap};

/// The row.
pub const ROW: Row = Row {
    name: "blinn-t",
    title: "What bump mapping costs beside Phong shading and colour texture mapping",
    parts: &[],
    parameters: &[],
    secs: 1.0,
    make,
};

const BATCHES: usize = 1500;
const EXPONENT: f64 = 20.0;
const BASE: BaseLobe = BaseLobe::BlinnPhong { exponent: EXPONENT };

fn make(task: &Task) -> Result<Exhibit, Halted> {
    let map = table("grid", SIDE, &[], task.seed);
    let of =
        |map: &Arc<NormalMap>| brute_force().prefilter(map, &BASE, &Silent).map_err(|_| Halted);
    let as_interpolated =
        |interpolation| Arc::new((*map).clone().with_interpolation(interpolation));
    let printed = as_interpolated(Interpolation::Table);
    let spline = as_interpolated(Interpolation::BSpline);
    let colour = Coloured { texture: Arc::clone(&map) };
    let ways: [(&str, Box<dyn Prefiltered>); 5] = [
        ("Phong shading, no texture", Box::new(Bare)),
        ("colour texture", Box::new(colour)),
        ("bumps, normals interpolated", of(&map)?),
        ("bumps, slopes of the paper's table", of(&printed)?),
        ("bumps, B-spline", of(&spline)?),
    ];
    let mut times = Vec::new();
    let caption = "Time to look up and shade a sample, one thread, and of that the part of the paper's three ways.";
    let mut of_ways = Table::new("times", caption, &["way", "ns a sample", "of Phong shading"]);
    for (name, way) in &ways {
        task.go_on()?;
        times.push(nanoseconds(way.as_ref()));
        of_ways.push(vec![
            (*name).into(),
            times[times.len() - 1].into(),
            (times[times.len() - 1] / times[0]).into(),
        ]);
    }
    let mut exhibit = ROW.exhibit();
    let why = "a table of slopes made once needs one lookup where the paper differences its table with four at every \
               sample, and the highlight's power weighs as much as a lookup";
    let claim = |what: &str, paper: f64, here: f64| {
        let within = here <= 1.5 * paper && here >= paper / 1.5;
        Claim::shown(what, paper, here, "within a factor of 1.5", within).because(why)
    };
    exhibit.timed.claims = vec![
        claim("time of bump mapping, of Phong shading's", 4.0, times[3] / times[0]),
        claim("time of bump mapping, of colour texture mapping's", 2.0, times[3] / times[1]),
    ];
    exhibit.timed.tables = vec![of_ways];
    exhibit.claims = vec![Claim::not_applicable(
        "time of bump mapping, of Phong shading's and of colour texture mapping's",
        "about 4 and about 2; pictures took from 3 to 7 minutes",
        "times vary from run to run: today's ratios and their verdicts are in costs.md",
    )];
    Ok(exhibit)
}

/// The surface's own normal, without a lookup.
struct Bare;

impl Prefiltered for Bare {
    fn bytes(&self) -> usize {
        0
    }

    fn needs_footprint(&self) -> bool {
        false
    }

    fn lobes_at(&self, _: &Footprint) -> MultipleSurface {
        let mut surface = MultipleSurface::new();
        surface.add(BASE.about([0.0, 0.0, 1.0], 1.0), 1.0);
        surface
    }

    fn shade(&self, batch: &Batch, _: Shading, radiance: &mut Lane) {
        vectorised(Shade { batch, radiance });
    }
}

/// The kernel: the lobe about the surface's own normal.
struct Shade<'a> {
    batch: &'a Batch,
    radiance: &'a mut Lane,
}

impl Kernel for Shade<'_> {
    #[inline(always)]
    fn run(self) {
        let phong = Phong::new(EXPONENT);
        for i in 0..BATCH {
            let half = self.batch.half(i);
            let density = phong.density(tan_squared([0.0, 0.0, 1.0], half));
            let sent = self.batch.irradiance[i] * density;
            self.radiance[i] = if half[2] > 0.0 { sent } else { 0.0 };
        }
    }
}

/// Phong shading times a texture's first number, which stands for a colour's.
struct Coloured {
    texture: Arc<NormalMap>,
}

impl Prefiltered for Coloured {
    fn bytes(&self) -> usize {
        0
    }

    fn needs_footprint(&self) -> bool {
        false
    }

    fn lobes_at(&self, at: &Footprint) -> MultipleSurface {
        Bare.lobes_at(at)
    }

    fn shade(&self, batch: &Batch, _: Shading, radiance: &mut Lane) {
        vectorised(ShadeColoured { shade: Shade { batch, radiance }, texture: &self.texture });
    }
}

/// The kernel of that.
struct ShadeColoured<'a> {
    shade: Shade<'a>,
    texture: &'a NormalMap,
}

impl Kernel for ShadeColoured<'_> {
    #[inline(always)]
    fn run(self) {
        let mut colours = [[0.0; BATCH]; 4];
        let Shade { batch, radiance } = self.shade;
        self.texture.sample_lanes::<BATCH, true>(&batch.u, &batch.v, &mut colours);
        Shade { batch, radiance: &mut *radiance }.run();
        for i in 0..BATCH {
            radiance[i] *= 0.5 + 0.5 * colours[0][i];
        }
    }
}

/// Nanoseconds a sample, the least of five runs.
fn nanoseconds(way: &dyn Prefiltered) -> f64 {
    let mut batch = Batch { len: BATCH, ..Batch::default() };
    for i in 0..BATCH {
        let part = (i as f32 + 0.5) / BATCH as f32;
        (batch.u[i], batch.v[i]) = (part, (7.0 * part).fract());
        (batch.half[0][i], batch.half[1][i]) = (0.4 * part - 0.2, 0.3 * (5.0 * part).fract());
        batch.irradiance[i] = 1.0;
    }
    let mut radiance = [0.0; BATCH];
    let mut run = || {
        let start = Instant::now();
        for _ in 0..BATCHES {
            way.shade(std::hint::black_box(&batch), Shading::Ndf, &mut radiance);
            std::hint::black_box(&radiance);
        }
        start.elapsed().as_secs_f64()
    };
    let least = (0..5).map(|_| run()).fold(f64::INFINITY, f64::min);
    1e9 * least / (BATCHES * BATCH) as f64
}
