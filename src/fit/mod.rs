//! Floor 2: fitting Phong peaks to a distribution of normals (Fournier 1992 §2).
//!
//! [`Directions`] are where a distribution is known; [`Distribution`] is what a region's normals make
//! of it, or what was measured ([`Samples`]); [`PeakProblem`] is the least-squares problem for a fixed number of peaks;
//! [`LevenbergMarquardt`] solves such problems; [`fit`] is the paper's procedure, a peak more at a time.

mod channels;
mod directions;
mod distribution;
mod greedy;
mod guess;
mod kernel;
mod least_squares;
mod mixture;
mod peak;
mod problem;
mod samples;
mod solver;
#[cfg(test)]
mod tests;

pub use channels::spread_channels;
pub use directions::Directions;
pub use distribution::Distribution;
pub use greedy::{Fit, GREEDY_SETTINGS, GreedyOptions, by_peaks, fit, reconstruct};
pub use guess::first_guess;
pub use least_squares::{LeastSquares, NormalEquations};
pub use mixture::{Mixture, NormalBins, mixture};
pub use peak::{InputError, Peak, merged};
pub use problem::PeakProblem;
pub use samples::{Samples, SamplesError};
pub use solver::{LevenbergMarquardt, Settings, Solution, Termination, solve};
