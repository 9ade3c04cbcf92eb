//! Floor 0: vectors, frames, hemisphere grids, rippled spheres, noise, the Fourier transform, and elementary functions
//! that give the same bits on every machine.

pub mod elementary;
pub mod fourier;
mod frame;
mod hemisphere;
pub mod noise;
mod quad;
mod ripples;
mod simd;

pub use frame::{Frame, turned};
pub use hemisphere::{HemisphereGrid, Sample};
pub use quad::Quad;
pub use ripples::{Ripples, spherical_frame};
pub use simd::{Kernel, vectorised};

/// A vector or point in double precision; which space it lives in is said where it is used.
pub type Vec3 = nalgebra::Vector3<f64>;
