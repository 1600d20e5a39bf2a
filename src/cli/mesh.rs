//! `ga-physics mesh FILE [--json] [--save]`: what a mesh is, what is wrong with it, and its mass properties and enclosing
//! sphere. With `--save` the mass properties are kept beside the mesh, for scenes that use it; see [`mass_file`].
//!
//! Exit code 0 if the mesh is usable as a body, 2 if not. With `--json` the report goes to standard output in either case,
//! for a file that cannot be read too (then with `triangles` 0 and the reason in `messages`). What is not defined is null:
//! the volume of a surface that does not close, the centre and inertia of what does not enclose a positive volume. The
//! sphere is the smallest around the vertices that facets use. A file kept beside the mesh that is of no use to scenes is a
//! warning.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::algebra::cga::Point;
use crate::geometry::enclosing_sphere::enclosing_sphere;
use crate::geometry::mass_properties::principal_axes;
use crate::geometry::mesh_checks::{MeshReport, Message, Severity, check};
use crate::io::mass_file::{self, KeptMass};
use crate::io::mesh_file::{MeshFile, MeshFileError, read_mesh};
use anyhow::Context;
use serde::Serialize;

/// Exit code for a mesh that can be a body.
const USABLE: u8 = 0;
/// Exit code for a mesh that cannot: the user's input is wrong.
const NOT_USABLE: u8 = 2;

/// What the command says about a mesh; the fields of its JSON.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct MeshSummary {
    /// Number of facets.
    pub triangles: usize,
    /// Every edge has an even number of triangles (two on a manifold).
    pub closed: bool,
    /// The facets agree about the outside.
    pub oriented: bool,
    /// At most two triangles on an edge, one fan at a vertex, no triangle twice.
    pub manifold: bool,
    /// The surface bounds a convex solid.
    pub convex: bool,
    /// Closed, oriented, of positive volume.
    pub usable_as_body: bool,
    /// Signed volume (m³).
    pub volume_m3: Option<f64>,
    /// Centre of mass (m).
    pub centre_m: Option<[f64; 3]>,
    /// Inertia at density 1 kg/m³ about the centre (kg m²), row-major, off-diagonals -∫xy.
    pub inertia_unit_density: Option<[[f64; 3]; 3]>,
    /// Principal moments (kg m²) at density 1 kg/m³ about the centre, smallest first.
    pub principal_moments_unit_density: Option<[f64; 3]>,
    /// Unit vectors along the principal axes, in the order of the moments, right-handed.
    pub principal_axes: Option<[[f64; 3]; 3]>,
    /// Centre of the smallest enclosing sphere (m).
    pub sphere_centre_m: Option<[f64; 3]>,
    /// Its radius (m).
    pub sphere_radius_m: Option<f64>,
    /// Findings, errors first, each with its severity in front.
    pub messages: Vec<String>,
}

/// What to examine, and where to say what was found.
#[derive(Clone, Debug)]
pub struct Options {
    /// The mesh file.
    pub file: PathBuf,
    /// The report as JSON.
    pub json: bool,
    /// Keep the mass properties beside the mesh.
    pub save: bool,
}

/// Reads and examines a mesh file.
///
/// # Errors
/// [`MeshFileError`] if the file holds no mesh. A mesh that is not usable as a body is no error: see the messages.
pub fn report(path: &Path) -> Result<MeshSummary, MeshFileError> {
    read_mesh(path).map(|file| {
        let mut summary = summarise(&file, &check(&file.mesh));
        if let Err(error) = mass_file::read(path, &file.fingerprint) {
            summary.messages.push(format!("{}: {error}", Severity::Warning));
        }
        summary
    })
}

/// Reads and examines a mesh file and keeps its mass properties beside it, if it is usable as a body.
///
/// # Errors
/// The file holds no mesh, or what is kept of it cannot be written.
pub fn report_and_save(path: &Path) -> anyhow::Result<MeshSummary> {
    let file = read_mesh(path)?;
    let found = check(&file.mesh);
    let mut summary = summarise(&file, &found);
    summary.messages.push(match found.mass_properties {
        Some(properties) => {
            let kept = KeptMass { convex: found.convex, properties };
            let place = mass_file::write(path, &file.fingerprint, &kept)?;
            format!("{}: mass properties kept in {}", Severity::Note, place.display())
        }
        None => format!("{}: nothing to keep: not usable as a body", Severity::Warning),
    });
    Ok(summary)
}

/// Writes the report on `out`, as text or as JSON, and returns the exit code: 0 if usable as a body, 2 if not.
///
/// # Errors
/// `out` cannot be written to; and, without `json`, a file that holds no mesh or a summary that cannot be kept (exit code 2
/// is right for both).
pub fn run(options: &Options, out: &mut dyn Write) -> anyhow::Result<u8> {
    let path = &options.file;
    let found = if options.save { report_and_save(path) } else { report(path).map_err(Into::into) };
    let summary = match found {
        Ok(summary) => summary,
        Err(error) if options.json => {
            MeshSummary { messages: vec![format!("{}: {error}", Severity::Error)], ..MeshSummary::default() }
        }
        Err(error) => return Err(error),
    };
    if options.json {
        serde_json::to_writer_pretty(&mut *out, &summary).context("cannot write the report")?;
        writeln!(out).context("cannot write the report")?;
    } else {
        write_text(path, &summary, out).context("cannot write the report")?;
    }
    Ok(if summary.usable_as_body { USABLE } else { NOT_USABLE })
}

fn summarise(file: &MeshFile, found: &MeshReport) -> MeshSummary {
    let mesh = &file.mesh;
    let mass = found.mass_properties;
    let principal = mass.and_then(|mass| principal_axes(mass.inertia_unit_density).ok());
    let sphere = enclosing_sphere(&mesh.used_vertices());
    let mut messages: Vec<String> = found.messages.iter().map(Message::to_string).collect();
    if let Err(error) = &sphere {
        messages.push(format!("{}: no enclosing sphere: {error}", Severity::Warning));
    }
    if file.unused_vertices > 0 {
        let n = file.unused_vertices;
        let vertices = if n == 1 { "1 vertex" } else { &format!("{n} vertices") };
        messages.push(format!("{}: {vertices} of the file not used by any facet and ignored", Severity::Note));
    }
    let ball = sphere.ok().map(|s| s.ball);
    MeshSummary {
        triangles: mesh.triangles.len(),
        closed: found.closed,
        oriented: found.oriented,
        manifold: found.manifold,
        convex: found.convex,
        usable_as_body: found.usable_as_body,
        volume_m3: found.volume,
        centre_m: mass.map(|m| coordinates(m.centre)),
        inertia_unit_density: mass.map(|m| m.inertia_unit_density),
        principal_moments_unit_density: principal.map(|p| p.moments),
        principal_axes: principal.map(|p| p.axes.map(|axis| [axis.e1, axis.e2, axis.e3])),
        sphere_centre_m: ball.map(|b| coordinates(b.centre)),
        sphere_radius_m: ball.map(|b| b.radius),
        messages,
    }
}

fn coordinates(p: Point<f64>) -> [f64; 3] {
    [p.x, p.y, p.z]
}

fn write_text(path: &Path, summary: &MeshSummary, out: &mut dyn Write) -> std::io::Result<()> {
    let yes = |b: bool| if b { "yes" } else { "no" };
    let verdict = if summary.usable_as_body { "usable as a body" } else { "NOT usable as a body" };
    writeln!(out, "{}: {verdict}", path.display())?;
    writeln!(out, "  triangles       {}", summary.triangles)?;
    for (name, value) in [
        ("closed", summary.closed),
        ("oriented", summary.oriented),
        ("manifold", summary.manifold),
        ("convex", summary.convex),
    ] {
        writeln!(out, "  {name:<14}  {}", yes(value))?;
    }
    if let Some(volume) = summary.volume_m3 {
        writeln!(out, "  volume          {volume:?} m³")?;
    }
    if let Some([x, y, z]) = summary.centre_m {
        writeln!(out, "  centre          ({x:?}, {y:?}, {z:?}) m")?;
    }
    for (row, [x, y, z]) in summary.inertia_unit_density.iter().flatten().enumerate() {
        let name = if row == 0 { "inertia" } else { "" };
        let unit = if row == 0 { "  kg m² about the centre, at 1 kg/m³" } else { "" };
        writeln!(out, "  {name:<14}  {x:>14.6e} {y:>14.6e} {z:>14.6e}{unit}")?;
    }
    let principal =
        summary.principal_moments_unit_density.iter().flatten().zip(summary.principal_axes.iter().flatten());
    for (row, (moment, [x, y, z])) in principal.enumerate() {
        let name = if row == 0 { "principal" } else { "" };
        writeln!(out, "  {name:<14}  {moment:>14.6e} kg m² about ({x:.6}, {y:.6}, {z:.6})")?;
    }
    if let (Some([x, y, z]), Some(radius)) = (summary.sphere_centre_m, summary.sphere_radius_m) {
        writeln!(out, "  enclosed by     a sphere of radius {radius:?} m about ({x:?}, {y:?}, {z:?}) m")?;
    }
    summary.messages.iter().try_for_each(|message| writeln!(out, "  {message}"))
}
