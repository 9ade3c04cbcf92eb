//! What the terminal at hand can show: from the environment, from the system, and by asking it.

use std::time::Duration;

use crossterm::terminal::window_size;
use ratatui_image::picker::{Capability, Picker, ProtocolType, cap_parser::QueryStdioOptions};

use super::choice::{Colours, Pictures};
use super::depth::{Depth, environment};
use super::screen::{Screen, Way, believed, plausible};

/// How long a terminal has to answer. Those that have a picture protocol answer within a few milliseconds and the way
/// to them and back.
const PATIENCE: Duration = Duration::from_millis(1000);

/// What the terminal can show. Asks it only where nothing was chosen and an answer is to be hoped for. To be called in
/// raw mode and before anything reads keys: a terminal that stays silent costs a second and may lose the first key.
pub fn probe(pictures: Pictures, colours: Colours) -> Screen {
    let found = if asks(pictures, environment) { ask() } else { None };
    let size = window_size().ok();
    let cell = size.and_then(|s| believed([s.columns, s.rows], [s.width, s.height]));
    let screen = Screen {
        cell: found.and_then(|f| f.cell).or(cell).unwrap_or(Screen::CELL),
        tmux: in_tmux(environment),
        inflates: found.is_some_and(|f| f.inflates),
        ..Screen::plain(colours.depth(environment))
    };
    Screen { way: way(pictures, screen.depth, found), ..screen }.settled()
}

/// What a terminal answered.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Found {
    protocol: Option<ProtocolType>,
    cell: Option<[u16; 2]>,
    inflates: bool,
}

/// The way of drawing: the user's, else the terminal's, else half blocks.
fn way(pictures: Pictures, depth: Depth, found: Option<Found>) -> Way {
    let theirs = || match found?.protocol? {
        // Who wants no colours wants none in pictures either.
        _ if depth == Depth::None => None,
        ProtocolType::Halfblocks => None,
        protocol => Some(Way::Protocol(protocol)),
    };
    pictures.way().or_else(theirs).unwrap_or(Way::HalfBlocks)
}

/// Whether to ask the terminal. Not where the user chose; not those that have no protocol; not through a multiplexer,
/// which passes pictures on only if it is set so, and answers for itself.
fn asks(pictures: Pictures, env: impl Fn(&str) -> Option<String> + Copy) -> bool {
    let term = env("TERM").unwrap_or_default();
    let bare = ["", "dumb", "linux", "cons25", "ansi"].contains(&term.as_str());
    let through = in_tmux(env) || env("STY").is_some() || term.starts_with("screen");
    let colours = Depth::detect(env) != Depth::None;
    pictures == Pictures::Auto && colours && !through && !bare && !term.starts_with("vt")
}

fn in_tmux(env: impl Fn(&str) -> Option<String>) -> bool {
    env("TMUX").is_some() || env("TERM").is_some_and(|term| term.starts_with("tmux"))
}

fn ask() -> Option<Found> {
    let options = QueryStdioOptions {
        timeout: PATIENCE,
        kitty_compression: true,
        ..QueryStdioOptions::default()
    };
    let picker = Picker::from_query_stdio_with_options(options).ok()?;
    let told = picker.capabilities();
    let size = |capability: &Capability| match capability {
        Capability::CellSize(Some((w, h))) => Some([*w, *h]),
        _ => None,
    };
    Some(Found {
        protocol: Some(picker.protocol_type()),
        cell: told.iter().find_map(size).filter(|cell| plausible(*cell)),
        inflates: told.contains(&Capability::KittyCompression),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const KITTY: Found =
        Found { protocol: Some(ProtocolType::Kitty), cell: Some([9, 18]), inflates: true };

    #[test]
    fn only_terminals_that_may_answer_are_asked() {
        let asked = |term: &'static str, also: Option<&'static str>| {
            asks(Pictures::Auto, |name| match name {
                "TERM" => Some(term.to_owned()),
                _ => (Some(name) == also).then(|| "1".to_owned()),
            })
        };
        assert!(asked("xterm-kitty", None) && asked("xterm-256color", None));
        for term in ["dumb", "linux", "vt220", "screen-256color", "tmux-256color", ""] {
            assert!(!asked(term, None), "{term}");
        }
        assert!(!asked("xterm", Some("TMUX")) && !asked("xterm", Some("NO_COLOR")));
        assert!(!asks(Pictures::HalfBlocks, |_| Some("xterm-kitty".to_owned())));
    }

    #[test]
    fn the_users_choice_goes_first() {
        assert_eq!(way(Pictures::Auto, Depth::True, None), Way::HalfBlocks);
        let kitty = Way::Protocol(ProtocolType::Kitty);
        assert_eq!(way(Pictures::Auto, Depth::True, Some(KITTY)), kitty);
        assert_eq!(way(Pictures::Auto, Depth::None, Some(KITTY)), Way::HalfBlocks);
        assert_eq!(way(Pictures::Characters, Depth::True, Some(KITTY)), Way::Characters);
        assert_eq!(way(Pictures::Kitty, Depth::None, None), kitty);
    }
}
