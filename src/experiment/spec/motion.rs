//! Motion: every scene of the sweep as a sequence of frames.

use super::limits::Limits;
use super::reader::Reader;
use super::scene::{CameraSpec, Shape, distance_limits};

/// How a scene moves, and in how many frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionSpec {
    /// What moves.
    pub kind: MotionKind,
    /// Frames of a sequence, in [2, 500].
    pub frames: u32,
    /// Frames a second of the animations, in [1, 60]; nothing that is measured depends on it.
    pub fps: u32,
}

/// What moves, and how far from the first frame to the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionKind {
    /// The object turns about the vertical through the origin; camera and light stay.
    Rotate {
        /// Degrees from +x towards +y.
        degrees: f64,
    },
    /// The light moves round the vertical through the origin.
    Light {
        /// Degrees from +x towards +y.
        degrees: f64,
    },
    /// The camera moves round the vertical through the origin.
    Drift {
        /// Degrees from +x towards +y.
        degrees: f64,
    },
    /// The camera comes nearer or goes away, by the same factor from each frame to the next.
    Distance {
        /// Distance of the first frame's camera, scene units.
        from: f64,
        /// Distance of the last frame's.
        to: f64,
    },
}

/// Where things stand in a frame: what has moved since the scene was at rest. At rest all is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Degrees that the object has turned.
    pub object: f64,
    /// Degrees that the light has moved round.
    pub light: f64,
    /// Degrees that the camera has moved round.
    pub camera: f64,
    /// The camera's distance, where the motion is one of distance.
    pub distance: Option<f64>,
}

impl MotionSpec {
    /// Reads it. The camera at rest is where `camera` says.
    pub(super) fn read(reader: &Reader, camera: &CameraSpec, shape: Shape) -> Self {
        Self {
            kind: MotionKind::read(reader, camera, shape),
            frames: reader.whole("frames", 24, 2, 500) as u32,
            fps: reader.whole("fps", 12, 1, 60) as u32,
        }
    }

    /// Where things stand in a frame, the first being number 0.
    pub fn pose(&self, frame: u32) -> Pose {
        let along = f64::from(frame) / f64::from(self.frames - 1);
        let rest = Pose::default();
        match self.kind {
            MotionKind::Rotate { degrees } => Pose { object: degrees * along, ..rest },
            MotionKind::Light { degrees } => Pose { light: degrees * along, ..rest },
            MotionKind::Drift { degrees } => Pose { camera: degrees * along, ..rest },
            MotionKind::Distance { from, to } => {
                Pose { distance: Some(from * libm::pow(to / from, along)), ..rest }
            }
        }
    }
}

/// The words for a motion, before its own keys are read.
#[derive(Clone, Copy)]
enum Word {
    Rotate,
    Light,
    Drift,
    Approach,
    Recede,
}

/// A turn or two, either way round, that is not none.
const TURN: Limits = Limits::from_to(-720.0, 720.0).degrees();

impl MotionKind {
    /// Whether the camera's distance changes.
    pub fn changes_distance(self) -> bool {
        matches!(self, Self::Distance { .. })
    }

    fn read(reader: &Reader, camera: &CameraSpec, shape: Shape) -> Self {
        let words = [
            ("rotate", Word::Rotate),
            ("light", Word::Light),
            ("drift", Word::Drift),
            ("approach", Word::Approach),
            ("recede", Word::Recede),
        ];
        match reader.choice("kind", &words) {
            Word::Rotate => Self::Rotate { degrees: reader.real("degrees", 60.0, TURN) },
            Word::Light => Self::Light { degrees: reader.real("degrees", 60.0, TURN) },
            Word::Drift => Self::Drift { degrees: reader.real("degrees", 10.0, TURN) },
            Word::Approach => Self::read_distance(reader, camera, shape, true),
            Word::Recede => Self::read_distance(reader, camera, shape, false),
        }
    }

    fn read_distance(reader: &Reader, camera: &CameraSpec, shape: Shape, nearer: bool) -> Self {
        let limits = distance_limits(shape);
        let from = reader.real("from", camera.distance, limits);
        let expected = "the camera's distance in the last frame";
        let Some(item) = reader.required("to", expected) else {
            return Self::Distance { from, to: from };
        };
        let to = item.real(limits).unwrap_or(from);
        let (word, wanted) = if nearer { ("approach", "less") } else { ("recede", "more") };
        if to != from && (to < from) != nearer || (to == from && item.real(limits).is_some()) {
            let message =
                format!("to {word} from {from}, `to` must be {wanted} than that, not {to}");
            item.error(message, None);
        }
        Self::Distance { from, to }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(kind: MotionKind) -> MotionSpec {
        MotionSpec { kind, frames: 5, fps: 10 }
    }

    #[test]
    fn a_turn_is_even_and_reaches_its_end() {
        let turns = motion(MotionKind::Rotate { degrees: 40.0 });
        let turned: Vec<f64> = (0..5).map(|frame| turns.pose(frame).object).collect();
        assert_eq!(turned, [0.0, 10.0, 20.0, 30.0, 40.0]);
        assert_eq!(turns.pose(0), Pose::default());
    }

    #[test]
    fn distances_change_by_one_factor() {
        let nears = motion(MotionKind::Distance { from: 16.0, to: 1.0 });
        let at: Vec<f64> = (0..5).filter_map(|frame| nears.pose(frame).distance).collect();
        for (got, want) in at.iter().zip([16.0, 8.0, 4.0, 2.0, 1.0]) {
            assert!((got / want - 1.0).abs() < 1e-14, "{at:?}");
        }
    }
}
