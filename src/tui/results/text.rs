//! Words of the pane: a report's answer, a row's claims, times gone by.

use std::time::SystemTime;

use ratatui::style::{Color, Modifier, Style};
use ratatui::text::{Line, Span};

use crate::evidence::Verdict;
use crate::report::phrase;
use crate::tui::library::{Kind, PaperRow, Report};
use crate::tui::view::words::wrapped;

/// A verdict's mark, so that it is told without colour.
pub(super) fn mark(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Reproduced => "=",
        Verdict::Differs => "≠",
        Verdict::NotApplicable => "·",
    }
}

/// How a verdict looks.
pub(super) fn style(verdict: Verdict) -> Style {
    match verdict {
        Verdict::Reproduced => Style::new().fg(Color::Green),
        Verdict::Differs => Style::new().fg(Color::Red).add_modifier(Modifier::BOLD),
        Verdict::NotApplicable => Style::new(),
    }
}

/// What is told of a report before it is looked into.
pub(super) fn about(report: &Report, now: SystemTime, width: usize) -> Vec<Line<'static>> {
    let kind = if report.kind == Kind::Paper { "a paper's evidence" } else { "a sweep" };
    let written = report
        .written
        .map_or("not written yet".to_owned(), |then| format!("written {}", ago(now, then)));
    let mut lines = vec![Line::raw(format!("{kind}, {written}")), Line::raw("")];
    for problem in &report.problems {
        lines.extend(paragraph("! ", &format!("{problem}."), width, BOLD));
    }
    if !report.problems.is_empty() {
        lines.push(Line::raw(""));
    }
    for text in &report.lead {
        lines.extend(paragraph("", text, width, Style::new()));
        lines.push(Line::raw(""));
    }
    lines
}

const BOLD: Style = Style::new().add_modifier(Modifier::BOLD);

/// A paper's row with its claims: what, the paper's, ours, the verdict and why.
pub(super) fn claims(row: &PaperRow, width: usize) -> Vec<Line<'static>> {
    let mut lines = paragraph("", &row.title, width, BOLD);
    if row.claims.is_empty() {
        lines.push(Line::raw(""));
        lines.push(Line::raw("It claims nothing that could be held against a number."));
    }
    for claim in &row.claims {
        lines.push(Line::raw(""));
        let verdict = format!("{} {}", mark(claim.verdict), claim.verdict.text());
        lines.push(Line::from(Span::styled(verdict, style(claim.verdict))));
        lines.extend(paragraph("  claim   ", &claim.what, width, Style::new()));
        // Full precision is for files.
        let here = claim.here.parse().map_or_else(|_| claim.here.clone(), phrase::number);
        let parts = [
            ("paper", &claim.paper),
            ("here", &here),
            ("rule", &claim.rule),
            ("because", &claim.because),
        ];
        for (name, text) in parts.into_iter().filter(|(_, text)| !text.is_empty()) {
            lines.extend(paragraph(&format!("  {name:8}"), text, width, Style::new()));
        }
    }
    lines
}

/// A text in lines of this width; the first begins with `head`, the others are set in as far.
pub(super) fn paragraph(head: &str, text: &str, width: usize, style: Style) -> Vec<Line<'static>> {
    let indent = columns(head);
    let room = width.saturating_sub(indent).max(8);
    let rows = wrapped(text, u16::try_from(room).unwrap_or(u16::MAX));
    let line = |(i, row): (usize, String)| {
        let start = if i == 0 { head.to_owned() } else { " ".repeat(indent) };
        Line::from(Span::styled(start + &row, style))
    };
    rows.into_iter().enumerate().map(line).collect()
}

/// Columns a text takes.
pub(super) fn columns(text: &str) -> usize {
    Span::raw(text).width()
}

/// A name that fits its room: of one that is too long both ends are kept, as names of scenes differ in either.
pub(super) fn shortened(name: &str, room: usize) -> String {
    if columns(name) <= room {
        return name.to_owned();
    }
    let mut ends = [String::new(), String::new()];
    let (mut front, mut back) = (name.chars(), name.chars().rev());
    for turn in 0.. {
        // Two at the end for one at the beginning.
        let (end, next) = if turn % 3 == 0 { (0, front.next()) } else { (1, back.next()) };
        let Some(next) = next else { break };
        let taken = columns(&ends[0]) + columns(&ends[1]) + columns(next.encode_utf8(&mut [0; 4]));
        if taken + 1 > room {
            break;
        }
        ends[end].push(next);
    }
    let [front, back] = ends;
    format!("{front}…{}", back.chars().rev().collect::<String>())
}

/// How long ago something was.
fn ago(now: SystemTime, then: SystemTime) -> String {
    let Ok(gone) = now.duration_since(then) else { return "just now".to_owned() };
    let minutes = gone.as_secs() / 60;
    let (count, unit) = match minutes {
        0 => return "just now".to_owned(),
        1..60 => (minutes, "minute"),
        60..2880 => (minutes / 60, "hour"),
        _ => (minutes / 1440, "day"),
    };
    format!("{count} {unit}{} ago", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn times_are_told_in_units_of_their_size() {
        let now = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000);
        let told = |secs| ago(now, now - Duration::from_secs(secs));
        assert_eq!(told(59), "just now");
        assert_eq!(told(61), "1 minute ago");
        assert_eq!(told(7_300), "2 hours ago");
        assert_eq!(told(200_000), "2 days ago");
        assert_eq!(ago(now, now + Duration::from_secs(9)), "just now");
    }

    #[test]
    fn lines_are_set_in_below_their_head() {
        let lines = paragraph("  here ", "one two three", 15, Style::new());
        let lines: Vec<String> = lines.iter().map(ToString::to_string).collect();
        assert_eq!(lines, ["  here one two", "       three"]);
    }

    #[test]
    fn long_names_keep_both_ends() {
        assert_eq!(shortened("small-twill-ggx-0.2-16-texels", 16), "small…-16-texels");
        assert_eq!(shortened("short", 5), "short");
        assert_eq!(shortened("界界界界", 5).chars().count(), 3);
    }

    proptest! {
        #[test]
        fn no_line_is_wider_than_its_room(text in "[a-z界 ]{0,80}", width in 12..60_usize) {
            let lines = paragraph("ab  ", &text, width, Style::new());
            prop_assert!(lines.iter().all(|line| line.width() <= width));
            let kept: String = lines.iter().map(ToString::to_string).collect();
            let letters = |text: &str| text.chars().filter(|c| !c.is_whitespace()).collect::<String>();
            prop_assert_eq!(letters(&kept), format!("ab{}", letters(&text)));
        }
    }
}
