//! Bump functions in closed form (Blinn 1978 §3: "the function F could, of course, be defined analytically").

use super::Bumps;
use crate::texture::{HeightMap, NormalMap, Wrap};

/// The bumps of F(u, v), u and v from 0 to 1 over the tile, from `f(u, v)` = [F, ∂F/∂u, ∂F/∂v], F in widths of
/// the tile. Normals are the function's own at texel centres, not differences of a table.
pub(super) fn bumps(width: usize, height: usize, f: impl Fn(f64, f64) -> [f64; 3]) -> Bumps {
    let (wide, high) = (width as f64, height as f64);
    let normals = NormalMap::from_fn(width, height, Wrap::Repeat, |u, v| {
        let [_, f_u, f_v] = f(u, v);
        [-f_u, -f_v * wide / high, 1.0, 1.0]
    });
    let heights = HeightMap::from_fn(width, height, Wrap::Repeat, |u, v| wide * f(u, v)[0]);
    Bumps { normals, heights: Some(heights), notes: vec![] }
}

#[cfg(test)]
mod tests {
    use crate::parameter::Values;
    use crate::pattern::find;

    #[test]
    fn slopes_are_of_the_heights() {
        for name in ["polynomial", "fourier", "mound", "ripple"] {
            let entry = find(name).unwrap();
            let values = Values::defaults(entry.parameters);
            // A ripple of 100 radians a width has a third derivative of 12000.
            let (width, height) = (1536, 768);
            let bumps = (entry.build)(width, height, &values, 0);
            let heights = bumps.heights.unwrap();
            let mut most = 0.0f64;
            for j in 1..height - 1 {
                for i in 1..width - 1 {
                    let [x, y] = heights.gradient(i as isize, j as isize);
                    let own = bumps.normals.slope(i, j);
                    most = most.max(own[0].abs());
                    // A central difference is off by a sixth of the third derivative.
                    assert!(
                        (x - own[0]).abs() < 2e-3 && (y - own[1]).abs() < 2e-3,
                        "{name} {i} {j}"
                    );
                }
            }
            assert!(most > 0.05, "{name}: {most}");
        }
    }
}
