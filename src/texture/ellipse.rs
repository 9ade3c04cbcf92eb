//! A footprint as an ellipse.

use super::Footprint;

/// The ellipse that has the second moments of a footprint, in texels: a square footprint of side s has both
/// axes s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ellipse {
    /// The longer axis.
    pub major: f32,
    /// The shorter axis, above 0.
    pub minor: f32,
    /// Unit vector along the longer axis.
    pub along: [f32; 2],
}

/// Axes are held between these: a millionth of a texel, and wider than any map.
const AXES: (f32, f32) = (1e-6, 1e8);

impl Ellipse {
    /// The ellipse of a footprint on a map of `width` × `height` texels.
    #[inline(always)]
    pub fn of(at: &Footprint, width: usize, height: usize) -> Self {
        let (w, h) = (width as f32, height as f32);
        let hold = |c: f32| c.clamp(-AXES.1, AXES.1);
        let [x, y] = [at.along_x, at.along_y].map(|[u, v]| [hold(u * w), hold(v * h)]);
        if x.iter().chain(&y).any(|c| c.is_nan()) {
            return Self { major: AXES.1, minor: AXES.1, along: [1.0, 0.0] };
        }
        // M = J Jᵀ, its eigenvalues the squared axes. The smaller one from the determinant: no digits are lost.
        let (a, b, c) =
            (x[0] * x[0] + y[0] * y[0], x[0] * x[1] + y[0] * y[1], x[1] * x[1] + y[1] * y[1]);
        let (mean, half) = (0.5 * (a + c), 0.5 * (a - c));
        let radius = (half * half + b * b).sqrt();
        let largest = mean + radius;
        let area = (x[0] * y[1] - x[1] * y[0]).abs();
        let major = largest.sqrt().clamp(AXES.0, AXES.1);
        let minor = (area / major).clamp(AXES.0, major);
        // Of two eigenvectors that are the same, the one without cancellation.
        let (vx, vy) = if half >= 0.0 { (half + radius, b) } else { (b, radius - half) };
        let length = (vx * vx + vy * vy).sqrt();
        let along = if length > 0.0 { [vx / length, vy / length] } else { [1.0, 0.0] };
        Self { major, minor, along }
    }

    /// The same, widened to be at most `ratio` times as long as wide.
    #[inline(always)]
    pub fn at_most(self, ratio: f32) -> Self {
        Self { minor: self.minor.max(self.major / ratio), ..self }
    }

    /// The covariance of a footprint of these axes, spread evenly, in texels², as [xx, xy, yy]: a side of s has
    /// s²/12.
    pub fn covariance(&self) -> [f32; 3] {
        let [x, y] = self.along;
        let (long, short) = (self.major * self.major / 12.0, self.minor * self.minor / 12.0);
        [long * x * x + short * y * y, (long - short) * x * y, long * y * y + short * x * x]
    }
}
