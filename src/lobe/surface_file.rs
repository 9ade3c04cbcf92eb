//! Multiple surfaces as files: the JSON that `wrinkle fit --json` and `wrinkle lobes --json` print.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::{CAPACITY, PhongPeak};

/// The largest amplitude, exponent, and part of a direction.
const MOST: f64 = 1e6;

/// Why a file holds no multiple surface.
#[derive(Debug, thiserror::Error)]
pub enum SurfaceFileError {
    /// It cannot be read.
    #[error("cannot read {}: {cause}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        #[source]
        cause: std::io::Error,
    },
    /// It is no JSON, or a key is missing or of the wrong kind.
    #[error(
        "{}: {cause}; a surface is written {{\"peaks\": [{{\"amplitude\": 0.4, \"direction\": [0.6, 0, 0.8], \
         \"exponent\": 100}}]}}",
        path.display()
    )]
    Form {
        /// The file.
        path: PathBuf,
        /// What, with its line and column.
        #[source]
        cause: serde_json::Error,
    },
    /// It has no peaks, or more than a multiple surface can have.
    #[error("{}: `peaks` has {count} peaks: give 1 to {CAPACITY}", path.display())]
    Count {
        /// The file.
        path: PathBuf,
        /// How many it has.
        count: usize,
    },
    /// A number is out of bounds.
    #[error("{}: `peaks[{index}].{key}` is {value}: {bounds}", path.display())]
    Bounds {
        /// The file.
        path: PathBuf,
        /// Which peak, from 0.
        index: usize,
        /// Which of its keys.
        key: &'static str,
        /// What it is.
        value: String,
        /// What it may be.
        bounds: &'static str,
    },
}

/// What is read of a file; other keys are passed over.
#[derive(Deserialize)]
struct Stored {
    peaks: Vec<StoredPeak>,
}

#[derive(Deserialize)]
struct StoredPeak {
    amplitude: f64,
    direction: [f64; 3],
    exponent: f64,
}

/// Reads a list of Phong peaks; directions are brought to unit length.
///
/// # Errors
/// [`SurfaceFileError`], which names the file and the place.
pub fn read_peaks(path: &Path) -> Result<Vec<PhongPeak>, SurfaceFileError> {
    let of = || path.to_owned();
    let bytes =
        std::fs::read(path).map_err(|cause| SurfaceFileError::Read { path: of(), cause })?;
    let stored: Stored = serde_json::from_slice(&bytes)
        .map_err(|cause| SurfaceFileError::Form { path: of(), cause })?;
    let count = stored.peaks.len();
    if !(1..=CAPACITY).contains(&count) {
        return Err(SurfaceFileError::Count { path: of(), count });
    }
    let peaks = stored.peaks.iter().enumerate();
    let read = peaks.map(|(index, stored)| {
        stored.peak().map_err(|(key, value, bounds)| SurfaceFileError::Bounds {
            path: of(),
            index,
            key,
            value,
            bounds,
        })
    });
    read.collect()
}

impl StoredPeak {
    /// The peak, or the key that is out of bounds, its value, and its bounds.
    fn peak(&self) -> Result<PhongPeak, (&'static str, String, &'static str)> {
        const FROM_ZERO: &str = "give a number from 0 to 1000000";
        for (key, value) in [("amplitude", self.amplitude), ("exponent", self.exponent)] {
            if !(0.0..=MOST).contains(&value) {
                return Err((key, value.to_string(), FROM_ZERO));
            }
        }
        let [x, y, z] = self.direction;
        let length = (x * x + y * y + z * z).sqrt();
        let held = self.direction.iter().all(|part| (-MOST..=MOST).contains(part));
        if !(held && length > 0.0) {
            let bounds = "give three numbers from −1000000 to 1000000, not all 0";
            return Err(("direction", format!("{:?}", self.direction), bounds));
        }
        Ok(PhongPeak {
            amplitude: self.amplitude as f32,
            direction: self.direction.map(|part| (part / length) as f32),
            exponent: self.exponent as f32,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<PhongPeak>, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("silk.json");
        std::fs::write(&path, text).unwrap();
        read_peaks(&path).map_err(|error| error.to_string())
    }

    fn one(amplitude: &str, direction: &str, exponent: &str) -> String {
        format!(
            "{{\"peaks\": [{{\"amplitude\": {amplitude}, \"direction\": {direction}, \"exponent\": {exponent}}}]}}"
        )
    }

    #[test]
    fn peaks_are_read_and_other_keys_passed_over() {
        let text = r#"{"rms": 0.1, "peaks": [
            {"amplitude": 0.4, "direction": [3, 0, 4], "exponent": 100, "energy": null},
            {"amplitude": 0, "direction": [0, 0, 1e-200], "exponent": 0}
        ]}"#;
        // A direction too short to have a length in doubles is none.
        assert!(read(text).unwrap_err().contains("peaks[1].direction"));
        let peaks = read(&text.replace("1e-200", "1e-9")).unwrap();
        let first = PhongPeak { amplitude: 0.4, direction: [0.6, 0.0, 0.8], exponent: 100.0 };
        assert_eq!(peaks[0], first);
        assert_eq!(peaks[1].direction, [0.0, 0.0, 1.0]);
    }

    #[test]
    fn errors_name_the_file_the_place_and_the_way_out() {
        let z = "[0, 0, 1]";
        for (text, says) in [
            ("{\"peaks\": [\n{\"amplitude\": 1,}]}".into(), "line 2 column 17"),
            ("{}".into(), "missing field `peaks`"),
            ("[1, 2".into(), "line 1"),
            (String::new(), "line 1 column 0"),
            ("{\"peaks\": []}".into(), "0 peaks: give 1 to 97"),
            (one("\"a\"", z, "1"), "invalid type: string \"a\", expected f64"),
            (one("-1", z, "1"), "`peaks[0].amplitude` is -1: give a number from 0"),
            (one("1", z, "1e9"), "`peaks[0].exponent` is 1000000000"),
            (one("1e999", z, "1"), "number out of range"),
            (one("1", "[0, 0, 0]", "1"), "`peaks[0].direction` is [0.0, 0.0, 0.0]: give three"),
            (one("1", "[0, 1]", "1"), "array of length 3"),
            (one("1", "[0, 0, 1e300]", "1"), "`peaks[0].direction`"),
        ] {
            let message = read(&text).unwrap_err();
            assert!(message.contains("silk.json") && message.contains(says), "{message}");
        }
        let peak = "{\"amplitude\": 1, \"direction\": [0, 0, 1], \"exponent\": 1}";
        let many = format!("{{\"peaks\": [{}]}}", [peak; CAPACITY + 1].join(","));
        assert!(read(&many).unwrap_err().contains("98 peaks"));
        let missing = read_peaks(Path::new("no/such.json")).unwrap_err().to_string();
        assert!(missing.starts_with("cannot read no/such.json"), "{missing}");
    }
}
