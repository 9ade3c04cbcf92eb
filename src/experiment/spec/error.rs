//! What is wrong with a spec, and where.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// One thing wrong with a spec.
///
/// It displays as plain text, without colour:
///
/// ```text
/// experiments/gloss.toml:5:1: unknown key `widht` in [image]
///   |
/// 5 | widht = 160
///   | ^^^^^
///   = did you mean `width`? The keys of [image] are `width` and `height`
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpecError {
    /// The spec's file, as it was given.
    pub path: PathBuf,
    /// Bytes of the text it is about.
    pub span: Range<usize>,
    /// Line of the span's start, from 1.
    pub line: usize,
    /// Column of the span's start, in characters from 1.
    pub column: usize,
    /// What is wrong, without a full stop.
    pub message: String,
    /// What to do about it, if there is more to say.
    pub help: Option<String>,
    /// The line of the span's start, as written.
    pub source_line: String,
    /// Characters of that line the span covers, at least 1.
    pub underline: usize,
}

impl SpecError {
    /// An error about the bytes `span` of `text`; a span past the end is about the end.
    pub(super) fn new(
        path: &Path,
        text: &str,
        span: Range<usize>,
        message: String,
        help: Option<String>,
    ) -> Self {
        let start = floor_boundary(text, span.start);
        let end = floor_boundary(text, span.end).max(start);
        let line_start = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
        let rest = &text[line_start..];
        let source_line = rest.split('\n').next().unwrap_or("").trim_end_matches('\r');
        let line_end = (line_start + source_line.len()).max(start);
        Self {
            path: path.to_owned(),
            line: text[..line_start].matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
            underline: text[start..end.min(line_end)].chars().count().max(1),
            source_line: source_line.to_owned(),
            span: start..end,
            message,
            help,
        }
    }
}

/// The greatest character boundary of `text` at or below `index`.
fn floor_boundary(text: &str, index: usize) -> usize {
    (0..=index.min(text.len())).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

impl fmt::Display for SpecError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { path, line, column, message, .. } = self;
        let gutter = line.to_string().len();
        // Tabs stay tabs, so that the caret stands under its text however wide they are shown.
        let indent: String = (self.source_line.chars().chain(std::iter::repeat(' ')))
            .take(column - 1)
            .map(|c| if c == '\t' { '\t' } else { ' ' })
            .collect();
        writeln!(f, "{}:{line}:{column}: {message}", path.display())?;
        writeln!(f, "{:gutter$} |", "")?;
        writeln!(f, "{line} | {}", self.source_line)?;
        write!(f, "{:gutter$} | {indent}{}", "", "^".repeat(self.underline))?;
        if let Some(help) = &self.help {
            write!(f, "\n{:gutter$} = {help}", "")?;
        }
        Ok(())
    }
}

impl std::error::Error for SpecError {}

/// Why there is no spec.
#[derive(Debug, thiserror::Error)]
pub enum SpecErrors {
    /// The file could not be read.
    #[error("{}: cannot read the experiment: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// Everything wrong with the text, in its order; at least one.
    #[error("{}", listed(.0))]
    Invalid(Vec<SpecError>),
}

impl SpecErrors {
    /// The errors that have a place in the text.
    pub fn errors(&self) -> &[SpecError] {
        match self {
            Self::Unreadable { .. } => &[],
            Self::Invalid(errors) => errors,
        }
    }
}

/// All errors, a blank line between them, and how many if there are several.
fn listed(errors: &[SpecError]) -> String {
    let mut parts: Vec<String> = errors.iter().map(ToString::to_string).collect();
    if let [first, _, ..] = errors {
        parts.push(format!("{} errors in {}", errors.len(), first.path.display()));
    }
    parts.join("\n\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn shown(text: &str, span: Range<usize>) -> String {
        let error = SpecError::new(Path::new("x.toml"), text, span, "odd".into(), None);
        error.to_string()
    }

    #[test]
    fn columns_count_characters_and_tabs_stay_tabs() {
        let text = "a = 1\n\tπ = 'ö' # ü\r\n";
        let span = text.find("'ö'").unwrap();
        let error = SpecError::new(Path::new("x.toml"), text, span..span + 4, "odd".into(), None);
        assert_eq!((error.line, error.column, error.underline), (2, 6, 3));
        assert_eq!(error.to_string(), "x.toml:2:6: odd\n  |\n2 | \tπ = 'ö' # ü\n  | \t    ^^^");
    }

    #[test]
    fn a_span_over_lines_is_underlined_to_the_end_of_its_first() {
        assert_eq!(shown("a = [\n1]\n", 4..8), "x.toml:1:5: odd\n  |\n1 | a = [\n  |     ^");
    }

    proptest! {
        #[test]
        fn no_span_of_any_text_panics(text in "[aé\t\r\n]{0,12}", from in 0usize..40, to in 0usize..40) {
            let shown = shown(&text, from..to);
            prop_assert!(shown.contains('^'));
        }
    }
}
