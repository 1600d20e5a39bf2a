//! G(1,3): spacetime, signature (+, -, -, -), with time in units of length.
//!
//! `e0` is the observer. The electromagnetic field is one bivector `F = E + I B`, in units where c = 1: E in
//! (e10, e20, e30), and -B in (e23, e31, e12), for `I e10 = -e23`. `F² = E² - B² + 2 I E.B` is the same for all observers.
//!
//! The boost by rapidity w along x is `exp(w/2 e10)`: `e10² = 1`, and it takes what is at rest to the velocity tanh w.

ga_physics::algebra! {
    pub algebra spacetime;
    basis e0 = 1, e1 = -1, e2 = -1, e3 = -1;
    pseudoscalar e0123;

    /// An event, a velocity, a momentum.
    type Vector = [e0, e1, e2, e3];
    /// A field, or the plane of a Lorentz transformation.
    type Bivector = [e10, e20, e30, e23, e31, e12];
    /// A Lorentz transformation.
    type Rotor: unit + versor = [s, e10, e20, e30, e23, e31, e12, e0123];
    /// A complex number `s + e0123 I`, for `I² = -1`.
    type Complex = [s, e0123];
    /// An even multivector.
    type Even = [s, e10, e20, e30, e23, e31, e12, e0123];
    /// A trivector.
    type Trivector = [e123, e023, e031, e012];
    /// An odd multivector.
    type Odd = [e0, e1, e2, e3, e123, e023, e031, e012];
    /// A multiple of I.
    type Pseudoscalar = [e0123];
    /// A general multivector.
    type Multivector = [
        s, e0, e1, e2, e3, e10, e20, e30, e23, e31, e12, e123, e023, e031, e012, e0123,
    ];
}

/// The squared interval between two events: positive where the one can reach the other.
#[ga_physics::formula(self, dynamic = interval_dynamic)]
pub fn interval(a: Vector, b: Vector) -> Scalar {
    let d = b - a;
    d | d
}

/// The invariants of a field, `F² = E² - B² + 2 E.B I`.
#[ga_physics::formula(self, dynamic = invariants_dynamic)]
pub fn invariants(field: Bivector) -> Complex {
    field * field
}

/// The force on a unit charge with a velocity u, `F . u = -(u | F)`: `(E + v x B) . v` in time, `E + v x B` in space, for
/// a slow one.
#[ga_physics::formula(self, dynamic = force_dynamic)]
pub fn force(field: Bivector, u: Vector) -> Vector {
    -(u | field)
}

impl Bivector {
    /// The field with the given electric and magnetic parts.
    pub fn from_fields([ex, ey, ez]: [f64; 3], [bx, by, bz]: [f64; 3]) -> Self {
        Self::new(ex, ey, ez, -bx, -by, -bz)
    }
}

impl Rotor {
    /// The boost by a rapidity along x.
    pub fn boost_x(rapidity: f64) -> Self {
        let (sinh, cosh) = ((rapidity / 2.0).sinh(), (rapidity / 2.0).cosh());
        Self { s: cosh, e10: sinh, ..Self::default() }
    }
}
