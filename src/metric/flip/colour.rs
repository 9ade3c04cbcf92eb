//! FLIP's colours: opponent space, L*a*b*, Hunt's effect. White is D65, as the sum of the primaries of sRGB.

use libm::cbrt;

/// Linear sRGB to XYZ, in the fractions that FLIP's authors use.
const XYZ: [[f64; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];

/// The inverse of [`XYZ`], as FLIP's authors print it.
const RGB: [[f64; 3]; 3] = [
    [3.241_003_275, -1.537_398_934, -0.498_615_861],
    [-0.969_224_334, 1.875_930_071, 0.041_554_224],
    [0.055_639_423, -0.204_011_202, 1.057_148_933],
];

/// XYZ of white.
const WHITE: [f64; 3] = [XYZ[0][0] + XYZ[0][1] + XYZ[0][2], 1.0, XYZ[2][0] + XYZ[2][1] + XYZ[2][2]];

fn times(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// Planes of Y, Cx and Cz, linear opponent colours; of a grey picture Y alone.
pub(super) fn opponent(channels: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let [r, g, b] = channels else {
        return vec![channels[0].iter().map(|light| 116.0 * light - 16.0).collect()];
    };
    let mut planes = [(); 3].map(|()| Vec::with_capacity(r.len()));
    for ((r, g), b) in r.iter().zip(g).zip(b) {
        let [x, y, z] = relative(times(&XYZ, [*r, *g, *b]));
        let colour = [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)];
        planes.iter_mut().zip(colour).for_each(|(plane, c)| plane.push(c));
    }
    planes.into()
}

/// XYZ over that of white.
fn relative(xyz: [f64; 3]) -> [f64; 3] {
    [xyz[0] / WHITE[0], xyz[1] / WHITE[1], xyz[2] / WHITE[2]]
}

/// L*, a* and b* with Hunt's effect of blurred opponent planes, held to what sRGB can show.
pub(super) fn faded_lab(planes: &[Vec<f64>]) -> Vec<[f64; 3]> {
    let [y, cx, cz] = planes else {
        let grey = |y: &f64| [lightness(super::unit((y + 16.0) / 116.0)), 0.0, 0.0];
        return planes[0].iter().map(grey).collect();
    };
    let at = |i: usize| {
        let level = (y[i] + 16.0) / 116.0;
        let xyz = [level + cx[i] / 500.0, level, level - cz[i] / 200.0];
        let rgb = times(&RGB, [xyz[0] * WHITE[0], xyz[1] * WHITE[1], xyz[2] * WHITE[2]]);
        faded(lab(rgb.map(super::unit)))
    };
    (0..y.len()).map(at).collect()
}

/// CIE L*a*b* of linear sRGB.
pub(super) fn lab(rgb: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = relative(times(&XYZ, rgb)).map(response);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn lightness(y: f64) -> f64 {
    116.0 * response(y) - 16.0
}

/// CIE's cube root, straight in the dark.
fn response(t: f64) -> f64 {
    const DELTA: f64 = 6.0 / 29.0;
    if t > DELTA * DELTA * DELTA { cbrt(t) } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
}

/// Hunt's effect: colours fade with lightness (2020, eq. 2).
pub(super) fn faded([l, a, b]: [f64; 3]) -> [f64; 3] {
    [l, 0.01 * l * a, 0.01 * l * b]
}
