//! How far a run is, and how long it will take.

use std::time::{Duration, SystemTime};

use crate::experiment::runner::RunEvent;

/// How far a run is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Progress {
    /// Work in all, without what earlier runs had done: that says nothing of this run's speed.
    all: f64,
    /// Work done by this run.
    done: f64,
    /// Work that earlier runs had done.
    kept: f64,
    /// Work of the piece under way, and which part of it is done.
    piece: (f64, f64),
    /// What the piece is, in a few words.
    pub what: String,
    /// The scene's slug, or the row's name, and its part.
    pub scene: Option<(Option<String>, String)>,
    /// The scene's number, and how many there are.
    pub scenes: (usize, usize),
    /// Trials with their scores, and how many there are in all.
    pub trials: (usize, usize),
    /// Time spent at work.
    active: Duration,
    /// When time was last counted; None while it waits.
    counted: Option<SystemTime>,
    /// Whether it waits at its gate.
    pub waits: bool,
}

impl Progress {
    /// Takes in what the run tells.
    pub fn take(&mut self, event: &RunEvent, now: SystemTime) {
        self.tick(now);
        match event {
            RunEvent::Started { work, scenes, trials } => {
                self.all = *work;
                (self.scenes.1, self.trials.1) = (*scenes, *trials);
            }
            RunEvent::Scene { slug, part, number, of } => {
                self.scene = Some((part.clone(), slug.clone()));
                self.scenes = (*number, *of);
            }
            RunEvent::Working { what, work } => {
                self.what.clone_from(what);
                self.piece = (*work, 0.0);
            }
            RunEvent::Partly { part } => self.piece.1 = part.clamp(0.0, 1.0),
            RunEvent::Advanced { work, kept } => {
                if *kept {
                    (self.all, self.kept) = (self.all - work, self.kept + work);
                } else {
                    self.done += work;
                }
                self.piece = (0.0, 0.0);
            }
            RunEvent::Scored { .. } => self.trials.0 += 1,
            RunEvent::Paused => self.waits = true,
            RunEvent::Resumed => self.waits = false,
            RunEvent::Reporting => {
                self.what = "writing the report".to_owned();
                self.piece = (0.0, 0.0);
            }
            RunEvent::Noted { .. }
            | RunEvent::Converged { .. }
            | RunEvent::Probed { .. }
            | RunEvent::Flickered { .. } => {}
        }
        self.counted = (!self.waits).then_some(now);
    }

    /// Counts the time until `now`.
    pub fn tick(&mut self, now: SystemTime) {
        if let Some(counted) = &mut self.counted {
            // A clock that was set back counts nothing.
            self.active += now.duration_since(*counted).unwrap_or_default();
            *counted = now;
        }
    }

    /// The part that is done, from 0 to 1; what earlier runs had done counts.
    pub fn part(&self) -> f64 {
        let all = self.all + self.kept;
        let done = self.done + self.kept + self.piece.0 * self.piece.1;
        if all > 0.0 { (done / all).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// The scene's slug, or the row's name, after its part's name if it is of one.
    pub fn scene_name(&self) -> String {
        match &self.scene {
            Some((Some(part), slug)) => format!("{part}/{slug}"),
            Some((None, slug)) => slug.clone(),
            None => String::new(),
        }
    }

    /// The part of the piece under way that is done; None if it does not tell.
    pub fn part_of_piece(&self) -> Option<f64> {
        (self.piece.1 > 0.0).then_some(self.piece.1)
    }

    /// Time left at the pace so far; None before there is one.
    pub fn left(&self) -> Option<Duration> {
        /// Under this a pace means nothing.
        const LEAST: Duration = Duration::from_millis(500);
        let done = self.done + self.piece.0 * self.piece.1;
        if done <= 0.0 || self.active < LEAST {
            return None;
        }
        let left = (self.all - done).max(0.0) / done * self.active.as_secs_f64();
        Duration::try_from_secs_f64(left).ok()
    }
}

/// A time in words: `3 s`, `2 min 10 s`, `1 h 5 min`.
pub fn in_words(time: Duration) -> String {
    let secs = time.as_secs_f64().round() as u64;
    match (secs / 3600, secs / 60 % 60, secs % 60) {
        (0, 0, secs) => format!("{secs} s"),
        (0, min, 0) => format!("{min} min"),
        (0, min, secs) if min < 10 => format!("{min} min {secs} s"),
        (0, min, _) => format!("{min} min"),
        (hours, 0, _) => format!("{hours} h"),
        (hours, min, _) if hours < 48 => format!("{hours} h {min} min"),
        (hours, ..) => format!("{} days", hours / 24),
    }
}

/// How long ago something was, in one unit: `now`, `5 min`, `3 h`, `12 d`.
pub fn age(then: SystemTime, now: SystemTime) -> String {
    let secs = now.duration_since(then).unwrap_or_default().as_secs();
    match secs {
        0..60 => "now".to_owned(),
        60..3600 => format!("{} min", secs / 60),
        3600..172_800 => format!("{} h", secs / 3600),
        _ => format!("{} d", secs / 86_400),
    }
}

/// The time of day (UTC), as `17:05:09`.
pub fn time_of_day(time: SystemTime) -> String {
    let secs = time.duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default().as_secs() % 86_400;
    format!("{:02}:{:02}:{:02}", secs / 3600, secs / 60 % 60, secs % 60)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(secs: u64) -> SystemTime {
        SystemTime::UNIX_EPOCH + Duration::from_secs(secs)
    }

    #[test]
    fn time_left_goes_by_this_runs_pace_and_waiting_does_not_count() {
        let mut progress = Progress::default();
        progress.take(&RunEvent::Started { work: 100.0, scenes: 1, trials: 4 }, at(0));
        progress.take(&RunEvent::Advanced { work: 40.0, kept: true }, at(0));
        assert_eq!((progress.part(), progress.left()), (0.4, None));
        progress.take(&RunEvent::Working { what: "a".into(), work: 20.0 }, at(0));
        progress.take(&RunEvent::Partly { part: 0.5 }, at(10));
        assert_eq!((progress.part(), progress.left()), (0.5, Some(Duration::from_secs(50))));
        progress.take(&RunEvent::Advanced { work: 20.0, kept: false }, at(20));
        progress.take(&RunEvent::Paused, at(20));
        progress.tick(at(500));
        progress.take(&RunEvent::Resumed, at(1000));
        assert_eq!(progress.left(), Some(Duration::from_secs(40)));
        progress.tick(at(1010));
        assert_eq!(progress.left(), Some(Duration::from_secs(60)));
    }

    #[test]
    fn times_in_words() {
        let words =
            [0, 59, 60, 130, 3000, 3600, 3900, 200_000].map(|s| in_words(Duration::from_secs(s)));
        assert_eq!(
            words,
            ["0 s", "59 s", "1 min", "2 min 10 s", "50 min", "1 h", "1 h 5 min", "2 days"]
        );
        assert_eq!(
            [at(10), at(120), at(7200), at(999_999)].map(|now| age(at(0), now)),
            ["now", "2 min", "2 h", "11 d"]
        );
        assert_eq!(age(at(100), at(0)), "now");
        assert_eq!(time_of_day(at(86_400 + 3723)), "01:02:03");
    }
}
