//! Floor 6: the experiment spec, its sweep into trials, the runner, and the results on disk.

pub mod results;
pub mod spec;
