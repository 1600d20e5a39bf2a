//! Meshes from files: OBJ (Wavefront) and STL (binary and ASCII), welded where coordinates are equal.
//!
//! Coordinates are taken as metres. STL holds f32, which f64 represents exactly. Only geometry is read: no normals (the
//! order of the corners says what is outside), texture coordinates, colours or materials. Vertices are numbered from 0 in
//! the order in which facets first use them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::geometry::mesh::{Mesh, MeshError};
use crate::io::mass_file::Fingerprint;
use crate::io::{obj, stl};

/// A mesh as read from a file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MeshFile {
    /// The mesh, welded; every vertex is used by a facet.
    pub mesh: Mesh,
    /// Vertices that the file lists and no facet uses. They are dropped.
    pub unused_vertices: usize,
    /// Vertices joined because their coordinates are equal (in an STL, where each facet lists its own, most of them).
    pub welded_vertices: usize,
    /// The bytes of the file.
    pub fingerprint: Fingerprint,
}

/// Why a file gave no mesh.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshFileError {
    /// The file cannot be read.
    #[error("{}: {source}; check the path and that the file may be read", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The name does not end in a known extension.
    #[error("{}: the extension must be .obj or .stl; convert the mesh to one of these", path.display())]
    UnknownExtension {
        /// The file.
        path: PathBuf,
    },
    /// The contents do not make sense.
    #[error("{}{}: {problem}", path.display(), line.map_or_else(String::new, |line| format!(":{line}")))]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1, where it is known.
        line: Option<usize>,
        /// What is wrong, and the remedy.
        problem: String,
    },
    /// The contents are understood, but are no mesh.
    #[error("{}: {source}", path.display())]
    NoMesh {
        /// The file.
        path: PathBuf,
        /// Why.
        source: MeshError,
    },
}

/// What a format's reader finds: a mesh not yet welded and the number of vertices it dropped.
pub(super) struct Parsed {
    pub(super) mesh: Mesh,
    pub(super) unused_vertices: usize,
}

/// Why a format's reader gave up; the path is added here.
pub(super) enum ParseError {
    Malformed { line: Option<usize>, problem: String },
    NoMesh(MeshError),
}

/// Reads a mesh; the extension (`.obj`, `.stl`, in either case) decides the format.
///
/// Polygons are cut into fans from their first corner, which is right for convex ones. All objects and groups of an OBJ,
/// and all solids of an ASCII STL, are taken together.
///
/// # Errors
/// [`MeshFileError`]: the file cannot be read, has another extension, does not follow its format, has no facets, or holds
/// a number that is not finite.
pub fn read_mesh(path: &Path) -> Result<MeshFile, MeshFileError> {
    let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let parse = match extension.as_deref() {
        Some("obj") => obj::parse,
        Some("stl") => stl::parse,
        _ => return Err(MeshFileError::UnknownExtension { path: path.into() }),
    };
    let bytes = fs::read(path).map_err(|source| MeshFileError::Unreadable { path: path.into(), source })?;
    let parsed = parse(&bytes).map_err(|error| match error {
        ParseError::Malformed { line, problem } => MeshFileError::Malformed { path: path.into(), line, problem },
        ParseError::NoMesh(source) => MeshFileError::NoMesh { path: path.into(), source },
    })?;
    let mesh = parsed.mesh.welded();
    let welded_vertices = parsed.mesh.vertices.len() - mesh.vertices.len();
    let fingerprint = Fingerprint::of(&bytes);
    Ok(MeshFile { mesh, unused_vertices: parsed.unused_vertices, welded_vertices, fingerprint })
}
