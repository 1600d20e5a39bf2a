//! The geometry of an OBJ file, by the crate `tobj`.
//!
//! `tobj` reports no line numbers, leaves facets of one or two corners out, makes facets of `l` lines, and overflows on
//! huge texture indices. So it is handed the geometry only, `v x y z` and `f i j k ...`, as one object; what it would leave
//! out is an error here, and what it refuses is looked up again to name the line. Comments may follow on a line, and a
//! line may continue after a backslash. The weight of `v x y z w` belongs to curves, not to facets, and is ignored.

use crate::algebra::cga::Point;
use crate::geometry::mesh::Mesh;
use crate::io::mesh_file::{ParseError, Parsed};

/// A line of geometry: where it stands (counted from 1) and its words, the first of which is `v` or `f`.
struct Line<'a> {
    number: usize,
    words: Vec<&'a str>,
}

impl Line<'_> {
    fn is_facet(&self) -> bool {
        self.words.first() == Some(&"f")
    }
}

/// Stands for the end of a line that continues, so that lines are still counted. No OBJ file holds this character.
const CONTINUED: char = '\u{1}';

/// Reads the facets of an OBJ file.
pub(super) fn parse(bytes: &[u8]) -> Result<Parsed, ParseError> {
    // Names in other encodings than UTF-8 are no concern of the geometry.
    let text = String::from_utf8_lossy(bytes);
    let mark = CONTINUED.to_string();
    let joined = text.replace("\\\r\n", &mark).replace("\\\n", &mark);
    let lines = geometry(&joined);
    let n_facets = lines.iter().filter(|l| l.is_facet()).count();
    let n_vertices = lines.len() - n_facets;
    if n_facets == 0 {
        let problem = match n_vertices {
            0 => "no geometry; is this an OBJ file?",
            _ => "vertices but no facets (no `f` lines); export the mesh with its faces",
        };
        return Err(ParseError::Malformed { line: None, problem: problem.into() });
    }
    if let Some(problem) = lines.iter().find_map(problem) {
        return Err(problem);
    }
    let mesh = facets(&lines, n_vertices)?;
    let unused_vertices = n_vertices.saturating_sub(mesh.vertices.len());
    Ok(Parsed { mesh, unused_vertices })
}

/// The mesh of the vertices that facets use, in the order of their use.
fn facets(lines: &[Line<'_>], n_vertices: usize) -> Result<Mesh, ParseError> {
    let clean: String = lines.iter().map(|l| l.words.join(" ") + "\n").collect();
    let no_materials = |_: &std::path::Path| Ok((Vec::new(), Default::default()));
    let (models, _) = tobj::load_obj_buf(&mut clean.as_bytes(), &tobj::GPU_LOAD_OPTIONS, no_materials)
        .map_err(|error| explain(lines, n_vertices, error))?;
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for model in &models {
        let base = u32::try_from(vertices.len()).unwrap_or(u32::MAX);
        let (points, _) = model.mesh.positions.as_chunks::<3>();
        vertices.extend(points.iter().map(|&[x, y, z]| Point { x, y, z }));
        let (facets, _) = model.mesh.indices.as_chunks::<3>();
        triangles.extend(facets.iter().map(|facet| facet.map(|i| base.saturating_add(i))));
    }
    Mesh::new(vertices, triangles).map_err(ParseError::NoMesh)
}

/// The lines of geometry, without comments, each facet reduced to the indices of its positions (`i` of `i/j/k`).
fn geometry(joined: &str) -> Vec<Line<'_>> {
    let mut number = 0;
    let mut lines = Vec::new();
    for line in joined.lines() {
        number += 1;
        let code = line.split('#').next().unwrap_or_default();
        let mut words = code.split(|c: char| c.is_whitespace() || c == CONTINUED).filter(|w| !w.is_empty());
        match words.next() {
            Some("v") => lines.push(Line { number, words: core::iter::once("v").chain(words.take(3)).collect() }),
            Some("f") => {
                let positions = words.map(|w| w.split('/').next().unwrap_or_default());
                lines.push(Line { number, words: core::iter::once("f").chain(positions).collect() });
            }
            _ => {}
        }
        number += line.matches(CONTINUED).count();
    }
    lines
}

/// What is wrong with a line taken by itself.
fn problem(line: &Line<'_>) -> Option<ParseError> {
    let words = line.words.get(1..).unwrap_or_default();
    let problem = if !line.is_facet() {
        let bad = words.iter().find(|w| !w.parse::<f64>().is_ok_and(f64::is_finite));
        match bad {
            Some(word) => format!("the coordinate `{word}` is not a finite number"),
            None if words.len() < 3 => format!("a vertex needs three coordinates, this one has {}", words.len()),
            None => return None,
        }
    } else {
        let bad = words.iter().find(|w| !w.parse::<i64>().is_ok_and(|i| i != 0));
        match bad {
            Some(word) => format!("`{word}` is not the index of a vertex; these count from 1, or back from -1"),
            None if words.len() < 3 => format!("a facet needs three corners or more, this one has {}", words.len()),
            None => return None,
        }
    };
    Some(ParseError::Malformed { line: Some(line.number), problem })
}

/// What `tobj` refuses after [`problem`] found nothing: an index without a vertex. Looks it up.
fn explain(lines: &[Line<'_>], n_vertices: usize, error: tobj::LoadError) -> ParseError {
    let mut n_before = 0usize;
    for line in lines {
        let Some((&"f", words)) = line.words.split_first() else {
            n_before += 1;
            continue;
        };
        // Positive indices may point ahead; negative ones count back from the vertices so far.
        let exists =
            |i: i64| usize::try_from(i.unsigned_abs()).is_ok_and(|n| n <= if i > 0 { n_vertices } else { n_before });
        if let Some(word) = words.iter().find(|w| !w.parse::<i64>().is_ok_and(exists)) {
            let problem = format!(
                "the facet uses vertex {word}, but the file has {n_vertices}, {n_before} of them before this line"
            );
            return ParseError::Malformed { line: Some(line.number), problem };
        }
    }
    ParseError::Malformed { line: None, problem: format!("not a valid OBJ file: {error}") }
}
