use super::*;
use crate::lobe::{BaseLobe, EllipticLobe, Profile};
use proptest::prelude::*;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

fn isotropic(exponent: f64, side: usize) -> NdfImage {
    let lobe = BaseLobe::BlinnPhong { exponent }.about([0.0, 0.0, 1.0], 1.0);
    NdfImage::of_surface(&[lobe].into_iter().collect(), side).unwrap()
}

fn anisotropic(side: usize) -> NdfImage {
    let lobe = EllipticLobe::new([0.0, 0.0, 1.0], [0.02, 0.01, 0.2], 1.0, Profile::Gaussian);
    NdfImage::of_surface(&[lobe].into_iter().collect(), side).unwrap()
}

fn two_lobes(side: usize) -> NdfImage {
    let base = BaseLobe::BlinnPhong { exponent: 30.0 };
    let lobes = [base.about([0.5, 0.1, 0.8], 0.6), base.about([-0.4, -0.3, 0.8], 0.4)];
    NdfImage::of_surface(&lobes.into_iter().collect(), side).unwrap()
}

/// Independent places of a domain of 2²⁰ by 2²⁰ cells.
fn drawn(synthesis: &Synthesis, count: usize, seed: u64) -> impl Iterator<Item = [f64; 2]> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut part = move || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    (0..count).map(move |_| synthesis.indices(part(), part(), 8.0))
}

const WIDE: Noise = Noise { cells: [1 << 20; 2], gain: 0.5, seed: 5 };

/// Seed 11, N = 2·10⁵ normals, 32 × 32 squares aligned with the NDF's pixels; refused at a significance of 10⁻⁴ for
/// each of three NDFs. (G itself is known from 5·10⁵ values.)
#[test]
fn normals_follow_the_ndf() {
    for ndf in [isotropic(20.0, 128), anisotropic(128), two_lobes(128)] {
        let synthesis = Synthesis::new(ndf.clone(), WIDE);
        let normals = drawn(&synthesis, 200_000, 11).map(|r| synthesis.normals.at(r));
        let found = Agreement::of(&ndf, normals, 32);
        assert!(found.p_value() > 1e-4, "{found:?}");
    }
}

/// The same test refuses normals that were not mapped through G.
#[test]
fn without_the_distribution_of_the_noise_they_do_not() {
    let ndf = isotropic(20.0, 128);
    let synthesis = Synthesis::new(ndf.clone(), WIDE);
    let straight = drawn(&synthesis, 200_000, 11).map(|r| {
        let [x, y] = synthesis.normals.cumulative.place(r);
        lifted([2.0 * x - 1.0, 2.0 * y - 1.0])
    });
    let found = Agreement::of(&ndf, straight, 32);
    assert!(found.chi_squared > 10.0 * found.degrees, "{found:?}");
}

#[test]
fn without_octaves_the_normal_is_the_surfaces_own() {
    for ndf in [isotropic(40.0, 64), two_lobes(64).with_floor(0.01)] {
        let synthesis = Synthesis::new(ndf, Noise::default());
        let [x, y, z] = synthesis.normals.at(synthesis.indices(0.3, 0.8, 0.0));
        assert!(x.abs() < 1e-4 && y.abs() < 1e-4 && z > 0.999, "{x} {y} {z}");
    }
}

#[test]
fn octaves_are_seen_once_their_cells_are_four_pixels_long() {
    let synthesis =
        Synthesis::new(isotropic(40.0, 32), Noise { cells: [8, 8], ..Noise::default() });
    // A pixel of 1/32 of a tile: the first octave's cells are 4 pixels long.
    assert!((synthesis.octaves_seen(1.0 / 32.0, 9.0) - 1.0).abs() < 1e-5);
    assert!((synthesis.octaves_seen(1.0 / 256.0, 9.0) - 4.0).abs() < 1e-5);
    assert_eq!(synthesis.octaves_seen(1.0 / 16.0, 9.0), 0.0);
    assert_eq!(synthesis.octaves_seen(0.0, 9.0), 9.0);
}

#[test]
fn a_baked_map_repeats_and_holds_as_many_octaves_as_its_texels_can_show() {
    assert_eq!(octaves_for([256, 256], [16, 16]), 4.0);
    assert_eq!(octaves_for([256, 100], [16, 16]), 2.0);
    assert_eq!(octaves_for([16, 16], [16, 16]), 0.0);
    let synthesis = Synthesis::new(anisotropic(64), Noise { cells: [4, 2], ..Noise::default() });
    let map = synthesis.bake(48, 24, octaves_for([48, 24], [4, 2]));
    assert_eq!((map.width(), map.height(), map.wrap()), (48, 24, crate::texture::Wrap::Repeat));
    // No seam: neighbours across the edge differ no more than others.
    let step = |j: usize, a: usize, b: usize| {
        let (a, b) = (map.texel(a, j), map.texel(b, j));
        (0..3).map(|c| (a[c] - b[c]).abs()).fold(0.0, f32::max)
    };
    let seam = (0..24).map(|j| step(j, 47, 0)).fold(0.0, f32::max);
    let within = (0..24)
        .flat_map(|j| (0..47).map(move |i| (j, i)))
        .map(|(j, i)| step(j, i, i + 1))
        .fold(0.0, f32::max);
    assert!(seam <= within, "{seam} {within}");
}

#[test]
fn the_table_is_the_normals_rounded() {
    let synthesis = Synthesis::new(isotropic(30.0, 128), Noise::default());
    for (r1, r2) in [(0.5, 0.5), (0.37, 0.61), (0.45, 0.3)] {
        let exact = synthesis.normals.at([r1, r2]);
        let r = [r1 as f32, r2 as f32];
        for (frame, most) in
            [(*synthesis.table.nearest(r), 0.05), (synthesis.table.smooth(r), 0.005)]
        {
            let [t, b, n] = frame;
            assert!((0..3).all(|c| (n[c] - exact[c]).abs() < most), "{n:?} {exact:?}");
            let cross = crate::lobe::vector::cross(t, b);
            assert!((0..3).all(|c| (cross[c] - n[c]).abs() < 1e-5));
        }
    }
}

/// Bumps of the program's own, 32 texels a side.
fn waves() -> crate::texture::NormalMap {
    let entry = crate::pattern::find("waves").unwrap();
    let values = crate::parameter::Values::defaults(entry.parameters);
    (entry.build)(32, 32, &values, 1).normals
}

/// The greatest difference of a coordinate.
fn apart(map: &crate::texture::NormalMap, other: &crate::texture::NormalMap) -> f32 {
    let pairs = map.texels().iter().zip(other.texels());
    let differences = pairs.flat_map(|(a, b)| (0..3).map(|c| (a[c] - b[c]).abs()));
    differences.fold(0.0, f32::max)
}

#[test]
fn detail_of_amount_zero_gives_the_map_back() {
    let map = waves();
    let own = NdfImage::of_normals(map.texels(), None, 128).unwrap();
    let narrow = isotropic(2000.0, 128);
    let mixed = NdfImage::mixed(&[(0.98, &narrow), (0.02, &own)]).unwrap();
    // Single precision of a coordinate, a few times over.
    for ndf in [own, mixed] {
        let synthesis = Synthesis::new(ndf, Noise::default());
        let same = apart(&map, &synthesis.with_detail(&map, 0.0, 4.0));
        assert!(same < 2e-6, "{same}");
        assert!(apart(&map, &synthesis.with_detail(&map, 0.3, 4.0)) > 0.01);
    }
    // Without its own distribution's part, those where the narrow one has none are lost.
    let narrow = Synthesis::new(narrow, Noise::default());
    assert!(apart(&map, &narrow.with_detail(&map, 0.0, 4.0)) > 0.1);
}

#[test]
fn finer_detail_of_amount_zero_is_the_map_between_its_texels() {
    let map = waves();
    let ndf = NdfImage::of_normals(map.texels(), None, 128).unwrap().with_floor(0.02);
    let synthesis = Synthesis::new(ndf, Noise::default());
    // Indices are kept in single precision; where the NDF is thin a step of them is a long way.
    assert!(apart(&map, &synthesis.with_finer_detail(&map, 1, 0.0, 4.0)) < 0.02);
    assert_eq!(synthesis.with_finer_detail(&map, 3, 0.5, 4.0).width(), 96);
}

#[test]
fn levels_of_a_texture_of_noise_lose_an_octave_each() {
    let synthesis =
        Synthesis::new(isotropic(30.0, 64), Noise { cells: [4, 4], ..Noise::default() });
    let texture = IndexTexture::of_noise(&synthesis, [64, 64], 4.0, Bits::Float);
    let centre = |side: f64, i: f64| (i + 0.5) / side;
    for (level, side) in [(0usize, 64.0), (1, 32.0), (2, 16.0)] {
        let want = synthesis.indices(centre(side, 3.0), centre(side, 5.0), 4.0 - level as f64);
        let got = texture.level(level)[5 * side as usize + 3];
        assert!((0..2).all(|k| (f64::from(got[k]) - want[k]).abs() < 1e-6));
    }
    // The last levels are the surface's own normal.
    assert_eq!(texture.level(4)[0], texture.level(6)[0]);
    assert!(texture.level(7).is_empty());
}

proptest! {
    #[test]
    fn rounding_is_to_the_nearest_code(r in -0.5f32..1.5) {
        let held = r.clamp(0.0, 1.0);
        prop_assert!((Bits::Eight.rounded(r) - held).abs() <= 0.5 / 255.0 + 1e-6);
        prop_assert!((Bits::Sixteen.rounded(r) - held).abs() <= 0.5 / 65535.0 + 1e-7);
    }
}
