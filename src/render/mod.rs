//! Floor 4: cameras, footprints, supersampling and films.

mod camera;
mod display;
mod environment;
mod film;
mod film_file;
mod image_file;
mod parts;
mod portrait;
mod probe;
mod reference;
mod renderer;
mod sampler;
mod view;

pub use camera::{Camera, direction};
pub use display::{heat, percentile, srgb, srgb_light, write_colours, write_error_png};
pub use environment::{Filtered, reference_replicate, trial};
pub use film::Film;
pub use image_file::{Coding, FilmError, StoredImage, read_image};
pub use parts::{Part, Replaced, Scene, Subject, replaced};
pub use portrait::Portrait;
pub use probe::true_distribution;
pub use reference::{Converged, Tally, average};
pub use renderer::{Cancelled, render};
pub use sampler::{Choices, PixelSampler, stream};
pub use view::View;
