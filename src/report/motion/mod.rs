//! Reports on things that move: animations first, then how methods flicker beside the truth.

pub mod animation;
mod answer;
pub mod csv;
mod curves;
pub mod page;
mod reel;
mod standing;
mod tables;
