//! wrinkle measures how well a *filter* keeps the look of a bump-mapped surface when many bumps fall
//! into one pixel.
//!
//! A filter turns the part of a bump map under a pixel (its footprint) into a *multiple surface*: a
//! short list of lobes, each a spread of normals around a direction (Fournier 1992). Shading
//! evaluates the lobes at the half vector. The supersampled reference is the same average taken the
//! slow way. Everything else measures the distance between the two, and what each costs.
//!
//! The modules are floors: an upper one may use a lower one, never the other way. ARCHITECTURE.md is
//! the map.
#![deny(missing_docs)]
#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod cli;
pub mod evidence;
pub mod experiment;
pub mod file;
pub mod fit;
pub mod geometry;
pub mod job;
pub mod light;
pub mod lobe;
pub mod method;
pub mod metric;
pub mod parameter;
pub mod pattern;
pub mod render;
pub mod report;
pub mod scene;
pub mod surface;
pub mod synthesis;
pub mod texture;
pub mod tui;
