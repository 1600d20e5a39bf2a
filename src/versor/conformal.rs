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
}
