//! Floor 7: reports.
