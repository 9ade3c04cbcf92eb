//! Shares of an experiment: the k-th of n, to be worked at apart and merged.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// The most parts an experiment may be divided in.
pub const MOST: u32 = 10_000;

/// Where, in an experiment's folder of results, its shards are; each has a folder of results of its own there.
pub const SHARDS: &str = ".shards";

/// One of several parts of an experiment, all of about the same work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Share {
    /// Of how many parts, from 1.
    pub of: u32,
    /// Which of them, from 1.
    pub number: u32,
}

impl Share {
    /// Which of the units of work, whose weights (≥ 0) are given, this share has. Shares are runs of consecutive
    /// units, so that what neighbours have in common is made in few shares: a unit belongs to the share in whose
    /// n-th of all work its middle lies. Every unit is in just one of the `of` shares; a share may have none.
    pub fn deal(self, weights: &[f64]) -> Vec<bool> {
        let all: f64 = weights.iter().sum();
        // Where no unit weighs anything they count alike.
        let (all, least) = if all > 0.0 { (all, 0.0) } else { (weights.len() as f64, 1.0) };
        let mut before = 0.0;
        let mine = |&weight: &f64| {
            let weight = weight.max(least);
            let middle = (before + 0.5 * weight) / all;
            before += weight;
            let share = (middle * f64::from(self.of)).floor() as u32;
            share.min(self.of - 1) == self.number - 1
        };
        weights.iter().map(mine).collect()
    }

    /// The name of its folder.
    pub fn slug(self) -> String {
        format!("{}-of-{}", self.number, self.of)
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Share {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (number, of) = text.split_once('/').ok_or("write it as 2/3: the second of three")?;
        let whole = |text: &str| match text.parse() {
            Ok(whole @ 1..=MOST) => Ok(whole),
            _ => Err(format!("`{text}` is not a whole number from 1 to {MOST}")),
        };
        let share = Self { of: whole(of)?, number: whole(number)? };
        if share.number > share.of {
            return Err(format!("there is no share {number} of {of}"));
        }
        Ok(share)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn shares(of: u32) -> impl Iterator<Item = Share> {
        (1..=of).map(move |number| Share { of, number })
    }

    proptest! {
        #[test]
        fn every_unit_is_in_just_one_share(weights in prop::collection::vec(0.0..10.0, 0..30), of in 1u32..12) {
            let dealt: Vec<_> = shares(of).map(|share| share.deal(&weights)).collect();
            for unit in 0..weights.len() {
                prop_assert_eq!(dealt.iter().filter(|mine| mine[unit]).count(), 1);
            }
            // Consecutive, and in the order of the shares.
            let owner = |unit: usize| dealt.iter().position(|mine| mine[unit]);
            let owners: Vec<_> = (0..weights.len()).map(owner).collect();
            prop_assert!(owners.is_sorted());
        }

        #[test]
        fn no_share_is_a_unit_heavier_than_its_due(weights in prop::collection::vec(0.1..10.0, 1..30), of in 1u32..12) {
            let all: f64 = weights.iter().sum();
            let heaviest = weights.iter().copied().fold(0.0, f64::max);
            for share in shares(of) {
                let mine = share.deal(&weights).into_iter().zip(&weights);
                let work: f64 = mine.filter(|(mine, _)| *mine).map(|(_, work)| work).sum();
                prop_assert!(work <= all / f64::from(of) + heaviest + 1e-9);
            }
        }
    }

    #[test]
    fn equal_units_are_dealt_evenly() {
        for weight in [0.0, 3.0] {
            let counts: Vec<_> = shares(3)
                .map(|share| share.deal(&[weight; 8]).iter().filter(|mine| **mine).count())
                .collect();
            assert_eq!(counts, [3, 2, 3]);
        }
    }

    #[test]
    fn shares_are_read_as_they_are_written() {
        let share: Share = "2/3".parse().unwrap();
        assert_eq!((share.number, share.of), (2, 3));
        assert_eq!((share.to_string().as_str(), share.slug().as_str()), ("2/3", "2-of-3"));
        for (wrong, told) in [
            ("2", "write it as 2/3"),
            ("0/3", "`0` is not a whole number"),
            ("4/3", "there is no share 4 of 3"),
            ("1/-1", "`-1` is not"),
            ("1/99999", "from 1 to 10000"),
        ] {
            let error = wrong.parse::<Share>().unwrap_err();
            assert!(error.contains(told), "{wrong}: {error}");
        }
    }
}
