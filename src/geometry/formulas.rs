//! The formulas of geometry, compiled as a whole: rounds, flats and reflections of points, planes and spheres.
//!
//! They are kernels: straight-line and unchecked, so that they run on every scalar; coplanar points divide by zero, as
//! floats do. The checked constructions of [`crate::geometry`] stand on them. Each has a twin over the dynamic
//! multivector, `.._dynamic`, product by product and in the world: what it is tested and measured against. A formula
//! `.._relative` returns its result in the frame of its first point, for whoever goes on from there.

use crate::formula;

/// The sphere through four points: centre and squared radius, in the local frame of the first point. Coplanar
/// points divide by zero; `geometry::sphere_through` has the checked form.
#[formula(crate::algebra::cga, local = a, dynamic = circumsphere_dynamic)]
pub fn circumsphere(a: Point, b: Point, c: Point, d: Point) -> Sphere {
    (a ^ b ^ c ^ d).dual().normalised()
}

/// The sphere through four points relative to the first, of weight 6 times their signed volume.
#[formula(crate::algebra::cga, relative = a, dynamic = circumsphere_relative_dynamic)]
pub fn circumsphere_relative(a: Point, b: Point, c: Point, d: Point) -> Round {
    (a ^ b ^ c ^ d).dual()
}

/// The smallest sphere through three points: it has the centre and radius of their circle. With the circle
/// `K = a ^ b ^ c` it is `K ^ (K ^ ninf)*`; the result is relative to the first point, of weight 4 times the squared
/// area.
#[formula(crate::algebra::cga, relative = a, dynamic = circle_sphere_relative_dynamic)]
pub fn circle_sphere_relative(a: Point, b: Point, c: Point) -> Round {
    let circle = a ^ b ^ c;
    (circle ^ (circle ^ Infinity).dual()).dual()
}

/// The smallest sphere through three points: centre and squared radius of their circle. Collinear points divide by zero;
/// `geometry::circle_through` has the checked form.
#[formula(crate::algebra::cga, local = a, dynamic = circle_sphere_dynamic)]
pub fn circle_sphere(a: Point, b: Point, c: Point) -> Sphere {
    let circle = a ^ b ^ c;
    (circle ^ (circle ^ Infinity).dual()).dual().normalised()
}

/// The smallest sphere through two points, `(A + B)/2 + (A . B)/2 ninf`: centre in the middle, radius half the distance.
#[formula(crate::algebra::cga, local = a, dynamic = pair_sphere_dynamic)]
pub fn pair_sphere(a: Point, b: Point) -> Sphere {
    (a + b) / 2 + ((a | b) * Infinity) / 2
}

/// The plane through three points relative to the first, with a normal of twice the area by the right-hand rule.
#[formula(crate::algebra::cga, relative = a, dynamic = plane_relative_dynamic)]
pub fn plane_relative(a: Point, b: Point, c: Point) -> Round {
    (a ^ b ^ c ^ Infinity).dual()
}

/// The line through two points relative to the first: `a ^ b ^ ninf`.
#[formula(crate::algebra::cga, relative = a, dynamic = line_relative_dynamic)]
pub fn line_relative(a: Point, b: Point) -> Line {
    a ^ b ^ Infinity
}

/// Where the line through two points meets a plane, relative to the first point.
#[formula(crate::algebra::cga, relative = a, dynamic = line_meets_plane_relative_dynamic)]
pub fn line_meets_plane_relative(a: Point, b: Point, plane: Plane) -> FlatPoint {
    plane | (a ^ b ^ Infinity)
}

/// Where the line through a point along a direction of any length meets a plane. A line parallel to the plane divides by
/// zero; `geometry::line_meets_plane` has the checked form.
#[formula(crate::algebra::cga, local = p, dynamic = ray_meets_plane_dynamic)]
pub fn ray_meets_plane(p: Point, u: Vector, plane: Plane) -> FinitePoint {
    (plane | (p ^ u ^ Infinity)).normalised()
}

/// Where a line given by its blade meets a plane. A line parallel to the plane divides by zero.
#[formula(crate::algebra::cga, dynamic = line_blade_meets_plane_dynamic)]
pub fn line_blade_meets_plane(line: Line, plane: Plane) -> FinitePoint {
    (plane | line).normalised()
}

/// Two balls by centre and radius: the square of the sum of the radii, and that of the distance, `-2 A . B`. They overlap
/// where the first is the larger; the comparison is left to the caller, who may have lanes.
#[formula(crate::algebra::cga, dynamic = ball_reach_and_distance_sq_dynamic)]
pub fn ball_reach_and_distance_sq(a: Point, radius_a: Scalar, b: Point, radius_b: Scalar) -> (Scalar, Scalar) {
    let reach = radius_a + radius_b;
    (reach * reach, -2 * (a | b))
}

/// The reciprocal vector of the first vertex of a facet, times `|Phi|²` = 4 times the squared area, relative to that
/// vertex: `-(ninf ^ (b ^ c)) | Phi` with `Phi = a ^ b ^ c ^ ninf`. Its inner product with a normalised point of the
/// facet's plane is the point's barycentric coordinate (report, equations 43 to 46, with the sign corrected).
#[formula(crate::algebra::cga, relative = a, dynamic = reciprocal_relative_dynamic)]
pub fn reciprocal_relative(a: Point, b: Point, c: Point) -> Round {
    -((Infinity ^ (b ^ c)) | (a ^ b ^ c ^ Infinity))
}

/// The image of a point in a plane, `pi X pi`, normalised.
#[formula(crate::algebra::cga, local = x, dynamic = reflect_in_plane_dynamic)]
pub fn reflect_in_plane(x: Point, plane: Plane) -> Point {
    (plane * x * plane).normalised()
}

/// The image of a point in a line, `L X L`, relative to the point, of weight minus the line's norm squared.
#[formula(crate::algebra::cga, relative = x, dynamic = reflect_in_line_relative_dynamic)]
pub fn reflect_in_line_relative(x: Point, line: Line) -> Round {
    (line * x * line).grade(1)
}

/// The inverse of a point in a circle, `K X K`, relative to the point, of any weight.
#[formula(crate::algebra::cga, relative = x, dynamic = reflect_in_circle_relative_dynamic)]
pub fn reflect_in_circle_relative(x: Point, circle: Circle) -> Round {
    (circle * x * circle).grade(1)
}

/// The centre of a circle, as a point of any weight: the image of infinity, `K ninf K`.
#[formula(crate::algebra::cga, dynamic = circle_centre_dynamic)]
pub fn circle_centre(circle: Circle) -> Round {
    (circle * Infinity * circle).grade(1)
}

/// The inverse of a point in a sphere, `s X s`, normalised.
#[formula(crate::algebra::cga, local = x, dynamic = reflect_in_sphere_dynamic)]
pub fn reflect_in_sphere(x: Point, sphere: Sphere) -> Point {
    (sphere * x * sphere).normalised()
}
