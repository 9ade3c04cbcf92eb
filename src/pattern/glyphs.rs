//! Text as a bitmap: letters of eight by eight pixels (the font in the public domain of the crate `font8x8`).

use font8x8::{
    BASIC_FONTS, BLOCK_FONTS, BOX_FONTS, GREEK_FONTS, HIRAGANA_FONTS, LATIN_FONTS, UnicodeFonts,
};

use crate::parameter::{Domain, Parameter};

/// Pixels along a letter's side.
pub(super) const LETTER: usize = 8;
/// Most letters of a text.
const MOST: usize = 1024;

/// The text of a pattern.
pub(super) const TEXT: Parameter = Parameter {
    name: "text",
    meaning: "what is written, in lines; as large as fits the tile",
    domain: Domain::Text { default: "WRINKLED\nSURFACES", check },
};

/// Free pixels around the text.
pub(super) const MARGIN: Parameter = Parameter {
    name: "margin",
    meaning: "free space around the text, pixels of the font",
    domain: Domain::Real { default: 2.0, min: 0.0, max: 1000.0 },
};

/// A letter's rows from the top, the leftmost pixel in the lowest bit.
fn glyph(letter: char) -> Option<[u8; LETTER]> {
    // The first set has empty pictures for codes that stand for no letter.
    let basic = (!letter.is_control()).then(|| BASIC_FONTS.get(letter)).flatten();
    basic
        .or_else(|| LATIN_FONTS.get(letter))
        .or_else(|| GREEK_FONTS.get(letter))
        .or_else(|| BOX_FONTS.get(letter))
        .or_else(|| BLOCK_FONTS.get(letter))
        .or_else(|| HIRAGANA_FONTS.get(letter))
}

/// Whether a text can be written: what is wrong, to go on "`text` ".
fn check(text: &str) -> Result<(), String> {
    if let Some(letter) = text.lines().flat_map(str::chars).find(|&c| glyph(c).is_none()) {
        let code = u32::from(letter);
        return Err(format!("has {letter:?} (U+{code:04X}), which the font has no picture of"));
    }
    let count = text.chars().count();
    if count > MOST {
        return Err(format!("has {count} letters; at most {MOST} are written"));
    }
    if text.chars().all(char::is_whitespace) {
        return Err("has nothing to write".to_owned());
    }
    Ok(())
}

/// A text's pixels.
pub(super) struct Page {
    /// Pixels across.
    pub width: usize,
    /// Pixels up.
    pub height: usize,
    set: Vec<bool>,
}

impl Page {
    /// The lines of a text, each in the middle. A letter without a picture is a space.
    pub fn of(text: &str) -> Self {
        let lines: Vec<Vec<char>> = text.lines().map(|line| line.chars().collect()).collect();
        let longest = lines.iter().map(Vec::len).max().unwrap_or(0).max(1);
        let (width, height) = (longest * LETTER, lines.len().max(1) * LETTER);
        let mut page = Self { width, height, set: vec![false; width * height] };
        for (row, line) in lines.iter().enumerate() {
            let indent = (longest - line.len()) * LETTER / 2;
            for (column, &letter) in line.iter().enumerate() {
                let rows = glyph(letter).unwrap_or_default();
                for (y, x) in (0..LETTER * LETTER).map(|k| (k / LETTER, k % LETTER)) {
                    let top = row * LETTER + y;
                    let at = (height - 1 - top) * width + indent + column * LETTER + x;
                    page.set[at] = rows[y] >> x & 1 == 1;
                }
            }
        }
        page
    }

    /// Whether pixel (x, y) is set, y from the bottom; none is set beyond the page.
    pub fn at(&self, x: isize, y: isize) -> bool {
        let inside = |c: isize, size: usize| usize::try_from(c).ok().filter(|&c| c < size);
        let at = inside(x, self.width).zip(inside(y, self.height));
        at.is_some_and(|(x, y)| self.set[y * self.width + x])
    }

    /// Every set pixel.
    pub fn pixels(&self) -> impl Iterator<Item = [isize; 2]> + '_ {
        let set = (0..self.set.len()).filter(|&k| self.set[k]);
        set.map(|k| [k % self.width, k / self.width].map(|c| c as isize))
    }

    /// How a tile of `width` × `height` texels is filled: texels a pixel, and where the page's bottom left
    /// corner stands, texels.
    pub fn fitted(&self, width: usize, height: usize, margin: f64) -> (f64, [f64; 2]) {
        let size = [width, height].map(|texels| texels as f64);
        let page = [self.width, self.height].map(|pixels| pixels as f64);
        let scale = (size[0] / (page[0] + 2.0 * margin)).min(size[1] / (page[1] + 2.0 * margin));
        (scale, [0, 1].map(|c| 0.5 * (size[c] - scale * page[c])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_l_stands_upright() {
        let page = Page::of("L");
        let rows: Vec<usize> = (0..8).map(|y| (0..8).filter(|&x| page.at(x, y)).count()).collect();
        // The font leaves the lowest row free; the foot is the widest.
        assert_eq!(rows.iter().max(), Some(&rows[1]), "{rows:?}");
        assert!(page.at(2, 4) && !page.at(5, 5), "the stem is left");
        assert_eq!(page.pixels().count(), rows.iter().sum::<usize>());
        assert!(!page.at(-1, 0) && !page.at(0, 8));
    }

    #[test]
    fn lines_are_centred_and_first_is_top() {
        let page = Page::of("ab\nI");
        assert_eq!((page.width, page.height), (16, 16));
        assert!((0..8).all(|y| (0..4).all(|x| !page.at(x, y) && !page.at(15 - x, y))));
        let (scale, corner) = page.fitted(40, 20, 2.0);
        assert_eq!((scale, corner), (1.0, [12.0, 2.0]));
    }

    #[test]
    fn what_cannot_be_written_is_named() {
        assert_eq!(check("Blinn 1978\né Ω ぁ"), Ok(()));
        assert!(check("5 €").unwrap_err().contains("'€' (U+20AC)"));
        assert!(check("a\u{7}").unwrap_err().contains("U+0007"));
        assert!(check(" \n ").unwrap_err().contains("nothing"));
        assert!(check("").is_err());
        assert!(check(&"x".repeat(MOST + 1)).unwrap_err().contains("1025"));
    }
}
