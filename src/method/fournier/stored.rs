//! A pyramid of peaks as bytes.
//!
//! All numbers are little-endian: the number of levels above the map (u32); level by level its width,
//! height and number of peaks (u32 each), where each cell's peaks begin and where the last's end (u32),
//! the peaks (amplitude, direction x, y, z, exponent: f32 each), and, where horizons are kept, the mean
//! slopes of all peaks' and then all their deviations (towards −x, +x, −y, +y: f32 each).

use super::lookup::StoredLevel;
use super::{MOST_PEAKS, widest_range};
use crate::lobe::{Horizon, PhongPeak};
use crate::method::Damaged;
use crate::texture::{NormalMap, level_sizes};

/// Numbers of a peak.
const PER_PEAK: usize = 5;
/// The largest gap of a direction's squared length to 1: rounding to single precision.
const ROUNDING: f32 = 1e-5;

/// A pyramid from bytes.
#[derive(Debug)]
pub(super) struct Stored {
    /// Levels 1 and up.
    pub levels: Vec<StoredLevel>,
    /// Level by level a horizon for each peak, or nothing.
    pub horizons: Vec<Vec<Horizon>>,
}

/// The levels as bytes, with their horizons if there are any.
pub(super) fn to_bytes(levels: &[StoredLevel], horizons: &[Vec<Horizon>]) -> Vec<u8> {
    let mut bytes = Vec::new();
    bytes.extend((levels.len() as u32).to_le_bytes());
    for (k, level) in levels.iter().enumerate() {
        for number in [level.width, level.height, level.peaks.len()] {
            bytes.extend((number as u32).to_le_bytes());
        }
        level.starts.iter().for_each(|start| bytes.extend(start.to_le_bytes()));
        let peak = |p: &PhongPeak| {
            let [x, y, z] = p.direction;
            [p.amplitude, x, y, z, p.exponent]
        };
        push_rows(&mut bytes, level.peaks.iter().map(peak));
        if let Some(horizons) = horizons.get(k) {
            push_rows(&mut bytes, horizons.iter().map(|horizon| horizon.mean));
            push_rows(&mut bytes, horizons.iter().map(|horizon| horizon.deviation));
        }
    }
    bytes
}

/// The levels that [`to_bytes`] wrote for this map and base exponent, `shadowed` or without horizons.
///
/// # Errors
/// [`Damaged`] if the bytes are too few or too many, or hold what no such pyramid has.
pub(super) fn from_bytes(
    map: &NormalMap,
    exponent: f64,
    shadowed: bool,
    bytes: &[u8],
) -> Result<Stored, Damaged> {
    let mut rest = Reader(bytes);
    let sizes = level_sizes(map.width(), map.height());
    if rest.number()? as usize != sizes.len() - 1 {
        return damaged("its levels are not those of the map");
    }
    let mut stored = Stored { levels: Vec::new(), horizons: Vec::new() };
    for &size in &sizes[1..] {
        let level = level(&mut rest, size, exponent)?;
        if shadowed {
            stored.horizons.push(horizons(&mut rest, level.peaks.len())?);
        }
        stored.levels.push(level);
    }
    if rest.0.is_empty() { Ok(stored) } else { damaged("it goes on after its last level") }
}

fn horizons(rest: &mut Reader, count: usize) -> Result<Vec<Horizon>, Damaged> {
    let numbers = |row: [[u8; 4]; 4]| row.map(f32::from_le_bytes);
    let mean: Vec<[f32; 4]> = rest.rows::<4>(count)?.map(numbers).collect();
    let deviation = rest.rows::<4>(count)?.map(numbers);
    let horizons: Vec<Horizon> = mean
        .into_iter()
        .zip(deviation)
        .map(|(mean, deviation)| Horizon { mean, deviation })
        .collect();
    let usable = |horizon: &Horizon| {
        horizon.mean.iter().chain(&horizon.deviation).all(|s| s.is_finite() && *s >= 0.0)
    };
    if horizons.iter().all(usable) { Ok(horizons) } else { damaged("one of its horizons is none") }
}

fn level(rest: &mut Reader, size: (usize, usize), exponent: f64) -> Result<StoredLevel, Damaged> {
    let [width, height, count] = [rest.number()?, rest.number()?, rest.number()?];
    if (width as usize, height as usize) != size {
        return damaged("a level's size is not that of the map's");
    }
    let starts: Vec<u32> =
        rest.rows::<1>(size.0 * size.1 + 1)?.map(|[word]| u32::from_le_bytes(word)).collect();
    let in_order =
        |pair: &[u32]| pair[1].checked_sub(pair[0]).is_some_and(|n| n as usize <= MOST_PEAKS);
    if starts[0] != 0 || starts.last() != Some(&count) || !starts.windows(2).all(in_order) {
        return damaged("its cells do not follow each other");
    }
    let peaks: Vec<PhongPeak> = rest.rows::<PER_PEAK>(count as usize)?.map(peak).collect();
    if !peaks.iter().all(|peak| usable(peak, exponent)) {
        return damaged("one of its peaks is none");
    }
    Ok(StoredLevel { width: size.0, height: size.1, starts, peaks })
}

fn peak(row: [[u8; 4]; PER_PEAK]) -> PhongPeak {
    let [amplitude, x, y, z, exponent] = row.map(f32::from_le_bytes);
    PhongPeak { amplitude, direction: [x, y, z], exponent }
}

fn usable(peak: &PhongPeak, exponent: f64) -> bool {
    let [x, y, z] = peak.direction;
    let gap = x * x + y * y + z * z - 1.0;
    peak.amplitude.is_finite()
        && peak.amplitude >= 0.0
        && gap.abs() <= ROUNDING
        && widest_range(exponent).contains(&peak.exponent)
}

fn damaged<T>(what: &str) -> Result<T, Damaged> {
    Err(Damaged(what.to_owned()))
}

/// Appends rows of numbers.
fn push_rows<const N: usize>(bytes: &mut Vec<u8>, rows: impl Iterator<Item = [f32; N]>) {
    rows.for_each(|row| row.iter().for_each(|number| bytes.extend(number.to_le_bytes())));
}

/// Bytes not yet read.
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn number(&mut self) -> Result<u32, Damaged> {
        let mut one = self.rows::<1>(1)?;
        Ok(one.next().map_or(0, |[word]| u32::from_le_bytes(word)))
    }

    /// `count` rows of `N` words of four bytes.
    fn rows<const N: usize>(
        &mut self,
        count: usize,
    ) -> Result<impl Iterator<Item = [[u8; 4]; N]> + use<'a, N>, Damaged> {
        let length = count.checked_mul(4 * N);
        let Some((taken, rest)) = length.and_then(|length| self.0.split_at_checked(length)) else {
            return damaged("it ends too soon");
        };
        self.0 = rest;
        let word = |row: &[u8], k: usize| std::array::from_fn(|i| row[4 * k + i]);
        Ok(taken.chunks_exact(4 * N).map(move |row| std::array::from_fn(|k| word(row, k))))
    }
}
