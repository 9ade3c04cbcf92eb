//! The keys: one table that dispatches them, hints at them in the footer and explains them on the help page.

mod bindings;
#[cfg(test)]
mod tests;

pub use bindings::{BINDINGS, Binding};

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

/// Where a key means something: what has the focus, from the most special to the most general.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Context {
    /// A question stands open.
    Question,
    /// The page of keys is shown.
    Help,
    /// The list of experiments.
    Experiments,
    /// The lab, whatever in it has the focus.
    Lab,
    /// The lab's settings.
    Settings,
    /// The lab's list of methods.
    Methods,
    /// The results, whatever in them has the focus.
    Results,
    /// The lists of reports, scenes and rows.
    Reports,
    /// Pictures that are compared, in the lab or among the results.
    Picture,
    /// A picture that has the focus: the arrows move its cursor.
    Cursor,
    /// Everywhere but in a question.
    Everywhere,
}

impl Context {
    /// Its heading on the help page.
    pub fn title(self) -> &'static str {
        match self {
            Self::Question => "Questions",
            Self::Help => "This page",
            Self::Experiments => "Experiments",
            Self::Lab => "Lab",
            Self::Settings => "Lab: settings",
            Self::Methods => "Lab: methods",
            Self::Results => "Results",
            Self::Reports => "Results: lists",
            Self::Picture => "Pictures",
            Self::Cursor => "Pictures: cursor",
            Self::Everywhere => "Everywhere",
        }
    }

    /// All of them, in the order of the help page.
    pub const ALL: [Self; 11] = [
        Self::Everywhere,
        Self::Experiments,
        Self::Lab,
        Self::Settings,
        Self::Methods,
        Self::Picture,
        Self::Cursor,
        Self::Results,
        Self::Reports,
        Self::Help,
        Self::Question,
    ];
}

/// A key as it is pressed: a code with Control or without. Shift is part of a character.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    code: KeyCode,
    control: bool,
}

const fn c(character: char) -> Key {
    Key { code: KeyCode::Char(character), control: false }
}

const fn ctrl(character: char) -> Key {
    Key { code: KeyCode::Char(character), control: true }
}

const fn k(code: KeyCode) -> Key {
    Key { code, control: false }
}

impl From<KeyEvent> for Key {
    fn from(event: KeyEvent) -> Self {
        Self { code: event.code, control: event.modifiers.contains(KeyModifiers::CONTROL) }
    }
}

#[cfg(test)]
impl From<Key> for KeyEvent {
    fn from(key: Key) -> Self {
        let modifiers = if key.control { KeyModifiers::CONTROL } else { KeyModifiers::NONE };
        Self::new(key.code, modifiers)
    }
}

impl std::fmt::Display for Key {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = match self.code {
            KeyCode::Char(' ') => "Space".to_owned(),
            KeyCode::Char(character) if self.control => character.to_uppercase().to_string(),
            KeyCode::Char(character) => character.to_string(),
            KeyCode::Up => "↑".to_owned(),
            KeyCode::Down => "↓".to_owned(),
            KeyCode::Left => "←".to_owned(),
            KeyCode::Right => "→".to_owned(),
            KeyCode::BackTab => "Shift-Tab".to_owned(),
            KeyCode::PageUp => "PgUp".to_owned(),
            KeyCode::PageDown => "PgDn".to_owned(),
            other => other.to_string(),
        };
        write!(f, "{}{name}", if self.control { "Ctrl-" } else { "" })
    }
}

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Action {
    // Everywhere.
    Quit,
    Suspend,
    Redraw,
    Help,
    ToExperiments,
    ToLab,
    ToResults,
    NextFocus,
    PreviousFocus,
    Mouse,
    // Questions and the page of keys.
    Yes,
    No,
    Close,
    // Lists.
    Up,
    Down,
    PageUp,
    PageDown,
    First,
    Last,
    Choose,
    // Experiments.
    Run,
    Pause,
    Cancel,
    OpenReport,
    ToLabWith,
    NextChart,
    NextScene,
    PreviousScene,
    SortNext,
    SortTurn,
    // Lab.
    Less,
    More,
    MuchLess,
    MuchMore,
    Texture,
    TextureBack,
    Surface,
    SurfaceBack,
    Farther,
    Nearer,
    LightUp,
    LightDown,
    LightLeft,
    LightRight,
    CameraLeft,
    CameraRight,
    Wider,
    Narrower,
    Lookup,
    Save,
    // Pictures.
    Pick,
    Flip,
    Split,
    SplitLeft,
    SplitRight,
    Tone,
    Values,
    ZoomIn,
    ZoomOut,
    Whole,
    Brighter,
    Darker,
    CursorUp,
    CursorDown,
    CursorLeft,
    CursorRight,
    // Results.
    Back,
    Samples,
    NextImage,
    PreviousImage,
}

/// What a key does: its action, and its place among the keys of the binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pressed {
    /// The action.
    pub action: Action,
    /// Which of the binding's keys it was.
    pub nth: usize,
}

/// What `key` does where these contexts hold; the first that binds it decides.
pub fn find(contexts: &[Context], key: Key) -> Option<Pressed> {
    contexts.iter().find_map(|context| {
        let of = BINDINGS.iter().filter(|binding| binding.context == *context);
        of.filter_map(|binding| {
            let nth = binding.keys.iter().position(|bound| *bound == key)?;
            Some(Pressed { action: binding.action, nth })
        })
        .next()
    })
}

/// The footer's hints where these contexts hold: a key and a word each, the most special first.
pub fn hints(contexts: &[Context]) -> Vec<(String, &'static str)> {
    let mut hints = Vec::new();
    for context in contexts {
        let of = BINDINGS.iter().filter(|b| b.context == *context && !b.hint.is_empty());
        let shown = of.filter(|b| find(contexts, b.keys[0]).is_some_and(|p| p.action == b.action));
        hints.extend(shown.map(|b| (named(b), b.hint)));
    }
    hints
}

/// The keys of a binding, as the footer names them.
fn named(binding: &Binding) -> String {
    match binding.action {
        Action::Pick => "0-9".to_owned(),
        Action::CursorLeft => "arrows".to_owned(),
        _ => binding.keys[0].to_string(),
    }
}
