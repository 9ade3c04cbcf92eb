//! Normal maps as pictures to look at.

use crate::texture::{NormalMap, downsample};

/// A normal map as an 8-bit picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Preview {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// (n + 1)/2 as red, green (bright where normals lean up) and blue, row by row from the *top*.
    /// Black where a map has no surface (weight 0).
    pub rgb: Vec<[u8; 3]>,
}

/// The map as a picture of at most `most` pixels a side, scaled down by averaging colours.
pub fn preview(map: &NormalMap, most: usize) -> Preview {
    let from = (map.width(), map.height());
    let longest = from.0.max(from.1);
    let fit = |side: usize| {
        if longest <= most { side } else { (side * most / longest).max(1) }
    };
    let to = (fit(from.0), fit(from.1));
    let colours = downsample(from, to, |i, j| {
        let [x, y, z, w] = map.texel(i, j);
        let lit = if w > 0.0 { 127.5 } else { 0.0 };
        [x, y, z].map(|c| lit * (c + 1.0))
    });
    let rgb = colours.chunks(to.0).rev().flatten().map(|c| c.map(|c| (c + 0.5) as u8)).collect();
    Preview { width: to.0, height: to.1, rgb }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::Wrap;

    #[test]
    fn colours_and_their_order() {
        let texels = vec![
            [1.0, 0.0, 0.0, 1.0], // bottom
            [0.0, -1.0, 0.0, 1.0],
            [0.0, 0.0, 1.0, 0.0], // top, the first without a surface
            [0.0, 0.0, 1.0, 1.0],
        ];
        let map = NormalMap::new(2, 2, Wrap::Repeat, texels);
        let picture = preview(&map, 100);
        assert_eq!((picture.width, picture.height), (2, 2));
        assert_eq!(picture.rgb, [[0, 0, 0], [128, 128, 255], [255, 128, 128], [128, 0, 128]]);
    }

    #[test]
    fn large_maps_are_scaled_down() {
        let map = NormalMap::from_fn(100, 30, Wrap::Repeat, |_, _| [0.0, 0.0, 1.0, 1.0]);
        let picture = preview(&map, 10);
        assert_eq!((picture.width, picture.height), (10, 3));
        assert!(picture.rgb.iter().all(|p| *p == [128, 128, 255]));
    }
}
