//! Keys, the mouse and changes of size, read on a thread of their own.

use std::io;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use crossterm::event::{Event, poll, read};

/// Longest wait for an event before the thread looks whether it should rest.
const GLANCE: Duration = Duration::from_millis(50);

/// The thread that reads events.
#[derive(Debug)]
pub struct Input {
    gate: Arc<Gate>,
}

impl Input {
    /// Starts it. Each event goes to `tell`, on that thread; an error is the last.
    pub fn start(tell: impl Fn(io::Result<Event>) + Send + 'static) -> Self {
        let gate = Arc::new(Gate::default());
        let theirs = Arc::clone(&gate);
        thread::spawn(move || {
            while theirs.pass() {
                match poll(GLANCE).and_then(|any| if any { read().map(Some) } else { Ok(None) }) {
                    Ok(Some(event)) => tell(Ok(event)),
                    Ok(None) => {}
                    Err(error) => return tell(Err(error)),
                }
            }
        });
        Self { gate }
    }

    /// Reads no more until [`Input::go_on`]: the keys belong to another program. Comes back when the thread rests.
    pub fn pause(&self) {
        self.gate.close();
    }

    /// Reads on.
    pub fn go_on(&self) {
        self.gate.set(State::Open);
    }
}

impl Drop for Input {
    fn drop(&mut self) {
        self.gate.set(State::Gone);
    }
}

/// Where the thread waits while it should rest.
#[derive(Debug, Default)]
struct Gate {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum State {
    #[default]
    Open,
    /// To be rested at.
    Closed,
    /// The thread rests.
    Resting,
    /// Nobody wants events any more.
    Gone,
}

impl Gate {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn set(&self, state: State) {
        *self.lock() = state;
        self.changed.notify_all();
    }

    /// For the thread: waits while closed; false if it should end.
    fn pass(&self) -> bool {
        let mut state = self.lock();
        if *state == State::Closed {
            *state = State::Resting;
            self.changed.notify_all();
        }
        let resting = |state: &mut State| matches!(state, State::Closed | State::Resting);
        let state = self.changed.wait_while(state, resting);
        *state.unwrap_or_else(PoisonError::into_inner) != State::Gone
    }

    /// For others: closes, and waits for the thread to rest; not forever, should it have ended.
    fn close(&self) {
        self.set(State::Closed);
        let closed = |state: &mut State| *state == State::Closed;
        drop(self.changed.wait_timeout_while(self.lock(), 10 * GLANCE, closed));
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;

    use super::*;

    #[test]
    fn a_closed_gate_holds_the_thread() {
        let gate = Arc::new(Gate::default());
        let theirs = Arc::clone(&gate);
        let (passed, passes) = mpsc::channel();
        let thread = thread::spawn(move || {
            while theirs.pass() {
                if passed.send(()).is_err() {
                    return;
                }
            }
        });
        passes.recv().unwrap();
        gate.close();
        assert_eq!(*gate.lock(), State::Resting);
        passes.try_iter().count();
        assert!(passes.try_recv().is_err());
        gate.set(State::Open);
        passes.recv().unwrap();
        gate.set(State::Gone);
        thread.join().unwrap();
    }

    #[test]
    fn closing_does_not_wait_for_a_thread_that_ended() {
        Gate::default().close();
    }
}
