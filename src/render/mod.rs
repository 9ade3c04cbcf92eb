//! Floor 4: cameras, footprints, supersampling and films.

mod camera;
mod film;
mod probe;
mod reference;
mod renderer;
mod sampler;
mod view;

pub use camera::{Camera, direction};
pub use film::Film;
pub use probe::true_distribution;
pub use reference::{Converged, average};
pub use renderer::{Cancelled, render};
pub use sampler::{PixelSampler, stream};
pub use view::View;
