//! Frames as pictures: animated PNG files, and one file a frame.

use ::png::{BitDepth, ColorType, DeflateCompression, Encoder, Filter, Writer};

use crate::render::{Film, srgb};

/// Films on one exposure, as 8-bit grey sRGB codes.
pub struct Codes {
    width: usize,
    height: usize,
    frames: Vec<Vec<u8>>,
}

impl Codes {
    /// The codes of films of one size, with `white` shown as white. At least one film, of at least one pixel.
    pub fn of(films: &[&Film], white: f64) -> Self {
        let code = |film: &&Film| -> Vec<u8> {
            film.pixels().iter().map(|radiance| srgb(f64::from(*radiance) / white)).collect()
        };
        let (width, height) = films.first().map_or((0, 0), |film| (film.width(), film.height()));
        Self { width, height, frames: films.iter().map(code).collect() }
    }

    /// One frame as a PNG file.
    pub fn still(&self, frame: usize) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut writer = self.header(&mut bytes, |_| ());
        writer.write_image_data(&self.frames[frame]).expect("as many pixels as the header says");
        writer.finish().expect("writing to memory cannot fail");
        bytes
    }

    /// All frames as one animated PNG file (PNG specification, third edition, §4.9) that plays for ever, `fps`
    /// frames a second. What knows no animated PNG shows the first frame.
    pub fn animated(&self, fps: u32) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut writer = self.header(&mut bytes, |encoder| {
            encoder.set_animated(self.frames.len() as u32, 0).expect("there are frames");
            encoder.set_frame_delay(1, fps as u16).expect("it is animated");
        });
        for frame in &self.frames {
            writer.write_image_data(frame).expect("as many pixels as the header says");
        }
        writer.finish().expect("as many frames as the header says");
        bytes
    }

    fn header<'b>(
        &self,
        bytes: &'b mut Vec<u8>,
        more: impl Fn(&mut Encoder<'_, &'b mut Vec<u8>>),
    ) -> Writer<&'b mut Vec<u8>> {
        let mut encoder = Encoder::new(bytes, self.width as u32, self.height as u32);
        encoder.set_color(ColorType::Grayscale);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_deflate_compression(DeflateCompression::Level(6));
        encoder.set_filter(Filter::Adaptive);
        more(&mut encoder);
        encoder.write_header().expect("a film has a pixel, memory has room")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn films() -> Vec<Film> {
        let film =
            |t: usize| Film::new(5, 3, (0..15).map(|i| (i * (t + 1)) as f32 / 45.0).collect());
        (0..3).map(film).collect()
    }

    #[test]
    fn an_animation_holds_every_frame_and_its_pace() {
        let films = films();
        let codes = Codes::of(&films.iter().collect::<Vec<_>>(), 1.0);
        let bytes = codes.animated(12);
        let mut reader = ::png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
        let control = *reader.info().animation_control().unwrap();
        assert_eq!((control.num_frames, control.num_plays), (3, 0));
        for frame in &codes.frames {
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut pixels).unwrap();
            assert_eq!(pixels, *frame);
            let shown = reader.info().frame_control().unwrap();
            assert_eq!((shown.delay_num, shown.delay_den), (1, 12));
        }
    }

    #[test]
    fn a_still_is_its_frame_and_what_animates_shows_the_first() {
        let films = films();
        let codes = Codes::of(&films.iter().collect::<Vec<_>>(), 0.5);
        let read = |bytes: &[u8]| image::load_from_memory(bytes).unwrap().into_luma8().into_raw();
        assert_eq!(read(&codes.still(1)), codes.frames[1]);
        assert_eq!(read(&codes.animated(24)), codes.frames[0]);
        assert_eq!((codes.frames[0][0], codes.frames[2][14]), (0, 255));
    }
}
