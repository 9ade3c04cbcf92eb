//! What a terminal can show, and how many pixels that gives a picture.

use ratatui::layout::Rect;
use ratatui_image::picker::ProtocolType;

use super::depth::Depth;

/// How pictures are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// By the terminal's own protocol: pixels of the screen.
    Protocol(ProtocolType),
    /// By '▀', its upper half in the colour of one pixel and its lower half in that of another.
    HalfBlocks,
    /// By characters, the lighter the fuller.
    Characters,
}

/// What the terminal can show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// How pictures are drawn.
    pub way: Way,
    /// The colours there are.
    pub depth: Depth,
    /// Pixels of a character cell, across and down.
    pub cell: [u16; 2],
    /// Whether tmux stands between and must be told to pass pictures on.
    pub tmux: bool,
    /// Whether the terminal takes compressed kitty pictures.
    pub inflates: bool,
}

/// Most pixels that are painted for one picture; more are made by repeating them. A wide terminal on a dense screen
/// has four times as many, and nobody waits for them gladly.
const MOST: usize = 1_500_000;

impl Screen {
    /// A cell's pixels where the terminal does not tell: twice as high as wide, as most are.
    pub const CELL: [u16; 2] = [10, 20];

    /// A terminal of these colours that takes half blocks.
    pub fn plain(depth: Depth) -> Self {
        let way = Way::HalfBlocks;
        Self { way, depth, cell: Self::CELL, tmux: false, inflates: false }.settled()
    }

    /// Half blocks without colours are all alike: characters instead.
    pub(super) fn settled(mut self) -> Self {
        if self.way == Way::HalfBlocks && self.depth == Depth::None {
            self.way = Way::Characters;
        }
        self
    }

    /// The same terminal with pictures in cells: what stands in while a protocol's picture is encoded or covered.
    pub fn in_cells(self) -> Self {
        match self.way {
            Way::Protocol(_) => Self { way: Way::HalfBlocks, ..self }.settled(),
            _ => self,
        }
    }

    /// Pixels to paint for a picture in `area`, across and down.
    pub fn pixels(&self, area: Rect) -> [usize; 2] {
        let [w, h] = [area.width, area.height].map(usize::from);
        match self.way {
            Way::HalfBlocks => [w, 2 * h],
            Way::Characters => [w, h],
            Way::Protocol(_) => {
                let full = self.full(area);
                let repeats = (1..).find(|k| full[0].div_ceil(*k) * full[1].div_ceil(*k) <= MOST);
                full.map(|side| side.div_ceil(repeats.unwrap_or(1)))
            }
        }
    }

    /// Pixels of the screen in `area`, across and down.
    pub(super) fn full(&self, area: Rect) -> [usize; 2] {
        let cells = [area.width, area.height].map(usize::from);
        [0, 1].map(|i| cells[i] * usize::from(self.cell[i]))
    }

    /// The width of a painted pixel over its height, on the screen.
    pub fn aspect(&self) -> f64 {
        let [w, h] = self.cell.map(f64::from);
        match self.way {
            Way::HalfBlocks => 2.0 * w / h,
            Way::Characters => w / h,
            Way::Protocol(_) => 1.0,
        }
    }
}

/// The pixels of a cell of a terminal of `cells` (columns, rows) and `pixels`, if they can be believed: some tell 0,
/// some a window of another screen.
pub(super) fn believed(cells: [u16; 2], pixels: [u16; 2]) -> Option<[u16; 2]> {
    if cells.contains(&0) || cells.iter().any(|n| *n > 5000) {
        return None;
    }
    let cell = [pixels[0] / cells[0], pixels[1] / cells[1]];
    plausible(cell).then_some(cell)
}

/// Whether a cell may have these pixels: at least 4 by 6, at most 100 by 200, upright or square.
pub(super) fn plausible([w, h]: [u16; 2]) -> bool {
    (4..=100).contains(&w) && (6..=200).contains(&h) && h >= w && h <= 4 * w
}

#[cfg(test)]
mod tests {
    use super::*;

    fn screen(way: Way) -> Screen {
        Screen { way, ..Screen::plain(Depth::True) }
    }

    #[test]
    fn pixels_are_counted_by_the_way_of_drawing() {
        let area = Rect::new(3, 1, 30, 10);
        assert_eq!(screen(Way::HalfBlocks).pixels(area), [30, 20]);
        assert_eq!(screen(Way::Characters).pixels(area), [30, 10]);
        assert_eq!(screen(Way::Protocol(ProtocolType::Sixel)).pixels(area), [300, 200]);
        assert_eq!(screen(Way::HalfBlocks).aspect(), 1.0);
        assert_eq!(screen(Way::Characters).aspect(), 0.5);
    }

    #[test]
    fn a_wide_terminal_is_painted_coarser() {
        let wide = screen(Way::Protocol(ProtocolType::Kitty));
        let [w, h] = wide.pixels(Rect::new(0, 0, 300, 80));
        assert_eq!([w, h], [1500, 800]);
        assert!(w * h <= MOST);
    }

    #[test]
    fn without_colour_pictures_are_characters() {
        assert_eq!(Screen::plain(Depth::None).way, Way::Characters);
        let kitty = Screen { depth: Depth::None, ..screen(Way::Protocol(ProtocolType::Kitty)) };
        assert_eq!(kitty.in_cells().way, Way::Characters);
    }

    #[test]
    fn nonsense_is_not_believed() {
        assert_eq!(believed([80, 24], [800, 480]), Some([10, 20]));
        for (cells, pixels) in [
            ([0, 24], [800, 480]),
            ([80, 24], [0, 0]),
            ([65535, 24], [65535, 480]),
            ([80, 24], [65535, 65535]),
            ([80, 24], [800, 24]),
        ] {
            assert_eq!(believed(cells, pixels), None, "{cells:?} {pixels:?}");
        }
    }
}
