//! What keys, clicks and the thread do to the pane.

use ratatui::layout::Position;

use super::layout::first;
use super::{Book, Focus, Item, Layout, Order, Results, Shown, Told};
use crate::tui::keys::{Action, Pressed};
use crate::tui::library::Opened;
use crate::tui::message::Effect;
use crate::tui::model::Model;

/// Lines that a key for a page goes.
const PAGE: isize = 10;

impl Results {
    /// The pane is shown: what reports there are may have changed.
    pub fn enter(_model: &mut Model) -> Vec<Effect> {
        vec![Effect::Results(Order::List)]
    }

    /// Does what a key asks.
    pub fn act(model: &mut Model, pressed: Pressed) -> Vec<Effect> {
        let look = Layout::of(model).look(model);
        let results = &mut model.results;
        match pressed.action {
            Action::NextFocus | Action::PreviousFocus => results.turn_focus(),
            Action::Up => return results.go(-1),
            Action::Down => return results.go(1),
            Action::PageUp => return results.go(-PAGE),
            Action::PageDown => return results.go(PAGE),
            Action::First => return results.go(isize::MIN),
            Action::Last => return results.go(isize::MAX),
            Action::Choose => return results.choose(),
            Action::Back => results.back(),
            Action::NextScene => return results.leap(1),
            Action::PreviousScene => return results.leap(-1),
            Action::NextImage => results.step(1),
            Action::PreviousImage => results.step(-1),
            Action::Samples => return Self::next_count(model),
            Action::OpenReport => return Self::open_written(model),
            _ => {
                let Some(book) = &mut results.book else { return Vec::new() };
                if matches!(book.shown, Shown::Images(_)) {
                    book.viewer.act(pressed, look);
                } else {
                    book.scroll_by(pressed.action);
                }
            }
        }
        Vec::new()
    }

    /// Does what a click asks: a line is chosen, a line that is chosen is looked into, a pixel gets the cursor.
    pub fn click(model: &mut Model, at: Position) -> Vec<Effect> {
        let layout = Layout::of(model);
        let look = layout.look(model);
        let pixels = model.screen.pixels(layout.shown);
        let results = &mut model.results;
        if let Some(area) = layout.list.filter(|area| area.contains(at)) {
            let (chosen, lines) = results.place();
            let from = first(chosen, area.height.into(), lines);
            let line = from + usize::from(at.y - area.y);
            results.focus = Focus::List;
            return match line {
                line if line >= lines => Vec::new(),
                line if line == chosen => results.choose(),
                line => results.go(line as isize - chosen as isize),
            };
        }
        if let Some(area) = layout.images.filter(|area| area.contains(at)) {
            if let Some(book) = &mut results.book {
                book.viewer.pick((at.y - area.y).into());
            }
        } else if layout.shown.contains(at) && results.book.is_some() {
            results.focus = Focus::Picture;
            let area = layout.shown;
            let scale = |offset: u16, cells: u16, pixels: usize| {
                (2 * usize::from(offset) + 1) * pixels / (2 * usize::from(cells.max(1)))
            };
            let x = scale(at.x - area.x, area.width, pixels[0]);
            let y = scale(at.y - area.y, area.height, pixels[1]);
            if let Some(book) = &mut results.book {
                book.viewer.point(x, y, look);
            }
        }
        Vec::new()
    }

    /// Takes in what was told.
    pub fn take(model: &mut Model, told: Told) -> Vec<Effect> {
        let results = &mut model.results;
        match told {
            Told::Listed(reports) => {
                let name = results.reports.as_ref().and_then(|old| old.get(results.report));
                let name = name.map(|report| report.name.clone());
                let same = reports.iter().position(|report| Some(&report.name) == name.as_ref());
                results.report =
                    same.unwrap_or(results.report).min(reports.len().saturating_sub(1));
                results.reports = Some(reports);
            }
            Told::Opened(report) => return Self::take_opened(model, *report),
            Told::Film(ticket, place, read) if ticket == results.ticket => {
                let problem = results.book.as_mut().and_then(|book| book.hang(place, read));
                problem.into_iter().for_each(|text| model.say(text, true));
            }
            Told::Plot(ticket, read) if ticket == results.ticket => match (read, &mut results.book)
            {
                (Ok(plot), Some(book)) => book.shown = Shown::Plot(Some(plot)),
                (Err(text), Some(book)) => {
                    book.shown = Shown::Nothing;
                    model.say(text, true);
                }
                _ => {}
            },
            // Of what is no longer looked at.
            Told::Film(..) | Told::Plot(..) => {}
        }
        Vec::new()
    }

    fn take_opened(model: &mut Model, report: Opened) -> Vec<Effect> {
        let results = &mut model.results;
        if results.opening.as_ref() != Some(&report.folder) {
            return Vec::new();
        }
        results.opening = None;
        results.focus = Focus::List;
        let mut problems = report.problems.clone();
        let book = Book::of(report);
        if book.items.is_empty() && problems.is_empty() {
            problems.push("this report holds neither images nor plots".to_owned());
        }
        results.book = Some(book);
        if let Some(problem) = problems.first() {
            let more = problems.len() - 1;
            let more = if more == 0 { String::new() } else { format!(" (and {more} more)") };
            model.say(format!("{problem}{more}"), true);
        }
        model.results.turn()
    }

    /// The line chosen in the list that is shown, and how many there are.
    pub fn place(&self) -> (usize, usize) {
        match &self.book {
            Some(book) => (book.item, book.items.len()),
            None => (self.report, self.reports.as_ref().map_or(0, Vec::len)),
        }
    }

    fn turn_focus(&mut self) {
        self.focus = match self.focus {
            Focus::List if self.book.is_some() => Focus::Picture,
            _ => Focus::List,
        };
    }

    /// Goes along the list.
    fn go(&mut self, by: isize) -> Vec<Effect> {
        let (at, lines) = self.place();
        let to = at.saturating_add_signed(by).min(lines.saturating_sub(1));
        match &mut self.book {
            None => self.report = to,
            Some(book) if to != at => {
                book.item = to;
                return self.turn();
            }
            Some(_) => {}
        }
        Vec::new()
    }

    /// Goes to the next scene or row, or the one before.
    fn leap(&mut self, by: isize) -> Vec<Effect> {
        let Some(book) = &self.book else { return self.go(by) };
        let leads = |item: &usize| book.items[*item].leads();
        let to = match by {
            1 => (book.item + 1..book.items.len()).find(leads),
            _ => (0..book.item).rev().find(leads),
        };
        to.map_or_else(Vec::new, |to| self.go(to as isize - self.place().0 as isize))
    }

    fn choose(&mut self) -> Vec<Effect> {
        if self.book.is_some() {
            self.focus = Focus::Picture;
            return Vec::new();
        }
        let report = self.reports.as_ref().and_then(|all| all.get(self.report));
        let Some(folder) = report.map(|report| report.folder.clone()) else { return Vec::new() };
        self.opening = Some(folder.clone());
        vec![Effect::Results(Order::Open(folder))]
    }

    fn back(&mut self) {
        self.opening = None;
        match self.focus {
            Focus::Picture => self.focus = Focus::List,
            Focus::List => self.book = None,
        }
    }

    /// Asks for what is chosen.
    fn turn(&mut self) -> Vec<Effect> {
        let Some(book) = &mut self.book else { return Vec::new() };
        let files = book.turn_to();
        self.ticket += 1;
        let order = match (&book.shown, files.first()) {
            (_, None) => return Vec::new(),
            (Shown::Plot(_), Some((_, path))) => Order::Plot(self.ticket, path.clone()),
            _ => Order::Films(self.ticket, files),
        };
        vec![Effect::Results(order)]
    }

    /// Goes to the next image on the side shown, or the one before, round and round: there may be more than digits.
    fn step(&mut self, by: isize) {
        if let Some(book) = &mut self.book
            && !book.viewer.shots.is_empty()
        {
            let at = book.viewer.side(book.viewer.on) as isize + by;
            book.viewer.pick(at.rem_euclid(book.viewer.shots.len() as isize) as usize);
        }
    }

    fn next_count(model: &mut Model) -> Vec<Effect> {
        let Some(book) = &mut model.results.book else { return Vec::new() };
        if let Shown::Images(stack) = &mut book.shown {
            stack.count = (stack.count + 1) % stack.counts.len().max(1);
            let told =
                stack.counts.get(stack.count).map(|count| format!("{count} samples a pixel"));
            book.look();
            told.into_iter().for_each(|told| model.say(told, false));
        }
        Vec::new()
    }

    fn open_written(model: &mut Model) -> Vec<Effect> {
        let results = &model.results;
        let folder = match (&results.book, &results.reports) {
            (Some(book), _) => Some(book.report.folder.clone()),
            (None, Some(reports)) => {
                reports.get(results.report).map(|report| report.folder.clone())
            }
            _ => None,
        };
        folder.map_or_else(Vec::new, |folder| vec![Effect::Open(folder.join("report.html"))])
    }
}

impl Book {
    /// Goes through text; it stops where the last line is seen, when it is drawn.
    fn scroll_by(&mut self, action: Action) {
        self.scroll = match (action, self.chosen()) {
            (Action::CursorUp, Some(Item::Row(_))) => self.scroll.saturating_sub(1),
            (Action::CursorDown, Some(Item::Row(_))) => self.scroll + 1,
            _ => return,
        };
    }
}
