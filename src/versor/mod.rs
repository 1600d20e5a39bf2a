//! Making versors: rotors from a plane and an angle, translators, motors, dilators; normalisation.
//!
//! Knows no geometry and no time. A rotor, translator or motor made here is unit up to rounding;
//! a dilator by k up to `eps max(k, 1/k)`, because it is stored by cosh and sinh.

mod conformal;
mod motor;
mod rotor;

pub use rotor::NotARotor;
