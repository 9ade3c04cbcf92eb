//! How an image changes from frame to frame, beside how the truth does.
//!
//! "A useful test of any image generation algorithm is to see how well the objects look as they move"
//! (Blinn 1978, §6). With A_t and R_t the image and the reference of frame t, and means over consecutive frames
//! and all pixels:
//!
//! | figure | formula | tells |
//! |---|---|---|
//! | change | mean \|A_{t+1} − A_t\| | how much is going on |
//! | flicker | change of A ÷ change of R | 1: as lively as the truth; above: it sparkles; below: it is stuck or smeared |
//! | error's change | mean \|(A − R)_{t+1} − (A − R)_t\| | how much of the change is wrong |
//! | error's flicker | error's change ÷ change of R | 0: moves as the truth does, whatever constant it is off by |
//!
//! One flicker can hide another: an image that sparkles here and is stuck there may be as lively as the truth in
//! all. The error's flicker does not fall for it. Of an image that does not change at all flicker is 0 and the
//! error's flicker is 1.
//!
//! # The reference's own noise
//! The frames' references share no random number, so that the noise of a pixel's change is theirs together. E |x + n|
//! is never less than |x| for noise n of mean 0, and at most |x| + E |n|, so a mean change that was measured is in
//! expectation too large, by at most σ_t + σ_{t+1}, σ the mean standard error of a reference's pixels. That
//! bound is given as [`Flicker::noise`]; figures are not corrected by it. Trials are another matter: their noise is what
//! they would show on a screen, where a renderer's sample positions are fixed, and so are theirs.

use serde::Serialize;

use crate::render::Film;

/// Changes from one frame to the next, means over pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Step {
    /// Of the image.
    pub change: f64,
    /// Of the image's error.
    pub error_change: f64,
    /// Of the reference.
    pub truth_change: f64,
}

/// How an image changes over a sequence of frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Flicker {
    /// From each frame to the next.
    pub steps: Vec<Step>,
    /// Their mean.
    pub mean: Step,
    /// By how much at most the reference's noise makes [`Step::truth_change`] and [`Step::error_change`] too
    /// large, in expectation.
    pub noise: f64,
}

impl Flicker {
    /// The flicker of `images` beside their `references`, the mean standard errors of whose pixels are `errors`. `None`
    /// of fewer than two frames.
    ///
    /// # Panics
    /// If the lists differ in length or the films in size: a programming error.
    pub fn of(images: &[&Film], references: &[&Film], errors: &[f64]) -> Option<Self> {
        let frames = images.len();
        assert_eq!([references.len(), errors.len()], [frames; 2], "one reference a frame");
        let step = |t: usize| {
            let (before, after) = ([images[t], references[t]], [images[t + 1], references[t + 1]]);
            step(before, after)
        };
        let steps: Vec<Step> = (0..frames.saturating_sub(1)).map(step).collect();
        let noise = mean(errors.windows(2).map(|e| e[0] + e[1]))?;
        let mean_of = |figure: fn(&Step) -> f64| mean(steps.iter().map(figure));
        let mean = Step {
            change: mean_of(|s| s.change)?,
            error_change: mean_of(|s| s.error_change)?,
            truth_change: mean_of(|s| s.truth_change)?,
        };
        Some(Self { steps, mean, noise })
    }

    /// The image's change over the reference's; `None` if the reference may be still: its change is within its
    /// noise.
    pub fn ratio(&self) -> Option<f64> {
        self.over_truth(self.mean.change)
    }

    /// The change of the image's error over the reference's change; `None` as for [`Flicker::ratio`].
    pub fn error_ratio(&self) -> Option<f64> {
        self.over_truth(self.mean.error_change)
    }

    fn over_truth(&self, change: f64) -> Option<f64> {
        let moves = self.mean.truth_change > self.noise;
        moves.then(|| change / self.mean.truth_change)
    }
}

/// The change from a frame to the next of an image and its reference.
fn step(before: [&Film; 2], after: [&Film; 2]) -> Step {
    let [image, reference] = [0, 1].map(|k| changes(before[k], after[k]));
    let count = before[0].pixels().len().max(1) as f64;
    let (mut change, mut error_change, mut truth_change) = (0.0, 0.0, 0.0);
    for (a, r) in image.zip(reference) {
        change += a.abs();
        error_change += (a - r).abs();
        truth_change += r.abs();
    }
    Step {
        change: change / count,
        error_change: error_change / count,
        truth_change: truth_change / count,
    }
}

/// The change of every pixel.
fn changes<'a>(before: &'a Film, after: &'a Film) -> impl Iterator<Item = f64> + 'a {
    let size = |film: &Film| (film.width(), film.height());
    assert_eq!(size(before), size(after), "frames of one size");
    after.pixels().iter().zip(before.pixels()).map(|(a, b)| f64::from(*a) - f64::from(*b))
}

/// The mean, in order; `None` of nothing.
fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.fold((0.0, 0u32), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / f64::from(count))
}

/// A flicker map: each pixel's mean |change| from frame to frame. `None` of fewer than two frames.
///
/// # Panics
/// If the films differ in size: a programming error.
pub fn flicker_map(frames: &[&Film]) -> Option<Film> {
    let [first, _, ..] = frames else { return None };
    let mut sums = vec![0.0f64; first.pixels().len()];
    for pair in frames.windows(2) {
        for (sum, change) in sums.iter_mut().zip(changes(pair[0], pair[1])) {
            *sum += change.abs();
        }
    }
    let steps = (frames.len() - 1) as f64;
    let pixels = sums.into_iter().map(|sum| (sum / steps) as f32).collect();
    Some(Film::new(first.width(), first.height(), pixels))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames of a function of frame and column.
    fn sequence(frames: usize, at: impl Fn(usize, usize) -> f32) -> Vec<Film> {
        let film = |t| Film::new(8, 1, (0..8).map(|x| at(t, x)).collect());
        (0..frames).map(film).collect()
    }

    fn flicker(images: &[Film], references: &[Film], error: f64) -> Flicker {
        let films = |list: &'_ [Film]| -> Vec<Film> { list.to_vec() };
        let (images, references) = (films(images), films(references));
        let (a, r): (Vec<&Film>, Vec<&Film>) =
            (images.iter().collect(), references.iter().collect());
        Flicker::of(&a, &r, &vec![error; a.len()]).unwrap()
    }

    #[test]
    fn what_is_still_does_not_change() {
        let still = sequence(4, |_, x| x as f32);
        let moving = sequence(4, |t, x| (t + x) as f32);
        let found = flicker(&still, &moving, 0.0);
        assert_eq!(
            (found.mean.change, found.ratio(), found.error_ratio()),
            (0.0, Some(0.0), Some(1.0))
        );
        // Beside a still reference nothing can be said, but for how much it changes.
        let found = flicker(&moving, &still, 0.0);
        assert_eq!((found.mean.change, found.ratio(), found.error_ratio()), (1.0, None, None));
    }

    #[test]
    fn an_alternating_image_changes_by_all_of_its_swing() {
        let blinking = sequence(7, |t, x| if (t + x) % 2 == 0 { 0.75 } else { 0.25 });
        let ramp = sequence(7, |t, x| 0.25 * (t + x) as f32);
        let found = flicker(&blinking, &ramp, 0.0);
        assert_eq!((found.mean.change, found.ratio()), (0.5, Some(2.0)));
        // +0.5 − 0.25 and −0.5 − 0.25 in turn.
        assert_eq!((found.mean.error_change, found.error_ratio()), (0.5, Some(2.0)));
        assert_eq!(found.steps.len(), 6);
    }

    #[test]
    fn a_moving_ramp_changes_by_its_slope_times_the_way() {
        let ramp = |slope: f32| sequence(5, move |t, x| slope * (x as f32 - 2.0 * t as f32));
        let found = flicker(&ramp(0.25), &ramp(0.5), 0.0);
        assert_eq!((found.mean.change, found.mean.truth_change), (0.5, 1.0));
        assert_eq!((found.ratio(), found.error_ratio()), (Some(0.5), Some(0.5)));
        let map = flicker_map(&ramp(0.25).iter().collect::<Vec<_>>()).unwrap();
        assert_eq!(map.pixels(), [0.5; 8]);
    }

    #[test]
    fn a_constant_error_does_not_flicker_and_an_opposite_motion_does_twice() {
        let up = sequence(5, |t, _| t as f32);
        let off = sequence(5, |t, x| t as f32 + 0.5 * x as f32);
        let down = sequence(5, |t, _| -(t as f32));
        let found = flicker(&off, &up, 0.0);
        assert_eq!((found.ratio(), found.error_ratio()), (Some(1.0), Some(0.0)));
        // As lively as the truth, and all of it wrong.
        let found = flicker(&down, &up, 0.0);
        assert_eq!((found.ratio(), found.error_ratio()), (Some(1.0), Some(2.0)));
    }

    #[test]
    fn a_reference_whose_change_its_noise_explains_may_be_still() {
        let ramp = sequence(3, |t, _| t as f32);
        let found = flicker(&ramp, &ramp, 0.4);
        assert_eq!((found.noise, found.ratio()), (0.8, Some(1.0)));
        assert_eq!(flicker(&ramp, &ramp, 0.5).ratio(), None);
    }

    #[test]
    fn noise_makes_changes_larger_by_no_more_than_the_bound() {
        // 4096 pixels, two frames: a change d and independent noise of two values ±σ. E |d + n₂ − n₁| is known:
        // of n₂ − n₁ a half is 0, a quarter each ±2σ.
        let sigma = 0.125f32;
        for change in [0.0f32, 0.0625, 0.25, 1.0] {
            let noise = |bits: usize, k: usize| if bits >> k & 1 == 0 { sigma } else { -sigma };
            let film = |t: usize| {
                let pixel = |i: usize| change * t as f32 + noise(i, t);
                Film::new(4096, 1, (0..4096).map(pixel).collect())
            };
            let films = [film(0), film(1)];
            let list: Vec<&Film> = films.iter().collect();
            let found = Flicker::of(&list, &list, &[f64::from(sigma); 2]).unwrap();
            let (d, s) = (f64::from(change), f64::from(sigma));
            let want = 0.5 * d + 0.25 * (d + 2.0 * s) + 0.25 * (d - 2.0 * s).abs();
            assert!((found.mean.truth_change - want).abs() < 1e-12);
            assert!(want >= d && want <= d + found.noise);
        }
    }

    #[test]
    fn one_frame_has_no_flicker() {
        let film = Film::new(1, 1, vec![1.0]);
        assert!(Flicker::of(&[&film], &[&film], &[0.0]).is_none());
        assert!(Flicker::of(&[], &[], &[]).is_none() && flicker_map(&[&film]).is_none());
    }
}
