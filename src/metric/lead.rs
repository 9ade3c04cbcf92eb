//! Who is nearer to a reference that is itself an estimate.

use super::mse_gap;
use crate::render::Film;

/// Standard errors on either side of an estimate that hold the truth 95 times in 100 (the normal distribution's).
pub const Z: f64 = 1.96;

/// What can be said of two images' distances from one reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The one is nearer, beyond the reference's noise, and by as much as is worth reporting.
    Ahead,
    /// They are as near, or their difference is not worth reporting.
    Level,
    /// They differ by as much as is worth reporting, but the reference's noise may be all there is to it.
    Undecided,
}

/// By how much one image is nearer to a reference than another, with the noise of the reference counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lead {
    /// The other's mean square error less the nearer one's.
    pub difference: f64,
    /// Its standard error.
    pub error: f64,
    /// The least difference worth reporting.
    pub smallest: f64,
}

impl Lead {
    /// The lead of `near` over `far`, before a reference with the variance of each of its pixels; `gap` is the least
    /// relative difference of root mean square errors worth reporting, such as 0.01.
    ///
    /// The square errors are too large by the mean of the variances, both by the same (see [`mse_gap`]); that is taken
    /// off what `gap` is relative to.
    ///
    /// # Panics
    /// If the sizes differ: a programming error.
    pub fn of(near: &Film, far: &Film, reference: &Film, variance: &[f64], gap: f64) -> Self {
        let (difference, error) = mse_gap(far, near, reference, variance);
        let pixels = near.pixels().iter().zip(reference.pixels()).zip(variance);
        let square = |((a, r), v): ((&f32, &f32), &f64)| {
            let error = f64::from(*a) - f64::from(*r);
            error * error - v
        };
        let square = pixels.map(square).sum::<f64>() / variance.len() as f64;
        let smallest = ((1.0 + gap) * (1.0 + gap) - 1.0) * square.max(0.0);
        Self { difference, error, smallest }
    }

    /// What can be said of it.
    pub fn verdict(&self) -> Verdict {
        match (self.difference > self.smallest, self.is_certain()) {
            (true, true) => Verdict::Ahead,
            (true, false) => Verdict::Undecided,
            (false, _) => Verdict::Level,
        }
    }

    /// Whether a less noisy reference could not change what is worth saying: either the lead is beyond noise, or it
    /// and its noise together are not worth reporting.
    pub fn is_resolved(&self) -> bool {
        self.is_certain() || self.difference + Z * self.error <= self.smallest
    }

    /// Whether there is a lead at all, beyond noise.
    fn is_certain(&self) -> bool {
        self.difference > Z * self.error
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::average;

    fn film(pixels: Vec<f32>) -> Film {
        Film::new(pixels.len(), 1, pixels)
    }

    #[test]
    fn the_difference_is_that_of_the_square_errors() {
        let [a, b, r] = [vec![1.0, 2.0, 4.0], vec![1.5, 1.0, 5.0], vec![1.0, 2.5, 3.0]].map(film);
        let lead = Lead::of(&a, &b, &r, &[0.0; 3], 0.1);
        // (0.25 + 2.25 + 4) / 3 − (0 + 0.25 + 1) / 3.
        assert!((lead.difference - 5.25 / 3.0).abs() < 1e-12);
        assert_eq!(lead.error, 0.0);
        assert!((lead.smallest - 0.21 * 1.25 / 3.0).abs() < 1e-12);
        assert_eq!(lead.verdict(), Verdict::Ahead);
        let lead = Lead::of(&a, &a, &r, &[1.0; 3], 0.1);
        assert_eq!((lead.verdict(), lead.is_resolved()), (Verdict::Level, true));
    }

    #[test]
    fn noise_that_could_explain_a_lead_leaves_it_undecided() {
        let lead = Lead { difference: 1.0, error: 0.4, smallest: 0.2 };
        assert_eq!((lead.verdict(), lead.is_resolved()), (Verdict::Ahead, true));
        let lead = Lead { error: 0.6, ..lead };
        assert_eq!((lead.verdict(), lead.is_resolved()), (Verdict::Undecided, false));
        // Not worth reporting, but it may be larger than it looks.
        let lead = Lead { difference: 0.1, error: 0.1, smallest: 0.2 };
        assert_eq!((lead.verdict(), lead.is_resolved()), (Verdict::Level, false));
        let lead = Lead { error: 0.05, ..lead };
        assert_eq!((lead.verdict(), lead.is_resolved()), (Verdict::Level, true));
    }

    /// Normal deviates by the sum of twelve uniform ones, from a counter: seed 1.
    fn noise(counter: u64) -> f64 {
        let uniform = |k: u64| {
            let hash = blake3::hash(&[1u64, counter, k].map(u64::to_le_bytes).concat());
            let word: [u8; 8] = hash.as_bytes()[..8].try_into().unwrap();
            u64::from_le_bytes(word) as f64 / u64::MAX as f64
        };
        (0..12).map(uniform).sum::<f64>() - 6.0
    }

    /// 400 references of 8 replicates each, 64 pixels, seed 1. The true difference must lie within Z standard errors
    /// in 95 % of them, less about 1 % as the variances are estimates from 8 replicates: 376 ± 4.7. Outside 362 to 391
    /// once in 500.
    #[test]
    fn the_standard_error_covers_the_truth() {
        let truth = |i: usize| 1.0 + 0.5 * ((i * 7 % 11) as f64 / 11.0);
        let a = film((0..64).map(|i| (truth(i) + 0.1 * ((i % 3) as f64 - 1.0)) as f32).collect());
        let b = film((0..64).map(|i| (truth(i) + 0.12 * ((i % 5) as f64 - 2.0)) as f32).collect());
        let exact = film((0..64).map(|i| truth(i) as f32).collect());
        let expected = Lead::of(&a, &b, &exact, &[0.0; 64], 0.01).difference;
        let covers = |run: u64| {
            let replicate = |k: u64| {
                let of = |i: usize| {
                    // Noise grows with the pixel, as a highlight's does.
                    let sigma = 0.05 + 0.01 * i as f64;
                    (truth(i) + sigma * noise((run * 8 + k) * 64 + i as u64)) as f32
                };
                film((0..64).map(of).collect())
            };
            let reference = average(&(0..8).map(replicate).collect::<Vec<_>>(), 8);
            let lead = Lead::of(&a, &b, &reference.film, &reference.variance, 0.01);
            (lead.difference - expected).abs() <= Z * lead.error
        };
        let covered = (0..400).filter(|&run| covers(run)).count();
        assert!((362..=391).contains(&covered), "{covered} of 400");
    }
}
