//! Pausing and halting a job from another thread.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

use crate::experiment::runner::{RunEvent, Watcher};
use crate::scene::Halt;

/// What stops a job: its halt for good, its gate for a while. Clones control the same job.
#[derive(Clone, Debug, Default)]
pub struct Control {
    /// Set, it ends the job soon, within a piece of work too; what was finished is kept.
    pub halt: Halt,
    /// Shut, it makes the job wait before its next piece of work.
    pub gate: Gate,
}

impl Control {
    /// Halts the job, even one that waits at its gate.
    pub fn halt(&self) {
        self.halt.0.store(true, Ordering::Relaxed);
        self.gate.open();
    }

    /// A watcher that waits at the gate before it hands on that a piece of work begins. Only there: that is told by
    /// the job's own thread, when no other is at work. A job halted meanwhile begins no piece, and none is told of.
    pub(super) fn gated(&self, watch: &Watcher) -> Watcher {
        let (control, watch) = (self.clone(), Arc::clone(watch));
        Arc::new(move |event| {
            if matches!(event, RunEvent::Working { .. }) && control.gate.is_shut() {
                watch(RunEvent::Paused);
                control.gate.pass(&control.halt);
                if control.halt.now() {
                    return;
                }
                watch(RunEvent::Resumed);
            }
            watch(event);
        })
    }
}

impl From<Halt> for Control {
    /// Nothing shuts its gate.
    fn from(halt: Halt) -> Self {
        Self { halt, gate: Gate::default() }
    }
}

/// A gate that is open or shut; open at first. Clones are the same gate.
#[derive(Clone, Debug, Default)]
pub struct Gate(Arc<Leaf>);

#[derive(Debug, Default)]
struct Leaf {
    shut: AtomicBool,
    /// Holds no data of its own: whoever waits holds it between looking at `shut` and sleeping.
    turn: Mutex<()>,
    opened: Condvar,
}

/// A halt that is set without opening the gate is noticed after this long.
const LOOK: Duration = Duration::from_millis(50);

impl Gate {
    /// Shuts it.
    pub fn shut(&self) {
        self.0.shut.store(true, Ordering::Relaxed);
    }

    /// Opens it.
    pub fn open(&self) {
        let _turn = self.0.turn.lock().unwrap_or_else(PoisonError::into_inner);
        self.0.shut.store(false, Ordering::Relaxed);
        self.0.opened.notify_all();
    }

    /// Whether it is shut.
    pub fn is_shut(&self) -> bool {
        self.0.shut.load(Ordering::Relaxed)
    }

    /// Waits until it is open, or `halt` is set.
    pub fn pass(&self, halt: &Halt) {
        let mut turn = self.0.turn.lock().unwrap_or_else(PoisonError::into_inner);
        while self.is_shut() && !halt.now() {
            let woken = self.0.opened.wait_timeout(turn, LOOK);
            turn = woken.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}
