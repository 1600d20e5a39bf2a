//! Dilators `exp(alpha/2 e ebar)`, which scale by `exp(-alpha)` about the origin.

use crate::algebra::Real;
use crate::algebra::cga::Dilator;

impl<T: Real> Dilator<T> {
    /// The dilator that scales by a positive factor k: `p = sqrt k`, `q = 1/sqrt k`, so that no logarithm is taken.
    /// `None` where k is not positive and finite.
    #[must_use]
    pub fn by(factor: T) -> Option<Self> {
        if !(factor > T::zero() && factor.is_finite()) {
            return None;
        }
        let root = factor.sqrt();
        Some(Self::new(root, T::one() / root))
    }

    /// The factor by which it scales, `p/q`.
    #[must_use]
    pub fn factor(self) -> T {
        self.p / self.q
    }

    /// `exp(b no_ninf)`: scales by `exp(2 b)`. It overflows where that does: see [`Dilator::factor`].
    #[must_use]
    pub fn exp(b: T) -> Self {
        Self::new(b.exp(), (-b).exp())
    }

    /// The b with `exp(b no_ninf) = D` or `-D`: half the logarithm of the factor. Errs by eps absolutely, since p and q
    /// of a small dilation are near 1.
    #[must_use]
    pub fn log(self) -> T {
        // The quotient of both would overflow before they do.
        (self.p.abs().ln() - self.q.abs().ln()) * T::ratio(1, 2)
    }

    /// Scales by the power t of the factor.
    #[must_use]
    pub fn powf(self, t: T) -> Self {
        Self::exp(self.log() * t)
    }

    /// From this dilator at t = 0 to `to` at t = 1, at a constant rate of growth; both ends are met to the bit.
    /// Where the two differ in sign, it ends at `-to`, the same dilation.
    #[must_use]
    pub fn interpolate(self, to: Self, t: T) -> Self {
        let log = to.log() - self.log();
        if t <= T::ratio(1, 2) {
            return self * Self::exp(log * t);
        }
        let end = if (self.p < T::zero()) == (to.p < T::zero()) { to } else { -to };
        end * Self::exp(log * (t - T::one()))
    }
}
