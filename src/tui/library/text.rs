//! Text from files, made fit to be drawn.

/// The text without characters that would steer a terminal or turn what follows around: control characters are
/// spaces, marks of direction are left out.
pub(super) fn clean(text: &str) -> String {
    let turns = |c: &char| !matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    text.chars().filter(turns).map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// The answer that a report's Markdown opens with, a plain paragraph each: what stands under `## Answer` up to the
/// next heading or table, or else the first paragraph that is bold throughout.
pub(super) fn lead(markdown: &str) -> Vec<String> {
    let paragraphs = markdown.split("\n\n").map(str::trim).filter(|p| !p.is_empty());
    let answer = paragraphs.clone().skip_while(|p| *p != "## Answer").skip(1);
    let markup = |p: &&str| p.starts_with(['#', '|', '!']);
    let answer: Vec<String> = answer.take_while(|p| !markup(p)).map(plain).collect();
    if !answer.is_empty() {
        return answer;
    }
    let bold = |p: &&str| p.len() > 4 && p.starts_with("**") && p.ends_with("**");
    paragraphs.filter(bold).take(1).map(|p| plain(&p[2..p.len() - 2])).collect()
}

/// Markdown without its escapes, on one line.
fn plain(markdown: &str) -> String {
    let mut out = String::with_capacity(markdown.len());
    let mut chars = markdown.chars();
    while let Some(c) = chars.next() {
        match c {
            '\\' => out.extend(chars.next()),
            c => out.push(c),
        }
    }
    clean(&out.replace("&lt;", "<").replace("&amp;", "&"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_steers_the_terminal() {
        assert_eq!(clean("a\u{1b}[31mb\nc\u{202e}d\u{9b}"), "a [31mb cd ");
    }

    #[test]
    fn the_answer_is_what_stands_under_its_heading() {
        let text = "# T\n\n*why?*\n\n## Answer\n\nChoose a\\_b at 4 &lt; 5.\n\nAnd so on.\n\n### A\n\nno\n";
        assert_eq!(lead(text), ["Choose a_b at 4 < 5.", "And so on."]);
    }

    #[test]
    fn of_a_paper_it_is_the_tally() {
        let text = "# T\n\n*why?*\n\nBlinn 1978\n\n**3 reproduced, 1 differs.**\n\n| Row |\n";
        assert_eq!(lead(text), ["3 reproduced, 1 differs."]);
        assert!(lead("# T\n\nnothing").is_empty() && lead("").is_empty());
    }
}
