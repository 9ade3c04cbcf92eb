//! Pictures on a terminal: by its own protocol, by half blocks, or by characters.
