//! Copies, and `y_i + sum_j h_j k_ji`, of one array of a state, for all formulations alike.
//!
//! The number of terms is that of a Runge-Kutta stage or step. For one and for four, which classical RK4 has, the arrays are
//! walked side by side: an index into each would be checked each time, which costs as much as the arithmetic.

use alloc::vec::Vec;
use core::ops::Add;

/// Adds `sum_j h_j k_j`, of an array of the rates, to an array of the state. The sum is formed before it is added.
#[inline(always)]
pub(super) fn add_scaled<T: Copy, R, K: Copy + Add<Output = K>, A>(
    state: &mut [A],
    terms: &[(T, &R)],
    array: impl Fn(&R) -> &[K],
    times: impl Fn(K, T) -> K,
    add: impl Fn(&mut A, K),
) {
    match terms {
        [(h, k)] => {
            for (y, k) in state.iter_mut().zip(array(k)) {
                add(y, times(*k, *h));
            }
        }
        [(h1, k1), (h2, k2), (h3, k3), (h4, k4)] => {
            let rates = array(k1).iter().zip(array(k2)).zip(array(k3)).zip(array(k4));
            for (y, (((k1, k2), k3), k4)) in state.iter_mut().zip(rates) {
                add(y, times(*k1, *h1) + times(*k2, *h2) + times(*k3, *h3) + times(*k4, *h4));
            }
        }
        [(h, first), rest @ ..] => {
            for (index, (y, k)) in state.iter_mut().zip(array(first)).enumerate() {
                let more = |sum, (h, rates): &(T, &R)| sum + times(array(rates)[index], *h);
                add(y, rest.iter().fold(times(*k, *h), more));
            }
        }
        [] => {}
    }
}

/// Copies an array of one state into that of another, mostly of the same length: then as bytes, which a clone of the
/// generated types is not.
#[inline(always)]
pub(super) fn assign<A: Copy>(to: &mut Vec<A>, from: &[A]) {
    if to.len() == from.len() {
        to.copy_from_slice(from);
    } else {
        to.clear();
        to.extend_from_slice(from);
    }
}
