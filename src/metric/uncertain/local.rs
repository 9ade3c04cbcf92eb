//! Metrics of neighbourhoods under a reference's noise.
//!
//! What such a metric is under noise has no short formula, so it is tried: each pixel of the reference is moved by one
//! standard error up or down, as a hash of its number and value says, and the field of the metric's local values is taken of this
//! reference, and of the one moved the other way. Half the difference of the two fields is what noise does to first
//! order; what their mean is above the field itself is its bias. Noise that is the same for two distant places is
//! none, so the variance of the mean is the sum, over blocks of [`BLOCK`] pixels a side, of the squares of the sums of
//! half the difference in each.
//!
//! # How rough that is
//! The standard error of n blocks scatters by about 1/√(2n) of itself: 13 % for 30
//! blocks, which an image of 160 × 120 has; and what crosses the border between blocks is not seen, which makes it a
//! little too small or large. The bias has a standard error of its own, which is of the second order.

use super::Uncertain;
use crate::metric::{Field, LocalMeasure, Viewing};
use crate::render::{Film, stream};

/// Pixels along a side of a block: more than a neighbourhood's.
const BLOCK: usize = 24;

/// What the hash of a pixel's number begins with.
const SEED: u64 = 0x006e_6f69_7365;

/// Value, bias and standard error of the mean of a metric's local values.
pub(in crate::metric) fn local(
    field: LocalMeasure,
    test: &Film,
    reference: &Film,
    variance: &[f64],
) -> Option<Uncertain> {
    let against = |reference: &Film| {
        field(std::slice::from_ref(test), std::slice::from_ref(reference), &Viewing::default())
    };
    let of = |sign: f64| against(&moved(reference, variance, SEED, sign));
    let (measured, (up, down)) =
        rayon::join(|| against(reference), || rayon::join(|| of(1.0), || of(-1.0)));
    let (measured, up, down) = (measured?, up?, down?);
    let value = measured.mean();
    let bias = 0.5 * (up.mean() + down.mean()) - value;
    let odd: Vec<f64> = up.values.iter().zip(&down.values).map(|(u, d)| 0.5 * (u - d)).collect();
    let scatter = block_scatter(&Field { width: measured.width, values: odd });
    Some(Uncertain { value, bias, error: scatter.sqrt() / measured.values.len() as f64 })
}

/// Pairs of noisy references for a metric that has no local values.
const PAIRS: u64 = 2;

/// Value, bias and standard error of a metric that has no local values: from [`PAIRS`] pairs of noisy references, the
/// root mean square of half their differences. Of two pairs that scatters by half of itself: an order of size.
pub(in crate::metric) fn whole(
    value: fn(&[Film], &[Film], &Viewing) -> Option<f64>,
    test: &Film,
    reference: &Film,
    variance: &[f64],
) -> Option<Uncertain> {
    let against = |reference: &Film| {
        value(std::slice::from_ref(test), std::slice::from_ref(reference), &Viewing::default())
    };
    let measured = against(reference)?;
    let (mut bias, mut scatter) = (0.0, 0.0);
    for pair in 0..PAIRS {
        let of = |sign: f64| against(&moved(reference, variance, SEED + pair, sign));
        let (up, down) = rayon::join(|| of(1.0), || of(-1.0));
        let (up, down) = (up?, down?);
        bias += (0.5 * (up + down) - measured) / PAIRS as f64;
        scatter += 0.25 * (up - down) * (up - down) / PAIRS as f64;
    }
    Some(Uncertain { value: measured, bias, error: scatter.sqrt() })
}

/// The reference with every pixel moved by a standard error, up or down as the hash of its number and value says, or the
/// other way.
fn moved(reference: &Film, variance: &[f64], seed: u64, sign: f64) -> Film {
    let way = |pixel: usize| {
        let bits = u64::from(reference.pixels()[pixel].to_bits());
        if stream(seed ^ bits, 0, pixel).count_ones().is_multiple_of(2) { sign } else { -sign }
    };
    let pixels = reference.pixels().iter().zip(variance).enumerate();
    let pixels = pixels.map(|(i, (r, v))| (f64::from(*r) + way(i) * v.max(0.0).sqrt()) as f32);
    Film::new(reference.width(), reference.height(), pixels.collect())
}

/// The sum of the squares of the sums in blocks.
fn block_scatter(field: &Field) -> f64 {
    let rows: Vec<&[f64]> = field.values.chunks_exact(field.width.max(1)).collect();
    let band = |rows: &[&[f64]]| {
        let sum = |from: usize| {
            let to = (from + BLOCK).min(field.width);
            rows.iter().map(|row| row[from..to].iter().sum::<f64>()).sum::<f64>()
        };
        (0..field.width).step_by(BLOCK).map(|from| sum(from) * sum(from)).sum::<f64>()
    };
    rows.chunks(BLOCK).map(band).sum()
}
