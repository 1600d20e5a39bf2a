//! Import of meshes, record and export formats. It decides nothing: it reads and writes what it is given.

pub mod files;
pub mod html;
pub mod mass_file;
pub mod mesh_file;
mod obj;
mod stl;
pub mod summary;
pub mod tables;
