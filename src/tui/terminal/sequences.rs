//! What a terminal is sent when it is taken and when it is given back.

use crossterm::Command;
use crossterm::cursor::{Hide, Show};
use crossterm::event::{DisableBracketedPaste, DisableMouseCapture, EnableMouseCapture};
use crossterm::style::ResetColor;
use crossterm::terminal::{
    Clear, ClearType, DisableLineWrap, EnableLineWrap, EndSynchronizedUpdate, EnterAlternateScreen,
    LeaveAlternateScreen, SetTitle,
};

/// Keeps the window's title and brings it back (xterm's window operations; others pass over them).
const KEEP_TITLE: &str = "\x1b[22;2t";
const BRING_TITLE: &str = "\x1b[23;2t";

/// The alternate screen, empty, with our title and no cursor.
pub(super) fn take(title: &str, mouse: bool) -> String {
    let mut text = String::from(KEEP_TITLE);
    add(&mut text, EnterAlternateScreen);
    add(&mut text, SetTitle(title.chars().filter(|c| !c.is_control()).collect::<String>()));
    add(&mut text, DisableBracketedPaste);
    if mouse {
        add(&mut text, EnableMouseCapture);
    }
    add(&mut text, DisableLineWrap);
    add(&mut text, Hide);
    add(&mut text, Clear(ClearType::All));
    text
}

/// Everything as it was. Harmless where little was taken.
pub(super) fn give() -> String {
    let mut text = String::new();
    add(&mut text, EndSynchronizedUpdate);
    add(&mut text, DisableMouseCapture);
    add(&mut text, ResetColor);
    add(&mut text, EnableLineWrap);
    add(&mut text, LeaveAlternateScreen);
    add(&mut text, Show);
    text.push_str(BRING_TITLE);
    text
}

fn add(text: &mut String, command: impl Command) {
    // Writing to a string cannot fail.
    let _ = command.write_ansi(text);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The private modes (CSI ? n h or l) set and not reset.
    fn on(text: &str) -> Vec<&str> {
        let modes = text.split("\x1b[?").skip(1).filter_map(|rest| {
            let end = rest.find(['h', 'l'])?;
            Some((&rest[..end], &rest[end..=end]))
        });
        let mut on = Vec::new();
        for (mode, state) in modes {
            on.retain(|other| *other != mode);
            if state == "h" {
                on.push(mode);
            }
        }
        on
    }

    #[test]
    fn what_is_taken_is_given_back() {
        for mouse in [false, true] {
            let taken = take("wrinkle", mouse);
            assert!(on(&taken).contains(&"1049") && on(&taken).contains(&"1006") == mouse);
            // Only those stay on that a terminal starts with: the cursor, and lines that wrap.
            assert_eq!(on(&(taken + &give())), ["7", "25"]);
        }
    }

    #[test]
    fn a_title_cannot_end_its_sequence() {
        assert!(take("a\x07\x1b[2Jb", false).contains("a[2Jb"));
    }
}
