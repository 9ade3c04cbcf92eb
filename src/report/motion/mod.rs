//! Reports on things that move: images in motion first, then how methods flicker beside the truth.

pub mod animation;
mod answer;
mod clip;
pub mod csv;
mod curves;
mod films;
pub mod page;
mod reel;
mod standing;
mod tables;
