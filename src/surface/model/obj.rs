//! Wavefront OBJ: vertices, texture coordinates, normals and faces; all else is passed over.

use std::collections::HashMap;
use std::path::Path;

use super::{FURTHEST, MOST_TRIANGLES, ModelError, Point, Soup, too_many, wrong};

/// Positions, texture coordinates and normals so far, and the points made of them.
#[derive(Default)]
struct Reader {
    positions: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    soup: Soup,
    /// Which point has these indices.
    made: HashMap<[u32; 3], u32>,
}

/// The index of a normal there is not.
const NONE: u32 = u32::MAX;
/// What was wrong with a line, and what to do.
type Fault = (String, &'static str);

/// Reads the text of an OBJ file.
///
/// # Errors
/// The first line that is wrong, or that there is no face at all.
pub(super) fn read(path: &Path, bytes: &[u8]) -> Result<Soup, ModelError> {
    let mut reader = Reader::default();
    for (k, line) in bytes.split(|&byte| byte == b'\n').enumerate() {
        // Names and comments may be in any encoding; what is read is plain.
        let text = String::from_utf8_lossy(line);
        let place = || format!(", line {}", k + 1);
        reader.line(&text).map_err(|(what, help)| wrong(path, place(), what, help))?;
        if reader.soup.triangles.len() > MOST_TRIANGLES {
            return Err(too_many(path));
        }
    }
    if reader.soup.triangles.is_empty() {
        let (what, help) = if reader.positions.is_empty() {
            ("neither OBJ nor glTF", "export the model as .obj, .gltf or .glb")
        } else {
            ("vertices but no faces", "export the model with its faces")
        };
        return Err(wrong(path, "", what, help));
    }
    Ok(reader.soup)
}

impl Reader {
    fn line(&mut self, text: &str) -> Result<(), Fault> {
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => self.positions.push(numbers(words)?),
            Some("vt") => self.uvs.push(numbers(words)?),
            Some("vn") => self.normals.push(numbers(words)?),
            Some("f") => self.face(words)?,
            _ => {}
        }
        Ok(())
    }

    /// A face, as a fan of triangles.
    fn face<'t>(&mut self, words: impl Iterator<Item = &'t str>) -> Result<(), Fault> {
        // A comment may follow.
        let corners: Result<Vec<u32>, Fault> =
            words.take_while(|word| !word.starts_with('#')).map(|word| self.corner(word)).collect();
        let corners = corners?;
        if corners.len() < 3 {
            let what = format!("a face of {} corners", corners.len());
            return Err((what, "a face needs at least three"));
        }
        let fan = corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]);
        self.soup.triangles.extend(fan);
        Ok(())
    }

    /// The point of a corner such as `7/3/5`.
    fn corner(&mut self, word: &str) -> Result<u32, Fault> {
        let mut parts = word.split('/');
        let mut index = |what, count| index(parts.next().unwrap_or(""), what, count);
        let position = index("vertex", self.positions.len())?;
        let uv = index("texture coordinate", self.uvs.len())?;
        let normal = index("normal", self.normals.len())?;
        let position =
            position.ok_or_else(|| (format!("the corner `{word}` has no vertex"), WRITTEN))?;
        let Some(uv) = uv else {
            let what = format!("the corner `{word}` has no texture coordinates");
            return Err((what, "unwrap the model and export it with texture coordinates"));
        };
        let next = self.soup.points.len() as u32;
        let point = *self.made.entry([position, uv, normal.unwrap_or(NONE)]).or_insert(next);
        if point == next {
            self.soup.points.push(Point {
                position: self.positions[position as usize],
                normal: normal.map(|normal| self.normals[normal as usize]),
                uv: self.uvs[uv as usize],
                tangent: None,
            });
        }
        Ok(point)
    }
}

const WRITTEN: &str = "corners are written vertex/texture coordinate/normal";

/// The place among `count` of an index from 1, or from −1 backwards; `None` if nothing is written.
fn index(word: &str, what: &str, count: usize) -> Result<Option<u32>, Fault> {
    if word.is_empty() {
        return Ok(None);
    }
    let Ok(written) = word.parse::<i64>() else {
        return Err((format!("`{word}` is no index of a {what}"), WRITTEN));
    };
    let place = if written < 0 { written.saturating_add(count as i64) } else { written - 1 };
    if written == 0 || !(0..count as i64).contains(&place) {
        let what = format!("{what} {written} is not among the {count} before this line");
        return Err((what, "the file may be cut off or its faces misnumbered: export it again"));
    }
    Ok(Some(place as u32))
}

/// The first N numbers of a line; what follows (a weight, a colour) is passed over.
fn numbers<'t, const N: usize>(
    mut words: impl Iterator<Item = &'t str>,
) -> Result<[f32; N], Fault> {
    const HELP: &str = "the file may be cut off: export it again";
    let mut all = [0.0f32; N];
    for (k, number) in all.iter_mut().enumerate() {
        let word =
            words.next().ok_or_else(|| (format!("{k} numbers where {N} are needed"), HELP))?;
        let read: f32 = word.parse().map_err(|_| (format!("`{word}` is no number"), HELP))?;
        let within = read.abs() <= FURTHEST;
        if !within {
            let what = format!("the number {word} is not finite, or beyond 10³⁰");
            return Err((what, "correct the model"));
        }
        *number = read;
    }
    Ok(all)
}
