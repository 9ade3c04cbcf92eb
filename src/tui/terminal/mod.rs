//! The terminal itself: taken for as long as a [`Session`] lives and given back however it ends; its keys ([`Input`])
//! and the system's signals ([`watch`]) as messages.
//!
//! ```text
//! start ── keys, frames ── suspend (Ctrl-Z) ── … ── drop, panic, or a signal nobody answers
//!   raw mode, alternate screen,    given back,          given back once, by whoever comes first
//!   cursor hidden, title           taken again
//! ```

mod input;
mod precedence;
mod sequences;
mod session;
mod signals;

pub use input::Input;
pub use precedence::give_way;
pub use session::{Options, Session, SessionError, Tty, draw, give_back};
pub use signals::{Notice, Signal, watch};
