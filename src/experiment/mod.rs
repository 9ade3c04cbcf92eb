//! Floor 6: the experiment spec, its sweep into trials, the runner, and the results on disk.

mod archive;
pub mod author;
mod budget;
mod collect;
mod event;
mod keys;
pub mod lock;
pub mod manifest;
pub mod preview;
pub mod results;
pub mod runner;
pub mod sequence;
pub mod share;
pub mod spec;
pub mod store;
mod work;

pub use archive::STATE;
