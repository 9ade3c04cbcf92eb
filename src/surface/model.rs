//! Models from files: OBJ, glTF and GLB.

mod accessor;
mod gltf;
mod obj;
mod smooth;
mod tangents;
#[cfg(test)]
mod tests;

use std::io::Read as _;
use std::path::{Path, PathBuf};

use super::mesh::{Corner, Mesh, Vertex};
use crate::geometry::Vec3;

/// Most triangles a model may have.
pub const MOST_TRIANGLES: usize = 2_000_000;
/// Furthest that a coordinate may be from 0: squares stay finite in single precision's range of differences.
const FURTHEST: f32 = 1e30;
/// Most bytes that are read of any file of a model.
const MOST_BYTES: u64 = 1 << 30;

/// Why a file is no model. Every message names the file, the place in it, and says what to do.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    /// It cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// Something in it is not as it should be.
    #[error("{}{place}: {what}; {help}", path.display())]
    Wrong {
        /// The file.
        path: PathBuf,
        /// Where in it, such as ", line 3"; empty for the file as a whole.
        place: String,
        /// What is wrong.
        what: String,
        /// What to do.
        help: String,
    },
}

/// A model, and what is worth knowing about how it was read, a sentence each.
#[allow(missing_docs)]
pub struct Model {
    pub mesh: Mesh,
    pub notes: Vec<String>,
}

/// Which axis of a file points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Up {
    /// y, as glTF has it and most programs write OBJ; its front, +z, faces −y here.
    Y,
    /// z, as here.
    Z,
}

/// Reads a model from an OBJ, glTF or GLB file, told apart by what is in it. It is turned so that its `up` is +z,
/// its box's centre moved to the origin, and scaled so that its furthest corner is 1 from there.
///
/// Normals that the file lacks are the means of the triangles around a position, by angle. Tangents are the file's
/// own (glTF), else those of MikkTSpace. Triangles without area are left out, with a note.
///
/// # Errors
/// What is wrong with the file, or one beside it that it names.
pub fn read_model(path: &Path, up: Up) -> Result<Model, ModelError> {
    let bytes = read_file(path)?;
    let soup =
        if gltf::recognises(&bytes) { gltf::read(path, &bytes)? } else { obj::read(path, &bytes)? };
    drop(bytes);
    soup.into_model(path, up)
}

/// The files that a model is read from: its own, and those that a glTF names beside it.
pub fn files_of(path: &Path) -> Vec<PathBuf> {
    let mut all = vec![path.to_owned()];
    if let Ok(bytes) = read_file(path)
        && gltf::recognises(&bytes)
    {
        all.extend(gltf::files_beside(path, &bytes));
    }
    all
}

/// A file's bytes, if there are not too many.
fn read_file(path: &Path) -> Result<Vec<u8>, ModelError> {
    let unreadable = |source| ModelError::Unreadable { path: path.to_owned(), source };
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(unreadable)?;
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(wrong(path, "", "more than a gibibyte", "simplify the model"));
    }
    Ok(bytes)
}

fn wrong(
    path: &Path,
    place: impl Into<String>,
    what: impl Into<String>,
    help: impl Into<String>,
) -> ModelError {
    let (place, what, help) = (place.into(), what.into(), help.into());
    ModelError::Wrong { path: path.to_owned(), place, what, help }
}

/// That a file has more triangles than are taken.
fn too_many(path: &Path) -> ModelError {
    wrong(path, "", format!("more than {MOST_TRIANGLES} triangles"), "simplify the model")
}

/// Triangles as a file has them, its indices and numbers checked: all in range and finite.
#[derive(Debug, Default)]
struct Soup {
    points: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    notes: Vec<String>,
}

/// A corner of triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Point {
    position: [f32; 3],
    /// Of any length.
    normal: Option<[f32; 3]>,
    /// u to the right and v up.
    uv: [f32; 2],
    /// Direction of growing u and the sign of the frame, if the file tells.
    tangent: Option<[f32; 4]>,
}

impl Soup {
    fn into_model(mut self, path: &Path, up: Up) -> Result<Model, ModelError> {
        if up == Up::Y {
            self.points.iter_mut().for_each(Point::turn);
        }
        let positions = placed(&self.points);
        let flat = |corners: &[u32; 3]| smooth::area(&positions, *corners) == 0.0;
        let all = self.triangles.len();
        self.triangles.retain(|corners| !flat(corners));
        let mut notes = self.notes;
        if self.triangles.is_empty() {
            let help = "export the model with faces of at least three different vertices";
            return Err(wrong(path, "", "no triangle with area", help));
        }
        let laid: Vec<Vec3> = (self.points.iter())
            .map(|point| Vec3::new(point.uv[0].into(), point.uv[1].into(), 0.0))
            .collect();
        let unlaid = |corners: &&[u32; 3]| smooth::area(&laid, **corners) == 0.0;
        let without_bumps = self.triangles.iter().filter(unlaid).count();
        let normals = smooth::normals(&positions, &self.points, &self.triangles);
        let corners = tangents::corners(&positions, &normals, &self.points, &self.triangles);
        let vertex = |(k, point): (usize, &Point)| Vertex {
            position: positions[k],
            normal: normals[k],
            uv: point.uv.map(f64::from),
        };
        let vertices = self.points.iter().enumerate().map(vertex).collect();
        let mesh = Mesh::framed(vertices, &self.triangles, &corners);
        let left_out = all - mesh.triangles();
        if left_out > 0 {
            notes.push(format!(
                "{}: {left_out} of {all} triangles have no area and are left out",
                path.display()
            ));
        }
        if without_bumps > 0 {
            notes.push(format!(
                "{}: {without_bumps} of {} triangles have no area in texture coordinates, so no bumps are seen on them; \
                 unwrap the model if they should be",
                path.display(),
                mesh.triangles()
            ));
        }
        Ok(Model { mesh, notes })
    }
}

impl Point {
    /// From y up to z up: the front, +z, comes to face −y.
    fn turn(&mut self) {
        let [x, y, z] = self.position;
        self.position = [x, -z, y];
        self.normal = self.normal.map(|[x, y, z]| [x, -z, y]);
        self.tangent = self.tangent.map(|[x, y, z, sign]| [x, -z, y, sign]);
    }
}

/// Positions, their box's centre at the origin and the furthest 1 from there.
fn placed(points: &[Point]) -> Vec<Vec3> {
    let wide = |p: &Point| Vec3::from(p.position.map(f64::from));
    let mut bounds = points.iter().map(wide);
    let first = bounds.next().unwrap_or_default();
    let (low, high) = bounds.fold((first, first), |(low, high), p| (low.inf(&p), high.sup(&p)));
    let middle = (low + high) * 0.5;
    let furthest = points.iter().map(|p| (wide(p) - middle).norm()).fold(0.0, f64::max);
    let scale = if furthest > 0.0 { 1.0 / furthest } else { 1.0 };
    points.iter().map(|p| (wide(p) - middle) * scale).collect()
}
