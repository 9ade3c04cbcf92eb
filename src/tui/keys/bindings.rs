//! The table of keys.

use crossterm::event::KeyCode;

use super::{Action, Context, Key, c, ctrl, k};

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Binding {
    /// Where it holds.
    pub context: Context,
    /// The keys that do it. Of [`Action::Pick`] the place in this list tells what is picked.
    pub keys: &'static [Key],
    /// What they do.
    pub action: Action,
    /// What that is, for the help page.
    pub words: &'static str,
    /// The same in a word or two for the footer; empty if the footer leaves it out.
    pub hint: &'static str,
}

const fn bind(
    context: Context,
    keys: &'static [Key],
    action: Action,
    words: &'static str,
    hint: &'static str,
) -> Binding {
    Binding { context, keys, action, words, hint }
}

pub(super) const UP: &[Key] = &[k(KeyCode::Up), c('k')];
pub(super) const DOWN: &[Key] = &[k(KeyCode::Down), c('j')];
pub(super) const LEFT: &[Key] = &[k(KeyCode::Left), c('h')];
pub(super) const RIGHT: &[Key] = &[k(KeyCode::Right), c('l')];
const DIGITS: &[Key] =
    &[c('0'), c('1'), c('2'), c('3'), c('4'), c('5'), c('6'), c('7'), c('8'), c('9')];

/// The table.
pub const BINDINGS: &[Binding] = {
    use Action as A;
    use Context as C;
    &[
        bind(C::Question, &[c('y'), k(KeyCode::Enter), ctrl('c')], A::Yes, "yes", "yes"),
        bind(C::Question, &[c('n'), k(KeyCode::Esc), c('q')], A::No, "no", "no"),
        bind(
            C::Help,
            &[k(KeyCode::Esc), c('?'), c('q'), k(KeyCode::Enter), ctrl('c')],
            A::Close,
            "close",
            "close",
        ),
        bind(C::Help, UP, A::Up, "scroll up", ""),
        bind(C::Help, DOWN, A::Down, "scroll down", "scroll"),
        bind(C::Help, &[k(KeyCode::PageUp), ctrl('b')], A::PageUp, "a page up", ""),
        bind(C::Help, &[k(KeyCode::PageDown), ctrl('f'), c(' ')], A::PageDown, "a page down", ""),
        // Experiments.
        bind(C::Experiments, UP, A::Up, "the experiment, or row, above", ""),
        bind(C::Experiments, DOWN, A::Down, "the experiment, or row, below", "choose"),
        bind(C::Experiments, &[k(KeyCode::PageUp), ctrl('b')], A::PageUp, "a page up", ""),
        bind(C::Experiments, &[k(KeyCode::PageDown), ctrl('f')], A::PageDown, "a page down", ""),
        bind(C::Experiments, &[k(KeyCode::Home), c('g')], A::First, "the first", ""),
        bind(C::Experiments, &[k(KeyCode::End), c('G')], A::Last, "the last", ""),
        bind(
            C::Experiments,
            &[k(KeyCode::Enter), c('r')],
            A::Run,
            "run it, or go on where it stopped",
            "run",
        ),
        bind(
            C::Experiments,
            &[c('p')],
            A::Pause,
            "pause the run after the piece under way, and go on",
            "pause",
        ),
        bind(
            C::Experiments,
            &[c('x')],
            A::Cancel,
            "cancel the run; what is finished is kept",
            "cancel",
        ),
        bind(C::Experiments, &[c('o')], A::OpenReport, "open the written report", "report"),
        bind(C::Experiments, &[c('v')], A::ToLabWith, "look at its first scene in the lab", "lab"),
        bind(
            C::Experiments,
            &[c('c')],
            A::NextChart,
            "the next chart: RMSE, flicker, cost, normals",
            "chart",
        ),
        bind(C::Experiments, &[c(']')], A::NextScene, "the next scene in chart and table", "scene"),
        bind(C::Experiments, &[c('[')], A::PreviousScene, "the scene before", ""),
        bind(C::Experiments, &[c('s')], A::SortNext, "sort the table by the next column", "sort"),
        bind(C::Experiments, &[c('S')], A::SortTurn, "turn the order round", ""),
        // Lab.
        bind(C::Settings, UP, A::Up, "the setting above", ""),
        bind(C::Settings, DOWN, A::Down, "the setting below", "setting"),
        bind(C::Settings, LEFT, A::Less, "less of it, or the one before", ""),
        bind(C::Settings, RIGHT, A::More, "more of it, or the next", "change"),
        bind(C::Settings, &[c('<')], A::MuchLess, "much less", ""),
        bind(C::Settings, &[c('>')], A::MuchMore, "much more", ""),
        bind(C::Methods, UP, A::Up, "the method above", ""),
        bind(C::Methods, DOWN, A::Down, "the method below", "method"),
        bind(C::Methods, &[k(KeyCode::Enter)], A::Choose, "look at it", "look"),
        bind(C::Methods, &[c('o')], A::SortNext, "order by the next column", "order"),
        bind(C::Lab, &[c('t')], A::Texture, "the next texture", "texture"),
        bind(C::Lab, &[c('T')], A::TextureBack, "the texture before", ""),
        bind(C::Lab, &[c('u')], A::Surface, "the next surface", "surface"),
        bind(C::Lab, &[c('U')], A::SurfaceBack, "the surface before", ""),
        bind(C::Lab, &[c('d')], A::Farther, "farther: more texels a pixel", "distance"),
        bind(C::Lab, &[c('D')], A::Nearer, "nearer: fewer texels a pixel", ""),
        bind(C::Lab, &[c('i')], A::LightUp, "raise the light", "light"),
        bind(C::Lab, &[c('I')], A::LightDown, "lower the light", ""),
        bind(C::Lab, &[c('a')], A::LightLeft, "turn the light to the left", ""),
        bind(C::Lab, &[c('A')], A::LightRight, "turn the light to the right", ""),
        bind(C::Lab, &[c('y')], A::CameraLeft, "walk round: the camera to the left", ""),
        bind(C::Lab, &[c('Y')], A::CameraRight, "walk round: the camera to the right", ""),
        bind(C::Lab, &[c('w')], A::Wider, "a wider base lobe: a rougher surface", "width"),
        bind(C::Lab, &[c('W')], A::Narrower, "a narrower base lobe: a smoother surface", ""),
        bind(
            C::Lab,
            &[c('p')],
            A::Lookup,
            "the next lookup: trilinear, anisotropic, EWA, exact",
            "lookup",
        ),
        bind(
            C::Lab,
            &[ctrl('s')],
            A::Save,
            "write the scene as an experiment, to be measured",
            "save",
        ),
        // Pictures.
        bind(
            C::Picture,
            DIGITS,
            A::Pick,
            "0: the reference; 1 to 9: that method, on the side shown",
            "pick",
        ),
        bind(C::Picture, &[c(' ')], A::Flip, "flip between the sides A and B", "flip"),
        bind(C::Picture, &[c('s')], A::Split, "split: A on the left, B on the right", "split"),
        bind(C::Picture, &[c(',')], A::SplitLeft, "move the split to the left", ""),
        bind(C::Picture, &[c('.')], A::SplitRight, "move the split to the right", ""),
        bind(
            C::Picture,
            &[c('e')],
            A::Tone,
            "the image, its error in false colour, its signed error",
            "error",
        ),
        bind(C::Picture, &[c('v')], A::Values, "pixels as numbers", "values"),
        bind(C::Picture, &[c('z'), c('+'), c('=')], A::ZoomIn, "zoom in at the cursor", "zoom"),
        bind(C::Picture, &[c('Z'), c('-')], A::ZoomOut, "zoom out", ""),
        bind(C::Picture, &[c('f')], A::Whole, "the whole picture, and back", ""),
        bind(C::Picture, &[c('x')], A::Brighter, "brighter by half a stop", "exposure"),
        bind(C::Picture, &[c('X')], A::Darker, "darker by half a stop", ""),
        bind(C::Cursor, UP, A::CursorUp, "the pixel above", ""),
        bind(C::Cursor, DOWN, A::CursorDown, "the pixel below", ""),
        bind(C::Cursor, LEFT, A::CursorLeft, "the pixel to the left", "cursor"),
        bind(C::Cursor, RIGHT, A::CursorRight, "the pixel to the right", ""),
        // Results.
        bind(C::Reports, UP, A::Up, "the line above", ""),
        bind(C::Reports, DOWN, A::Down, "the line below", "choose"),
        bind(C::Reports, &[k(KeyCode::PageUp), ctrl('b')], A::PageUp, "a page up", ""),
        bind(C::Reports, &[k(KeyCode::PageDown), ctrl('f')], A::PageDown, "a page down", ""),
        bind(C::Reports, &[k(KeyCode::Home), c('g')], A::First, "the first", ""),
        bind(C::Reports, &[k(KeyCode::End), c('G')], A::Last, "the last", ""),
        bind(
            C::Reports,
            &[k(KeyCode::Enter), k(KeyCode::Right), c('l')],
            A::Choose,
            "look into it",
            "look",
        ),
        bind(C::Reports, &[k(KeyCode::Left), c('h')], A::Back, "back", ""),
        bind(C::Results, &[k(KeyCode::Esc), k(KeyCode::Backspace)], A::Back, "back", "back"),
        bind(C::Results, &[c(']')], A::NextScene, "the next scene or row", "scene"),
        bind(C::Results, &[c('[')], A::PreviousScene, "the scene or row before", ""),
        bind(C::Results, &[c('m')], A::NextImage, "the next image, on the side shown", "image"),
        bind(C::Results, &[c('b')], A::PreviousImage, "the image before", ""),
        bind(
            C::Results,
            &[c('n')],
            A::Samples,
            "images of the next number of samples a pixel",
            "spp",
        ),
        bind(C::Results, &[c('o')], A::OpenReport, "open the written report", "report"),
        // Everywhere.
        bind(C::Everywhere, &[k(KeyCode::F(1)), c('E')], A::ToExperiments, "experiments", ""),
        bind(C::Everywhere, &[k(KeyCode::F(2)), c('L')], A::ToLab, "lab", ""),
        bind(C::Everywhere, &[k(KeyCode::F(3)), c('R')], A::ToResults, "results", ""),
        bind(
            C::Everywhere,
            &[k(KeyCode::Tab)],
            A::NextFocus,
            "the focus to the next part",
            "focus",
        ),
        bind(
            C::Everywhere,
            &[k(KeyCode::BackTab)],
            A::PreviousFocus,
            "the focus to the part before",
            "",
        ),
        bind(
            C::Everywhere,
            &[c('M')],
            A::Mouse,
            "let go of the mouse, so that the terminal selects text, and take it again",
            "",
        ),
        bind(C::Everywhere, &[ctrl('l')], A::Redraw, "draw everything anew", ""),
        bind(C::Everywhere, &[ctrl('z')], A::Suspend, "suspend; `fg` in the shell comes back", ""),
        bind(C::Everywhere, &[c('?')], A::Help, "all keys", "keys"),
        bind(C::Everywhere, &[c('q'), ctrl('c')], A::Quit, "quit", "quit"),
    ]
};
