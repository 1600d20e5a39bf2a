//! G(3,1): the conformal model of the plane, in the null basis. The library's `algebra::cga` is the same for space.
//!
//! `no` is the point at the origin, `ninf` the point at infinity, `no . ninf = -1`; a point is `X = no + x + x²/2 ninf`,
//! so `X . Y = -|x - y|²/2`. Circles and lines are stored dual, as vectors: a circle `C - rho²/2 ninf`, with
//! `X . s = (rho² - d²)/2` positive *inside*, a line `nu + delta ninf`. Direct, `A ^ B ^ C` is the circle through three
//! points. `I = e12_no_ninf`, `I² = -1`; in four dimensions I and vectors anticommute.

ga_physics::algebra! {
    pub algebra cga2;
    basis e1 = 1, e2 = 1, null pair (no, ninf) = -1;
    pseudoscalar e12_no_ninf;

    /// The point at infinity.
    type Infinity = ninf;
    /// A normalised point: two numbers, the rest is known.
    type Point = x*e1 + y*e2 + no + (x*x + y*y)/2*ninf;
    /// A circle in dual form: centre and squared radius, negative for an imaginary one.
    type Circle = x*e1 + y*e2 + no + (x*x + y*y - rho_sq)/2*ninf;
    /// A line in dual form: unit normal, and distance from the origin along it.
    type Line: unit = [e1, e2, ninf];
    /// A vector: a point, circle or line of any weight.
    type Round = [e1, e2, no, ninf];
    /// A free vector.
    type Vector = [e1, e2];
    /// A rotor about the origin.
    type Rotor: unit + versor = [s, e12];
    /// A translator `1 - t ninf / 2`, which moves by t = (x, y).
    type Translator: unit + versor = 1 - (x*e1_ninf + y*e2_ninf)/2;
    /// A dilator: `q = 1/p`, scales by `p²`. Split on the null pair, so that no digit cancels.
    type Dilator: unit + versor = (p + q)/2 + (p - q)/2*no_ninf;
    /// A flat point `X ^ ninf`, where lines meet.
    type FlatPoint = [e1_ninf, e2_ninf, no_ninf];
    /// A point pair: any bivector.
    type PointPair = [e12, e1_no, e2_no, e1_ninf, e2_ninf, no_ninf];
    /// A line `A ^ B ^ ninf`.
    type DirectLine = [e12_ninf, e1_no_ninf, e2_no_ninf];
    /// A circle `A ^ B ^ C`: any trivector.
    type DirectCircle = [e12_no, e12_ninf, e1_no_ninf, e2_no_ninf];
    /// A multiple of I.
    type Pseudoscalar = [e12_no_ninf];
    /// A unit motor `T R`.
    type Motor: unit + versor = [s, e12, e1_ninf, e2_ninf];
    /// A factored motor, first the rotation, then the translation.
    type Pose: unit + versor = Translator * Rotor;
    /// A unit rotor of the conformal algebra: rotations, translations, dilations, transversions. Split on the null pair,
    /// `p P + q Q + v no - w ninf/2` with `P, Q = (1 +- no_ninf)/2`: p and q complex, v and w vectors of the plane.
    type ConformalRotor: unit + versor =
        (p + q)/2 + (p - q)/2*no_ninf
        + (p12 + q12)/2*e12 + (p12 - q12)/2*e12_no_ninf
        + v1*e1_no + v2*e2_no
        - (w1*e1_ninf + w2*e2_ninf)/2;
    /// An even multivector.
    type Even = [s, e12, e1_no, e2_no, e1_ninf, e2_ninf, no_ninf, e12_no_ninf];
    /// An odd multivector.
    type Odd = [e1, e2, no, ninf, e12_no, e12_ninf, e1_no_ninf, e2_no_ninf];
    /// A general multivector.
    type Multivector = [
        s, e1, e2, no, ninf, e12, e1_no, e2_no, e1_ninf, e2_ninf, no_ninf, e12_no, e12_ninf, e1_no_ninf, e2_no_ninf,
        e12_no_ninf,
    ];
}

/// The circle through three points.
#[ga_physics::formula(self, local = a, dynamic = circle_through_dynamic)]
pub fn circle_through(a: Point, b: Point, c: Point) -> Circle {
    (a ^ b ^ c).dual().normalised()
}

/// The centre of a circle: infinity, reflected in it.
#[ga_physics::formula(self, dynamic = centre_dynamic)]
pub fn centre(circle: Circle) -> Point {
    (circle * Infinity * circle).normalised()
}

/// The image of a point in a circle: `d d' = rho²` along the ray from the centre. The centre goes to infinity, by a
/// division by zero.
#[ga_physics::formula(self, dynamic = invert_dynamic)]
pub fn invert(circle: Circle, p: Point) -> Point {
    (circle * p * circle).normalised()
}

/// The power of a point with respect to a circle, negative inside: `d² - rho²`.
#[ga_physics::formula(self, dynamic = power_dynamic)]
pub fn power(p: Point, circle: Circle) -> Scalar {
    -2 * (p | circle)
}

impl Dilator {
    /// The scaling about the origin by a positive factor.
    pub fn by(factor: f64) -> Self {
        Self::new(factor.sqrt(), 1.0 / factor.sqrt())
    }
}

impl Rotor {
    /// The rotation about the origin by an angle in radians, counter-clockwise.
    pub fn from_angle(radians: f64) -> Self {
        let (sin, cos) = (radians / 2.0).sin_cos();
        Self::new(cos, -sin)
    }
}
