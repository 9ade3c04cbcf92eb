//! What a wrong spec says: every error at once, each with its place, what would be right, and the
//! nearest name.

use std::path::Path;

use wrinkle::experiment::spec::Spec;

/// The errors of a text, as shown.
fn errors_of(text: &str) -> String {
    Spec::parse(text, Path::new("experiments/trial.toml")).expect_err("it is wrong").to_string()
}

/// The one error of a text, as shown, with the names it offers taken out: they grow.
fn error_without_names(text: &str) -> String {
    let shown = errors_of(text);
    let (before, _) = shown.split_once(" Here it may be").expect("it offers names");
    before.to_owned()
}

#[test]
fn every_error_is_told_at_once() {
    insta::assert_snapshot!(errors_of(include_str!("specs/many-errors.toml")));
}

#[test]
fn what_is_not_toml_is_shown_the_same_way() {
    insta::assert_snapshot!(errors_of("title = \"Gloss\nseed = = 1\n[image\n"), @r#"
experiments/trial.toml:1:15: not TOML: invalid basic string, expected `"`
  |
1 | title = "Gloss
  |               ^

experiments/trial.toml:2:8: not TOML: extra `=`, expected nothing
  |
2 | seed = = 1
  |        ^

experiments/trial.toml:2:10: not TOML: unexpected key or value, expected newline, `#`
  |
2 | seed = = 1
  |          ^

experiments/trial.toml:3:7: not TOML: unclosed table, expected `]`
  |
3 | [image
  |       ^

4 errors in experiments/trial.toml
"#);
}

#[test]
fn an_empty_file_lacks_what_has_no_default() {
    insta::assert_snapshot!(errors_of("# nothing yet\n\n"), @r#"
experiments/trial.toml:1:14: [sweep] needs the key `texture`: a list of names of patterns or of [texture.NAME] tables
  |
1 | # nothing yet
  |              ^

experiments/trial.toml:1:14: [sweep] needs the key `method`: a list of names of methods or of [method.LABEL] tables
  |
1 | # nothing yet
  |              ^

2 errors in experiments/trial.toml
"#);
}

#[test]
fn a_misspelt_method_is_recognised() {
    let text = "[sweep]\ntexture = [\"mine\"]\nmethod = [\"avaraged\"]\n\
                [texture.mine]\nfile = \"../Cargo.toml\"\n";
    insta::assert_snapshot!(error_without_names(text), @r#"
experiments/trial.toml:3:11: unknown method "avaraged"
  |
3 | method = ["avaraged"]
  |           ^^^^^^^^^^
  = did you mean "averaged"?
"#);
}

#[test]
fn a_misspelt_texture_is_recognised() {
    let text = "[sweep]\ntexture = [\"brick-file\"]\nmethod = [\"averaged\"]\n\
                [texture.bricks-file]\nfile = \"../Cargo.toml\"\n";
    insta::assert_snapshot!(error_without_names(text), @r#"
experiments/trial.toml:2:12: unknown texture "brick-file"
  |
2 | texture = ["brick-file"]
  |            ^^^^^^^^^^^^
  = did you mean "bricks-file"?
"#);
}

#[test]
fn a_file_that_is_not_there_is_told_without_a_place() {
    let error = Spec::load(Path::new("no/such.toml")).expect_err("no such file");
    assert!(error.to_string().starts_with("no/such.toml: cannot read the experiment: "));
    assert!(error.errors().is_empty());
}

#[test]
fn places_can_be_asked_for() {
    let text = "[image]\nwidth = 0\n[sweep]\ntexture = [\"mine\"]\nmethod = [\"averaged\"]\n\
                [texture.mine]\nfile = \"../Cargo.toml\"\n";
    let error = Spec::parse(text, Path::new("tests/trial.toml")).expect_err("a width of 0");
    let [error] = error.errors() else { panic!("one error: {error}") };
    assert_eq!((error.line, error.column, &text[error.span.clone()]), (2, 9, "0"));
}
