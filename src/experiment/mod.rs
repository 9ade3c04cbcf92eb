//! Floor 6: the experiment spec, its sweep into trials, the runner, and the results on disk.

pub mod author;
mod budget;
mod collect;
mod event;
mod keys;
pub mod lock;
pub mod preview;
pub mod results;
pub mod runner;
pub mod sequence;
pub mod spec;
pub mod store;
mod work;
