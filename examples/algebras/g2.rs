//! G(2,0): the plane, and with it the complex numbers.
//!
//! `I = e12` squares to -1, so `x + y e12` is the complex number `x + i y`, and a unit one turns vectors: by twice its
//! angle as a rotor, `R v ~R`, by its angle as a factor from the right, `v z`. Both turn from e1 to e2 where the rotor is
//! `cos(phi/2) - sin(phi/2) e12` and the factor `cos(phi) + sin(phi) e12`.

ga_physics::algebra! {
    pub algebra g2;
    basis e1 = 1, e2 = 1;
    pseudoscalar e12;

    /// A vector.
    type Vector = [e1, e2];
    /// An oriented area.
    type Bivector = [e12];
    /// A rotation `cos(phi/2) - sin(phi/2) e12`.
    type Rotor: unit + versor = [s, e12];
    /// A complex number `s + e12 I`: all of the even algebra.
    type Complex = [s, e12];
    /// A general multivector.
    type Multivector = [s, e1, e2, e12];
}

/// The complex number that a vector is, with `origin` as the unit: `origin v`.
#[ga_physics::formula(self, dynamic = complex_dynamic)]
pub fn complex(origin: Vector, v: Vector) -> Complex {
    origin * v
}

/// `b a`: where both are unit, the rotor of twice the angle from a to b.
#[ga_physics::formula(self, dynamic = twice_the_angle_dynamic)]
pub fn twice_the_angle(a: Vector, b: Vector) -> Complex {
    b * a
}

/// The signed area of a triangle.
#[ga_physics::formula(self, dynamic = area_dynamic)]
pub fn area(a: Vector, b: Vector, c: Vector) -> Scalar {
    ((b - a) ^ (c - a)).e12 / 2
}

impl Rotor {
    /// The rotation by an angle in radians, from e1 to e2.
    pub fn from_angle(radians: f64) -> Self {
        let (sin, cos) = (radians / 2.0).sin_cos();
        Self::new(cos, -sin)
    }
}
