//! Floor 1: lobes. A lobe is a spread of normals around a direction; a list of them is a multiple
//! surface.
//!
//! # The measure
//! A lobe's density D is per steradian, and D of a single base lobe about its own normal n is
//! normalised as a microfacet distribution: ∫ D(h) (h·n) dω = 1. Then ∫ D(h) h dω = n as well (by
//! symmetry), so the *vector moment* of a weighted mixture is Σ wᵢ nᵢ. That identity is how "energy"
//! is stated everywhere here: a lobe keeps the energy of a footprint if its vector moment along its
//! own axis is |Σ wᵢ nᵢ|.

mod base;
mod elliptic;
mod facet;
mod horizon;
pub mod intensity;
mod multiple_surface;
mod named;
mod ndf_image;
mod peak;
mod pedal;
mod reflection;
mod restricted;
pub mod round;
pub mod sampled;
mod slopes;
mod surface_file;
pub mod vector;
mod warp;

pub use base::BaseLobe;
pub use elliptic::{EllipticLobe, Profile};
pub use facet::{Facet, Shading, Spread};
pub use horizon::Horizon;
pub use multiple_surface::{CAPACITY, Lobe, MultipleSurface, Visibility};
pub use named::{NamedSurface, find_named, named};
pub use ndf_image::{Measure, NdfError, NdfImage, SIDES};
pub use peak::PhongPeak;
pub use pedal::{Contour, Fall, PedalLobe};
pub use reflection::reflection;
pub use restricted::{Cut, Generator, RestrictedLobe};
pub use sampled::SampledLobe;
pub use slopes::{GAUSSIANS, Gaussian, Gaussians, Slopes};
pub use surface_file::{SurfaceFileError, read_peaks};
pub use warp::{Replacing, SlopeMoments, Warp, Warped};
