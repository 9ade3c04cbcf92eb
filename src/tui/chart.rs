//! A chart with logarithmic axes, drawn in characters.
