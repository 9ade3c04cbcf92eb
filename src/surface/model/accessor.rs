//! Numbers in the buffers of a glTF file.

use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::View;

/// Reads accessors, and stops at the first number that is not there.
pub(super) struct Buffers {
    /// The bytes of each buffer.
    pub bytes: Vec<Vec<u8>>,
}

/// What is wrong with an accessor.
pub(super) type Fault = String;

impl Buffers {
    /// The elements of an accessor of these dimensions, normalised integers as fractions.
    pub(super) fn floats<const N: usize>(
        &self,
        accessor: &Accessor,
        dimensions: Dimensions,
    ) -> Result<Vec<[f32; N]>, Fault> {
        if accessor.dimensions() != dimensions {
            return Err(format!("{:?} where {dimensions:?} is needed", accessor.dimensions()));
        }
        let kind = accessor.data_type();
        if kind != DataType::F32 && !accessor.normalized() {
            return Err(format!("{kind:?} that is not normalised where fractions are needed"));
        }
        self.elements(accessor, |bytes| {
            let mut all = [0.0; N];
            let size = kind.size();
            all.iter_mut().enumerate().for_each(|(k, c)| *c = fraction(kind, &bytes[k * size..]));
            all
        })
    }

    /// The elements of an accessor of indices.
    pub(super) fn indices(&self, accessor: &Accessor) -> Result<Vec<u32>, Fault> {
        let kind = accessor.data_type();
        let whole = matches!(kind, DataType::U8 | DataType::U16 | DataType::U32);
        if accessor.dimensions() != Dimensions::Scalar || !whole {
            return Err(format!("indices are {kind:?} {:?}", accessor.dimensions()));
        }
        self.elements(accessor, |bytes| whole_number(kind, bytes))
    }

    fn elements<T: Copy>(
        &self,
        accessor: &Accessor,
        read: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<T>, Fault> {
        let (size, count) = (accessor.size(), accessor.count());
        let mut all = match accessor.view() {
            Some(view) => self.strided(&view, accessor.offset(), size, count, &read)?,
            // Without a view, all are zero but the sparse ones.
            None if count <= 3 * super::MOST_TRIANGLES => vec![read(&[0; 64]); count],
            None => return Err(format!("{count} elements")),
        };
        if let Some(sparse) = accessor.sparse() {
            let (places, values) = (sparse.indices(), sparse.values());
            let kind = match places.index_type() {
                gltf::accessor::sparse::IndexType::U8 => DataType::U8,
                gltf::accessor::sparse::IndexType::U16 => DataType::U16,
                gltf::accessor::sparse::IndexType::U32 => DataType::U32,
            };
            let place = |bytes: &[u8]| whole_number(kind, bytes) as usize;
            let count = sparse.count();
            let at = self.strided(&places.view(), places.offset(), kind.size(), count, place)?;
            let new = self.strided(&values.view(), values.offset(), size, count, &read)?;
            for (place, value) in at.into_iter().zip(new) {
                *all.get_mut(place)
                    .ok_or_else(|| format!("sparse element {place} of {}", accessor.count()))? =
                    value;
            }
        }
        Ok(all)
    }

    /// `count` elements of `size` bytes of a view.
    fn strided<T>(
        &self,
        view: &View,
        offset: usize,
        size: usize,
        count: usize,
        read: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<T>, Fault> {
        let stride = view.stride().unwrap_or(size).max(1);
        let buffer = self.bytes.get(view.buffer().index()).map_or(&[][..], Vec::as_slice);
        let end = view.offset().saturating_add(view.length());
        let start = view.offset().saturating_add(offset);
        let bytes = buffer.get(start..end.min(buffer.len())).unwrap_or(&[]);
        let there = if bytes.len() < size { 0 } else { (bytes.len() - size) / stride + 1 };
        if there < count {
            return Err(format!("{count} elements of which its buffer has {there}"));
        }
        Ok((0..count).map(|k| read(&bytes[k * stride..])).collect())
    }
}

/// The first number of `bytes`, which are long enough, as a fraction of the greatest (glTF 2.0, section 3.6.2.2).
fn fraction(kind: DataType, bytes: &[u8]) -> f32 {
    match kind {
        DataType::F32 => f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
        DataType::U8 => f32::from(bytes[0]) / 255.0,
        DataType::I8 => (f32::from(bytes[0] as i8) / 127.0).max(-1.0),
        DataType::U16 => f32::from(u16::from_le_bytes([bytes[0], bytes[1]])) / 65535.0,
        DataType::I16 => (f32::from(i16::from_le_bytes([bytes[0], bytes[1]])) / 32767.0).max(-1.0),
        DataType::U32 => whole_number(kind, bytes) as f32,
    }
}

fn whole_number(kind: DataType, bytes: &[u8]) -> u32 {
    match kind {
        DataType::U8 | DataType::I8 => u32::from(bytes[0]),
        DataType::U16 | DataType::I16 => u32::from(u16::from_le_bytes([bytes[0], bytes[1]])),
        DataType::U32 | DataType::F32 => {
            u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
        }
    }
}
