//! Distances and profiles that height tables are drawn with.

/// How high a shape stands at `distance` inside its edge (negative outside): 0 outside, 1 from `bevel`
/// inwards, a smooth step between (3t² − 2t³); a cliff where `bevel` is 0. Same unit for both.
pub(super) fn rise(distance: f64, bevel: f64) -> f64 {
    let t =
        if bevel > 0.0 { (distance / bevel).clamp(0.0, 1.0) } else { f64::from(distance > 0.0) };
    t * t * (3.0 - 2.0 * t)
}

/// The place of the centre of texel `i` in cells that cut `size` texels into `count`: the cell and the
/// distances to its two ends, texels. `shift` moves the cells along, in cells.
pub(super) fn cell(i: usize, size: usize, count: usize, shift: f64) -> (usize, [f64; 2]) {
    let length = size as f64 / count as f64;
    let place = (i as f64 + 0.5) / length + shift;
    let from_start = (place - place.floor()) * length;
    (place.floor() as usize, [from_start, length - from_start])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_smooth_or_a_cliff() {
        assert_eq!([-1.0, 0.0, 1.0, 2.0, 3.0].map(|d| rise(d, 2.0)), [0.0, 0.0, 0.5, 1.0, 1.0]);
        assert_eq!([-1.0, 0.0, 0.1].map(|d| rise(d, 0.0)), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn cells_and_their_ends() {
        assert_eq!(cell(5, 12, 3, 0.0), (1, [1.5, 2.5]));
        assert_eq!(cell(5, 12, 3, 0.5), (1, [3.5, 0.5]));
    }
}
