//! Floor 4: error measures between images, and between distributions.
