//! Making versors: rotors from a plane and an angle, translators, motors, dilators; normalisation.
//!
//! Knows no geometry and no time. A versor made here is unit up to rounding.

mod conformal;
mod motor;
mod rotor;

pub use rotor::NotARotor;
