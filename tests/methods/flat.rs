//! A flat map is left alone.

use std::path::Path;
use std::sync::Arc;

use image::{ImageBuffer, Rgb};
use wrinkle::texture::image_file::{NormalReading, Zero, read_normal_map};
use wrinkle::texture::{NormalMap, Wrap};

use super::fixture::{cases, footprint, half_vectors, single, top};

const SIZES: [(u32, u32); 3] = [(1, 1), (5, 3), (16, 16)];

/// A flat map as paint programs write it: (128, 128, 255), or (32768, 32768, 65535).
fn flat_file(folder: &Path, bits: u32, (width, height): (u32, u32)) -> std::path::PathBuf {
    let path = folder.join(format!("flat-{width}x{height}-{bits}.png"));
    if bits == 8 {
        ImageBuffer::from_pixel(width, height, Rgb([128u8, 128, 255])).save(&path).unwrap();
    } else {
        ImageBuffer::from_pixel(width, height, Rgb([32768u16, 32768, 65535])).save(&path).unwrap();
    }
    path
}

fn read(path: &Path, zero: Zero) -> Arc<NormalMap> {
    let reading = NormalReading { zero, wrap: Wrap::Repeat, ..NormalReading::default() };
    Arc::new(read_normal_map(path, &reading).unwrap().map)
}

/// Every file a flat map may come as: (bits, its map read with `zero`).
fn flat_maps(zero: Zero) -> Vec<(u32, Arc<NormalMap>)> {
    let folder = tempfile::tempdir().unwrap();
    let kinds = SIZES.into_iter().flat_map(|size| [(8, size), (16, size)]);
    kinds.map(|(bits, size)| (bits, read(&flat_file(folder.path(), bits, size), zero))).collect()
}

#[test]
fn code_128_is_zero_or_half_a_step_above_it() {
    for (_, map) in flat_maps(Zero::Above) {
        assert!(map.texels().iter().all(|t| *t == [0.0, 0.0, 1.0, 1.0]));
    }
    // With the middle of the range as 0, half a step is 1/255 of full scale (1/65535 of 16 bits).
    for (bits, map) in flat_maps(Zero::Middle) {
        let half_step = 1.0 / (2f32.powi(bits as i32) - 1.0);
        for [x, y, z, _] in map.texels() {
            assert!((x / z - half_step).abs() < 1e-6 && (y / z - half_step).abs() < 1e-6);
        }
    }
}

#[test]
fn a_flat_map_gives_the_same_lobe_at_every_level() {
    for zero in [Zero::Above, Zero::Middle] {
        for (bits, map) in flat_maps(zero) {
            for case in cases() {
                let filtered = case.on(&map);
                let normal = map.texel(0, 0);
                let within = 1.5 / (2f32.powi(bits as i32) - 1.0);
                let surface = |level: f32| filtered.lobes_at(&footprint(&map, 0.3, 0.7, level));
                let bottom = surface(0.0);
                for half_level in 0..=2 * (top(&map) + 1) {
                    let level = half_level as f32 / 2.0;
                    for lobe in surface(level).lobes() {
                        let [x, y, z] = lobe.axis();
                        let lean = (x / z).abs().max((y / z).abs());
                        // Indices are kept in single precision.
                        let rounding = if case.card.fractal { 1e-5 } else { 0.0 };
                        let most = if zero == Zero::Above { rounding } else { within };
                        assert!(lean <= most, "{} leans by {lean} from {normal:?}", case.name);
                    }
                    // Rounding: weights of a lookup add to 1 within 10⁻⁶, and D is off by its exponent
                    // (up to 60 · ln sec) times that.
                    for h in half_vectors() {
                        let (got, want) = (surface(level).density(h), bottom.density(h));
                        let far = (got - want).abs();
                        assert!(
                            far <= 5e-5 * want + 1e-6,
                            "{} level {level}: {got} {want}",
                            case.name
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn a_flat_file_and_no_bumps_at_all_are_one() {
    for (_, map) in flat_maps(Zero::Above).iter().filter(|(_, m)| m.width() == 16) {
        let ideal = single(16, [0.0, 0.0, 1.0]);
        for case in cases() {
            let (from_file, made) = (case.on(map), case.on(&ideal));
            for level in [-2.0, -0.5, 0.0, 1.3, 9.0] {
                let at = footprint(map, 0.21, 0.83, level);
                assert_eq!(
                    from_file.lobes_at(&at).lobes(),
                    made.lobes_at(&at).lobes(),
                    "{}",
                    case.name
                );
            }
        }
    }
}
