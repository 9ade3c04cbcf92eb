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

/// A sentence: there is no `what` of this name, the nearest that there is, and all of them.
pub(crate) fn no_such(what: &str, name: &str, names: &[&str]) -> String {
    let hint =
        nearest(name, names).map_or(String::new(), |near| format!("; did you mean `{near}`?"));
    format!("there is no {what} `{name}`{hint} (known: {})", names.join(", "))
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
    fn what_there_is_not_comes_with_what_there_is() {
        let names = ["twill", "waves"];
        let near = "there is no pattern `twil`; did you mean `twill`? (known: twill, waves)";
        assert_eq!(no_such("pattern", "twil", &names), near);
        assert_eq!(
            no_such("pattern", "x", &names),
            "there is no pattern `x` (known: twill, waves)"
        );
    }

    #[test]
    fn lists_read_as_sentences() {
        let names = ["a", "b", "c"].map(str::to_owned);
        assert_eq!(any_of(&names), "a, b or c");
        assert_eq!(all_of(&names[..2]), "a and b");
        assert_eq!(any_of(&names[..1]), "a");
    }
}
