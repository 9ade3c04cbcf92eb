//! What else normals carry, spread over the hemisphere along with them.

use rayon::prelude::*;

use super::kernel::{CHUNK, spread_chunk};
use super::{Directions, Peak};

/// From this many normals on, they are spread on all cores (see [`super::Distribution::spread`]).
const MANY_NORMALS: usize = 512;

/// Σ cᵢ wᵢ max(0, ω·nᵢ)^eᵢ at every direction ω of a grid, for each of C numbers cᵢ that normal i carries.
/// With c = 1 it is the distribution itself (Fournier 1992 §2.2); with another c the ratio of the two is
/// the mean of c at ω, "each contribution weighted by the vector amplitude" (§5). The sum at a direction
/// is taken in the order of the normals. `None` if `cancelled` says so.
pub fn spread_channels<const C: usize>(
    normals: &[(Peak, [f64; C])],
    directions: &Directions,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<[f64; C]>> {
    let chunk = |k: usize| {
        let mut sums = [[0.0; CHUNK]; C];
        for some in normals.chunks(MANY_NORMALS) {
            if cancelled() {
                break;
            }
            some.iter().for_each(|normal| add(directions.chunk(k), normal, &mut sums));
        }
        sums
    };
    let chunks = 0..directions.chunks();
    let sums: Vec<_> = if normals.len() < MANY_NORMALS {
        chunks.map(chunk).collect()
    } else {
        chunks.into_par_iter().map(chunk).collect()
    };
    let all = sums.iter().flat_map(|sums| (0..CHUNK).map(|i| std::array::from_fn(|c| sums[c][i])));
    (!cancelled()).then(|| all.take(directions.count()).collect())
}

fn add<const C: usize>(
    axes: [&[f64; CHUNK]; 3],
    (normal, carried): &(Peak, [f64; C]),
    sums: &mut [[f64; CHUNK]; C],
) {
    let mut weights = [0.0; CHUNK];
    spread_chunk(axes, std::slice::from_ref(normal), &mut weights);
    for (sum, c) in sums.iter_mut().zip(carried) {
        sum.iter_mut().zip(&weights).for_each(|(sum, weight)| *sum += c * weight);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Distribution;
    use crate::geometry::{HemisphereGrid, Vec3};

    #[test]
    fn a_channel_of_ones_is_the_distribution() {
        let directions = Directions::new(HemisphereGrid::fournier());
        let normals: Vec<Peak> = (0..600)
            .map(|i| {
                let t = f64::from(i);
                let direction = Vec3::new((0.7 * t).sin(), (1.3 * t).cos(), 1.2).normalize();
                Peak { amplitude: 0.1 + t % 3.0, direction, exponent: 20.0 }
            })
            .collect();
        let carried: Vec<_> = normals.iter().map(|&n| (n, [1.0, n.direction.x])).collect();
        let spread = spread_channels(&carried, &directions, &|| false).unwrap();
        let want = Distribution::spread(&normals, &directions, &|| false).unwrap();
        for ((got, want), sample) in
            spread.iter().zip(want.values()).zip(directions.grid().unwrap().samples())
        {
            assert!((got[0] - want).abs() <= 1e-12 * want);
            let mean: f64 = normals.iter().map(|n| n.direction.x * n.value(sample.direction)).sum();
            assert!((got[1] - mean).abs() <= 1e-10 * want);
        }
        assert!(spread_channels(&carried, &directions, &|| true).is_none());
    }
}
