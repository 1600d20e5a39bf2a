//! G(3,0,1): the projective geometry of space, on the library's G(3,0). Planes are vectors, points trivectors.
//!
//! The plane `a x + b y + c z + d = 0` is `a e1 + b e2 + c e3 + d e0`, the point (x, y, z) is
//! `e123 + x e032 + y e013 + z e021`. Then `^` intersects, and `&`, the regressive product, joins: `P & Q` is the line
//! from P to Q, `P & Q & R` the plane that is positive where one sees P, Q, R counter-clockwise.
//! `I = e0123` squares to 0, so there is no dual.
//!
//! A rotor of G(3,0) turns about the origin here too: `g3::Rotor` is one type for both algebras, and a translator times a
//! rotor is a motor.

ga_physics::algebra! {
    pub algebra pga3 extends ga_physics::algebra::g3;
    basis e0 = 0;
    pseudoscalar e0123;

    /// The plane `a x + b y + c z + d = 0` as `a e1 + b e2 + c e3 + d e0`.
    type Plane = [e1, e2, e3, e0];
    /// A line: its direction in (e23, e31, e12), its moment in (e01, e02, e03).
    type Line = [e23, e31, e12, e01, e02, e03];
    /// The point (x, y, z), of weight 1.
    type Point = e123 + x*e032 + y*e013 + z*e021;
    /// A point of any weight; without weight a direction.
    type AnyPoint = [e123, e032, e013, e021];
    /// A translation by (x, y, z).
    type Translator: unit + versor = 1 - (x*e01 + y*e02 + z*e03)/2;
    /// A rigid motion.
    type Motor: unit + versor = [s, e23, e31, e12, e01, e02, e03, e0123];
    /// A multiple of I.
    type Pseudoscalar = [e0123];
    /// An even multivector.
    type Even = [s, e23, e31, e12, e01, e02, e03, e0123];
    /// An odd multivector.
    type Odd = [e1, e2, e3, e0, e123, e032, e013, e021];
    /// A general multivector.
    type Multivector = [
        s, e1, e2, e3, e0, e23, e31, e12, e01, e02, e03, e123, e032, e013, e021, e0123,
    ];
}

/// The line in which two planes meet.
#[ga_physics::formula(self, dynamic = meet_planes_dynamic)]
pub fn meet_planes(a: Plane, b: Plane) -> Line {
    a ^ b
}

/// The point in which a line meets a plane; its weight is 0 where they are parallel.
#[ga_physics::formula(self, dynamic = pierce_dynamic)]
pub fn pierce(line: Line, plane: Plane) -> AnyPoint {
    line ^ plane
}

/// The line through two points, from the first to the second.
#[ga_physics::formula(self, dynamic = join_dynamic)]
pub fn join(a: Point, b: Point) -> Line {
    a & b
}

/// The plane through three points.
#[ga_physics::formula(self, dynamic = plane_through_dynamic)]
pub fn plane_through(a: Point, b: Point, c: Point) -> Plane {
    (a & b) & c
}

/// Six times the signed volume of a tetrahedron, `a & b & c & d`: positive where d is on the positive side of the plane
/// through a, b and c.
#[ga_physics::formula(self, dynamic = six_volumes_dynamic)]
pub fn six_volumes(a: Point, b: Point, c: Point, d: Point) -> Scalar {
    ((a & b) & c) & d
}

/// First the rotation, then the translation.
#[ga_physics::formula(self, dynamic = motor_dynamic)]
pub fn motor(translator: Translator, rotor: Rotor) -> Motor {
    translator * rotor
}
