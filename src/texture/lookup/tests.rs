use super::*;
use proptest::prelude::*;

const LEVELS: Levels = Levels { width: 64, height: 64, wrap: Wrap::Repeat, top: 6 };

fn footprint(lookup: Lookup, x: [f32; 2], y: [f32; 2]) -> Footprint {
    let texels = |c: [f32; 2]| c.map(|c| c / 64.0);
    Footprint {
        u: 0.43,
        v: 0.61,
        along_x: texels(x),
        along_y: texels(y),
        lookup,
        ..Footprint::default()
    }
}

fn cells(at: &Footprint, levels: &Levels) -> Vec<Cell> {
    let mut found = vec![];
    at.each_cell(levels, |cell| found.push(cell));
    found
}

/// Mean and covariance, in texels, of the weights of a lookup, its cells spread evenly over their squares.
/// Distances are taken the short way round the tile.
fn moments(at: &Footprint) -> ([f32; 2], [f32; 3]) {
    let (mut mean, mut second, mut own) = ([0.0; 2], [0.0; 3], 0.0);
    let middle = [at.u * 64.0, at.v * 64.0];
    for cell in cells(at, &LEVELS) {
        let side = (1 << cell.level) as f32;
        let off = |k: usize, m: f32| {
            let d = (k as f32 + 0.5) * side - m;
            d - 64.0 * (d / 64.0).round()
        };
        let (x, y) = (off(cell.i, middle[0]), off(cell.j, middle[1]));
        mean[0] += cell.weight * x;
        mean[1] += cell.weight * y;
        own += cell.weight * if cell.level > 0 { side * side / 12.0 } else { 0.0 };
        second = [
            second[0] + cell.weight * x * x,
            second[1] + cell.weight * x * y,
            second[2] + cell.weight * y * y,
        ];
    }
    let covariance = [
        second[0] - mean[0] * mean[0] + own,
        second[1] - mean[0] * mean[1],
        second[2] - mean[1] * mean[1] + own,
    ];
    (mean, covariance)
}

proptest! {
    #[test]
    fn weights_sum_to_one_and_cells_exist(
        x0 in -900.0f32..900.0, x1 in -900.0f32..900.0, y0 in -30.0f32..30.0, y1 in -3.0f32..3.0,
        width in 1usize..90, height in 1usize..90, u in 0.0f32..1.0, v in 0.0f32..1.0, clamp in any::<bool>()
    ) {
        let wrap = if clamp { Wrap::Clamp } else { Wrap::Repeat };
        let top = crate::texture::level_sizes(width, height).len() - 1;
        let levels = Levels { width, height, wrap, top };
        for lookup in Lookup::ALL {
            let at = Footprint { u, v, ..footprint(lookup, [x0, x1], [y0, y1]) };
            let found = cells(&at, &levels);
            let total: f32 = found.iter().map(|cell| cell.weight).sum();
            prop_assert!((total - 1.0).abs() < 1e-4, "{lookup:?} {total}");
            for cell in found {
                let (w, h) = levels.size(cell.level);
                prop_assert!(cell.level <= top && cell.i < w && cell.j < h && cell.weight >= 0.0);
            }
        }
    }

    #[test]
    fn ewa_has_the_footprints_second_moments(
        turn in 0.0f32..3.2, long in 2.0f32..20.0, part in 0.15f32..1.0
    ) {
        // A rectangle of sides long × short: covariance diag(long², short²)/12, plus that of the bilinear
        // interpolation between texels, 1/6 each way. Cut off at three standard deviations a Gaussian keeps
        // 1 − 4.5 e^(−4.5)/(1 − e^(−4.5)) = 95 % of its variance.
        let short = (long * part).max(1.5);
        let (s, c) = turn.sin_cos();
        let at = footprint(Lookup::Ewa, [long * c, long * s], [-short * s, short * c]);
        let (mean, [xx, xy, yy]) = moments(&at);
        let (a, b) = (long * long / 12.0, short * short / 12.0);
        let want = [a * c * c + b * s * s + 1.0 / 6.0, (a - b) * s * c, a * s * s + b * c * c + 1.0 / 6.0];
        let size = want[0] + want[2];
        for (got, want) in [xx, xy, yy].into_iter().zip(want) {
            prop_assert!((got - want).abs() < 0.09 * size, "{got} {want} of {size}");
        }
        prop_assert!(mean[0].abs() < 0.1 * size.sqrt() && mean[1].abs() < 0.1 * size.sqrt(), "{mean:?}");
    }

    #[test]
    fn probes_have_the_variance_along_and_no_more_across(turn in 0.0f32..3.2, long in 4.0f32..30.0) {
        // Compared with a trilinear lookup of the short side: the same blur, plus (long² − short²)/12 along.
        let short = 2.0;
        let (s, c) = turn.sin_cos();
        let at = footprint(Lookup::Anisotropic, [long * c, long * s], [-short * s, short * c]);
        let mut second = [0.0f32; 3];
        let mut count = 0.0;
        at.each_probe(&LEVELS, |probe| {
            let off = |a: f32, m: f32| { let d = (a - m) * 64.0; d - 64.0 * (d / 64.0).round() };
            let (x, y) = (off(probe.u, at.u), off(probe.v, at.v));
            let (along, across) = (x * c + y * s, y * c - x * s);
            second = [second[0] + probe.weight * along * along, second[1] + probe.weight * across * across, probe.level];
            count += 1.0;
        });
        prop_assert!((second[0] / ((long * long - short * short) / 12.0) - 1.0).abs() < 1e-2, "{second:?}");
        prop_assert!(second[1] < 1e-3 && (second[2] - 1.0).abs() < 1e-3, "{second:?}");
        prop_assert!(count == (long / short - 1e-3).ceil());
    }
}

#[test]
fn a_square_footprint_is_one_probe() {
    for turn in [0.0f32, 0.3, 0.8] {
        let (s, c) = turn.sin_cos();
        let at = |lookup| footprint(lookup, [4.0 * c, 4.0 * s], [-4.0 * s, 4.0 * c]);
        let mut probes = vec![];
        at(Lookup::Anisotropic).each_probe(&LEVELS, |probe| probes.push(probe));
        assert_eq!(probes.len(), 1);
        assert!((probes[0].level - 2.0).abs() < 1e-5);
    }
}

#[test]
fn points_fill_the_parallelogram_evenly() {
    let at = footprint(Lookup::Exact, [8.0, 2.0], [-1.0, 5.0]);
    let (mut n, mut mean, mut second) = (0.0, [0.0; 2], [0.0; 3]);
    at.each_point(&LEVELS, 4096, |u, v, count| {
        let (x, y) = ((u - at.u) * 64.0, (v - at.v) * 64.0);
        n = count as f32;
        mean = [mean[0] + x, mean[1] + y];
        second = [second[0] + x * x, second[1] + x * y, second[2] + y * y];
    });
    assert!(mean.iter().all(|m| m.abs() / n < 0.02), "{mean:?}");
    for (got, want) in second.into_iter().zip([65.0, 11.0, 29.0]) {
        // 256 points: a hundredth of the whole, 65 + 29.
        assert!((got / n * 12.0 - want).abs() < 0.9, "{} {want}", got / n * 12.0);
    }
}

#[test]
fn no_footprint_leads_outside_or_takes_for_ever() {
    for side in [0.0, 1e-30, 1e30, f32::INFINITY, f32::NAN] {
        for lookup in Lookup::ALL {
            for (x, y) in [
                ([side, 0.0], [0.0, side]),
                ([side, 1.0], [1.0, 0.0]),
                ([side, side], [side, side]),
            ] {
                let at = footprint(lookup, x, y);
                let found = cells(&at, &LEVELS);
                assert!(found.len() < 20_000, "{lookup:?} {side}: {}", found.len());
                for cell in found {
                    let (w, h) = LEVELS.size(cell.level);
                    assert!(cell.i < w && cell.j < h);
                }
                let mut points = 0;
                at.each_point(&LEVELS, 1024, |_, _, _| points += 1);
                assert!((1..=1024).contains(&points));
            }
        }
    }
}
