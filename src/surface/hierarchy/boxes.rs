//! Four boxes before a ray at once.

use super::{Corners, LEAF};
use crate::geometry::Vec3;

/// How many boxes are tested at once: as many single-precision numbers as the narrowest vector registers hold.
pub(super) const WIDE: usize = 4;
type Lane = [f32; WIDE];

/// Up to four children, each with a box around it. A child that is not there has a box that no ray enters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    low: [Lane; 3],
    high: [Lane; 3],
    /// Index of a node, or of a leaf if [`LEAF`] is set.
    pub(super) children: [u32; WIDE],
}

/// A box in single precision, rounded outwards.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
}

impl Bounds {
    pub(super) fn around([low, high]: &Corners) -> Self {
        Self {
            low: [low.x, low.y, low.z].map(|c| (c as f32).next_down()),
            high: [high.x, high.y, high.z].map(|c| (c as f32).next_up()),
        }
    }

    pub(super) fn join(self, other: Self) -> Self {
        let pick =
            |a: [f32; 3], b: [f32; 3], f: fn(f32, f32) -> f32| [0, 1, 2].map(|k| f(a[k], b[k]));
        Self {
            low: pick(self.low, other.low, f32::min),
            high: pick(self.high, other.high, f32::max),
        }
    }

    pub(super) fn corners(&self) -> Corners {
        [self.low, self.high].map(|corner| Vec3::from(corner.map(f64::from)))
    }
}

impl Node {
    /// A node without children: where they would be, boxes are infinitely far away.
    pub(super) const EMPTY: Self = Self {
        low: [[f32::INFINITY; WIDE]; 3],
        high: [[f32::INFINITY; WIDE]; 3],
        children: [LEAF; WIDE],
    };

    pub(super) fn put(&mut self, lane: usize, bounds: &Bounds, child: u32) {
        for k in 0..3 {
            self.low[k][lane] = bounds.low[k];
            self.high[k][lane] = bounds.high[k];
        }
        self.children[lane] = child;
    }

    /// Distances at which a ray enters the boxes, 0 within one; infinity where it passes by, or enters beyond `far`.
    #[inline(always)]
    pub(super) fn entered(&self, ray: &Nearby, far: f32) -> Lane {
        let (mut enter, mut exit) = ([0.0f32; WIDE], [far; WIDE]);
        for k in 0..3 {
            let (origin, per_step, slack) = (ray.origin[k], ray.per_step[k], ray.slack[k]);
            for lane in 0..WIDE {
                let a = (self.low[k][lane] - origin) * per_step;
                let b = (self.high[k][lane] - origin) * per_step;
                enter[lane] = greater(enter[lane], lesser(a, b) - slack);
                exit[lane] = lesser(exit[lane], greater(a, b) + slack);
            }
        }
        let mut entered = [f32::INFINITY; WIDE];
        for lane in 0..WIDE {
            if enter[lane] <= exit[lane] {
                entered[lane] = enter[lane];
            }
        }
        entered
    }
}

/// A ray in single precision, its origin moved to where it enters the box around everything: from afar, single
/// precision would not tell boxes apart.
pub(super) struct Nearby {
    origin: [f32; 3],
    per_step: [f32; 3],
    /// What the distance to a side may be wrong by, for no ray may slip between boxes that touch.
    slack: [f32; 3],
    /// How far the origin was moved.
    moved: f64,
}

impl Nearby {
    /// `None` if the ray passes the box by.
    #[inline(always)]
    pub(super) fn new(origin: Vec3, direction: Vec3, [low, high]: &Corners) -> Option<Self> {
        let (mut enter, mut exit) = (0.0f64, f64::INFINITY);
        let per_step = direction.map(reciprocal);
        for k in 0..3 {
            let (a, b) = ((low[k] - origin[k]) * per_step[k], (high[k] - origin[k]) * per_step[k]);
            enter = enter.max(a.min(b));
            exit = exit.min(a.max(b));
        }
        if enter > exit * (1.0 + 1e-12) {
            return None;
        }
        // Rounding of the origin, of a side and of their difference, each at most half a last place of the largest
        // coordinate there is; the product's is relative to the distance, which is at most the box's breadth.
        let largest = low.amax().max(high.amax());
        let near = origin + direction * enter;
        let per_step = [0, 1, 2].map(|k| per_step[k].clamp(-1e18, 1e18) as f32);
        let hair = (8.0 * f64::from(f32::EPSILON) * largest) as f32;
        Some(Self {
            origin: [0, 1, 2].map(|k| near[k] as f32),
            per_step,
            slack: per_step.map(|per_step| hair * per_step.abs()),
            moved: enter,
        })
    }

    /// A distance along the ray as boxes know it, not less than it is.
    pub(super) fn reach(&self, t: f64) -> f32 {
        ((t - self.moved) * (1.0 + 1e-6)) as f32
    }
}

/// The lesser of two numbers of which none is NaN: one instruction, where `f32::min` takes a few.
#[inline(always)]
fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The greater of two numbers of which none is NaN.
#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// 1/c, finite and of the sign of `c` even where c is 0: then a ray within a box's sides stays within.
pub(super) fn reciprocal(c: f64) -> f64 {
    1.0 / c.abs().max(1e-300).copysign(c)
}
