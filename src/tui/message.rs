//! What comes in, and what is to be done about it.

use std::path::PathBuf;
use std::time::SystemTime;

use crossterm::event::{KeyEvent, MouseEvent};

use super::terminal::Signal;
use super::{experiments, lab, results};

/// What changes the model: everything it learns comes in as one of these.
#[derive(Clone, Debug)]
pub enum Message {
    /// A key was pressed.
    Key(KeyEvent),
    /// The mouse did something.
    Mouse(MouseEvent),
    /// The terminal has another size: columns and rows.
    Resized(u16, u16),
    /// The time, a few times a second.
    Tick(SystemTime),
    /// The system asks the program to end.
    Ending(Signal),
    /// About the experiments.
    Experiments(experiments::Told),
    /// About the lab.
    Lab(lab::Told),
    /// About the results.
    Results(results::Told),
    /// Something went as it should, a sentence.
    Note(String),
    /// Something is wrong, a sentence.
    Problem(String),
}

/// What is to be done, by those who may touch the world.
#[derive(Clone, Debug)]
pub enum Effect {
    /// To end the program. If a signal asked for it, with its exit code.
    Quit(Option<Signal>),
    /// To stop until the shell continues us.
    Suspend,
    /// To draw everything anew.
    Clear,
    /// To take the mouse or to let go of it.
    Mouse(bool),
    /// To open a file in the program the desktop has for it.
    Open(PathBuf),
    /// Of the experiments' threads.
    Experiments(experiments::Order),
    /// Of the lab's threads.
    Lab(lab::Order),
    /// Of the results' threads.
    Results(results::Order),
}
