//! A table sorted by any column.
