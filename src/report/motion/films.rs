//! The viewer of a sequence: the linear films of all its images, frame by frame, as far as the page has room.

use super::clip::{Clip, Scales, Shown};
use crate::render::{Film, percentile};
use crate::report::contest::{BRUTE_FORCE, median};
use crate::report::viewer::{Image, Images, Motion, Viewer};

/// A viewer holds every frame, or else every second or fourth one.
const STEPS: [usize; 3] = [1, 2, 4];

/// The viewer of a sequence, the reference its first image, and every which frame it holds. `None` if all that it could
/// hold takes more than `room`, in bytes, or if less than two frames would be left.
pub fn viewer(
    shown: &[Shown],
    clips: &[Clip],
    scales: Scales,
    room: usize,
) -> Option<(Viewer, usize)> {
    let full = error_size(shown).filter(|full| *full > 0.0).unwrap_or(scales.white);
    let change = Some(change_size(&shown[0].films)).filter(|change| *change > 0.0);
    let change = change.unwrap_or(scales.flicker);
    let of_step = |step: usize| {
        let images = shown.iter().zip(clips).map(|(shown, clip)| image(shown, clip, step));
        let viewer = Viewer::of(&Images {
            images: images.collect(),
            reference: Some(0),
            against: brute_force(shown),
            telling: telling(shown),
            white: scales.white,
            full,
            motion: Some(Motion {
                fps: f64::from(scales.fps) / step as f64,
                change,
                flicker: scales.flicker,
            }),
        })?;
        (viewer.size(viewer.len()) <= room).then_some((viewer, step))
    };
    let moves = |step: &usize| shown[0].films.len() > *step;
    STEPS.into_iter().filter(moves).find_map(of_step)
}

fn image<'a>(shown: &Shown<'a>, clip: &Clip, step: usize) -> Image<'a> {
    Image {
        label: clip.label.clone(),
        remark: clip.remark.clone(),
        lines: String::new(),
        films: shown.films.iter().step_by(step).copied().collect(),
        prints: clip.prints(),
    }
}

/// The image that improvements are measured against at first.
fn brute_force(shown: &[Shown]) -> usize {
    let is = |shown: &Shown| shown.method.is_some_and(|method| method.name == BRUTE_FORCE);
    shown.iter().position(is).unwrap_or(0)
}

/// The reference and the methods whose radiance can be compared with it.
fn telling(shown: &[Shown]) -> Vec<usize> {
    let normalised = |i: &usize| shown[*i].method.is_none_or(|method| method.normalised);
    (0..shown.len()).filter(normalised).collect()
}

/// The size of error that 99.5 % of a method's pixels do not exceed in all frames, the median over methods.
fn error_size(shown: &[Shown]) -> Option<f64> {
    let (reference, methods) = shown.split_first()?;
    let sizes = methods.iter().map(|method| {
        let frames = method.films.iter().zip(&reference.films);
        percentile(frames.flat_map(|(film, truth)| gaps(film, truth)))
    });
    median(sizes.collect(), |size| size)
}

/// The change from a frame to the next that 99.5 % of pixels do not exceed.
fn change_size(films: &[&Film]) -> f64 {
    percentile(films.windows(2).flat_map(|pair| gaps(pair[0], pair[1])))
}

fn gaps<'a>(a: &'a Film, b: &'a Film) -> impl Iterator<Item = f32> + 'a {
    a.pixels().iter().zip(b.pixels()).map(|(a, b)| (a - b).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(films: &[Film]) -> Vec<Shown<'_>> {
        let clip = |label, i: usize| Shown {
            label,
            remark: String::new(),
            method: None,
            films: films[i * 5..][..5].iter().collect(),
        };
        vec![clip("reference", 0), clip("flat", 1)]
    }

    #[test]
    fn what_finds_less_room_keeps_fewer_frames_and_then_none() {
        // Numbers that no packing makes much smaller.
        let value = |i: usize| ((i * 2_654_435_761) % 65_521) as f32 / 65_521.0;
        let film = |n: usize| Film::new(9, 9, (0..81).map(|i| value(i + 81 * n)).collect());
        let films: Vec<Film> = (0..10).map(film).collect();
        let shown = shown(&films);
        let scales = Scales { white: 1.0, flicker: 0.1, fps: 12 };
        let clips: Vec<Clip> = shown.iter().map(|s| Clip::of(s, "x", scales)).collect();
        let of = |room| viewer(&shown, &clips, scales, room);
        let (all, step) = of(usize::MAX).unwrap();
        assert_eq!(step, 1);
        let all = all.size(2);
        assert_eq!(of(all).unwrap().1, 1);
        let (some, step) = of(all - 1).unwrap();
        assert_eq!(step, 2);
        let (few, step) = of(some.size(2) - 1).unwrap();
        assert_eq!(step, 4);
        assert!(of(few.size(2) - 1).is_none());
    }

    #[test]
    fn scales_are_percentiles_over_all_frames() {
        let level = |value: f32| Film::new(2, 1, vec![value; 2]);
        let reference = [0.0, 0.1, 0.2, 0.3, 0.5].map(level);
        let other = [0.0, 0.1, 0.2, 0.3, 0.9].map(level);
        let films: Vec<Film> = reference.into_iter().chain(other).collect();
        let shown = shown(&films);
        assert!((error_size(&shown).unwrap() - 0.4).abs() < 1e-6);
        assert!((change_size(&shown[0].films) - 0.2).abs() < 1e-6);
    }
}
