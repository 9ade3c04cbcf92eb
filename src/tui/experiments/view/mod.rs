//! How the pane is drawn.
//!
//! ```text
//!  ┌ Experiments ┐┌ quick ──────────────────────────────┐
//!  │✓ quick  3 h ││ its question, its size, its answer   │
//!  │  sphere     ││                                      │
//!  │▶ teapot     │└──────────────────────────────────────┘
//!  │             │ the run: how far it is, what is left
//!  │             │┌ RMSE against samples ────────────────┐
//!  │             ││ chart, table and log: as many of     │
//!  │             ││ them as there is room for, else the  │
//!  └─────────────┘└ one that has the focus ──────────────┘
//! ```

mod about;
mod figures;
mod layout;
mod list;

use ratatui::Frame;
use ratatui::layout::Rect;

pub use layout::Layout;
pub use list::first_row;

use crate::tui::model::Model;
use crate::tui::picture::Gallery;

/// Draws the pane.
pub fn draw(model: &Model, _gallery: &Gallery, area: Rect, frame: &mut Frame) {
    let pane = &model.experiments;
    let layout = Layout::of(area, pane.focus, pane.is_running());
    list::draw(pane, model.now, layout.list, frame);
    about::draw(pane, model.now, layout.about, frame);
    if let (Some(run), Some(area)) = (pane.running(), layout.progress) {
        about::draw_progress(run, area, frame);
    }
    if let Some(area) = layout.chart {
        figures::draw_chart(pane, area, frame);
    }
    if let Some(area) = layout.table {
        figures::draw_table(pane, area, frame);
    }
    if let Some(area) = layout.log {
        figures::draw_log(pane, area, frame);
    }
}
