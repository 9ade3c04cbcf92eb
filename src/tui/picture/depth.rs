//! The colours a terminal has, and a drawing brought to them.

use ratatui::buffer::{Buffer, CellDiffOption};
use ratatui::style::Color;

/// The colours a terminal has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Depth {
    /// None, or none wanted.
    None,
    /// The 256 colours of xterm.
    Ansi256,
    /// Any sRGB triple.
    True,
}

/// The process's environment, for what reads it.
pub fn environment(name: &str) -> Option<String> {
    std::env::var(name).ok().filter(|value| !value.is_empty())
}

impl Depth {
    /// What the environment tells: NO_COLOR (no-color.org), COLORTERM, TERM.
    pub fn detect(env: impl Fn(&str) -> Option<String>) -> Self {
        if env("NO_COLOR").is_some() { Self::None } else { Self::of_terminal(env) }
    }

    /// What the terminal has, wanted or not.
    pub fn of_terminal(env: impl Fn(&str) -> Option<String>) -> Self {
        let term = env("TERM").unwrap_or_default();
        let told = env("COLORTERM").is_some_and(|told| told == "truecolor" || told == "24bit");
        let known = ["kitty", "ghostty", "alacritty", "wezterm", "foot", "-direct", "truecolor"];
        if told || env("WT_SESSION").is_some() || known.iter().any(|name| term.contains(name)) {
            return Self::True;
        }
        match term.as_str() {
            "" if cfg!(windows) => Self::True,
            "" | "dumb" => Self::None,
            old if old.starts_with("vt1") || old.starts_with("vt2") => Self::None,
            _ => Self::Ansi256,
        }
    }

    /// Brings every cell to these colours: the nearest of 256, or none. Bold, reverse and the like stay. Cells of a
    /// picture in the terminal's own protocol are left alone: their colours are no colours.
    pub fn limit(self, buf: &mut Buffer) {
        if self == Self::True {
            return;
        }
        let plain = |cell: &&mut ratatui::buffer::Cell| cell.diff_option == CellDiffOption::None;
        for cell in buf.content.iter_mut().filter(plain) {
            (cell.fg, cell.bg) = (self.nearest(cell.fg), self.nearest(cell.bg));
        }
    }

    /// The colour of this depth that stands for another.
    pub fn nearest(self, colour: Color) -> Color {
        match (self, colour) {
            (Self::None, _) => Color::Reset,
            (Self::Ansi256, Color::Rgb(r, g, b)) => Color::Indexed(indexed([r, g, b])),
            _ => colour,
        }
    }
}

/// The codes of a channel in xterm's colour cube, entries 16 to 231.
const CUBE: [u8; 6] = [0, 95, 135, 175, 215, 255];

/// The entry of xterm's cube or ramp of greys (16 to 255) nearest to a colour by Euclidean distance of sRGB codes; of
/// two as near, the lower. The first 16 entries are whatever a user made them, so they are not taken.
pub fn indexed(rgb: [u8; 3]) -> u8 {
    let steps = rgb.map(step);
    let cube = 16 + 36 * steps[0] + 6 * steps[1] + steps[2];
    let mean = rgb.iter().map(|c| u32::from(*c)).sum::<u32>() / 3;
    // The ramp's codes are 8 + 10 i; the mean minimises the sum of three squares.
    let grey = 232 + (mean.saturating_sub(3) / 10).min(23) as u8;
    let distance = |entry: u8| {
        let other = entry_rgb(entry);
        (0..3).map(|c| u32::from(rgb[c].abs_diff(other[c])).pow(2)).sum::<u32>()
    };
    if distance(grey) < distance(cube) { grey } else { cube }
}

/// The nearest step of the cube, of two as near the lower.
fn step(code: u8) -> u8 {
    let far = |i: &usize| CUBE[*i].abs_diff(code);
    (0..CUBE.len()).min_by_key(far).unwrap_or(0) as u8
}

/// The sRGB codes of xterm's entries 16 to 255; black for the first 16.
pub fn entry_rgb(entry: u8) -> [u8; 3] {
    match entry {
        0..16 => [0; 3],
        16..232 => [36, 6, 1].map(|place| CUBE[usize::from((entry - 16) / place % 6)]),
        232.. => [8 + 10 * (entry - 232); 3],
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use ratatui::layout::Rect;
    use ratatui::style::{Modifier, Style};

    use super::*;

    fn env<'a>(set: &'a [(&'a str, &'a str)]) -> impl Fn(&str) -> Option<String> + 'a {
        |name| set.iter().find(|(key, _)| *key == name).map(|(_, value)| (*value).to_owned())
    }

    #[test]
    fn the_environment_is_believed() {
        let of = |set: &[(&str, &str)]| Depth::detect(env(set));
        assert_eq!(of(&[("TERM", "xterm-256color")]), Depth::Ansi256);
        assert_eq!(of(&[("TERM", "xterm-256color"), ("COLORTERM", "truecolor")]), Depth::True);
        assert_eq!(of(&[("TERM", "xterm-direct")]), Depth::True);
        assert_eq!(of(&[("TERM", "xterm-kitty")]), Depth::True);
        assert_eq!(of(&[("TERM", "dumb")]), Depth::None);
        let refused = [("TERM", "xterm-kitty"), ("COLORTERM", "24bit"), ("NO_COLOR", "1")];
        assert_eq!(of(&refused), Depth::None);
        assert_eq!(Depth::of_terminal(env(&refused)), Depth::True);
    }

    #[test]
    fn entries_are_their_own_nearest() {
        // 16, 231 and greys of the cube come before the ramp's equals.
        for entry in 16..=255_u8 {
            let found = indexed(entry_rgb(entry));
            assert_eq!(entry_rgb(found), entry_rgb(entry), "{entry}");
        }
    }

    #[test]
    fn a_drawing_is_limited_but_keeps_its_marks() {
        let area = Rect::new(0, 0, 3, 1);
        let mut buf = Buffer::empty(area);
        let style = Style::new().fg(Color::Rgb(255, 0, 0)).bg(Color::Red);
        buf.set_string(0, 0, "ab", style.add_modifier(Modifier::BOLD));
        buf[(2, 0)].set_fg(Color::Rgb(1, 2, 3)).set_diff_option(CellDiffOption::Skip);
        let mut none = buf.clone();
        Depth::Ansi256.limit(&mut buf);
        assert_eq!((buf[(0, 0)].fg, buf[(0, 0)].bg), (Color::Indexed(196), Color::Red));
        Depth::None.limit(&mut none);
        assert_eq!((none[(1, 0)].fg, none[(1, 0)].bg), (Color::Reset, Color::Reset));
        assert!(none[(1, 0)].modifier.contains(Modifier::BOLD));
        assert_eq!(none[(2, 0)].fg, Color::Rgb(1, 2, 3), "a protocol's cell");
    }

    proptest! {
        #[test]
        fn the_nearest_is_nearest(rgb in prop::array::uniform3(any::<u8>())) {
            let far = |entry: u8| -> u32 {
                let other = entry_rgb(entry);
                (0..3).map(|c| u32::from(rgb[c].abs_diff(other[c])).pow(2)).sum()
            };
            let best = (16..=255).map(far).min().unwrap();
            prop_assert_eq!(far(indexed(rgb)), best);
        }
    }
}
