//! "Did you mean": the nearest of the names that would have been right.

/// The name most like `word`, if any is near enough to be what was meant.
pub(super) fn nearest<'a>(word: &str, names: &[&'a str]) -> Option<&'a str> {
    let word = word.to_lowercase();
    let distance = |name: &str| strsim::damerau_levenshtein(&word, &name.to_lowercase());
    let near = 1 + word.chars().count() / 4;
    let close = names.iter().map(|name| (distance(name), *name)).filter(|(d, _)| *d <= near);
    close.min_by_key(|(d, _)| *d).map(|(_, name)| name).or_else(|| {
        // A part of the name, such as `phong` for `blinn-phong`.
        names.iter().copied().find(|name| word.len() >= 3 && name.contains(&word))
    })
}

/// "a", "a or b", "a, b or c".
pub(super) fn any_of(names: &[String]) -> String {
    joined(names, "or")
}

/// "a", "a and b", "a, b and c".
pub(super) fn all_of(names: &[String]) -> String {
    joined(names, "and")
}

fn joined(names: &[String], last: &str) -> String {
    match names {
        [] => "none".to_owned(),
        [one] => one.clone(),
        [most @ .., end] => format!("{} {last} {end}", most.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_recognised_and_nonsense_is_not() {
        let names = ["hemispheres", "twill", "blinn-phong", "ggx"];
        assert_eq!(nearest("hemisphere", &names), Some("hemispheres"));
        assert_eq!(nearest("Twlil", &names), Some("twill"));
        assert_eq!(nearest("phong", &names), Some("blinn-phong"));
        assert_eq!(nearest("GGX", &names), Some("ggx"));
        assert_eq!(nearest("marble", &names), None);
        assert_eq!(nearest("", &names), None);
    }

    #[test]
    fn lists_read_as_sentences() {
        let names = ["a", "b", "c"].map(str::to_owned);
        assert_eq!(any_of(&names), "a, b or c");
        assert_eq!(all_of(&names[..2]), "a and b");
        assert_eq!(any_of(&names[..1]), "a");
    }
}
