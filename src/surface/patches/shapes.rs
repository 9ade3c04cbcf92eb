//! Open surfaces of a few patches.

use super::{Chart, Charted, Patches};
use crate::geometry::Vec3;
use crate::surface::Bezier;

/// How far the bent corner of [`bent_patch`] is from where it was, scene units.
const BENT: [f64; 3] = [-0.5, -0.5, 0.8];

/// A flat patch with one corner bent back (Blinn 1978, figure 5, of which no numbers are printed): the square
/// |x| ≤ 1, |y| ≤ 1 of the plane z = 0 but for its corner control point at (1, 1), which is moved, so
/// P = (2u − 1, 2v − 1, 0) + u³v³ (−0.5, −0.5, 0.8). Both sides are seen. A unit of u and of v counts the two
/// scene units that it is where the patch is flat.
pub fn bent_patch() -> Patches {
    let at = |k: usize| 2.0 * k as f64 / 3.0 - 1.0;
    let mut points = [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| Vec3::new(at(i), at(j), 0.0)));
    points[3][3] += Vec3::from(BENT);
    let chart = Chart { origin: [0.0; 2], extent: [2.0; 2], around: None };
    Patches::new(vec![Charted { patch: Bezier::new(points), chart }], true)
}

/// Half the ribbon's length and height, and of its waves.
const RIBBON: [f64; 3] = [1.25, 0.3, 0.22];
/// Half waves of the ribbon.
const WAVES: usize = 5;

/// A ribbon that waves (such as the one on the cover of the proceedings Blinn 1978 is in): 2.5 long and 0.6 high
/// about the origin, in 5 half waves across y, one patch each; it faces −y, u runs along +x by length along the
/// ribbon, v along +z. Both sides are seen.
pub fn ribbon() -> Patches {
    let [half, high, deep] = RIBBON;
    let long = 2.0 * half / WAVES as f64;
    let mut length = 0.0;
    let patches = (0..WAVES).map(|k| {
        let start = k as f64 * long - half;
        let depth = if k % 2 == 0 { deep } else { -deep };
        // Level at crests and troughs, where patches meet.
        let line = [(0.0, 1.0), (0.5, 1.0), (0.5, -1.0), (1.0, -1.0)];
        let points = line.map(|(along, across)| {
            let at = |j: usize| high * (2.0 * j as f64 / 3.0 - 1.0);
            [0, 1, 2, 3].map(|j| Vec3::new(start + along * long, across * depth, at(j)))
        });
        let patch = Bezier::new(points);
        let extent = [length_of(&patch, 0, 0.5), 2.0 * high];
        let chart = Chart { origin: [length, 0.0], extent, around: None };
        length += extent[0];
        Charted { patch, chart }
    });
    Patches::new(patches.collect(), true)
}

/// Length of a patch along an axis (u is 0, v is 1), where the other parameter is `other`: of 64 chords.
pub(super) fn length_of(patch: &Bezier, axis: usize, other: f64) -> f64 {
    const CHORDS: usize = 64;
    let point = |k: usize| {
        let along = k as f64 / CHORDS as f64;
        let [u, v] = if axis == 0 { [along, other] } else { [other, along] };
        patch.at(u, v).point
    };
    (0..CHORDS).map(|k| (point(k + 1) - point(k)).norm()).sum()
}
