//! The cost of the three ways to shade.

use std::sync::Arc;
use std::time::Instant;

use super::super::{Claim, Quantity, Table};
use super::common::prefiltered;
use super::s::WAYS;
use crate::lobe::{BaseLobe, Shading};
use crate::method::{BATCH, Batch, Method, Prefiltered};
use crate::texture::NormalMap;

/// Batches to time.
const BATCHES: usize = 3000;

/// How long each way takes to build and to shade.
pub fn times(
    methods: &[Box<dyn Method>; WAYS.len()],
    map: &Arc<NormalMap>,
    base: &BaseLobe,
) -> Table {
    let mut table = Table::new(
        "times",
        "Time to build the pyramid of the first map, and to look up and shade a sample, one thread.",
        &["way", "bytes a cell", "build, ms", "shade, ns a sample"],
    );
    let cells = 341.0; // above a map of 32 × 32
    for ((label, _, _), method) in WAYS.iter().zip(methods) {
        let start = Instant::now();
        let built = prefiltered(method.as_ref(), map, base);
        let secs = start.elapsed().as_secs_f64();
        table.push(vec![
            (*label).into(),
            (built.bytes() as f64 / cells).into(),
            (1e3 * secs).into(),
            shading(built.as_ref()).into(),
        ]);
    }
    table
}

/// Nanoseconds a sample, the least of five runs.
fn shading(built: &dyn Prefiltered) -> f64 {
    let mut batch = Batch { len: BATCH, ..Batch::default() };
    for i in 0..BATCH {
        let part = (i as f32 + 0.5) / BATCH as f32;
        (batch.u[i], batch.v[i]) = (part, (7.0 * part).fract());
        for axis in [0, 3] {
            batch.jacobian[axis][i] = 0.2 * part;
        }
        (batch.half[0][i], batch.half[1][i]) = (0.4 * part - 0.2, 0.3 * (5.0 * part).fract());
        batch.irradiance[i] = 1.0;
    }
    let mut radiance = [0.0; BATCH];
    let run = |radiance: &mut [f32; BATCH]| {
        let start = Instant::now();
        for _ in 0..BATCHES {
            built.shade(std::hint::black_box(&batch), Shading::Ndf, radiance);
            std::hint::black_box(&radiance);
        }
        start.elapsed().as_secs_f64()
    };
    let least = (0..5).map(|_| run(&mut radiance)).fold(f64::INFINITY, f64::min);
    1e9 * least / (BATCHES * BATCH) as f64
}

/// "By far, computationally the least expensive."
pub fn cheapest(times: &Table) -> Claim {
    let of = |row: usize| match times.rows[row][3] {
        Quantity::Number(ns) => ns,
        _ => f64::NAN,
    };
    let next = (1..times.rows.len()).map(of).fold(f64::INFINITY, f64::min);
    Claim::shown(
        "time of a sample with the next cheapest way, over the unnormalised one's",
        "unnormalised is by far the least expensive (§6)",
        next / of(0),
        "above 1.5",
        next > 1.5 * of(0),
    )
    .because(
        "a tenth number or a projection is a few operations beside the eight texels of a trilinear lookup, and an \
         exponential is not slow any more",
    )
}
