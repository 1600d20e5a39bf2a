//! io

pub mod mesh_file;
mod obj;
mod stl;
