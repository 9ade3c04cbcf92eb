//! What has happened, line by line.

use std::collections::VecDeque;
use std::time::SystemTime;

/// What kind of thing happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A run began, or a scene of it.
    Begun,
    /// Something is done.
    Done,
    /// Something worth knowing.
    Note,
    /// Something is wrong.
    Problem,
}

impl Kind {
    /// Its sign.
    pub fn sign(self) -> char {
        match self {
            Self::Begun => '▸',
            Self::Done => '✓',
            Self::Note => '·',
            Self::Problem => '!',
        }
    }
}

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// When it was heard of.
    pub time: SystemTime,
    /// What kind of thing happened.
    pub kind: Kind,
    /// What, a sentence.
    pub text: String,
}

/// The last lines there were.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    /// The oldest first.
    entries: VecDeque<Entry>,
    /// Lines that the view is scrolled up from the newest.
    pub up: usize,
}

/// Lines that are kept.
const KEPT: usize = 2000;

impl Log {
    /// Adds a line. A view that is scrolled up stays where it is.
    pub fn add(&mut self, time: SystemTime, kind: Kind, text: impl Into<String>) {
        if self.entries.len() == KEPT {
            self.entries.pop_front();
        }
        self.entries.push_back(Entry { time, kind, text: text.into() });
        if self.up > 0 {
            self.scroll(1);
        }
    }

    /// Scrolls up, or down if negative.
    pub fn scroll(&mut self, lines: isize) {
        self.up = self.up.saturating_add_signed(lines).min(self.entries.len().saturating_sub(1));
    }

    /// The newest lines at or before the view's end, as many as `room`, the oldest first.
    pub fn shown(&self, room: usize) -> impl Iterator<Item = &Entry> {
        let end = self.entries.len() - self.up.min(self.entries.len());
        self.entries.range(end.saturating_sub(room)..end)
    }

    /// Number of lines.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_lines_are_kept_and_a_scrolled_view_stays() {
        let mut log = Log::default();
        (0..KEPT + 5).for_each(|i| log.add(SystemTime::UNIX_EPOCH, Kind::Note, i.to_string()));
        let texts = |log: &Log| log.shown(2).map(|entry| entry.text.clone()).collect::<Vec<_>>();
        assert_eq!((log.len(), texts(&log)), (KEPT, vec!["2003".to_owned(), "2004".to_owned()]));
        log.scroll(1);
        log.add(SystemTime::UNIX_EPOCH, Kind::Note, "new");
        assert_eq!(texts(&log), ["2002", "2003"]);
        log.scroll(-9);
        assert_eq!(texts(&log), ["2004", "new"]);
    }
}
