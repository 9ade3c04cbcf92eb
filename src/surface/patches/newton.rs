//! From near a point of patches to the point that a ray meets.

use super::Charted;
use super::join::Joined;
use crate::geometry::{Frame, Vec3};

/// A point of patches by its parameters, in the unit square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub patch: usize,
    pub at: [f64; 2],
}

/// Where a ray meets a patch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub place: Place,
    /// Distance along the ray, in lengths of its direction.
    pub t: f64,
    /// The point of the patch.
    pub point: Vec3,
}

/// Most steps: from a cell's chord three or four do.
const STEPS: usize = 10;
/// Longest step along u or v, so that none leaps over a patch.
const LONGEST: f64 = 0.25;

/// Newton's method in u and v for the two distances of P(u, v) from the ray, across it, being 0 (Kajiya 1982, *Ray
/// Tracing Parametric Patches*, writes the ray as two planes in this way). From the patch of `guess` it goes over
/// to those that meet it. `None` if it does not settle, or settles further from the guess, at distance `t`, than half
/// the patch.
pub(super) fn solve(
    patches: &[Charted],
    joined: &[Joined],
    origin: Vec3,
    direction: Vec3,
    guess: Place,
    t: f64,
) -> Option<Found> {
    let length = direction.norm();
    let across = Frame::about(direction / length);
    let mut place = guess;
    for _ in 0..STEPS {
        let patch = &patches[place.patch].patch;
        let at = patch.at(place.at[0], place.at[1]);
        let from = at.point - origin;
        let off = [across.tangent.dot(&from), across.bitangent.dot(&from)];
        // A few units in the last place of the coordinates that were subtracted.
        let exact = 1e-13 * patch.size() + 1e-15 * from.norm();
        if off[0].abs().max(off[1].abs()) <= exact {
            let found = across.normal.dot(&from) / length;
            let near = (found - t).abs() * length <= 0.5 * patch.size();
            return (near && found > 0.0).then_some(Found { place, t: found, point: at.point });
        }
        let [a, b] = [across.tangent.dot(&at.along_u), across.tangent.dot(&at.along_v)];
        let [c, d] = [across.bitangent.dot(&at.along_u), across.bitangent.dot(&at.along_v)];
        let det = a * d - b * c;
        if det.abs() <= 1e-14 * at.along_u.norm() * at.along_v.norm() {
            return None;
        }
        let step = [(d * off[0] - b * off[1]) / det, (a * off[1] - c * off[0]) / det];
        if !step.iter().all(|s| s.is_finite()) {
            return None;
        }
        place = moved(place, step.map(|s| -s.clamp(-LONGEST, LONGEST)), joined);
    }
    None
}

/// A step from a place, over an edge where patches meet, else held to the patch.
fn moved(place: Place, step: [f64; 2], joined: &[Joined]) -> Place {
    let to = [0, 1].map(|axis| place.at[axis] + step[axis]);
    for axis in 0..2 {
        let (past, end) = (to[axis].max(1.0) - 1.0 + (-to[axis]).max(0.0), to[axis] > 1.0);
        if past > 0.0
            && let Some(beyond) = &joined[place.patch][2 * axis + usize::from(end)]
        {
            let at = beyond.enter(past, to[1 - axis]).map(|c| c.clamp(0.0, 1.0));
            return Place { patch: beyond.patch, at };
        }
    }
    Place { at: to.map(|c| c.clamp(0.0, 1.0)), ..place }
}
