//! Versors: rotors, translators, motors, poses, dilators and general conformal rotors. Making them, exponentials and logarithms,
//! powers, interpolation, renormalisation.
//!
//! `exp` takes the bivector itself, half the angle and half the displacement, and minus it: the motion with twist V is
//! `exp(-V t / 2)`. `log` is that of the *motion*: a versor and its negative move alike, and the logarithm belongs to the
//! one with the smaller angle. So `exp(log M)` is M where its scalar part is not negative, and -M where it is.
//!
//! Knows no geometry and no time. A versor made here is unit up to rounding.

mod conformal;
mod dilator;
mod direction;
mod functions;
mod motor;
mod pose;
mod rotor;
mod screw;

pub use conformal::NotAConformalRotor;
pub use rotor::NotARotor;
pub use screw::NotAMotor;
