//! The renderer: samples, batches, films.

use rayon::prelude::*;

use super::view::Needs;
use super::{Film, PixelSampler, View, stream};
use crate::method::{BATCH, Batch, Prefiltered};

/// A rendering was stopped before its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

/// Renders `map` in `view`: every pixel is the mean of its samples' radiance (a box filter, one pixel
/// wide). Each sample's footprint is the pixel's, shrunk by √spp a side.
///
/// Rows run in parallel; a pixel's samples add up in double precision in the sampler's order, so the
/// film is the same at any thread count.
///
/// # Errors
/// [`Cancelled`] if `cancelled` says so; it is asked before each row.
pub fn render(
    view: &View,
    map: &dyn Prefiltered,
    sampler: &PixelSampler,
    seed: u64,
    replicate: u32,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<Film, Cancelled> {
    let (width, height) = (view.camera.width(), view.camera.height());
    let mut pixels = vec![0.0f32; width * height];
    pixels.par_chunks_mut(width).enumerate().try_for_each(|(row, line)| {
        if cancelled() {
            return Err(Cancelled);
        }
        let streams = (0..width).map(|column| stream(seed, replicate, row * width + column));
        render_row(view, map, sampler, row, streams, line);
        Ok(())
    })?;
    Ok(Film::new(width, height, pixels))
}

/// Renders one row of pixels, batch by batch.
fn render_row(
    view: &View,
    map: &dyn Prefiltered,
    sampler: &PixelSampler,
    row: usize,
    streams: impl Iterator<Item = u64>,
    line: &mut [f32],
) {
    let spp = f64::from(sampler.spp());
    let needs = Needs { footprint: map.needs_footprint().then(|| 1.0 / spp.sqrt()) };
    let mut sums = vec![0.0f64; line.len()];
    let mut samples = Samples::default();
    let mut flush = |samples: &mut Samples| {
        view.fill(&samples.x, &samples.y, samples.len, needs, &mut samples.batch);
        map.shade(&samples.batch, view.shading, &mut samples.radiance);
        for i in 0..samples.len {
            sums[samples.column[i]] += f64::from(samples.radiance[i]);
        }
        samples.len = 0;
    };
    for (column, stream) in streams.enumerate() {
        for [dx, dy] in sampler.positions(stream) {
            samples.push(column, column as f64 + dx, row as f64 + dy);
            if samples.len == BATCH {
                flush(&mut samples);
            }
        }
    }
    flush(&mut samples);
    for (pixel, sum) in line.iter_mut().zip(sums) {
        *pixel = (sum / spp) as f32;
    }
}

/// Samples waiting to be shaded together.
struct Samples {
    len: usize,
    x: [f64; BATCH],
    y: [f64; BATCH],
    column: [usize; BATCH],
    batch: Batch,
    radiance: [f32; BATCH],
}

impl Default for Samples {
    fn default() -> Self {
        Self {
            len: 0,
            x: [0.0; BATCH],
            y: [0.0; BATCH],
            column: [0; BATCH],
            batch: Batch::default(),
            radiance: [0.0; BATCH],
        }
    }
}

impl Samples {
    fn push(&mut self, column: usize, x: f64, y: f64) {
        self.column[self.len] = column;
        self.x[self.len] = x;
        self.y[self.len] = y;
        self.len += 1;
    }
}
