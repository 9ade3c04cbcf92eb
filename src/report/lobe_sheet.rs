//! A multiple surface in one picture: what it reflects beside its distribution of normals.

use super::canvas::Canvas;
use super::{disc, png, polar};
use crate::evidence::{Disc, LobePlot};

/// The picture as a PNG file: polar plots of reflection, and to their right the distribution. Densities
/// are those of [`Disc`].
pub fn lobe_sheet(distribution: &Disc, plots: &[LobePlot]) -> Vec<u8> {
    let left = polar::draw(plots);
    let right = disc::discs(std::slice::from_ref(distribution));
    let [left_width, right_width] = [&left, &right].map(|canvas| canvas.width() as f32);
    let height = left.height().max(right.height()) as f32;
    let mut canvas = Canvas::new(left_width + right_width, height);
    canvas.paste([0.0, 0.0], &left);
    canvas.paste([left_width, 0.0], &right);
    png::drawing(&canvas.dots())
}
