//! Words on lines of a width.

use ratatui::text::Span;

/// A text broken between words into lines of this width; words that are longer are broken too.
pub fn wrapped(text: &str, width: u16) -> Vec<String> {
    let width = usize::from(width.max(1));
    let mut lines = vec![String::new()];
    let wide = |text: &str| Span::raw(text).width();
    for word in text.split_whitespace() {
        let line = lines.last_mut().expect("there is always one");
        if !line.is_empty() && wide(line) + 1 + wide(word) <= width {
            line.push(' ');
            line.push_str(word);
            continue;
        }
        if !line.is_empty() {
            lines.push(String::new());
        }
        for c in word.chars() {
            let line = lines.last_mut().expect("there is always one");
            if !line.is_empty() && wide(line) + wide(c.encode_utf8(&mut [0; 4])) > width {
                lines.push(c.to_string());
            } else {
                line.push(c);
            }
        }
    }
    lines
}

/// At most so many lines; the last one tells whether there are more.
pub fn at_most(mut lines: Vec<String>, room: usize, width: u16) -> Vec<String> {
    if lines.len() > room {
        lines.truncate(room);
        if let Some(last) = lines.last_mut() {
            last.push_str(" …");
            *last = crate::tui::table::fitted(last, width);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_broken_between_words_where_they_can_be() {
        assert_eq!(wrapped("one two  three", 7), ["one two", "three"]);
        assert_eq!(wrapped("abcdefg hi", 3), ["abc", "def", "g", "hi"]);
        assert_eq!(wrapped("平織り", 4), ["平織", "り"]);
        assert_eq!(wrapped("", 4), [""]);
        assert_eq!(at_most(wrapped("one two three", 5), 2, 5), ["one", "two …"]);
    }
}
