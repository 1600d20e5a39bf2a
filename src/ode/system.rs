//! What is integrated: `dy/dt = f(t, y)`, or motion under an acceleration.

use super::State;
use core::convert::Infallible;

/// `dy/dt = f(t, y)`, and what keeps y on its manifold.
///
/// Every closure `FnMut(f64, &S, &mut S::Rate)` is one that cannot fail.
pub trait System<S: State<T>, T> {
    /// Why a rate cannot be had. [`Infallible`] if it always can.
    type Error;

    /// Writes the rate of a state at a time, s.
    ///
    /// # Errors
    /// What the system says. It ends the step; the state is then that before the step.
    fn rate(&mut self, t_s: f64, state: &S, rate: &mut S::Rate) -> Result<(), Self::Error>;

    /// After every accepted step, and on every interpolated state: back onto the manifold (unit norm, constraints).
    /// True if it changed the state: the rate there is then computed anew.
    ///
    /// # Errors
    /// What the system says.
    fn settle(&mut self, _t_s: f64, _state: &mut S) -> Result<bool, Self::Error> {
        Ok(false)
    }
}

impl<S: State<T>, T, F: FnMut(f64, &S, &mut S::Rate) + ?Sized> System<S, T> for F {
    type Error = Infallible;

    #[inline(always)]
    fn rate(&mut self, t_s: f64, state: &S, rate: &mut S::Rate) -> Result<(), Infallible> {
        self(t_s, state, rate);
        Ok(())
    }
}

/// Motion `x' = v, v' = a(t, x)`, for velocity Verlet and its compositions.
///
/// The acceleration must not depend on the velocity: with drag these methods still run, but are of order 1. A
/// constrained system overrides `drift` and `settle`, which makes velocity Verlet RATTLE (Andersen 1983).
pub trait Mechanics<S, T> {
    /// Why a step cannot be made.
    type Error;
    /// The rate of the velocity, of all there is.
    type Acceleration;

    /// Writes the acceleration of a state at a time, s.
    ///
    /// # Errors
    /// What the system says. It ends the step; the state is then that before the step.
    fn acceleration(&mut self, t_s: f64, state: &S, out: &mut Self::Acceleration) -> Result<(), Self::Error>;

    /// `v += h a`
    fn kick(&mut self, state: &mut S, h_s: T, acceleration: &Self::Acceleration);

    /// `x += h v` from the time given on; with constraints, positions that hold them (SHAKE).
    ///
    /// # Errors
    /// What the system says.
    fn drift(&mut self, t_s: f64, state: &mut S, h_s: T) -> Result<(), Self::Error>;

    /// After the last kick of a step of `h_s`: velocities back on the constraints. Between the substeps of a
    /// composition two kicks at one place are made as one, and need it not: the next SHAKE takes out what a projection
    /// would.
    ///
    /// # Errors
    /// What the system says.
    fn settle(&mut self, _t_s: f64, _state: &mut S, _h_s: T) -> Result<(), Self::Error> {
        Ok(())
    }
}
