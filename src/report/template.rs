//! The templates of all reports, compiled in.

use super::{colour, viewer};
use minijinja::syntax::SyntaxConfig;
use minijinja::{AutoEscape, Environment};

const TEMPLATES: [(&str, &str); 33] = [
    ("table.md", include_str!("templates/table.md")),
    ("parts.html", include_str!("templates/parts.html")),
    ("base.html", include_str!("templates/base.html")),
    ("report.md", include_str!("templates/report.md")),
    ("report.html", include_str!("templates/report.html")),
    ("budget.md", include_str!("templates/budget.md")),
    ("budget.html", include_str!("templates/budget.html")),
    ("cards.md", include_str!("templates/cards.md")),
    ("cards.html", include_str!("templates/cards.html")),
    ("motion.md", include_str!("templates/motion.md")),
    ("motion.html", include_str!("templates/motion.html")),
    ("evidence.md", include_str!("templates/evidence.md")),
    ("evidence.html", include_str!("templates/evidence.html")),
    ("style.css", include_str!("templates/style.css")),
    ("script/dom.js", include_str!("templates/script/dom.js")),
    ("script/colour.js", include_str!("templates/script/colour.js")),
    ("script/films.js", include_str!("templates/script/films.js")),
    ("script/camera.js", include_str!("templates/script/camera.js")),
    ("script/maps.js", include_str!("templates/script/maps.js")),
    ("script/draw.js", include_str!("templates/script/draw.js")),
    ("script/pointer.js", include_str!("templates/script/pointer.js")),
    ("script/player.js", include_str!("templates/script/player.js")),
    ("script/bench.js", include_str!("templates/script/bench.js")),
    ("script/scene.js", include_str!("templates/script/scene.js")),
    ("script/keys.js", include_str!("templates/script/keys.js")),
    ("script/sources.js", include_str!("templates/script/sources.js")),
    ("script/theme.js", include_str!("templates/script/theme.js")),
    ("script/flip.js", include_str!("templates/script/flip.js")),
    ("script/main.js", include_str!("templates/script/main.js")),
    ("index.md", include_str!("templates/index.md")),
    ("index.html", include_str!("templates/index.html")),
    ("costs.md", include_str!("templates/costs.md")),
    ("costs.html", include_str!("templates/costs.html")),
];

/// Fills in a template by its name.
///
/// # Panics
/// If there is no such template or it asks for what it is not given: programming errors that a test
/// of each report finds.
pub fn render(template: &str, context: minijinja::Value) -> String {
    let environment = environment();
    let found = environment.get_template(template).expect("the template is compiled in");
    found.render(context).expect("templates use only what they are given; tests render each")
}

fn environment() -> Environment<'static> {
    let mut environment = Environment::new();
    environment.set_auto_escape_callback(|name| {
        if name.ends_with(".html") { AutoEscape::Html } else { AutoEscape::None }
    });
    let mut syntax = SyntaxConfig::builder();
    syntax.trim_blocks(true).lstrip_blocks(true).keep_trailing_newline(true);
    environment.set_syntax(syntax.build().expect("only the handling of whitespace is changed"));
    environment.add_filter("plain", plain);
    environment.add_global("colours", viewer::json(&colour::scales()));
    for (name, source) in TEMPLATES {
        environment
            .add_template(name, source)
            .expect("the template is compiled in; tests parse it");
    }
    environment
}

/// Text that Markdown takes as it stands: nothing in it is markup, and it stays on one line.
fn plain(text: String) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' | '|' | '*' | '`' | '[' | ']' | '#' | '_' => out.extend(['\\', c]),
            '<' => out.push_str("&lt;"),
            '&' => out.push_str("&amp;"),
            '\n' | '\r' => out.push(' '),
            _ => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_never_markup() {
        assert_eq!(plain("a|b <script>\n*x*".into()), "a\\|b &lt;script> \\*x\\*");
    }
}
