//! The least-squares problem of a fixed number of Phong peaks.

use argmin::core::{Error, Jacobian, Operator};
use nalgebra::{DMatrix, DVector};

use super::kernel::{CHUNK, Chart, PER_PEAK, Sums, accumulate_chunk, derive};
use super::{Directions, Distribution, LeastSquares, NormalEquations, Peak};
use crate::geometry::Frame;
use crate::geometry::elementary::{exp64, ln64};

/// Exponents stay in this range.
pub(super) const EXPONENTS: [f64; 2] = [1e-3, 1e4];
/// The longest step in ln n and in direction: what a linear model can be trusted for.
const LONGEST: f64 = 1.0;
/// Chunks between two questions whether the work is cancelled: about a millisecond.
const CHUNKS_UNASKED: usize = 128;

/// The axes of some directions, and the distribution there.
type Chunk<'a> = ([&'a [f64; CHUNK]; 3], [f64; CHUNK]);

/// Least squares between a distribution and Σ aᵢ max(0, ω·dᵢ)^nᵢ at some directions, in
/// units of the distribution's maximum.
///
/// The unknowns of a peak are steps from where it is: (δa, u, v, t) leads to amplitude a + δa, direction
/// normalise(d + u e₁ + v e₂) and exponent n eᵗ, with e₁, e₂ across d. A chart about the peak itself has
/// no pole to be singular at, and eᵗ no sign to go wrong. a ≥ 0 and 10⁻³ ≤ n ≤ 10⁴.
#[derive(Clone, Copy)]
pub struct PeakProblem<'a> {
    directions: &'a Directions,
    distribution: &'a Distribution,
    scale: f64,
    cancelled: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> PeakProblem<'a> {
    /// The problem for a distribution on these directions. Amplitudes of peaks are in units of its
    /// maximum; see [`PeakProblem::scale`].
    pub fn new(directions: &'a Directions, distribution: &'a Distribution) -> Self {
        let maximum = distribution.maximum();
        let scale = if maximum > 0.0 { maximum } else { 1.0 };
        Self { directions, distribution, scale, cancelled: &|| false }
    }

    /// The same problem, which gives up with an error once `cancelled` says so: asked every
    /// few thousand directions.
    pub fn unless(self, cancelled: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self { cancelled, ..self }
    }

    /// The unit of amplitudes: the distribution's maximum, or 1 if that is 0.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Runs over chunks of directions with the distribution there, in units of its maximum.
    fn chunks(&self) -> impl Iterator<Item = Result<Chunk<'a>, Error>> {
        let Self { directions, distribution, scale, cancelled } = *self;
        let padded = distribution.padded();
        (0..directions.chunks()).map(move |k| {
            if k % CHUNKS_UNASKED == 0 && cancelled() {
                return Err(Error::msg("cancelled"));
            }
            let target = std::array::from_fn(|i| padded[k * CHUNK + i] / scale);
            Ok((directions.chunk(k), target))
        })
    }
}

/// fit − distribution at every direction, and zeros to whole chunks.
impl Operator for PeakProblem<'_> {
    type Param = Vec<Peak>;
    type Output = DVector<f64>;

    fn apply(&self, peaks: &Vec<Peak>) -> Result<DVector<f64>, Error> {
        let charts: Vec<Chart> = peaks.iter().map(|&p| Chart::about(p)).collect();
        let mut columns = [[0.0; CHUNK]; PER_PEAK];
        let mut residuals = Vec::with_capacity(self.directions.chunks() * CHUNK);
        for chunk in self.chunks() {
            let (axes, target) = chunk?;
            let mut residual = target.map(|t| -t);
            for chart in &charts {
                derive(axes, chart, &mut residual, &mut columns);
            }
            residuals.extend(residual);
        }
        Ok(DVector::from_vec(residuals))
    }
}

/// Derivatives of the residuals by (δa, u, v, t) of each peak, at no step.
impl Jacobian for PeakProblem<'_> {
    type Param = Vec<Peak>;
    type Jacobian = DMatrix<f64>;

    fn jacobian(&self, peaks: &Vec<Peak>) -> Result<DMatrix<f64>, Error> {
        let rows = self.directions.chunks() * CHUNK;
        let mut jacobian = DMatrix::zeros(rows, PER_PEAK * peaks.len());
        for (p, &peak) in peaks.iter().enumerate() {
            let chart = Chart::about(peak);
            for (k, chunk) in self.chunks().enumerate() {
                let (axes, _) = chunk?;
                let mut columns = [[0.0; CHUNK]; PER_PEAK];
                derive(axes, &chart, &mut [0.0; CHUNK], &mut columns);
                for (c, column) in columns.iter().enumerate() {
                    for (i, &value) in column.iter().enumerate() {
                        jacobian[(k * CHUNK + i, PER_PEAK * p + c)] = value;
                    }
                }
            }
        }
        Ok(jacobian)
    }
}

impl LeastSquares<Vec<Peak>> for PeakProblem<'_> {
    /// Accumulated chunk by chunk: the Jacobian is never stored.
    fn normal_equations(&self, peaks: &Vec<Peak>) -> Result<NormalEquations, Error> {
        let charts: Vec<Chart> = peaks.iter().map(|&p| Chart::about(p)).collect();
        let mut sums = Sums::new(peaks.len());
        for chunk in self.chunks() {
            let (axes, target) = chunk?;
            accumulate_chunk(axes, &target, &charts, &mut sums);
        }
        let count = PER_PEAK * peaks.len();
        let mut equations = NormalEquations {
            cost: 0.5 * sums.squares(),
            gradient: DVector::from_fn(count, |i, _| sums.gradient(i)),
            gram: DMatrix::from_fn(count, count, |i, j| sums.gram(i, j)),
        };
        pin(peaks, &mut equations);
        Ok(equations)
    }

    fn held(&self, peaks: &Vec<Peak>, mut step: DVector<f64>) -> DVector<f64> {
        for (p, peak) in peaks.iter().enumerate() {
            let mut s = step.rows_mut(PER_PEAK * p, PER_PEAK);
            s[0] = s[0].max(-peak.amplitude);
            let turn = (s[1] * s[1] + s[2] * s[2]).sqrt();
            if turn > LONGEST {
                s[1] *= LONGEST / turn;
                s[2] *= LONGEST / turn;
            }
            let room = EXPONENTS.map(|n| ln64(n / peak.exponent));
            s[3] = s[3].clamp(-LONGEST, LONGEST).clamp(room[0].min(0.0), room[1].max(0.0));
        }
        step
    }

    fn moved(&self, peaks: &Vec<Peak>, step: &DVector<f64>) -> Vec<Peak> {
        let move_one = |(p, peak): (usize, &Peak)| {
            let s = step.rows(PER_PEAK * p, PER_PEAK);
            let Frame { tangent: e1, bitangent: e2, .. } = Frame::about(peak.direction);
            Peak {
                amplitude: (peak.amplitude + s[0]).max(0.0),
                direction: (peak.direction + e1 * s[1] + e2 * s[2]).normalize(),
                exponent: (peak.exponent * exp64(s[3])).clamp(EXPONENTS[0], EXPONENTS[1]),
            }
        };
        peaks.iter().enumerate().map(move_one).collect()
    }

    fn size(&self, peaks: &Vec<Peak>) -> f64 {
        peaks.iter().map(|p| p.amplitude * p.amplitude + 1.0).sum::<f64>().sqrt()
    }
}

/// Leaves out the unknowns that stand at a bound and would leave it: their gradient, row and column
/// become 0, so that the damped equations do not move them.
fn pin(peaks: &[Peak], equations: &mut NormalEquations) {
    for (p, peak) in peaks.iter().enumerate() {
        let (amplitude, exponent) = (PER_PEAK * p, PER_PEAK * p + 3);
        let downhill = |unknown: usize| -equations.gradient[unknown];
        let no_less = peak.amplitude <= 0.0 && downhill(amplitude) < 0.0;
        let no_wider = peak.exponent <= EXPONENTS[0] && downhill(exponent) < 0.0;
        let no_narrower = peak.exponent >= EXPONENTS[1] && downhill(exponent) > 0.0;
        for (unknown, pinned) in [(amplitude, no_less), (exponent, no_wider || no_narrower)] {
            if pinned {
                equations.gradient[unknown] = 0.0;
                equations.gram.row_mut(unknown).fill(0.0);
                equations.gram.column_mut(unknown).fill(0.0);
            }
        }
    }
}
