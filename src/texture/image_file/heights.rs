//! Height maps from image files.

use std::path::Path;

use super::samples::Samples;
use super::{ImageError, Loaded};
use crate::texture::{HeightMap, Wrap};

/// How a file is read as a height map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightReading {
    /// Height of a full sample (white, 255, 65535 or 1.0) above a zero one, in units of a texel's side.
    pub height_scale: f64,
    /// What lies beyond the edge.
    pub wrap: Wrap,
}

impl Default for HeightReading {
    fn default() -> Self {
        Self { height_scale: 8.0, wrap: Wrap::Repeat }
    }
}

/// Reads a height map: F = `height_scale` · (sample / full sample). Of a colour image the luma counts,
/// 0.2126 R + 0.7152 G + 0.0722 B (ITU-R BT.709).
///
/// # Errors
/// An [`ImageError`] if the file is not a readable image with finite samples.
pub fn read_height_map(
    path: impl AsRef<Path>,
    reading: &HeightReading,
) -> Result<Loaded<HeightMap>, ImageError> {
    let samples = Samples::read(path.as_ref())?;
    let unit = reading.height_scale / f64::from(samples.depth.full());
    let values: Vec<f64> = samples.pixels.iter().map(|&p| unit * luma(p)).collect();
    let mut notes = vec![samples.note];
    let coloured = samples.pixels.iter().filter(|[r, g, b]| r != g || g != b).count();
    if coloured > 0 {
        notes.push(format!("{coloured} pixels have a colour: their luma is the height"));
    }
    let map = HeightMap::new(samples.width, samples.height, reading.wrap, values);
    Ok(Loaded { map, notes })
}

/// A grey sample exactly as it is; the luma of another.
fn luma([r, g, b]: [f32; 3]) -> f64 {
    if r == g && g == b {
        return r.into();
    }
    0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
}
