//! How series are told apart: by a letter, and by colour where there is colour.

use ratatui::style::{Color, Modifier, Style};

use crate::report::colour::OKABE_ITO;

/// The key of a series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Its letter, of width 1, unlike that of any other series.
    pub letter: char,
    /// Its colour.
    pub style: Style,
}

/// The yardstick, brute force.
const UNFILTERED: &str = "unfiltered";

/// Keys for methods, given as their labels with the names of those they are forms of. Forms of one method share a
/// colour; the unfiltered one has the terminal's own, bold. A letter is taken from the label where one is free.
pub fn keys(methods: &[(String, String)]) -> Vec<Key> {
    let family = |name: &str| name.strip_suffix("-printed").unwrap_or(name).to_owned();
    let mut families: Vec<String> = Vec::new();
    let mut keys: Vec<Key> = Vec::new();
    for (label, name) in methods {
        let family = family(name);
        let style = if family == UNFILTERED {
            Style::new().add_modifier(Modifier::BOLD)
        } else {
            let known = families.iter().position(|other| *other == family);
            let place = known.unwrap_or_else(|| {
                families.push(family);
                families.len() - 1
            });
            let [r, g, b] = OKABE_ITO[place % OKABE_ITO.len()];
            Style::new().fg(Color::Rgb(r, g, b))
        };
        let free = |c: &char| keys.iter().all(|key| key.letter != *c);
        let letter = letters(label).find(free).unwrap_or('?');
        keys.push(Key { letter, style });
    }
    keys
}

/// The letters that could stand for a label, the best first: those its words begin with, its others, all others.
fn letters(label: &str) -> impl Iterator<Item = char> {
    let plain = |c: &char| c.is_ascii_alphanumeric();
    let firsts: Vec<char> = label.split('-').filter_map(|word| word.chars().next()).collect();
    let all: Vec<char> = firsts.into_iter().chain(label.chars()).filter(plain).collect();
    let small = all.clone().into_iter().map(|c| c.to_ascii_lowercase());
    let large = all.into_iter().map(|c| c.to_ascii_uppercase());
    small.chain(large).chain('a'..='z').chain('A'..='Z').chain('0'..='9')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(names: &[&str]) -> Vec<Key> {
        let named = names.iter().map(|name| ((*name).to_owned(), (*name).to_owned()));
        keys(&named.collect::<Vec<_>>())
    }

    #[test]
    fn letters_are_taken_from_labels_and_never_twice() {
        let keys = of(&["unfiltered", "averaged", "olano-north", "olano-north-printed", "a", "7"]);
        let letters: String = keys.iter().map(|key| key.letter).collect();
        assert_eq!(letters, "uaonA7");
        assert_eq!(keys[2].style, keys[3].style);
        assert_ne!(keys[1].style, keys[2].style);
        assert_eq!(keys[0].style.fg, None);
    }

    #[test]
    fn many_methods_and_odd_labels_have_keys() {
        let labels: Vec<String> = (0..62).map(|i| format!("ß-{i}")).collect();
        let labels: Vec<&str> = labels.iter().map(String::as_str).collect();
        let mut letters: Vec<char> = of(&labels).iter().map(|key| key.letter).collect();
        letters.sort_unstable();
        letters.dedup();
        assert_eq!(letters.len(), 62);
        assert_eq!(of(&[""; 70])[69].letter, '?');
    }
}
