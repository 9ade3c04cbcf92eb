//! Floor 2: parametric surfaces.
