//! What must be known of an EXR file before it is decoded: the decoder takes some of what the file says
//! on trust, and damage there would end the program.

/// How far into a file its header is looked for, bytes.
pub(super) const HEADER: u64 = 1 << 20;

/// The largest of the file's *data windows*, [width, height]: what the decoder makes room for, which may
/// be another size than the picture's. `start` is the file up to [`HEADER`].
pub(super) fn data_window(start: &[u8]) -> [u32; 2] {
    let mut largest = [0, 0];
    // Least x, least y, greatest x, greatest y; each 32 bits, the greatest included.
    for values in attributes(start, b"dataWindow\0box2i\0\x10\0\0\0", 16) {
        let corner = |k: usize| {
            let bytes = [values[4 * k], values[4 * k + 1], values[4 * k + 2], values[4 * k + 3]];
            i64::from(i32::from_le_bytes(bytes))
        };
        for (axis, largest) in largest.iter_mut().enumerate() {
            let side = (corner(axis + 2) - corner(axis) + 1).clamp(0, i64::from(u32::MAX));
            *largest = (side as u32).max(*largest);
        }
    }
    largest
}

/// The compression that is not decoded here, if the file uses it. DWAA and DWAB lose detail, and their
/// decoder makes room for whatever sizes the compressed data states.
pub(super) fn refused_compression(start: &[u8]) -> Option<&'static str> {
    attributes(start, b"compression\0compression\0\x01\0\0\0", 1).find_map(|value| match value[0] {
        8 => Some("DWAA compression"),
        9 => Some("DWAB compression"),
        _ => None,
    })
}

/// The values, `length` bytes each, of the attributes whose name, type and length are `name`.
fn attributes<'a>(
    start: &'a [u8],
    name: &'a [u8],
    length: usize,
) -> impl Iterator<Item = &'a [u8]> + 'a {
    let value_at = move |at: usize| start[at..].strip_prefix(name)?.get(..length);
    (0..start.len()).filter_map(value_at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_window_is_found_wherever_it_stands() {
        let mut bytes = b"other things".to_vec();
        bytes.extend(b"dataWindow\0box2i\0\x10\0\0\0");
        for corner in [-2i32, 0, 7, i32::MAX] {
            bytes.extend(corner.to_le_bytes());
        }
        assert_eq!(data_window(&bytes), [10, 1 << 31]);
        assert_eq!(data_window(&bytes[..30]), [0, 0]);
    }

    #[test]
    fn compressions_by_number() {
        let of = |number| {
            let mut bytes = b"\x02\0\0\0compression\0compression\0\x01\0\0\0".to_vec();
            bytes.push(number);
            refused_compression(&bytes)
        };
        assert_eq!(
            [of(3), of(8), of(9)],
            [None, Some("DWAA compression"), Some("DWAB compression")]
        );
    }
}
