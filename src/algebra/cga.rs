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
    /// A flat point `X ^ ninf` of weight 1: where a line meets a plane, divided by the weight.
    type FinitePoint = x*e1_ninf + y*e2_ninf + z*e3_ninf + no_ninf;
    /// A flat point of any weight: where a line meets a plane, or a direction.
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
}
