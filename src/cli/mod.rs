//! The commands of the program `ga-physics`: reports as data, as text and as JSON, and exit codes.

pub mod mesh;
