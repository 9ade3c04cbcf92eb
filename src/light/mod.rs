//! Floor 3: lights.
