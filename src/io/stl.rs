//! STL files, binary and ASCII, by the crate `stl_io`.
//!
//! `stl_io` tells the two apart by the first word, `solid `, which many binary files begin with too, wants a name after it,
//! and stops at the first `endsolid`. Here a file is binary if its length fits its count of triangles; a text with several
//! solids is read as one, and a file cut short is an error. Normals are not read.

use std::io::Cursor;

use crate::algebra::cga::Point;
use crate::geometry::mesh::Mesh;
use crate::io::mesh_file::{ParseError, Parsed};

/// A binary STL: a header, a count, then records of twelve f32 and two bytes.
const HEADER_BYTES: usize = 80;
const COUNT_BYTES: usize = 4;
const RECORD_BYTES: usize = 50;

/// Reads the facets of an STL file.
pub(super) fn parse(bytes: &[u8]) -> Result<Parsed, ParseError> {
    let mut reader = Cursor::new(unambiguous(bytes)?);
    let facets =
        stl_io::create_stl_reader(&mut reader).map_err(|error| malformed(format!("not a valid STL file: {error}")))?;
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for facet in facets {
        let place = triangles.len();
        let facet = facet
            .map_err(|error| malformed(format!("facet {place} (counted from 0): {error}; export the file again")))?;
        let base = u32::try_from(vertices.len())
            .map_err(|_| malformed("more vertices than 32 bits can number; split the mesh".into()))?;
        vertices.extend(facet.vertices.iter().map(|v| Point { x: v[0].into(), y: v[1].into(), z: v[2].into() }));
        triangles.push([base, base.saturating_add(1), base.saturating_add(2)]);
    }
    let mesh = Mesh::new(vertices, triangles).map_err(ParseError::NoMesh)?;
    Ok(Parsed { mesh, unused_vertices: 0 })
}

/// The file, binary or text, in the form that `stl_io` recognises as such.
fn unambiguous(bytes: &[u8]) -> Result<Vec<u8>, ParseError> {
    let text = str::from_utf8(bytes).ok().filter(|t| starts_like_text(t));
    match (text, records(bytes)) {
        (_, Some((count, room))) if room == count => Ok(binary(bytes)),
        (Some(text), _) => ascii(text),
        (None, Some((count, room))) if room > count => {
            Err(malformed(format!("the count says {count} triangles, the file holds {room}; export it again")))
        }
        (None, Some((count, room))) => Err(malformed(format!(
            "the file is cut short: the count says {count} triangles, there are {room}; copy or export it again"
        ))),
        (None, None) => {
            Err(malformed("not an STL file: too short for a binary one, and not text that starts with `solid`".into()))
        }
    }
}

fn malformed(problem: String) -> ParseError {
    ParseError::Malformed { line: None, problem }
}

fn starts_like_text(text: &str) -> bool {
    text.split_whitespace().next().is_some_and(|word| word.eq_ignore_ascii_case("solid"))
}

/// Of a binary file, the number of triangles that it states and the number that it has room for.
fn records(bytes: &[u8]) -> Option<(usize, usize)> {
    let (_, rest) = bytes.split_at_checked(HEADER_BYTES)?;
    let (count, records) = rest.split_first_chunk::<COUNT_BYTES>()?;
    Some((usize::try_from(u32::from_le_bytes(*count)).ok()?, records.len() / RECORD_BYTES))
}

/// The file with a header that cannot be taken for text.
fn binary(bytes: &[u8]) -> Vec<u8> {
    let mut clean = bytes.to_vec();
    clean.iter_mut().take(HEADER_BYTES).for_each(|b| *b = 0);
    clean
}

/// The facets of all solids as one, in lower case.
fn ascii(text: &str) -> Result<Vec<u8>, ParseError> {
    let (mut begun, mut ended) = (0usize, 0usize);
    let mut clean = String::from("solid mesh\n");
    for line in text.lines() {
        let lower = line.trim().to_ascii_lowercase();
        match lower.split_whitespace().next() {
            Some("solid") => begun += 1,
            Some("endsolid") => ended += 1,
            _ => {
                clean.push_str(&lower);
                clean.push('\n');
            }
        }
    }
    if begun != ended {
        return Err(malformed(format!(
            "{begun} `solid` but {ended} `endsolid`: the file is cut short; copy or export it again"
        )));
    }
    clean.push_str("endsolid mesh\n");
    Ok(clean.into_bytes())
}
