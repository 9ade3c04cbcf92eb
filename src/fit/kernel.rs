//! The two loops that take the time: spreading normals, and the normal equations of a fit.
//!
//! Both run over chunks of directions without branches inside, so that they become vector code. Where
//! the processor has AVX2 the same source is compiled for it as well; as nothing is fused or
//! reordered, both versions give the same bits.

use super::Peak;
use crate::geometry::elementary::{exp64, ln64};
use crate::geometry::{Frame, Vec3};

/// Directions handled at a time: their derivatives for a dozen peaks stay in the first-level cache.
pub(super) const CHUNK: usize = 32;
/// Partial sums of a dot product: a fixed number, so that its order of additions is fixed.
const LANES: usize = 4;
/// Derivatives of a peak: by amplitude, by direction along its two tangents, by ln n.
pub(super) const PER_PEAK: usize = 4;
/// A peak is skipped where its value is below e^−40 of its amplitude: less than rounding.
const NEGLIGIBLE: f64 = -40.0;
/// Below this cosine the slope of a peak is held: for n < 1 it has a cusp at its horizon.
const HORIZON: f64 = 1e-4;

/// Compiles a function for AVX2 too, and picks the version at run time.
macro_rules! for_avx2_too {
    ($(#[$doc:meta])* $name:ident => $body:ident($($argument:ident: $kind:ty),*)) => {
        $(#[$doc])*
        pub(super) fn $name($($argument: $kind),*) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx2")]
                fn wide($($argument: $kind),*) {
                    $body($($argument),*);
                }
                if std::arch::is_x86_feature_detected!("avx2") {
                    // SAFETY: the processor has the feature, as just detected.
                    return unsafe { wide($($argument),*) };
                }
            }
            $body($($argument),*);
        }
    };
}

type Lanes = [f64; CHUNK];

for_avx2_too! {
    /// Adds the peaks to `out`, direction by direction, in order.
    spread_chunk => spread(axes: [&Lanes; 3], peaks: &[Peak], out: &mut Lanes)
}

#[inline(always)]
fn spread([x, y, z]: [&Lanes; 3], peaks: &[Peak], out: &mut Lanes) {
    for peak in peaks {
        let (d, n) = (peak.direction, peak.exponent);
        let mut cosine = [0.0; CHUNK];
        for i in 0..CHUNK {
            cosine[i] = x[i] * d.x + y[i] * d.y + z[i] * d.z;
        }
        if largest(&cosine) <= cutoff(n) {
            continue;
        }
        for i in 0..CHUNK {
            let value = peak.amplitude * exp64(n * ln64(cosine[i].max(f64::MIN_POSITIVE)));
            out[i] += if cosine[i] > 0.0 { value } else { 0.0 };
        }
    }
}

/// The cosine below which a peak of exponent n is negligible; 0 where it reaches to its horizon.
#[inline(always)]
fn cutoff(n: f64) -> f64 {
    if n > 0.0 { exp64(NEGLIGIBLE / n) } else { 0.0 }
}

#[inline(always)]
fn largest(values: &Lanes) -> f64 {
    let mut best = [f64::MIN; LANES];
    for four in values.chunks_exact(LANES) {
        for lane in 0..LANES {
            best[lane] = if four[lane] > best[lane] { four[lane] } else { best[lane] };
        }
    }
    best[0].max(best[1]).max(best[2].max(best[3]))
}

/// A peak and two directions across it: the chart in which it moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chart {
    peak: Peak,
    e1: Vec3,
    e2: Vec3,
    cutoff: f64,
}

impl Chart {
    pub(super) fn about(peak: Peak) -> Self {
        let Frame { tangent: e1, bitangent: e2, .. } = Frame::about(peak.direction);
        Self { peak, e1, e2, cutoff: cutoff(peak.exponent) }
    }
}

/// The derivatives of a peak over a chunk.
pub(super) type Columns = [Lanes; PER_PEAK];

/// Adds the peak's values over a chunk to `values` and writes its derivatives; `false`, and nothing
/// written, where it is negligible.
#[inline(always)]
pub(super) fn derive(
    [x, y, z]: [&Lanes; 3],
    chart: &Chart,
    values: &mut Lanes,
    columns: &mut Columns,
) -> bool {
    let Chart { peak: Peak { amplitude, direction: d, exponent: n }, e1, e2, cutoff } = *chart;
    let mut cosine = [0.0; CHUNK];
    for i in 0..CHUNK {
        cosine[i] = x[i] * d.x + y[i] * d.y + z[i] * d.z;
    }
    if largest(&cosine) <= cutoff {
        return false;
    }
    let [by_amplitude, by_u, by_v, by_ln_n] = columns;
    for i in 0..CHUNK {
        let logarithm = ln64(cosine[i].max(f64::MIN_POSITIVE));
        let power = if cosine[i] > 0.0 { exp64(n * logarithm) } else { 0.0 };
        let value = amplitude * power;
        let slope = n * value / cosine[i].max(HORIZON);
        by_amplitude[i] = power;
        by_u[i] = slope * (x[i] * e1.x + y[i] * e1.y + z[i] * e1.z);
        by_v[i] = slope * (x[i] * e2.x + y[i] * e2.y + z[i] * e2.z);
        by_ln_n[i] = n * value * logarithm;
        values[i] += value;
    }
    true
}

/// Sums of the normal equations of `count` unknowns, row by row; of the matrix the lower blocks only.
#[derive(Clone, Debug)]
pub(super) struct Sums {
    pub squares: f64,
    pub gradient: Vec<f64>,
    pub gram: Vec<f64>,
    columns: Vec<Columns>,
    active: Vec<usize>,
}

impl Sums {
    pub(super) fn new(peaks: usize) -> Self {
        let count = PER_PEAK * peaks;
        Self {
            squares: 0.0,
            gradient: vec![0.0; count],
            gram: vec![0.0; count * count],
            columns: vec![[[0.0; CHUNK]; PER_PEAK]; peaks],
            active: Vec::with_capacity(peaks),
        }
    }
}

for_avx2_too! {
    /// Adds a chunk of directions, at which the distribution has `target`, to the normal equations.
    accumulate_chunk =>
        accumulate(axes: [&Lanes; 3], target: &Lanes, charts: &[Chart], sums: &mut Sums)
}

#[inline(always)]
fn accumulate(axes: [&Lanes; 3], target: &Lanes, charts: &[Chart], sums: &mut Sums) {
    let Sums { squares, gradient, gram, columns, active } = sums;
    let mut residual = target.map(|t| -t);
    active.clear();
    for (p, chart) in charts.iter().enumerate() {
        if derive(axes, chart, &mut residual, &mut columns[p]) {
            active.push(p);
        }
    }
    *squares += dot(&residual, &residual);
    let count = gradient.len();
    for (at, &p) in active.iter().enumerate() {
        let rows = &columns[p];
        for (i, row) in rows.iter().enumerate() {
            gradient[PER_PEAK * p + i] += dot(row, &residual);
        }
        for &q in &active[..=at] {
            for i in [0, 2] {
                let block = products([&rows[i], &rows[i + 1]], &columns[q]);
                for (di, line) in block.iter().enumerate() {
                    let start = (PER_PEAK * p + i + di) * count + PER_PEAK * q;
                    for (sum, add) in gram[start..start + PER_PEAK].iter_mut().zip(line) {
                        *sum += add;
                    }
                }
            }
        }
    }
}

#[inline(always)]
fn dot(a: &Lanes, b: &Lanes) -> f64 {
    let mut sum = [0.0; LANES];
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for lane in 0..LANES {
            sum[lane] += a[lane] * b[lane];
        }
    }
    (sum[0] + sum[1]) + (sum[2] + sum[3])
}

/// Dot products of two columns with four: as many sums as there are vector registers.
#[inline(always)]
fn products(a: [&Lanes; 2], b: &Columns) -> [[f64; PER_PEAK]; 2] {
    let mut sums = [[[0.0; LANES]; PER_PEAK]; 2];
    for at in (0..CHUNK).step_by(LANES) {
        for i in 0..2 {
            for j in 0..PER_PEAK {
                for lane in 0..LANES {
                    sums[i][j][lane] += a[i][at + lane] * b[j][at + lane];
                }
            }
        }
    }
    sums.map(|row| row.map(|s| (s[0] + s[1]) + (s[2] + s[3])))
}
