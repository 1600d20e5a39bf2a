//! Mass properties kept beside their mesh: `gem.obj.mass.toml` beside `gem.obj`, and used only while the mesh is unchanged.
//!
//! The report's program stored the inertia of a solid in a data file when it was first imported. So does this, on request
//! (`ga-physics mesh FILE --save`). The file can be read by people: TOML with a format number, what it was made from
//! (length and SHA-256 of the mesh file, as `sha256sum` prints it), the verdict of the checks that a body needs, and volume,
//! centre and inertia at 1 kg/m³ with 17 digits, which give back every bit. Its last line is the SHA-256 of all lines above.
//!
//! Nothing is guessed: a file that was cut short, altered, written by another version or made from other bytes than the
//! mesh has now is an error that says how to be rid of it, never a reason to compute in silence.

use std::fmt::Write as _;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use crate::algebra::cga::Point;
use crate::geometry::mass_properties::MassProperties;
use crate::io::files::{WriteError, write_whole};
use serde::Deserialize;
use sha2::{Digest, Sha256};

/// The format that is written, and the only one that is read.
pub const FORMAT: i64 = 1;

/// Which bytes a mesh was read from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fingerprint {
    /// How many.
    pub bytes: u64,
    /// Their SHA-256, in lower-case hexadecimal digits.
    pub sha256: String,
}

impl Fingerprint {
    /// Of these bytes.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        Self { bytes: bytes.len() as u64, sha256: sha256(bytes) }
    }
}

/// What is kept of a mesh that is usable as a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeptMass {
    /// Whether the solid is convex.
    pub convex: bool,
    /// In the frame of the mesh file, m; at 1 kg/m³.
    pub properties: MassProperties,
}

/// Why a kept file is of no use, or was not written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MassFileError {
    /// It is there and cannot be read.
    #[error("{}: {source}; {}", path.display(), remedy(path))]
    Unreadable {
        /// The kept file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// It ends before its closing line.
    #[error("{}: cut short, or not closed by its `checksum` line; {}", path.display(), remedy(path))]
    Truncated {
        /// The kept file.
        path: PathBuf,
    },
    /// Its lines are not the ones that were written.
    #[error("{}: altered since it was written: the checksum in its last line is not that of the lines above; {}", path.display(), remedy(path))]
    Altered {
        /// The kept file.
        path: PathBuf,
    },
    /// It is whole, and still not understood.
    #[error("{}: {problem}; {}", path.display(), remedy(path))]
    Malformed {
        /// The kept file.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// Another version wrote it.
    #[error("{}: format {format}, where this version reads format {FORMAT}; {}", path.display(), remedy(path))]
    OtherFormat {
        /// The kept file.
        path: PathBuf,
        /// Its format.
        format: i64,
    },
    /// The mesh has changed.
    #[error(
        "{}: stale, made from another content of the mesh ({} bytes, SHA-256 {}...; now {} bytes, {}...); {}",
        path.display(), kept.bytes, head(&kept.sha256), now.bytes, head(&now.sha256), remedy(path)
    )]
    Stale {
        /// The kept file.
        path: PathBuf,
        /// What it was made from.
        kept: Fingerprint,
        /// What the mesh is now.
        now: Fingerprint,
    },
    /// It cannot be written.
    #[error(transparent)]
    Unwritten(#[from] WriteError),
}

/// The remedy that all of these have.
fn remedy(path: &Path) -> String {
    let mesh = path.with_extension("").with_extension("");
    format!("delete it, or make it anew: `ga-physics mesh {} --save`", mesh.display())
}

/// Enough digits to tell two contents apart by eye.
fn head(sha256: &str) -> &str {
    sha256.get(..8).unwrap_or(sha256)
}

/// The file as TOML has it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Kept {
    format: i64,
    mesh_bytes: u64,
    mesh_sha256: String,
    convex: bool,
    volume_m3: f64,
    centre_m: [f64; 3],
    inertia_unit_density: [[f64; 3]; 3],
}

/// Read first, so that another format is told from a fault of this one.
#[derive(Deserialize)]
struct Format {
    format: i64,
}

/// Where the mass properties of a mesh file are kept: beside it.
#[must_use]
pub fn path_beside(mesh: &Path) -> PathBuf {
    let mut name = mesh.file_name().unwrap_or_default().to_os_string();
    name.push(".mass.toml");
    mesh.with_file_name(name)
}

/// Keeps the mass properties of a mesh, in place of what was kept before; returns where.
///
/// # Errors
/// The file cannot be written.
pub fn write(mesh: &Path, fingerprint: &Fingerprint, kept: &KeptMass) -> Result<PathBuf, MassFileError> {
    let path = path_beside(mesh);
    let mut text = text(mesh, fingerprint, kept);
    let checksum = sha256(text.as_bytes());
    text += &format!("{CLOSING}{checksum}\"\n");
    write_whole(&path, |out| out.write_all(text.as_bytes()))?;
    Ok(path)
}

/// How the last line begins.
const CLOSING: &str = "checksum = \"";

fn text(mesh: &Path, fingerprint: &Fingerprint, kept: &KeptMass) -> String {
    // 17 significant digits name one f64.
    let row = |x: [f64; 3]| format!("[{:.16e}, {:.16e}, {:.16e}]", x[0], x[1], x[2]);
    let KeptMass { convex, properties: MassProperties { volume, centre, inertia_unit_density } } = kept;
    let [xx, yy, zz] = inertia_unit_density.map(row);
    let mut text = String::new();
    let lines = [
        format!("# Mass properties of {:?}, in its frame, at 1 kg/m³.", mesh.file_name().unwrap_or_default()),
        "# Written by `ga-physics mesh FILE --save`, and used only while the mesh is unchanged.".into(),
        format!("format = {FORMAT}"),
        format!("mesh_bytes = {}", fingerprint.bytes),
        format!("mesh_sha256 = \"{}\"", fingerprint.sha256),
        format!("convex = {convex}"),
        format!("volume_m3 = {volume:.16e}"),
        format!("centre_m = {}", row([centre.x, centre.y, centre.z])),
        "# kg m² about the centre; off-diagonals are -∫xy.".into(),
        format!("inertia_unit_density = [{xx}, {yy}, {zz}]"),
    ];
    for line in lines {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{line}");
    }
    text
}

/// What is kept beside a mesh file; nothing if there is no such file.
///
/// # Errors
/// [`MassFileError`]: there is one, and it cannot be used.
pub fn read(mesh: &Path, now: &Fingerprint) -> Result<Option<KeptMass>, MassFileError> {
    let path = path_beside(mesh);
    let bytes = match fs::read(&path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(source) => return Err(MassFileError::Unreadable { path, source }),
    };
    let Ok(text) = String::from_utf8(bytes) else {
        return Err(MassFileError::Malformed { path, problem: "not UTF-8 text".into() });
    };
    parse(path, &text, now).map(Some)
}

fn parse(path: PathBuf, text: &str, now: &Fingerprint) -> Result<KeptMass, MassFileError> {
    let Some((above, checksum)) = closed(text) else {
        return Err(MassFileError::Truncated { path });
    };
    if checksum != sha256(above.as_bytes()) {
        return Err(MassFileError::Altered { path });
    }
    let malformed =
        |error: toml::de::Error| MassFileError::Malformed { path: path.clone(), problem: error.message().into() };
    let Format { format } = toml::from_str(above).map_err(malformed)?;
    if format != FORMAT {
        return Err(MassFileError::OtherFormat { path, format });
    }
    let kept: Kept = toml::from_str(above).map_err(malformed)?;
    debug_assert_eq!(kept.format, format, "read twice");
    let made_from = Fingerprint { bytes: kept.mesh_bytes, sha256: kept.mesh_sha256 };
    if made_from != *now {
        return Err(MassFileError::Stale { path, kept: made_from, now: now.clone() });
    }
    let ([x, y, z], inertia) = (kept.centre_m, kept.inertia_unit_density);
    let finite = inertia.iter().flatten().chain(&kept.centre_m).all(|number| number.is_finite());
    if !(finite && kept.volume_m3 > 0.0 && kept.volume_m3.is_finite()) {
        let problem = "numbers that no solid has".into();
        return Err(MassFileError::Malformed { path, problem });
    }
    let properties =
        MassProperties { volume: kept.volume_m3, centre: Point { x, y, z }, inertia_unit_density: inertia };
    Ok(KeptMass { convex: kept.convex, properties })
}

/// The lines above the closing one, and the checksum in it.
fn closed(text: &str) -> Option<(&str, &str)> {
    let start = text.rfind(CLOSING)?;
    let (above, last) = text.split_at(start);
    let checksum = last.strip_prefix(CLOSING)?.strip_suffix("\"\n")?;
    above.ends_with('\n').then_some((above, checksum))
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}
