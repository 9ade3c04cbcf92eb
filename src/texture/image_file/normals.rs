//! Normal maps from image files.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::samples::{Depth, Samples};
use super::{ImageError, Loaded};
use crate::texture::{NormalMap, Texel, Wrap};

/// Which way along v a normal leans where green is bright.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Green {
    /// Up the picture (the OpenGL convention).
    #[default]
    Up,
    /// Down the picture (the DirectX convention).
    Down,
}

/// Which whole number stands for 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Zero {
    /// The middle of the range, 127.5 or 32767.5, which no file can store: c = 2·b/255 − 1. A flat
    /// texel stored as (128, 128, 255) then leans by a slope of 0.004.
    ///
    /// The default, since maps that were photographed or computed and then rounded have no preference:
    /// in those looked at, 127 and 128 are about equally frequent and means are nearer to 127.5.
    #[default]
    Middle,
    /// 128 or 32768: c = (b − 128)/127, held to −1. Right for maps drawn by hand on a ground of
    /// (128, 128, 255).
    Above,
}

/// How a file is read as a normal map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NormalReading {
    /// Which way green points.
    pub green: Green,
    /// Which number is 0.
    pub zero: Zero,
    /// What lies beyond the edge.
    pub wrap: Wrap,
}

/// Reads a normal map: red, green and blue are x, y and z, from −1 to 1.
///
/// Normals need not be of unit length; they are brought to it, and the notes say how many were off by
/// more than rounding explains. Where blue is 0 or below all over the map, it holds two channels, and z
/// is √(1 − x² − y²). Floating-point samples are 2c − 1 like the others, unless some are below −0.01: then
/// they are the normals themselves. All weights are 1.
///
/// # Errors
/// An [`ImageError`] if the file is not a readable colour image with finite samples.
pub fn read_normal_map(
    path: impl AsRef<Path>,
    reading: &NormalReading,
) -> Result<Loaded<NormalMap>, ImageError> {
    let path = path.as_ref();
    let samples = Samples::read(path)?;
    if samples.grey {
        return Err(ImageError::Grey { path: path.to_owned() });
    }
    let code = Code::of(&samples, reading.zero);
    let mut notes = vec![samples.note];
    notes.extend(code.note());
    let mut normals: Vec<[f32; 3]> =
        samples.pixels.iter().map(|p| p.map(|c| code.decode(c))).collect();
    if normals.iter().all(|n| n[2] <= code.step) && normals.iter().all(|n| n[2] == normals[0][2]) {
        normals.iter_mut().for_each(|n| n[2] = (1.0 - n[0] * n[0] - n[1] * n[1]).max(0.0).sqrt());
        notes.push("blue is empty: z is found from x and y".into());
    } else {
        notes.extend(lengths_note(&normals, code.step));
    }
    if reading.zero == Zero::Middle {
        notes.extend(flat_note(&samples.pixels, samples.depth));
    }
    let sign = if reading.green == Green::Up { 1.0 } else { -1.0 };
    let texels: Vec<Texel> = normals.iter().map(|&[x, y, z]| [x, sign * y, z, 1.0]).collect();
    let map = NormalMap::new(samples.width, samples.height, reading.wrap, texels);
    if map.below_horizon() > 0 {
        let (count, all) = (map.below_horizon(), map.texels().len());
        notes.push(format!("{count} of {all} normals are below the horizon or all but on it"));
    }
    Ok(Loaded { map, notes })
}

/// How samples stand for numbers from −1 to 1.
struct Code {
    zero: f32,
    scale: f32,
    /// The distance between neighbouring numbers.
    step: f32,
    signed: bool,
}

impl Code {
    fn of(samples: &Samples, zero: Zero) -> Self {
        let signed = samples.depth == Depth::Float
            && samples.pixels.iter().any(|p| p.iter().any(|&c| c < -0.01));
        let half = samples.depth.full() / 2.0;
        let (zero, scale) = match (samples.depth, zero) {
            _ if signed => (0.0, 1.0),
            (Depth::Float, _) | (_, Zero::Middle) => (half, half),
            (_, Zero::Above) => (half + 0.5, half - 0.5),
        };
        // A half float near 1 is good to 2⁻¹¹, and 2c − 1 doubles that.
        let step = if samples.depth == Depth::Float { 1.0 / 1024.0 } else { 1.0 / scale };
        Self { zero, scale, step, signed }
    }

    fn decode(&self, sample: f32) -> f32 {
        let value = (sample - self.zero) / self.scale;
        if self.signed { value } else { value.max(-1.0) }
    }

    fn note(&self) -> Option<String> {
        self.signed.then(|| "samples below 0: they are the normals themselves, not 2c − 1".into())
    }
}

/// How many lengths are further from 1 than half a step in each of three channels can bring them.
fn lengths_note(normals: &[[f32; 3]], step: f32) -> Option<String> {
    let rounding = 3f32.sqrt() * step / 2.0;
    let (mut off, mut least, mut most) = (0, f32::INFINITY, 0f32);
    for [x, y, z] in normals {
        let length = (x * x + y * y + z * z).sqrt();
        off += usize::from((length - 1.0).abs() > 1.01 * rounding);
        (least, most) = (least.min(length), most.max(length));
    }
    let all = normals.len();
    let none = normals.iter().filter(|n| **n == [0.0; 3]).count();
    let flat =
        if none > 0 { format!("; {none} have no direction and are flat") } else { String::new() };
    (off > 0).then(|| {
        format!(
            "{off} of {all} normals are not of unit length beyond rounding (from {least:.3} to \
             {most:.3}) and were brought to it{flat}"
        )
    })
}

/// Whether much of the map is what a paint program calls flat.
fn flat_note(pixels: &[[f32; 3]], depth: Depth) -> Option<String> {
    let above = (depth.full() / 2.0).ceil();
    let drawn = pixels.iter().filter(|p| **p == [above, above, depth.full()]).count();
    (depth != Depth::Float && drawn * 20 > pixels.len()).then(|| {
        format!(
            "{drawn} of {} pixels are ({above}, {above}, {}): if that is meant to be flat, read with \
             zero = \"above\"",
            pixels.len(),
            depth.full()
        )
    })
}
