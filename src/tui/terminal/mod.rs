//! The terminal itself: taken, given back whatever happens, and asked what it can show.
