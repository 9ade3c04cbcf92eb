//! By how much normals miss others.

use crate::lobe::vector::V3;
use crate::texture::Texel;

/// Angles between pairs of unit normals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Missed {
    /// Their root mean square, degrees.
    pub rms: f64,
    /// The greatest, degrees.
    pub most: f64,
    /// The part of pairs, in [0, 1], that are over [`Missed::FAR`] apart.
    pub far: f64,
}

impl Missed {
    /// Degrees that count as far apart.
    pub const FAR: f64 = 2.0;

    /// Of texels, and a normal for each in their order.
    pub fn of(texels: &[Texel], others: impl Iterator<Item = V3>) -> Self {
        let (mut squares, mut most, mut far) = (0.0, 0.0f64, 0usize);
        for (t, n) in texels.iter().zip(others) {
            let chord: f64 = (0..3).map(|c| f64::from(n[c] - t[c]) * f64::from(n[c] - t[c])).sum();
            let angle = 2.0 * libm::asin((0.5 * chord.sqrt()).min(1.0)).to_degrees();
            squares += angle * angle;
            most = most.max(angle);
            far += usize::from(angle > Self::FAR);
        }
        let count = texels.len().max(1) as f64;
        Self { rms: (squares / count).sqrt(), most, far: far as f64 / count }
    }

    /// Of texels and the surface's own normal, (0, 0, 1): how they tilt.
    pub fn upright(texels: &[Texel]) -> Self {
        Self::of(texels, std::iter::repeat([0.0, 0.0, 1.0]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_between_the_normals() {
        let (sin, cos) = (30f32.to_radians().sin(), 30f32.to_radians().cos());
        let texels = [[0.0, 0.0, 1.0, 1.0], [sin, 0.0, cos, 1.0], [0.0, -sin, cos, 1.0]];
        let Missed { rms, most, far } = Missed::upright(&texels);
        assert!((most - 30.0).abs() < 1e-4 && (rms - 600f64.sqrt()).abs() < 1e-4, "{rms} {most}");
        assert!((far - 2.0 / 3.0).abs() < 1e-12);
        let same = texels.map(|[x, y, z, _]| [x, y, z]).into_iter();
        assert_eq!(Missed::of(&texels, same), Missed::default());
    }
}
