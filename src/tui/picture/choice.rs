//! What a user may say of pictures and colours: `--pictures` and `--colour`.

use clap::ValueEnum;
use ratatui_image::picker::ProtocolType;

use super::depth::Depth;
use super::screen::Way;

/// How pictures are to be drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Pictures {
    /// As well as the terminal can: it is asked.
    #[default]
    Auto,
    /// By the kitty graphics protocol.
    Kitty,
    /// By iTerm2's inline images.
    Iterm2,
    /// By sixels.
    Sixel,
    /// In half blocks, two pixels a character.
    HalfBlocks,
    /// In plain characters, by lightness.
    Characters,
}

impl Pictures {
    /// The way chosen; none if it is the terminal's.
    pub(super) fn way(self) -> Option<Way> {
        match self {
            Self::Auto => None,
            Self::Kitty => Some(Way::Protocol(ProtocolType::Kitty)),
            Self::Iterm2 => Some(Way::Protocol(ProtocolType::Iterm2)),
            Self::Sixel => Some(Way::Protocol(ProtocolType::Sixel)),
            Self::HalfBlocks => Some(Way::HalfBlocks),
            Self::Characters => Some(Way::Characters),
        }
    }
}

/// Which colours are to be used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Colours {
    /// What the environment tells: NO_COLOR, COLORTERM, TERM.
    #[default]
    Auto,
    /// All: 24 bits a colour.
    #[value(alias = "true")]
    Always,
    /// The 256 colours of xterm.
    #[value(name = "256")]
    Indexed,
    /// None.
    Never,
}

impl Colours {
    /// The depth chosen, or found in the environment.
    pub fn depth(self, env: impl Fn(&str) -> Option<String>) -> Depth {
        match self {
            Self::Auto => Depth::detect(env),
            Self::Always => Depth::True,
            Self::Indexed => Depth::Ansi256,
            Self::Never => Depth::None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_have_the_names_of_the_manual() {
        let names = |all: Vec<clap::builder::PossibleValue>| {
            all.iter().map(|v| v.get_name().to_owned()).collect::<Vec<_>>().join(" ")
        };
        let pictures = Pictures::value_variants().iter().filter_map(Pictures::to_possible_value);
        let colours = Colours::value_variants().iter().filter_map(Colours::to_possible_value);
        assert_eq!(names(pictures.collect()), "auto kitty iterm2 sixel half-blocks characters");
        assert_eq!(names(colours.collect()), "auto always 256 never");
        assert_eq!(Colours::from_str("true", false), Ok(Colours::Always));
    }

    #[test]
    fn a_wish_goes_before_the_environment() {
        let refused = |name: &str| (name == "NO_COLOR").then(|| "1".to_owned());
        assert_eq!(Colours::Auto.depth(refused), Depth::None);
        assert_eq!(Colours::Always.depth(refused), Depth::True);
    }
}
