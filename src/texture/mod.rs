//! Floor 1: what a bump map is made of. Height maps, normal maps, pyramids of moments, image files.

mod bend;
mod ellipse;
mod footprint;
mod height_map;
mod horizon;
pub mod image_file;
mod integrate;
mod interpolation;
mod lookup;
mod normal_map;
mod pyramid;
mod relief;
mod wrap;

pub use bend::Bend;
pub use footprint::Footprint;
pub use height_map::HeightMap;
pub use horizon::{HorizonMap, SIDES};
pub use integrate::{Integrated, Residual, integrate};
pub use interpolation::{Interpolation, Spline};
pub use lookup::{Cell, Levels, Lookup, MOST_PROBES};
pub use normal_map::{MIN_COSINE, NormalMap, Texel};
pub use pyramid::{Moments, Pyramid, downsample, level_sizes, tap_weights};
pub use relief::Relief;
pub use wrap::{Taps, Wrap};
