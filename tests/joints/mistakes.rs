//! What cannot be held is told, by name.
