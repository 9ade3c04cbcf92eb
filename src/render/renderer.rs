//! The renderer: samples, batches, films.

use rayon::prelude::*;

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

/// Renders one row of pixels, batch by batch. Samples of one pixel follow one another; a batch may
/// hold samples of many pixels, or a part of one pixel's.
fn render_row(
    view: &View,
    map: &dyn Prefiltered,
    sampler: &PixelSampler,
    row: usize,
    streams: impl Iterator<Item = u64>,
    line: &mut [f32],
) {
    let spp = sampler.spp() as usize;
    let spacing = map.needs_footprint().then(|| 1.0 / f64::from(sampler.spp()).sqrt());
    let mut sums = vec![0.0f64; line.len()];
    let mut waiting = Waiting::default();
    for (column, stream) in streams.enumerate() {
        let corner = [column as f64, row as f64];
        let mut first = 0;
        while first < spp {
            let lanes = waiting.len..(waiting.len + spp - first).min(BATCH);
            let (x, y) = (&mut waiting.x[lanes.clone()], &mut waiting.y[lanes.clone()]);
            sampler.fill(stream, first, corner, x, y);
            first += lanes.len();
            waiting.len = lanes.end;
            waiting.runs.push((column, lanes.end));
            if waiting.len == BATCH {
                waiting.shade(view, map, spacing, &mut sums);
            }
        }
    }
    waiting.shade(view, map, spacing, &mut sums);
    for (pixel, sum) in line.iter_mut().zip(sums) {
        *pixel = (sum / spp as f64) as f32;
    }
}

/// Samples waiting to be shaded together.
struct Waiting {
    len: usize,
    x: [f64; BATCH],
    y: [f64; BATCH],
    /// Runs of samples of one pixel: its column, and the lane after the run's last.
    runs: Vec<(usize, usize)>,
    batch: Batch,
    radiance: [f32; BATCH],
}

impl Default for Waiting {
    fn default() -> Self {
        Self {
            len: 0,
            x: [0.0; BATCH],
            y: [0.0; BATCH],
            runs: Vec::with_capacity(BATCH),
            batch: Batch::default(),
            radiance: [0.0; BATCH],
        }
    }
}

impl Waiting {
    /// Shades them and adds each pixel's radiance to its sum.
    fn shade(
        &mut self,
        view: &View,
        map: &dyn Prefiltered,
        spacing: Option<f64>,
        sums: &mut [f64],
    ) {
        let directions = map.needs_directions();
        view.fill(&self.x, &self.y, self.len, spacing, directions, &mut self.batch);
        map.shade(&self.batch, view.shading, &mut self.radiance);
        let mut start = 0;
        for (column, end) in self.runs.drain(..) {
            sums[column] += total(&self.radiance[start..end]);
            start = end;
        }
        self.len = 0;
    }
}

/// The sum of a run, in eight interleaved partial sums: a fixed order that need not wait for one
/// addition to begin the next.
fn total(run: &[f32]) -> f64 {
    let mut partial = [0.0f64; 8];
    let chunks = run.chunks_exact(8);
    let rest = chunks.remainder();
    for chunk in chunks {
        for (sum, &value) in partial.iter_mut().zip(chunk) {
            *sum += f64::from(value);
        }
    }
    for (sum, &value) in partial.iter_mut().zip(rest) {
        *sum += f64::from(value);
    }
    let [a, b, c, d, e, f, g, h] = partial;
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}
