//! G(3,0): the algebra of Euclidean three-space.
//!
//! Bivectors are stored as `(e23, e31, e12)`, so that their components read like those of the axial vector:
//! `B = b I3`. A rotor `R = exp(-B phi / 2)` turns by `phi` in the plane and sense of the unit bivector `B`, as
//! `x' = R x ~R`; the quaternion `w + x i + y j + z k` is the rotor `w - x e23 - y e31 - z e12`.

crate::algebra! {
    pub algebra g3;
    basis e1 = 1, e2 = 1, e3 = 1;
    pseudoscalar e123;

    /// A vector: a directed length.
    type Vector = [e1, e2, e3];
    /// A bivector: a directed area; angular velocity, angular momentum, torque.
    type Bivector = [e23, e31, e12];
    /// A trivector: a signed volume.
    type Trivector = [e123];
    /// A unit rotor.
    type Rotor: unit + versor = [s, e23, e31, e12];
    /// An even multivector, not normalised: products of two vectors, sums of rotors.
    type Even = [s, e23, e31, e12];
    /// An odd multivector: products of a vector and a bivector.
    type Odd = [e1, e2, e3, e123];
    /// A general multivector.
    type Multivector = [s, e1, e2, e3, e23, e31, e12, e123];
}
