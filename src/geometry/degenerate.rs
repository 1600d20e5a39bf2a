//! The degenerate cases of constructions and meets, by name.

/// Why a construction has no answer, or no single one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Degenerate {
    /// Two points that should differ are the same within rounding.
    #[error("two of the points coincide within rounding; give distinct points")]
    CoincidentPoints,
    /// Three points on one line, within rounding: no circle, and no single plane, goes through them.
    #[error("the three points lie on one line within rounding; give points of a proper triangle")]
    CollinearPoints,
    /// Four points in one plane, within rounding: no single sphere goes through them.
    #[error("the four points lie in one plane within rounding; give corners of a proper tetrahedron")]
    CoplanarPoints,
    /// A line parallel to a plane: it meets it nowhere, or it lies in it.
    #[error("the line is parallel to the plane; it has no single point in common with it")]
    ParallelLineAndPlane,
    /// Two parallel planes.
    #[error("the planes are parallel; they have no single line in common")]
    ParallelPlanes,
    /// A vector without weight: a plane or a point at infinity where a finite point was expected.
    #[error("the vector has no weight: it is no finite point")]
    PointAtInfinity,
    /// A round of imaginary radius, where a real one was expected.
    #[error("the radius is imaginary: the two objects have no real point in common")]
    ImaginaryRound,
    /// The centre of a sphere has no image under inversion in it.
    #[error("the point is the centre of the sphere; its inverse is the point at infinity")]
    CentreOfInversion,
    /// An input that is infinite or not a number.
    #[error("a coordinate is infinite or not a number")]
    NotFinite,
    /// A difference or a squared radius that overflows, or is so small that it loses digits.
    #[error("a squared length is too large or too small for the number format; give lengths in a unit nearer to them")]
    OutOfRange,
}
