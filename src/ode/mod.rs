//! Steppers for ordinary differential equations `dy/dt = f(t, y)`. They know no bodies: a state says how a rate moves it.

mod rk4;

pub use rk4::Rk4;

/// A state that a rate can move: `y + h k`.
///
/// State and rate are separate types, because they need not be of the same kind: a world position may be an f64 point
/// while its rate is an f32 vector.
pub trait State<T> {
    /// The derivative of the state with time.
    type Rate;

    /// Becomes a copy of another state of the same size, without allocation.
    fn assign(&mut self, other: &Self);

    /// `y + sum h_i k_i`. The sum is formed before it is added, so that a large state is rounded once.
    fn add_scaled(&mut self, terms: &[(T, &Self::Rate)]);
}
