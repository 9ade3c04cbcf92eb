//! Floor 4: cameras, footprints, supersampling and films.

mod film;

pub use film::Film;
