//! Floor 9: the terminal runner: watch, explore and compare without leaving the terminal.
//!
//! ```text
//!  keys, mouse, signals, clock ─┐
//!                               ├─ Message ─> update(&mut Model) ─ Effect ─> threads, terminal, disk
//!  threads' findings ───────────┘                  │                             │
//!        ^                                   view(&Model) ─> Frame               │
//!        └───────────────────────────────────────────────────────────────────────┘
//! ```
//!
//! The model is plain data. [`update()`] is a function of it and of one message: time, disk and threads come in with
//! messages. The view takes `&Model` and draws. All that takes time happens on threads, so nothing keeps the keys
//! waiting. What keys do stands in one table, [`keys::BINDINGS`].

mod app;
pub mod chart;
pub mod experiments;
pub mod keys;
pub mod lab;
pub mod library;
pub mod message;
pub mod model;
pub mod picture;
pub mod results;
pub mod table;
pub mod terminal;
mod update;
pub mod view;
pub mod viewer;

pub use app::{Options, TuiError, run};
pub use update::update;
