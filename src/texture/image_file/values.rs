//! Grey images of values that are neither normals nor heights, such as densities. Rows here run from the top, as files have
//! them.

use std::path::Path;

use image::ExtendedColorType;

use super::write::{write_exr, write_png};
use super::{HeightReading, ImageError, read_height_map};

/// Reads an image as ((width, height), values), row by row from the top; white is 1, of a colour image the luma counts.
///
/// # Errors
/// An [`ImageError`] if the file is not a readable image with finite samples.
pub fn read_values(path: impl AsRef<Path>) -> Result<((usize, usize), Vec<f32>), ImageError> {
    let reading = HeightReading { height_scale: 1.0, ..HeightReading::default() };
    let map = read_height_map(path, &reading)?.map;
    let rows = map.values().chunks(map.width()).rev();
    let values = rows.flatten().map(|value| *value as f32).collect();
    Ok(((map.width(), map.height()), values))
}

/// Writes values, row by row from the top, as an EXR file of 32-bit floats: the values themselves, in R, G and B alike. The
/// file appears whole or not at all.
///
/// # Errors
/// [`ImageError::Unwritable`].
pub fn write_values_exr(
    path: impl AsRef<Path>,
    size: (usize, usize),
    values: &[f32],
) -> Result<(), ImageError> {
    let samples: Vec<[f32; 3]> = values.iter().map(|value| [*value; 3]).collect();
    write_exr(path.as_ref(), &samples, size)
}

/// Writes values, row by row from the top, as a grey 16-bit PNG file in which white is the greatest; negative ones are
/// black. The file appears whole or not at all.
///
/// # Errors
/// [`ImageError::Unwritable`].
pub fn write_values_png(
    path: impl AsRef<Path>,
    size: (usize, usize),
    values: &[f32],
) -> Result<(), ImageError> {
    let most = values.iter().fold(f32::MIN_POSITIVE, |most, value| most.max(*value));
    let code = |value: &f32| (f64::from(value / most) * 65_535.0 + 0.5) as u16;
    let samples: Vec<u16> = values.iter().map(code).collect();
    write_png(path.as_ref(), bytemuck::cast_slice(&samples), size, ExtendedColorType::L16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        let folder = tempfile::tempdir().unwrap();
        let values: Vec<f32> = (0..12).map(|k| 0.37 * k as f32).collect();
        let path = folder.path().join("values.exr");
        write_values_exr(&path, (4, 3), &values).unwrap();
        assert_eq!(read_values(&path).unwrap(), ((4, 3), values.clone()));
        let path = folder.path().join("values.png");
        write_values_png(&path, (4, 3), &values).unwrap();
        let (size, read) = read_values(&path).unwrap();
        assert_eq!(size, (4, 3));
        for (got, want) in read.iter().zip(&values) {
            assert!((got * values[11] - want).abs() <= 0.5001 * values[11] / 65_535.0);
        }
    }
}
