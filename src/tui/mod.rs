//! Floor 9: the terminal runner: watch, explore and compare without leaving the terminal.
//!
//! A model is changed by messages alone (update); the view takes `&Model` and draws; all that takes time
//! happens on threads that send messages.

pub mod chart;
pub mod library;
pub mod picture;
pub mod table;
pub mod terminal;
