//! G(4,1): the conformal model of Euclidean three-space, in the null basis.
//!
//! `no` is the point at the origin, `ninf` the point at infinity, `no . ninf = -1`. A point is
//! `X = no + x + x²/2 ninf`; then `X . Y = -|x - y|²/2` and `X . ninf = -1`. `dual(M) = I M` with
//! `I = -e123 (no ^ ninf)`, `I² = -1`.
//!
//! Spheres and planes are stored dual, as vectors: a sphere `s = C - rho²/2 ninf` is its centre and signed radius
//! squared, `X . s = (rho² - d²)/2` is positive *inside*; a plane is `nu + delta ninf` with unit normal,
//! `X . pi = nu . x - delta` is positive on the side of `nu`, *outside* a body. Lines, circles, point pairs and flat
//! points are stored direct, as outer products of the points that they pass through.
//!
//! The report's vectors e, ebar (squares +1, -1) are `ninf = e + ebar`, `no = (ebar - e)/2`.

crate::algebra! {
    pub algebra cga extends super::g3;
    basis null pair (no, ninf) = -1;
    pseudoscalar -e123_no_ninf;

    /// The point at infinity.
    type Infinity = ninf;
    /// The point at the origin.
    type Origin = no;
    /// A normalised point; its weight 1 and its `ninf` coefficient are known, so three numbers are stored.
    type Point = x*e1 + y*e2 + z*e3 + no + (x*x + y*y + z*z)/2*ninf;
    /// A sphere in dual form: centre and squared radius, negative for an imaginary sphere. Storing the `ninf`
    /// coefficient in the place of `rho_sq` would lose `eps |c|²` of it.
    type Sphere = x*e1 + y*e2 + z*e3 + no + (x*x + y*y + z*z - rho_sq)/2*ninf;
    /// A plane in dual form: unit normal, and distance from the origin along it.
    type Plane: unit = [e1, e2, e3, ninf];
    /// A flat point `X ^ ninf`: where a line meets a plane.
    type FlatPoint = [e1_ninf, e2_ninf, e3_ninf, no_ninf];
    /// A general vector: a point, sphere or plane of any weight, or their sum.
    type Round = [e1, e2, e3, no, ninf];
    /// A translator `1 - t ninf / 2`, which moves by t = (x, y, z).
    type Translator: unit + versor = 1 - (x*e1_ninf + y*e2_ninf + z*e3_ninf)/2;
    /// A dilator `exp(alpha/2 e ebar)`, which scales by `exp(-alpha)` about the origin: `p = exp(-alpha/2)`,
    /// `q = exp(alpha/2) = 1/p`. Stored split on the null pair: cosh and sinh would have to be subtracted again.
    type Dilator: unit + versor = (p + q)/2 + (p - q)/2*no_ninf;
    /// A line in dual form; the axis of a rotation.
    type DualLine = [e23, e31, e12, e1_ninf, e2_ninf, e3_ninf];
    /// A line `A ^ B ^ ninf`: its direction in `ei_no_ninf`, its moment in `eij_ninf`.
    type Line = [e23_ninf, e31_ninf, e12_ninf, e1_no_ninf, e2_no_ninf, e3_no_ninf];
    /// A twist: the bivector velocity of a rigid motion, `Mdot = -1/2 V M`.
    type Twist = [e23, e31, e12, e1_ninf, e2_ninf, e3_ninf];
    /// A point pair `A ^ B`: any bivector.
    type PointPair = [e23, e31, e12, e1_no, e2_no, e3_no, e1_ninf, e2_ninf, e3_ninf, no_ninf];
    /// A circle `A ^ B ^ C`: any trivector.
    type Circle = [e123, e23_no, e31_no, e12_no, e23_ninf, e31_ninf, e12_ninf, e1_no_ninf, e2_no_ninf, e3_no_ninf];
    /// A plane `A ^ B ^ C ^ ninf`.
    type DirectPlane = [e123_ninf, e23_no_ninf, e31_no_ninf, e12_no_ninf];
    /// A sphere `A ^ B ^ C ^ D`: any 4-vector.
    type DirectSphere = [e123_no, e123_ninf, e23_no_ninf, e31_no_ninf, e12_no_ninf];
    /// A multiple of `e123_no_ninf = -I`.
    type Pseudoscalar = [e123_no_ninf];
    /// A unit motor `T R`: rotation and translation.
    type Motor: unit + versor = [s, e23, e31, e12, e1_ninf, e2_ninf, e3_ninf, e123_ninf];
    /// A factored motor, first the rotation, then the translation: seven numbers, for bodies.
    type Pose: unit + versor = Translator * Rotor;
    /// A unit rotor of the conformal algebra: rotations, translations, dilations, transversions. Stored split on the
    /// null pair, as `p P + q Q + v no - w ninf/2` with `P, Q = (1 +- no_ninf)/2`: p and q even, v and w odd
    /// multivectors of G(3,0). A translator by t is p = q = 1, w = t; a dilator p, q.
    type ConformalRotor: unit + versor =
        (p + q)/2 + (p - q)/2*no_ninf
        + (p23 + q23)/2*e23 + (p31 + q31)/2*e31 + (p12 + q12)/2*e12
        + (p23 - q23)/2*e23_no_ninf + (p31 - q31)/2*e31_no_ninf + (p12 - q12)/2*e12_no_ninf
        + v1*e1_no + v2*e2_no + v3*e3_no + v123*e123_no
        - (w1*e1_ninf + w2*e2_ninf + w3*e3_ninf + w123*e123_ninf)/2;
    /// An even multivector.
    type Even = [
        s, e23, e31, e12, e1_no, e2_no, e3_no, e1_ninf, e2_ninf, e3_ninf, no_ninf,
        e123_no, e123_ninf, e23_no_ninf, e31_no_ninf, e12_no_ninf,
    ];
    /// An odd multivector.
    type Odd = [
        e1, e2, e3, no, ninf, e123, e23_no, e31_no, e12_no, e23_ninf, e31_ninf, e12_ninf,
        e1_no_ninf, e2_no_ninf, e3_no_ninf, e123_no_ninf,
    ];
    /// A general multivector.
    type Multivector = [
        s, e1, e2, e3, no, ninf, e23, e31, e12, e1_no, e2_no, e3_no, e1_ninf, e2_ninf, e3_ninf, no_ninf,
        e123, e23_no, e31_no, e12_no, e23_ninf, e31_ninf, e12_ninf, e1_no_ninf, e2_no_ninf, e3_no_ninf,
        e123_no, e123_ninf, e23_no_ninf, e31_no_ninf, e12_no_ninf, e123_no_ninf,
    ];

    /// The sphere through four points: centre and squared radius, in the local frame of the first point. Coplanar
    /// points divide by zero; `geometry::sphere_through` has the checked form.
    fn circumsphere(a: Point, b: Point, c: Point, d: Point) -> Sphere, local a {
        (a ^ b ^ c ^ d).dual().normalised()
    }
    /// The sphere through four points relative to the first, of weight 6 times their signed volume.
    fn circumsphere_relative(a: Point, b: Point, c: Point, d: Point) -> Round, relative a {
        (a ^ b ^ c ^ d).dual()
    }
    /// The smallest sphere through three points: it has the centre and radius of their circle. With the circle
    /// `K = a ^ b ^ c` it is `K ^ (K ^ ninf)*`; the result is relative to the first point, of weight 4 times the squared
    /// area.
    fn circle_sphere_relative(a: Point, b: Point, c: Point) -> Round, relative a {
        (((a ^ b) ^ c) ^ (((a ^ b) ^ c) ^ Infinity).dual()).dual()
    }
    /// The smallest sphere through two points, `(A + B)/2 + (A . B)/2 ninf`: centre in the middle, radius half the distance.
    fn pair_sphere(a: Point, b: Point) -> Sphere, local a {
        (a + b) / 2 + ((a | b) * Infinity) / 2
    }
    /// The plane through three points relative to the first, with a normal of twice the area by the right-hand rule.
    fn plane_relative(a: Point, b: Point, c: Point) -> Round, relative a {
        (a ^ b ^ c ^ Infinity).dual()
    }
    /// The line through two points relative to the first: `a ^ b ^ ninf`.
    fn line_relative(a: Point, b: Point) -> Line, relative a {
        a ^ b ^ Infinity
    }
    /// Where the line through two points meets a plane, relative to the first point.
    fn line_meets_plane_relative(a: Point, b: Point, plane: Plane) -> FlatPoint, relative a {
        plane | (a ^ b ^ Infinity)
    }
    /// The reciprocal vector of the first vertex of a facet, times `|Phi|²` = 4 times the squared area, relative to that
    /// vertex: `-(ninf ^ (b ^ c)) | Phi` with `Phi = a ^ b ^ c ^ ninf`. Its inner product with a normalised point of the
    /// facet's plane is the point's barycentric coordinate (report, equations 43 to 46, with the sign corrected).
    fn reciprocal_relative(a: Point, b: Point, c: Point) -> Round, relative a {
        -((Infinity ^ (b ^ c)) | (a ^ b ^ c ^ Infinity))
    }
    /// The image of a point in a plane, `pi X pi`, normalised.
    fn reflect_in_plane(x: Point, plane: Plane) -> Point, local x {
        (plane * x * plane).normalised()
    }
    /// The image of a point in a line, `L X L`, relative to the point, of weight minus the line's norm squared.
    fn reflect_in_line_relative(x: Point, line: Line) -> Round, relative x {
        (line * x * line).grade(1)
    }
    /// The inverse of a point in a circle, `K X K`, relative to the point, of any weight.
    fn reflect_in_circle_relative(x: Point, circle: Circle) -> Round, relative x {
        (circle * x * circle).grade(1)
    }
    /// The centre of a circle, as a point of any weight: the image of infinity, `K ninf K`.
    fn circle_centre(circle: Circle) -> Round {
        (circle * Infinity * circle).grade(1)
    }
    /// The inverse of a point in a sphere, `s X s`, normalised.
    fn reflect_in_sphere(x: Point, sphere: Sphere) -> Point, local x {
        (sphere * x * sphere).normalised()
    }
}
