//! Basis blades as bit sets over the declared basis vectors.

/// A basis blade: bit i is set when the i-th declared basis vector is a factor; the factors stand in declared order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Blade(pub u32);

impl Blade {
    /// The scalar blade, 1.
    pub const SCALAR: Self = Self(0);

    /// The blade of one basis vector.
    #[must_use]
    pub fn vector(index: usize) -> Self {
        Self(1 << index)
    }

    /// The number of factors.
    #[must_use]
    pub fn grade(self) -> u32 {
        self.0.count_ones()
    }

    /// Does the blade contain the basis vector?
    #[must_use]
    pub fn contains(self, index: usize) -> bool {
        self.0 >> index & 1 == 1
    }

    /// Is the sign of the reversed blade -1? Reversing k factors takes k (k - 1) / 2 swaps.
    #[must_use]
    pub fn reverse_is_negative(self) -> bool {
        self.grade() & 2 == 2
    }
}

/// Is the number of swaps odd that sorts the factors of `a` followed by those of `b` into declared order?
#[must_use]
pub fn swaps_are_odd(a: Blade, b: Blade) -> bool {
    let mut swaps = 0;
    let mut rest = a.0 >> 1;
    while rest != 0 {
        swaps += (rest & b.0).count_ones();
        rest >>= 1;
    }
    swaps & 1 == 1
}
