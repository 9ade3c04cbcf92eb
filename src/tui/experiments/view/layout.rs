//! Where the parts of the pane stand.

use ratatui::layout::Rect;

use crate::tui::experiments::Focus;

/// The areas of the parts; those there is no room for have none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub struct Layout {
    pub list: Rect,
    pub about: Rect,
    pub progress: Option<Rect>,
    pub chart: Option<Rect>,
    pub table: Option<Rect>,
    pub log: Option<Rect>,
}

impl Layout {
    /// Of a pane with this area; `running` tells whether there is a run to show.
    pub fn of(area: Rect, focus: Focus, running: bool) -> Self {
        let (list, right) = columns(area, (area.width * 3 / 10).clamp(24, 46));
        let high = if right.height >= 30 { 9 } else { 7 };
        let (about, rest) = rows(right, high.min(right.height));
        let (progress, rest) = if running {
            let (progress, rest) = rows(rest, 2.min(rest.height));
            (Some(progress), rest)
        } else {
            (None, rest)
        };
        let base = Self { list, about, progress, chart: None, table: None, log: None };
        if rest.width >= 130 && rest.height >= 18 {
            let (figures, log) = rows(rest, rest.height - (rest.height / 4).clamp(5, 16));
            let (chart, table) = columns(figures, figures.width * 11 / 20);
            return Self { chart: Some(chart), table: Some(table), log: Some(log), ..base };
        }
        if rest.height >= 24 {
            let (chart, below) = rows(rest, (rest.height / 2).max(12));
            let (table, log) = rows(below, below.height * 3 / 5);
            return Self { chart: Some(chart), table: Some(table), log: Some(log), ..base };
        }
        match focus {
            Focus::List => Self { chart: Some(rest), ..base },
            Focus::Table => Self { table: Some(rest), ..base },
            Focus::Log => Self { log: Some(rest), ..base },
        }
    }
}

/// The left columns, as many as said, and the rest.
fn columns(area: Rect, left: u16) -> (Rect, Rect) {
    let left = left.min(area.width);
    (Rect { width: left, ..area }, Rect { x: area.x + left, width: area.width - left, ..area })
}

/// The upper rows, as many as said, and the rest.
fn rows(area: Rect, upper: u16) -> (Rect, Rect) {
    let upper = upper.min(area.height);
    (
        Rect { height: upper, ..area },
        Rect { y: area.y + upper, height: area.height - upper, ..area },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_fill_the_pane_and_do_not_overlap() {
        for (width, height) in [(60, 13), (80, 21), (120, 37), (200, 30), (300, 77), (80, 60)] {
            for (focus, running) in Focus::ALL.into_iter().flat_map(|f| [(f, true), (f, false)]) {
                let area = Rect::new(0, 1, width, height);
                let layout = Layout::of(area, focus, running);
                let rest = [layout.progress, layout.chart, layout.table, layout.log];
                let all: Vec<Rect> = [layout.list, layout.about]
                    .into_iter()
                    .chain(rest.into_iter().flatten())
                    .collect();
                let covered: u32 = all.iter().map(|part| part.area()).sum();
                assert_eq!(covered, area.area(), "{width} × {height}");
                let apart =
                    |(i, one): (usize, &Rect)| all[..i].iter().all(|other| !one.intersects(*other));
                assert!(all.iter().enumerate().all(apart), "{layout:?}");
            }
        }
    }
}
