//! What a paper says, beside what a run measured.

use serde::{Deserialize, Serialize};

/// Whether a paper's claim was found to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// It cannot be held against anything: a photograph, a lost input.
    NotApplicable,
    /// It holds here.
    Reproduced,
    /// It does not hold here.
    Differs,
}

impl Verdict {
    /// It in words.
    pub fn text(self) -> &'static str {
        match self {
            Self::NotApplicable => "not applicable",
            Self::Reproduced => "reproduced",
            Self::Differs => "differs",
        }
    }
}

/// A figure or a fact, as a paper states it or as a run measured it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Quantity {
    /// A whole number of things.
    Count(u64),
    /// A number.
    Number(f64),
    /// Words.
    Text(String),
}

impl From<usize> for Quantity {
    fn from(count: usize) -> Self {
        Self::Count(count as u64)
    }
}

impl From<f64> for Quantity {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for Quantity {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Quantity {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

/// A statement of a paper and what became of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Claim {
    /// What is stated, a phrase with its unit.
    pub what: String,
    /// What the paper has.
    pub paper: Quantity,
    /// What was measured here.
    pub here: Quantity,
    /// Whether they agree.
    pub verdict: Verdict,
    /// How the verdict was reached: the bound it was held to, or why it cannot be.
    pub rule: String,
    /// Why it differs, as far as that is known; empty if it does not, or nothing is known.
    pub because: String,
}

impl Claim {
    fn new(
        what: impl Into<String>,
        (paper, here): (Quantity, Quantity),
        holds: bool,
        rule: String,
    ) -> Self {
        let verdict = if holds { Verdict::Reproduced } else { Verdict::Differs };
        Self { what: what.into(), paper, here, verdict, rule, because: String::new() }
    }

    /// A count, which must be the paper's.
    pub fn count(what: impl Into<String>, paper: usize, here: usize) -> Self {
        Self::new(what, (paper.into(), here.into()), paper == here, "equal".into())
    }

    /// A number that must be within `part` (0.1 is 10 %) of the paper's.
    pub fn near(what: impl Into<String>, paper: f64, here: f64, part: f64) -> Self {
        let holds = (here - paper).abs() <= part * paper.abs();
        let rule = format!("within {} % of the paper's", 100.0 * part);
        Self::new(what, (paper.into(), here.into()), holds, rule)
    }

    /// A number of which the paper says that it is at most `bound`, in its own words `paper`.
    pub fn at_most(
        what: impl Into<String>,
        paper: impl Into<Quantity>,
        bound: f64,
        here: f64,
    ) -> Self {
        let rule = format!("at most {}", written(bound));
        Self::new(what, (paper.into(), here.into()), here <= bound, rule)
    }

    /// Something the paper shows or says, and whether it `holds` here by a stated rule.
    pub fn shown(
        what: impl Into<String>,
        paper: impl Into<Quantity>,
        here: impl Into<Quantity>,
        rule: impl Into<String>,
        holds: bool,
    ) -> Self {
        Self::new(what, (paper.into(), here.into()), holds, rule.into())
    }

    /// Something that nothing can be held against.
    pub fn not_applicable(
        what: impl Into<String>,
        paper: impl Into<Quantity>,
        why: impl Into<String>,
    ) -> Self {
        Self {
            verdict: Verdict::NotApplicable,
            rule: why.into(),
            ..Self::new(what, (paper.into(), Quantity::Text(String::new())), true, String::new())
        }
    }

    /// The same claim with a reason for differing, which is left out if it does not differ.
    pub fn because(mut self, reason: impl Into<String>) -> Self {
        if self.verdict == Verdict::Differs {
            self.because = reason.into();
        }
        self
    }
}

/// A bound in all its digits; a small one with a power of ten, as `10⁻¹²` or `5×10⁻⁷`.
fn written(bound: f64) -> String {
    let text = format!("{bound:e}");
    match text.split_once("e-") {
        Some((digits, exponent)) if bound.abs() < 1e-4 => {
            let digits = if digits == "1" { String::new() } else { format!("{digits}×") };
            let raised = |c: char| c.to_digit(10).map_or('⁻', |d| SUPERSCRIPT[d as usize]);
            format!("{digits}10⁻{}", exponent.chars().map(raised).collect::<String>())
        }
        _ => bound.to_string(),
    }
}

const SUPERSCRIPT: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_follow_from_the_numbers() {
        assert_eq!(Claim::count("fits", 73, 73).verdict, Verdict::Reproduced);
        assert_eq!(Claim::count("fits", 73, 72).verdict, Verdict::Differs);
        assert_eq!(Claim::near("ratio", 2.0, 2.19, 0.1).verdict, Verdict::Reproduced);
        assert_eq!(Claim::near("ratio", 2.0, 2.21, 0.1).verdict, Verdict::Differs);
        assert_eq!(Claim::near("ratio", 2.0, f64::NAN, 0.1).verdict, Verdict::Differs);
        assert_eq!(Claim::at_most("rms", "a few percent", 0.05, 0.06).verdict, Verdict::Differs);
        let photograph = Claim::not_applicable("Figure 1", "a photograph", "a photograph");
        assert_eq!(photograph.verdict, Verdict::NotApplicable);
    }

    #[test]
    fn bounds_are_written_as_numbers_are() {
        let rule = |bound: f64| Claim::at_most("x", "y", bound, 0.0).rule;
        assert_eq!(rule(0.05), "at most 0.05");
        assert_eq!(rule(80.0), "at most 80");
        assert_eq!(rule(0.0), "at most 0");
        assert_eq!(rule(1e-12), "at most 10⁻¹²");
        assert_eq!(rule(2.5e-7), "at most 2.5×10⁻⁷");
        assert_eq!(rule(f64::NAN), "at most NaN");
    }

    #[test]
    fn only_what_differs_needs_a_reason() {
        assert_eq!(Claim::count("fits", 1, 1).because("the weave is lost").because, "");
        assert_eq!(
            Claim::count("fits", 1, 2).because("the weave is lost").because,
            "the weave is lost"
        );
    }

    #[test]
    fn quantities_survive_json() {
        for quantity in [Quantity::Count(7), Quantity::Number(0.5), Quantity::Text("7".into())] {
            let text = serde_json::to_string(&quantity).unwrap();
            assert_eq!(serde_json::from_str::<Quantity>(&text).unwrap(), quantity);
        }
    }
}
