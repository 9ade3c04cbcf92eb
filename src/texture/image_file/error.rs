//! What can go wrong with an image file.

use std::error::Error as _;
use std::io;
use std::path::{Path, PathBuf};

/// Why an image file was not read or written. Every message names the file and says what to do.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// There is no such file.
    #[error("{}: there is no such file; in an experiment file, a path is relative to that file", path.display())]
    NotFound {
        /// The file.
        path: PathBuf,
    },
    /// The system refuses to read it.
    #[error("{}: cannot be read ({source})", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Its first bytes are of no format known here.
    #[error("{}: not an image that can be read here; save it as PNG, TIFF, WebP or EXR", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// It ends too early.
    #[error("{}: the file is cut short; copy or export it again", path.display())]
    Truncated {
        /// The file.
        path: PathBuf,
    },
    /// It is whole, but uses something the decoder does not know.
    #[error("{}: this kind of file is not supported ({what}); save it again as PNG, or as EXR with ZIP compression and \
             R, G and B channels", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// What is not known.
        what: String,
    },
    /// It breaks its format's rules.
    #[error("{}: the file is damaged ({what}); copy or export it again", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What the decoder says.
        what: String,
    },
    /// It has no bytes or no pixels.
    #[error("{}: the image is empty; export it again", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// It has more pixels than a map may have.
    #[error("{}: {width} × {height} pixels are too many; scale it down to at most {limit} a side", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Most pixels across or down.
        limit: u32,
    },
    /// A sample is infinite or not a number.
    #[error("{}: the pixel {x} from the left, {y} from the top (counted from 0) is {value}; \
             replace samples that are not finite", path.display())]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// Pixels from the left.
        x: usize,
        /// Pixels from the top.
        y: usize,
        /// The sample.
        value: f32,
    },
    /// It has a single channel where a normal map needs two.
    #[error("{}: a grey image holds no normals; read it with kind = \"height\"", path.display())]
    Grey {
        /// The file.
        path: PathBuf,
    },
    /// It could not be written.
    #[error("{}: cannot be written ({source})", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

impl ImageError {
    /// What a failure to open or read `path` means.
    pub(super) fn reading(path: &Path, source: io::Error) -> Self {
        let path = path.to_owned();
        match source.kind() {
            io::ErrorKind::NotFound => Self::NotFound { path },
            io::ErrorKind::UnexpectedEof => Self::Truncated { path },
            _ => Self::Unreadable { path, source },
        }
    }

    /// What a decoder's failure on `path` means.
    pub(super) fn decoding(path: &Path, error: image::ImageError) -> Self {
        use image::ImageError as Decoder;
        let owned = path.to_owned();
        match error {
            Decoder::IoError(source) => Self::reading(path, source),
            Decoder::Unsupported(e) => Self::Unsupported { path: owned, what: e.to_string() },
            Decoder::Limits(_) => {
                Self::Damaged { path: owned, what: "it asks for more memory than its size".into() }
            }
            other => {
                // The decoders' own words are in the source, where there is one.
                let what = other.source().map_or_else(|| other.to_string(), |s| s.to_string());
                Self::in_words(owned, what)
            }
        }
    }

    /// What a failure of the EXR decoder itself on `path` means.
    pub(super) fn decoding_exr(path: &Path, error: exr::error::Error) -> Self {
        use exr::error::Error as Decoder;
        match error {
            Decoder::Io(source) => Self::reading(path, source),
            Decoder::NotSupported(what) => {
                Self::Unsupported { path: path.to_owned(), what: what.into_owned() }
            }
            other => Self::in_words(path.to_owned(), other.to_string()),
        }
    }

    /// What a decoder's words on a file mean.
    fn in_words(path: PathBuf, what: String) -> Self {
        if is_about_missing_bytes(&what) {
            Self::Truncated { path }
        } else if is_about_features(&what) {
            Self::Unsupported { path, what }
        } else {
            Self::Damaged { path, what }
        }
    }
}

/// Whether a decoder's message means that the file ends too early. They have no common type for it.
fn is_about_missing_bytes(what: &str) -> bool {
    ["missing bytes", "chunk was missing", "end of file", "unexpected eof", "failed to fill"]
        .iter()
        .any(|words| what.to_lowercase().contains(words))
}

/// Whether a decoder's message means that the file is fine but beyond it.
fn is_about_features(what: &str) -> bool {
    ["not supported", "unsupported", "unimplemented", "does not contain non-deep rgb"]
        .iter()
        .any(|words| what.to_lowercase().contains(words))
}
