//! Pictures hung in their slots: drawn by the terminal's protocol where an encoding is at hand, else in cells.
//!
//! A terminal keeps what it was sent, so leftovers must be thought of. Sixels and iTerm2's images are written with one
//! cell and the others skipped; ratatui compares cells with their skipping, so a cell that becomes text again is
//! written and overdraws the picture. But a popup would overdraw what is not written again when it closes, so a picture
//! under a popup ([`Gallery::cover`]) is drawn in cells. Kitty's pictures stand behind placeholders that text replaces,
//! and are sent once: what is sent while a popup hides the first cell would be lost. They too are drawn in cells then.
//! After the screen was left or cleared, [`Gallery::forget`]: the terminal may have dropped its pictures.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, VecDeque};
use std::fmt::Write;
use std::sync::Arc;

use ratatui::buffer::Buffer;
use ratatui::layout::{Rect, Size};
use ratatui::widgets::Widget;
use ratatui_image::Image;
use ratatui_image::picker::{ProtocolType, cap_parser::Parser};
use ratatui_image::protocol::Protocol;

use super::encoder::{Encoded, KITTY_TURNS, Wish, kitty_number};
use super::screen::{Screen, Way};
use super::{Paint, Slot, Stamp, cells};
use crate::experiment::results::Picture;

/// Encodings kept a slot, so that flipping to and fro is at once. Fewer than kitty's numbers in turn.
const KEPT: usize = 6;

/// The pictures on the screen, and how they are drawn there.
pub struct Gallery {
    screen: Screen,
    hooks: RefCell<BTreeMap<Slot, Hook>>,
    wishes: RefCell<Vec<Wish>>,
    covered: Cell<Option<Rect>>,
}

/// What hangs in a slot.
#[derive(Default)]
struct Hook {
    /// The last painted for cells.
    painted: Option<(Stamp, Size, Picture)>,
    /// Encodings, oldest first; none where encoding failed.
    encoded: VecDeque<(Stamp, Size, Option<Protocol>)>,
    /// The last wished for.
    asked: Option<(Stamp, Size)>,
}

impl Gallery {
    /// An empty gallery on this terminal.
    pub fn new(screen: Screen) -> Self {
        let (hooks, wishes) = (RefCell::default(), RefCell::default());
        Self { screen, hooks, wishes, covered: Cell::new(None) }
    }

    /// What the terminal can show.
    pub fn screen(&self) -> &Screen {
        &self.screen
    }

    /// Tells, before a frame is drawn, what a popup will cover in it.
    pub fn cover(&self, popup: Option<Rect>) {
        self.covered.set(popup);
    }

    /// Draws a picture: by the protocol if its encoding is here (or that of an earlier version of it), else in cells.
    /// In that case the encoding is wished for.
    pub fn show(
        &self,
        slot: Slot,
        stamp: Stamp,
        paint: &Arc<dyn Paint>,
        area: Rect,
        buf: &mut Buffer,
    ) {
        let area = area.intersection(buf.area);
        if area.is_empty() {
            return;
        }
        let mut hooks = self.hooks.borrow_mut();
        let hook = hooks.entry(slot).or_default();
        let covered = self.covered.get().is_some_and(|popup| popup.intersects(area));
        if matches!(self.screen.way, Way::Protocol(_)) && !covered {
            self.wish(hook, slot, stamp, paint, area.as_size());
            if let Some(protocol) = hook.find(stamp, area.as_size()) {
                Image::new(protocol).render(area, buf);
                return;
            }
        }
        self.in_cells(hook, stamp, paint, area, buf);
    }

    fn wish(&self, hook: &mut Hook, slot: Slot, stamp: Stamp, paint: &Arc<dyn Paint>, size: Size) {
        let here = hook.encoded.iter().any(|(s, z, _)| (*s, *z) == (stamp, size));
        if !here && hook.asked != Some((stamp, size)) {
            hook.asked = Some((stamp, size));
            let paint = Arc::clone(paint);
            self.wishes.borrow_mut().push(Wish { slot, stamp, paint, size });
        }
    }

    fn in_cells(
        &self,
        hook: &mut Hook,
        stamp: Stamp,
        paint: &Arc<dyn Paint>,
        area: Rect,
        buf: &mut Buffer,
    ) {
        let screen = self.screen.in_cells();
        let size = area.as_size();
        if !matches!(&hook.painted, Some((s, z, _)) if (*s, *z) == (stamp, size)) {
            let painted = paint.paint(screen.pixels(area), screen.aspect());
            hook.painted = Some((stamp, size, painted));
        }
        if let Some((_, _, painted)) = &hook.painted {
            cells::draw(painted, area, screen.way, buf);
        }
    }

    /// What the frames drawn so far wished to have encoded; each wish is handed out once.
    pub fn take_wishes(&self) -> Vec<Wish> {
        self.wishes.take()
    }

    /// Hangs an encoding; the next frame shows it.
    pub fn hang(&self, encoded: Encoded) {
        let mut hooks = self.hooks.borrow_mut();
        let hook = hooks.entry(encoded.slot).or_default();
        let Encoded { stamp, size, protocol, .. } = encoded;
        // Of one picture only the latest version is of use, and of one size only: areas change for good.
        hook.encoded.retain(|(s, z, _)| s.picture != stamp.picture && *z == size);
        hook.encoded.push_back((stamp, size, protocol));
        if hook.encoded.len() > KEPT {
            hook.encoded.pop_front();
        }
    }

    /// Forgets all encodings: the terminal may have dropped what it was sent. The next frame wishes anew.
    pub fn forget(&self) {
        self.hooks.borrow_mut().clear();
    }

    /// What to send a terminal before its screen is left, so that it keeps no picture: kitty's are deleted; the others
    /// went with their cells.
    pub fn farewell(&self) -> String {
        let mut text = String::new();
        if self.screen.way == Way::Protocol(ProtocolType::Kitty) {
            let (start, escape, end) = Parser::tmux_start_escape_end(self.screen.tmux);
            let numbers = |slot: &Slot| {
                let slot = *slot;
                (0..KITTY_TURNS).map(move |turn| kitty_number(slot, turn))
            };
            for number in self.hooks.borrow().keys().flat_map(numbers) {
                let _ = write!(text, "{start}{escape}_Ga=d,d=I,i={number},q=2{escape}\\{end}");
            }
        }
        text
    }
}

impl Hook {
    /// The encoding of this picture at this size, of whichever version.
    fn find(&self, stamp: Stamp, size: Size) -> Option<&Protocol> {
        let fits =
            |(s, z, _): &&(Stamp, Size, Option<Protocol>)| s.picture == stamp.picture && *z == size;
        self.encoded.iter().rev().find(fits).and_then(|(_, _, protocol)| protocol.as_ref())
    }
}

#[cfg(test)]
mod tests {
    use ratatui::buffer::CellDiffOption;
    use ratatui_image::protocol::sixel::Sixel;

    use super::super::{Depth, Flat};
    use super::*;

    const AREA: Rect = Rect::new(1, 1, 4, 2);

    fn gallery(kind: ProtocolType) -> Gallery {
        Gallery::new(Screen { way: Way::Protocol(kind), ..Screen::plain(Depth::True) })
    }

    fn stamp(picture: u64, version: u64) -> Stamp {
        Stamp { picture, version }
    }

    fn frame(gallery: &Gallery, stamp: Stamp) -> Buffer {
        let mut buf = Buffer::empty(Rect::new(0, 0, 8, 4));
        let rgb = vec![[9; 3]; 4];
        let paint: Arc<dyn Paint> = Arc::new(Flat(Arc::new(Picture { width: 2, height: 2, rgb })));
        gallery.show(Slot(0), stamp, &paint, AREA, &mut buf);
        buf
    }

    fn sixel(stamp: Stamp) -> Encoded {
        let size = AREA.as_size();
        let protocol = Protocol::Sixel(Sixel { data: "SIXEL".into(), size, is_tmux: false });
        Encoded { slot: Slot(0), stamp, size, protocol: Some(protocol) }
    }

    #[test]
    fn half_blocks_stand_in_until_the_encoding_comes() {
        let gallery = gallery(ProtocolType::Sixel);
        assert_eq!(frame(&gallery, stamp(1, 1))[(1, 1)].symbol(), "▀");
        frame(&gallery, stamp(1, 1));
        assert_eq!(gallery.take_wishes().len(), 1, "wished for once");
        gallery.hang(sixel(stamp(1, 1)));
        let drawn = frame(&gallery, stamp(1, 1));
        assert_eq!(drawn[(1, 1)].symbol(), "SIXEL");
        assert_eq!(drawn[(2, 2)].diff_option, CellDiffOption::Skip);
        assert!(gallery.take_wishes().is_empty());
    }

    #[test]
    fn an_earlier_version_stands_in_but_no_other_picture() {
        let gallery = gallery(ProtocolType::Sixel);
        gallery.hang(sixel(stamp(1, 1)));
        assert_eq!(frame(&gallery, stamp(1, 2))[(1, 1)].symbol(), "SIXEL");
        assert_eq!(gallery.take_wishes()[0].stamp, stamp(1, 2));
        assert_eq!(frame(&gallery, stamp(2, 1))[(1, 1)].symbol(), "▀");
    }

    #[test]
    fn flipping_back_needs_no_new_encoding() {
        let gallery = gallery(ProtocolType::Sixel);
        gallery.hang(sixel(stamp(1, 1)));
        gallery.hang(sixel(stamp(2, 1)));
        for picture in [1, 2, 1] {
            assert_eq!(frame(&gallery, stamp(picture, 1))[(1, 1)].symbol(), "SIXEL");
        }
        assert!(gallery.take_wishes().is_empty());
    }

    /// The cells a terminal is sent between two frames.
    fn sent(before: &Buffer, after: &Buffer) -> Vec<(u16, u16)> {
        before.diff(after).into_iter().map(|(x, y, _)| (x, y)).collect()
    }

    #[test]
    fn a_picture_left_is_overdrawn_cell_by_cell() {
        let gallery = gallery(ProtocolType::Sixel);
        gallery.hang(sixel(stamp(1, 1)));
        let shown = frame(&gallery, stamp(1, 1));
        let empty = Buffer::empty(shown.area);
        let mut cells: Vec<_> = AREA.positions().map(|p| (p.x, p.y)).collect();
        cells.sort_by_key(|(x, y)| (*y, *x));
        assert_eq!(sent(&shown, &empty), cells);
    }

    #[test]
    fn a_popup_turns_the_picture_into_cells_and_back() {
        let gallery = gallery(ProtocolType::Sixel);
        gallery.hang(sixel(stamp(1, 1)));
        let shown = frame(&gallery, stamp(1, 1));
        gallery.cover(Some(Rect::new(3, 2, 4, 2)));
        let covered = frame(&gallery, stamp(1, 1));
        assert!(AREA.positions().all(|p| covered[p].symbol() == "▀"));
        assert_eq!(sent(&shown, &covered).len(), 8, "every cell is overdrawn");
        gallery.cover(None);
        assert_eq!(sent(&covered, &frame(&gallery, stamp(1, 1))), [(1, 1)], "sent again whole");
    }

    #[test]
    fn failure_is_not_tried_again_and_again() {
        let gallery = gallery(ProtocolType::Sixel);
        gallery.hang(Encoded { protocol: None, ..sixel(stamp(1, 1)) });
        assert_eq!(frame(&gallery, stamp(1, 1))[(1, 1)].symbol(), "▀");
        assert!(gallery.take_wishes().is_empty());
    }

    #[test]
    fn a_forgotten_picture_is_wished_for_anew() {
        let gallery = gallery(ProtocolType::Kitty);
        gallery.hang(sixel(stamp(1, 1)));
        gallery.forget();
        frame(&gallery, stamp(1, 1));
        assert_eq!(gallery.take_wishes().len(), 1);
        assert_eq!(gallery.farewell().matches("a=d").count(), KITTY_TURNS as usize);
    }
}
