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

#[test]
fn texts_and_rows_are_checked_letter_by_letter_and_number_by_number() {
    let spec = |texture: &str| {
        errors_of(&format!(
            "[sweep]\ntexture = [\"mine\"]\nmethod = [\"averaged\"]\n[texture.mine]\n{texture}\n"
        ))
    };
    let euro = spec("pattern = \"letters\"\ntext = \"5 €\"");
    assert!(euro.contains("`text` has '€' (U+20AC), which the font has no picture of"), "{euro}");
    let rows = |terms: &str| spec(&format!("pattern = \"fourier\"\nterms = {terms}"));
    let short = rows("[[1, 2, 0.1]]");
    assert!(short.contains("each of `terms` must be [k, l, a, b], not a list"), "{short}");
    let broken = rows("[[1.5, 2, 0.1, 0], [0, 1, \"x\", 2e9]]");
    for wrong in [
        "`k` of each row must be a whole number from -2048 to 2048, not 1.5",
        "`a` of each row must be a number from -1000 to 1000, not \"x\"",
        "`b` of each row must be a number from -1000 to 1000, not 2e9",
    ] {
        assert!(broken.contains(wrong), "{broken}");
    }
    assert!(rows("[]").contains("a list of 1 to 1024 rows [k, l, a, b], not an empty list"));
}

#[test]
fn methods_that_spread_normals_refuse_stretched_slopes() {
    let spec = |rest: &str| {
        errors_of(&format!(
            "[sweep]\ntexture = [\"grid\"]\nmethod = [\"averaged\", \"lean\"]\n[surface]\nperturbation = \
             \"displacement\"\n{rest}\n"
        ))
    };
    let errors = spec("height_unit = 0.5");
    assert!(errors.contains("\"lean\" cannot be used with this `perturbation`"), "{errors}");
    assert!(!errors.contains("\"averaged\" cannot"), "{errors}");
    let framed = spec("frame = \"main-direction\"");
    assert!(framed.contains("displacements stand along u and v"), "{framed}");
    let truth = spec("[reference]\ntruth = \"relief\"");
    assert!(truth.contains("takes slopes as they are in the map"), "{truth}");
}
