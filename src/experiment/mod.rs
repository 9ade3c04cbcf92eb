//! Floor 6: the experiment spec, its sweep into trials, the runner, and the results on disk.

pub mod author;
mod collect;
mod keys;
pub mod preview;
pub mod results;
pub mod runner;
pub mod spec;
pub mod store;
