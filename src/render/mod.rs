//! Floor 4: cameras, footprints, supersampling and films.

mod camera;
mod film;
mod reference;
mod renderer;
mod sampler;
mod view;

pub use camera::{Camera, direction};
pub use film::Film;
pub use reference::{Converged, converge};
pub use renderer::{Cancelled, render};
pub use sampler::{PixelSampler, stream};
pub use view::View;
