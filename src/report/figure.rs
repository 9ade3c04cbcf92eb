//! A picture of a report: its file, its size and its caption.

use base64::Engine;
use serde::Serialize;

use super::canvas::Canvas;
use super::png;
use super::sheet::Frame;

/// A picture with what it shows.
#[derive(Serialize)]
pub struct Figure {
    /// Its file, relative to the report.
    pub file: String,
    /// What it shows, a sentence or two.
    pub caption: String,
    /// How wide it is shown, CSS pixels.
    width: u32,
    /// The picture as a data URI, if the page holds it; else where its file is, if the page shows it.
    uri: Option<String>,
    /// The bytes of its file.
    #[serde(skip)]
    pub png: Vec<u8>,
}

impl Figure {
    /// A drawing: a plot or a distribution.
    pub fn drawing(file: String, caption: String, drawing: &Canvas) -> Self {
        let png = png::drawing(&drawing.dots());
        Self { file, caption, width: drawing.width(), uri: Some(data_uri(&png)), png }
    }

    /// What it takes up in a page, bytes.
    pub fn size(&self) -> usize {
        self.uri.as_ref().map_or(0, String::len)
    }

    /// Has the page show its file instead of holding it.
    pub fn stand_beside(&mut self) {
        self.uri = Some(self.file.clone());
    }

    /// A contact sheet. The HTML report shows its images one by one, so it needs no URI.
    pub fn sheet(file: String, caption: String, drawing: &Canvas) -> Self {
        let png = png::exact(&drawing.dots());
        Self { file, caption, width: drawing.width(), uri: None, png }
    }
}

/// One image for flipping.
#[derive(Serialize)]
pub struct FrameImages {
    label: String,
    remark: String,
    image: String,
    error: Option<String>,
}

impl FrameImages {
    /// The images of a frame, as the page holds them.
    pub fn of(frame: &Frame) -> Self {
        Self {
            label: frame.label.clone(),
            remark: frame.remark.clone(),
            image: data_uri(&png::exact(&frame.image)),
            error: frame.error.as_ref().map(|picture| data_uri(&png::exact(picture))),
        }
    }
}

/// A PNG file as a URI that holds it.
pub fn data_uri(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", base64::engine::general_purpose::STANDARD.encode(png))
}
