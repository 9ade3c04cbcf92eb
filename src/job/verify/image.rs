//! How two images differ.

use std::path::Path;

use crate::render::read_image;

/// Two pictures of 8 or 16 bits a channel; `None` if one is no picture, or their first frames are the same.
pub(super) fn codes(one: &[u8], two: &[u8]) -> Option<String> {
    let [a, b] = [one, two].map(|bytes| image::load_from_memory(bytes).ok());
    let (a, b) = (a?, b?);
    let size = |image: &image::DynamicImage| (image.width() as usize, image.height() as usize);
    if size(&a) != size(&b) {
        return Some(sizes(size(&a), size(&b)));
    }
    if a.color() != b.color() {
        return Some(format!("{:?} and {:?}", a.color(), b.color()));
    }
    let (a, b) = (a.to_rgba16(), b.to_rgba16());
    let pixels = a.pixels().zip(b.pixels()).map(|(a, b)| {
        let apart = a.0.iter().zip(&b.0).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
        f64::from(apart) / 65535.0 * 255.0
    });
    let apart: Vec<f64> = pixels.collect();
    let place = Place::of(&apart, a.width() as usize)?;
    let most = apart.iter().copied().fold(0.0, f64::max);
    Some(format!("{place}; the greatest difference is {most:.1} of 255"))
}

/// Two images of radiance; `None` if one is no image, or they have the same pixels.
pub(super) fn radiances(one: &Path, two: &Path) -> Option<String> {
    let [a, b] = [one, two].map(|path| read_image(path).ok());
    let (a, b) = (a?.channels, b?.channels);
    if a.len() != b.len() {
        return Some(format!("{} and {} channels", a.len(), b.len()));
    }
    let (first, other) = (a.first()?, b.first()?);
    if (first.width(), first.height()) != (other.width(), other.height()) {
        return Some(sizes((first.width(), first.height()), (other.width(), other.height())));
    }
    let pairs = || {
        let all = a.iter().zip(&b).map(|(a, b)| a.pixels().iter().zip(b.pixels()));
        all.flatten().map(|(a, b)| (*a, *b))
    };
    let apart: Vec<f64> = pairs().map(|(a, b)| ulps(a, b) as f64).collect();
    let place = Place::of(&apart, first.width())?;
    let most = apart.iter().copied().fold(0.0, f64::max);
    let mean = |value: fn((f32, f32)) -> f64| pairs().map(value).sum::<f64>() / apart.len() as f64;
    let rmse = mean(|(a, b)| (f64::from(a) - f64::from(b)).powi(2)).sqrt();
    let size = mean(|(a, _)| f64::from(a).powi(2)).sqrt();
    Some(format!(
        "{place}; the greatest difference is {most} units in the last place; root mean square {rmse:.3e}, {:.3e} of \
         the image's",
        rmse / size
    ))
}

fn sizes(one: (usize, usize), two: (usize, usize)) -> String {
    format!("{}x{} and {}x{} pixels", one.0, one.1, two.0, two.1)
}

/// Floats between two, themselves not counted: 0 only for the same bits.
fn ulps(a: f32, b: f32) -> u64 {
    let ordered = |x: f32| {
        let bits = i64::from(x.to_bits());
        if bits & (1 << 31) == 0 { bits } else { (1 << 31) - 1 - bits }
    };
    ordered(a).abs_diff(ordered(b))
}

/// Which pixels differ.
struct Place {
    count: usize,
    of: usize,
    first: (usize, usize),
}

impl Place {
    /// From how far apart pixels are, row by row; `None` if none is.
    fn of(apart: &[f64], width: usize) -> Option<Self> {
        let first = apart.iter().position(|apart| *apart > 0.0)?;
        let count = apart.iter().filter(|apart| **apart > 0.0).count();
        let height = apart.len() / width.max(1);
        // A second channel's pixels come after the first's.
        let first = (first % width, first / width % height.max(1));
        Some(Self { count, of: apart.len(), first })
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let Self { count, of, first: (x, y) } = self;
        write!(f, "{count} of {of} pixels, the first at {x}, {y} from the upper left")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::Film;

    #[test]
    fn units_in_the_last_place_count_floats() {
        assert_eq!(ulps(1.0, 1.0), 0);
        assert_eq!(ulps(1.0, 1.0f32.next_up().next_up()), 2);
        assert_eq!(ulps(0.0, -0.0), 1, "they are other bits");
        assert_eq!(ulps(f32::from_bits(1), -f32::from_bits(1)), 3);
        assert_eq!(ulps(-1.0, (-1.0f32).next_down()), 1);
    }

    #[test]
    fn radiances_are_told_by_pixel_and_size() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, film: Film| {
            let path = folder.path().join(name);
            film.write_exr(&path).unwrap();
            path
        };
        let one = write("one.exr", Film::new(3, 2, vec![1.0; 6]));
        let mut pixels = vec![1.0; 6];
        pixels[4] = 1.0f32.next_up();
        pixels[5] = 3.0;
        let two = write("two.exr", Film::new(3, 2, pixels));
        let told = radiances(&one, &two).unwrap();
        let start = "2 of 6 pixels, the first at 1, 1 from the upper left; the greatest difference is 12582912 units";
        assert!(told.starts_with(start), "{told}");
        assert!(told.contains("root mean square 8.165e-1, 8.165e-1 of the image's"), "{told}");
        let three = write("three.exr", Film::new(2, 2, vec![1.0; 4]));
        assert_eq!(radiances(&one, &three).unwrap(), "3x2 and 2x2 pixels");
        assert_eq!(radiances(&one, &one), None);
    }

    #[test]
    fn codes_are_told_by_pixel_and_size() {
        let png = |pixels: &[u8]| {
            let image = image::GrayImage::from_raw(2, 2, pixels.to_vec()).unwrap();
            let mut bytes = std::io::Cursor::new(Vec::new());
            image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
            bytes.into_inner()
        };
        let told = codes(&png(&[0, 10, 20, 30]), &png(&[0, 10, 22, 30])).unwrap();
        assert_eq!(
            told,
            "1 of 4 pixels, the first at 0, 1 from the upper left; the greatest difference is 2.0 of 255"
        );
        assert_eq!(codes(&png(&[0; 4]), b"no picture"), None);
    }
}
