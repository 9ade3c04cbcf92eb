//! Where the parts of the pane are.

use ratatui::layout::{Margin, Rect};

use super::{Focus, Results, Shown};
use crate::tui::model::Model;
use crate::tui::viewer::Look;

/// Least and most columns of the lists.
const LIST: [u16; 2] = [24, 48];
/// Rows from which the list of images has a place beside the list of scenes.
const HIGH: u16 = 30;

/// Where the parts are; each is the inside of its frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// The list of reports, or of what one holds; where there is little room the images take its place.
    pub list: Option<Rect>,
    /// The list of images that are compared.
    pub images: Option<Rect>,
    /// What is shown.
    pub shown: Rect,
}

impl Layout {
    /// Lays the pane out.
    pub fn of(model: &Model) -> Self {
        let (area, results) = (model.pane_area(), &model.results);
        let width = (area.width * 3 / 10).clamp(LIST[0], LIST[1]).min(area.width / 2);
        let left = Rect { width, ..area };
        let shown = inside(Rect { x: area.x + width, width: area.width - width, ..area });
        let images =
            compared(results).map(|count| (count + 2).min(usize::from(area.height / 2)) as u16);
        let (list, images) = match images {
            Some(rows) if area.height >= HIGH => {
                let upper = left.height - rows;
                let lower = Rect { y: left.y + upper, height: rows, ..left };
                (Some(Rect { height: upper, ..left }), Some(lower))
            }
            Some(_) if results.focus == Focus::Picture => (None, Some(left)),
            _ => (Some(left), None),
        };
        Self { list: list.map(inside), images: images.map(inside), shown }
    }

    /// The room that images have.
    pub fn look(&self, model: &Model) -> Look {
        Look { size: model.screen.pixels(self.shown), aspect: model.screen.aspect() }
    }
}

/// How many images are compared, if any are.
fn compared(results: &Results) -> Option<usize> {
    match &results.book.as_ref()?.shown {
        Shown::Images(stack) => Some(stack.compared().len()),
        _ => None,
    }
}

/// What is within a frame of one cell.
fn inside(area: Rect) -> Rect {
    area.inner(Margin::new(1, 1))
}

/// The frame about an area.
pub(super) fn outside(area: Rect) -> Rect {
    Rect::new(area.x.saturating_sub(1), area.y.saturating_sub(1), area.width + 2, area.height + 2)
}

/// The first of a list's lines, so that the chosen one is seen, in the middle if it can be.
pub(super) fn first(chosen: usize, room: usize, lines: usize) -> usize {
    chosen.saturating_sub(room / 2).min(lines.saturating_sub(room))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_chosen_line_is_always_seen() {
        for lines in 0..20 {
            for room in 1..12 {
                for chosen in 0..lines {
                    let first = first(chosen, room, lines);
                    assert!((first..first + room).contains(&chosen), "{chosen} {room} {lines}");
                }
            }
        }
    }
}
