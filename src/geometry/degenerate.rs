//! The degenerate cases of constructions and meets, by name.

use core::fmt;

/// Why a construction has no answer, or no single one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Degenerate {
    /// Two points that should differ are the same within rounding.
    CoincidentPoints,
    /// Three points on one line, within rounding: no circle, and no single plane, goes through them.
    CollinearPoints,
    /// Four points in one plane, within rounding: no single sphere goes through them.
    CoplanarPoints,
    /// A line parallel to a plane: it meets it nowhere, or it lies in it.
    ParallelLineAndPlane,
    /// Two parallel planes.
    ParallelPlanes,
    /// A vector without weight: a plane or a point at infinity where a finite point was expected.
    PointAtInfinity,
    /// A round of imaginary radius, where a real one was expected.
    ImaginaryRound,
    /// The centre of a sphere has no image under inversion in it.
    CentreOfInversion,
    /// An input that is infinite or not a number.
    NotFinite,
}

impl fmt::Display for Degenerate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::CoincidentPoints => "two of the points coincide within rounding; give distinct points",
            Self::CollinearPoints => {
                "the three points lie on one line within rounding; give points of a proper triangle"
            }
            Self::CoplanarPoints => {
                "the four points lie in one plane within rounding; give corners of a proper tetrahedron"
            }
            Self::ParallelLineAndPlane => "the line is parallel to the plane; it has no single point in common with it",
            Self::ParallelPlanes => "the planes are parallel; they have no single line in common",
            Self::PointAtInfinity => "the vector has no weight: it is no finite point",
            Self::ImaginaryRound => "the radius is imaginary: the two objects have no real point in common",
            Self::CentreOfInversion => "the point is the centre of the sphere; its inverse is the point at infinity",
            Self::NotFinite => "a coordinate is infinite or not a number",
        })
    }
}

impl core::error::Error for Degenerate {}
