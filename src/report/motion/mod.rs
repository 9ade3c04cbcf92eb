//! Reports on things that move: animations first, then how methods flicker beside the truth.

pub mod csv;
