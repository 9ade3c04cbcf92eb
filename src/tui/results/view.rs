//! The pane on the screen.
//!
//! ```text
//!  ┌ quick ───────────┐╔ A fournier 1 spp ══════════════╗
//!  │▸twill-ggx-0.2-2  │║                                ║
//!  │ plot samples     │║           the picture          ║
//!  ├ Images ──────────┤║                                ║
//!  │0    reference    │║                                ║
//!  │1 A  fournier 0.01│║                                ║
//!  └──────────────────┘╚ (80, 60)  R 1.20  A 1.10 ══════╝
//! ```

use std::path::Path;
use std::sync::Arc;

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::Line;
use ratatui::widgets::Paragraph;

use super::layout::{first, outside};
use super::text::{about, claims, columns, mark, paragraph, shortened};
use super::{Book, Focus, Item, Layout, Results, Shown, Stack};
use crate::experiment::results::Picture;
use crate::tui::model::Model;
use crate::tui::picture::{Flat, Gallery, Paint, Slot, Stamp};
use crate::tui::view::panel;
use crate::tui::viewer::values;

/// Where the pane's pictures are.
const IMAGE: Slot = Slot(8);
const PLOT: Slot = Slot(9);
/// Rows that a plot below text has at least.
const PLOT_ROWS: u16 = 8;

/// Draws the pane.
pub fn draw(model: &Model, gallery: &Gallery, _area: Rect, frame: &mut Frame) {
    let (results, layout) = (&model.results, Layout::of(model));
    if let Some(area) = layout.list {
        list(results, area, frame);
    }
    if let (Some(area), Some(book)) = (layout.images, &results.book)
        && let Shown::Images(stack) = &book.shown
    {
        images(book, stack, area, frame);
    }
    match &results.book {
        Some(book) => shown(model, book, gallery, layout.shown, frame),
        None => report(model, layout.shown, frame),
    }
}

fn list(results: &Results, area: Rect, frame: &mut Frame) {
    let (title, names) = match &results.book {
        Some(book) => {
            let folder = book.report.folder.as_path();
            (last_part(folder), book.items.iter().map(|item| name(book, *item)).collect())
        }
        None => ("Reports".to_owned(), report_names(results)),
    };
    let focus = results.focus == Focus::List;
    frame.render_widget(panel(&title, focus), outside(area));
    let (chosen, lines) = results.place();
    let room = usize::from(area.height);
    let line = |(place, name): (usize, String)| {
        let here = place == chosen;
        let name = shortened(&name, usize::from(area.width).saturating_sub(1));
        let text = format!("{}{name}", if here { "▸" } else { " " });
        let style = if here && focus { Modifier::REVERSED } else { Modifier::empty() };
        Line::styled(text, Style::new().add_modifier(style))
    };
    let shown = names.into_iter().enumerate().skip(first(chosen, room, lines)).take(room);
    frame.render_widget(Paragraph::new(shown.map(line).collect::<Vec<_>>()), area);
}

fn last_part(folder: &Path) -> String {
    crate::tui::model::plain(&folder.file_name().unwrap_or_default().to_string_lossy())
}

/// An item's name; a row has its verdict's mark before it.
fn name(book: &Book, item: Item) -> String {
    match item {
        Item::Row(i) => format!("{} {}", mark(book.report.paper[i].verdict()), book.name(item)),
        _ => book.name(item),
    }
}

/// The reports' names, `!` after those that are not whole.
fn report_names(results: &Results) -> Vec<String> {
    let reports = results.reports.iter().flatten();
    let name = |report: &crate::tui::library::Report| {
        format!("{}{}", report.name, if report.problems.is_empty() { "" } else { " !" })
    };
    reports.map(name).collect()
}

/// What is told of the report chosen in the list.
fn report(model: &Model, area: Rect, frame: &mut Frame) {
    let results = &model.results;
    let chosen = results.reports.as_ref().and_then(|all| all.get(results.report));
    let width = usize::from(area.width);
    let (title, lines) = match (chosen, &results.reports, &results.opening) {
        (Some(report), _, Some(_)) => (report.name.clone(), vec![Line::raw("Opening …")]),
        (Some(report), ..) => (report.name.clone(), about(report, model.now, width)),
        (None, None, _) => (String::new(), vec![Line::raw("Looking for reports …")]),
        (None, Some(_), _) => {
            let text =
                "There are no reports yet. Run an experiment (E), and its report is found here.";
            (String::new(), paragraph("", text, width, Style::new()))
        }
    };
    frame.render_widget(panel(&title, false), outside(area));
    frame.render_widget(Paragraph::new(lines), area);
}

/// The images that are compared: their keys, sides and errors.
fn images(book: &Book, stack: &Stack, area: Rect, frame: &mut Frame) {
    let title = match stack.counts.get(stack.count) {
        Some(count) if stack.counts.len() > 1 => format!("Images, {count} spp"),
        _ => "Images".to_owned(),
    };
    frame.render_widget(panel(&title, false), outside(area));
    let viewer = &book.viewer;
    let line = |(number, place): (usize, usize)| {
        let image = &stack.images[place];
        let key = if number < 10 { number.to_string() } else { " ".to_owned() };
        let side =
            |i: usize, name: &'static str| if viewer.sides[i] == number { name } else { " " };
        let error = match (image.failed, image.rmse) {
            (true, _) => "missing".to_owned(),
            (false, Some(rmse)) => format!("{rmse:.3}"),
            (false, None) => String::new(),
        };
        let head = format!("{key} {}{} ", side(0, "A"), side(1, "B"));
        let room = usize::from(area.width).saturating_sub(columns(&head) + columns(&error) + 1);
        let label = shortened(&image.label, room);
        let gap = " ".repeat(room.saturating_sub(columns(&label)) + 1);
        let shown = viewer.side(viewer.on) == number;
        let style = if shown { Modifier::BOLD } else { Modifier::empty() };
        Line::styled(format!("{head}{label}{gap}{error}"), Style::new().add_modifier(style))
    };
    let lines: Vec<Line> = stack.compared().into_iter().enumerate().map(line).collect();
    frame.render_widget(Paragraph::new(lines), area);
}

/// What is chosen in a report.
fn shown(model: &Model, book: &Book, gallery: &Gallery, area: Rect, frame: &mut Frame) {
    let focus = model.results.focus == Focus::Picture;
    match (&book.shown, book.chosen()) {
        (Shown::Images(_), _) => compared(book, focus, gallery, area, frame),
        (_, Some(Item::Row(i))) => row(model, book, i, gallery, area, frame),
        (Shown::Plot(plot), Some(item)) => {
            frame.render_widget(panel(book.name(item).trim(), focus), outside(area));
            picture(model, plot.as_ref(), gallery, area, frame);
        }
        _ => {
            frame.render_widget(panel(&book.report.title, focus), outside(area));
            let told = book.report.problems.iter();
            let lines =
                told.flat_map(|text| paragraph("! ", text, area.width.into(), Style::new()));
            frame.render_widget(Paragraph::new(lines.collect::<Vec<_>>()), area);
        }
    }
}

fn compared(book: &Book, focus: bool, gallery: &Gallery, area: Rect, frame: &mut Frame) {
    let viewer = &book.viewer;
    let title = viewer.caption();
    let under = viewer.under_cursor().unwrap_or_default();
    let block = panel(&title, focus).title_bottom(format!(" {under} "));
    frame.render_widget(block, outside(area));
    if viewer.numbers {
        values(viewer, area, frame.buffer_mut());
        return;
    }
    let sight = viewer.sight();
    let stamp = Stamp { picture: sight.stamp(), version: 0 };
    let paint: Arc<dyn Paint> = Arc::new(sight);
    gallery.show(IMAGE, stamp, &paint, area, frame.buffer_mut());
}

/// A row's claims, and its first plot below them where there is room.
fn row(model: &Model, book: &Book, i: usize, gallery: &Gallery, area: Rect, frame: &mut Frame) {
    let row = &book.report.paper[i];
    let focus = model.results.focus == Focus::Picture;
    let lines = claims(row, area.width.into());
    let plot = match &book.shown {
        Shown::Plot(plot) if area.height > lines.len() as u16 + PLOT_ROWS => Some(plot.as_ref()),
        _ => None,
    };
    let high = if plot.is_some() { lines.len() as u16 + 1 } else { area.height };
    let from = book.scroll.min(lines.len().saturating_sub(usize::from(high)));
    let below = lines.len() - from > usize::from(high);
    let title = format!("{}{}", row.name, if below { ", ↓ for more" } else { "" });
    frame.render_widget(panel(&title, focus), outside(area));
    let text = Rect { height: high.min(area.height), ..area };
    frame.render_widget(Paragraph::new(lines.into_iter().skip(from).collect::<Vec<_>>()), text);
    if let Some(plot) = plot {
        let rest = Rect { y: area.y + high, height: area.height - high, ..area };
        picture(model, plot, gallery, rest, frame);
    }
}

fn picture(
    model: &Model,
    plot: Option<&Arc<Picture>>,
    gallery: &Gallery,
    area: Rect,
    frame: &mut Frame,
) {
    let Some(plot) = plot else {
        frame.render_widget(Paragraph::new("Reading …"), area);
        return;
    };
    let stamp = Stamp { picture: model.results.ticket, version: 0 };
    let paint: Arc<dyn Paint> = Arc::new(Flat(Arc::clone(plot)));
    gallery.show(PLOT, stamp, &paint, area, frame.buffer_mut());
}
