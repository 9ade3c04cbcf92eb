//! What a run found for one row of a paper.

use serde::{Deserialize, Serialize};

use super::{Claim, Figure, Table, Verdict};

/// What was made and measured for one figure, table or number of a paper.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Exhibit {
    /// The row's name, such as `fournier-f3`: also the name of its artefacts.
    pub row: String,
    /// What the row shows, a line.
    pub title: String,
    /// The paper's claims beside what was measured.
    pub claims: Vec<Claim>,
    /// Drawings.
    pub figures: Vec<Figure>,
    /// Tables of numbers.
    pub tables: Vec<Table>,
    /// Things a reader should know, sentence by sentence: readings tried, inputs that are lost.
    pub remarks: Vec<String>,
    /// Names of the ordinary reports, in folders beside this one, that it draws on.
    pub parts: Vec<String>,
    /// What varies from run to run.
    pub timed: Timed,
}

/// Claims and numbers about time: they belong in the files of costs, not among what reproduces.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Timed {
    /// Claims about time.
    pub claims: Vec<Claim>,
    /// Tables of times.
    pub tables: Vec<Table>,
}

/// All that a run found about a paper.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Evidence {
    /// The experiment's name: its file's stem.
    pub name: String,
    /// Its title, a line.
    pub title: String,
    /// The question it answers, a sentence or two.
    pub question: String,
    /// The paper: author, year, title, where it appeared.
    pub paper: String,
    /// The spec as written, TOML.
    pub spec: String,
    /// The seed of every random choice.
    pub seed: u64,
    /// One a row, in the paper's order.
    pub exhibits: Vec<Exhibit>,
    /// Name and title of the ordinary reports in folders beside this one, in the order of the spec.
    pub parts: Vec<(String, String)>,
}

impl Evidence {
    /// How many rows have each verdict: reproduced, differs, not applicable.
    pub fn tally(&self) -> [usize; 3] {
        let of = |verdict| self.exhibits.iter().filter(|e| e.verdict() == verdict).count();
        [Verdict::Reproduced, Verdict::Differs, Verdict::NotApplicable].map(of)
    }
}

impl Exhibit {
    /// The row's verdict: it differs if any claim does, and is reproduced if any is and none differs.
    /// Claims about time do not count: their verdicts may change from run to run.
    pub fn verdict(&self) -> Verdict {
        let worst = self.claims.iter().map(|claim| claim.verdict).max();
        worst.unwrap_or(Verdict::NotApplicable)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_claim_decides() {
        let of = |claims: Vec<Claim>| Exhibit { claims, ..Exhibit::default() }.verdict();
        let (good, bad) = (Claim::count("a", 1, 1), Claim::count("a", 1, 2));
        let none = Claim::not_applicable("a", "a photograph", "a photograph");
        assert_eq!(of(vec![]), Verdict::NotApplicable);
        assert_eq!(of(vec![none.clone()]), Verdict::NotApplicable);
        assert_eq!(of(vec![none.clone(), good.clone()]), Verdict::Reproduced);
        assert_eq!(of(vec![bad, none, good]), Verdict::Differs);
    }
}
