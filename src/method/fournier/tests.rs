use super::*;
use crate::lobe::{Shading, Spread};
use crate::method::{BATCH, Batch, Silent, shade_by_lobes};
use crate::texture::{Footprint, Wrap};

/// A hemisphere seen from above: the disc inscribed in the map, nothing outside, and surface area as
/// weight (Fournier 1992 §2.3, §3).
fn hemisphere(side: usize) -> NormalMap {
    NormalMap::from_fn(side, side, Wrap::Clamp, |u, v| {
        let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        if z > 0.0 { [x, y, z, 1.0 / z] } else { [0.0, 0.0, 1.0, 0.0] }
    })
}

/// Smooth bumps without two equal normals.
fn bumps(width: usize, height: usize) -> Arc<NormalMap> {
    Arc::new(NormalMap::from_fn(width, height, Wrap::Repeat, |u, v| {
        let (x, y) = (std::f64::consts::TAU * u, std::f64::consts::TAU * v);
        [
            0.5 * (x + 0.3).sin() + 0.2 * (2.0 * y).cos(),
            0.4 * (y + x).cos(),
            1.0,
            1.0 + 0.5 * x.sin(),
        ]
    }))
}

#[test]
fn the_papers_counts_for_a_sphere() {
    for exponent in [30.0, 50.0, 65.0] {
        let counts = count_fits(&Fournier::default(), &hemisphere(32), exponent, &Silent).unwrap();
        for c in &counts {
            eprintln!("{exponent} {c:?}");
        }
        let fits: Vec<usize> = counts.iter().map(|c| c.fits).collect();
        assert_eq!(fits, [0, 52, 16, 4, 1], "exponent {exponent}");
        assert_eq!(counts.iter().map(|c| c.at_most_peaks).sum::<usize>(), 5, "exponent {exponent}");
    }
}
