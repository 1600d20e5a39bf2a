//! Explicit Runge-Kutta methods, each written once, as a table of published coefficients:
//!
//! ```text
//! k_i = f(t + c_i h, y + h sum_j a_ij k_j)     next = y + h sum_i b_i k_i     error = h sum_i e_i k_i
//! y(theta) = y + h sum_i b_i(theta) k_i        0 <= theta <= 1
//! ```
//!
//! The macro makes straight-line steps of a table, without the terms that are zero, and keeps the numbers as
//! [`Coefficients`] with the text they were written in, so that tests hold the order conditions against every digit.
//! Rates are counted from 1 as in the papers; the one after the last stage is that at the end of the step.

mod cash_karp;
mod classical;
mod dop853;
mod tsit5;

pub use cash_karp::CashKarp;
pub use classical::{Euler, Rk4, Rk4Doubling};
pub use dop853::Dop853;
pub use tsit5::Tsit5;

use super::{Controlled, State, System, Tolerance};
use crate::algebra::Real;

/// An explicit Runge-Kutta method.
pub trait Tableau {
    /// The order p of the method: the error after a given time falls like `h^p`.
    const ORDER: u32;
    /// The numbers.
    const COEFFICIENTS: Coefficients;
    /// Storage for the rates of a step: the stages, the end, and what dense output needs beyond.
    type Rates<R>: AsRef<[R]> + AsMut<[R]>;

    /// Storage for rates of a given size.
    fn rates<R: Clone>(rate: R) -> Self::Rates<R>;

    /// The rates of stages 2 to s; the first is there.
    ///
    /// # Errors
    /// Those of the system.
    fn stages<T: Real, S: State<T>, Y: System<S, T> + ?Sized>(
        rates: &mut Self::Rates<S::Rate>,
        stage: &mut S,
        step: Start<'_, S>,
        system: &mut Y,
    ) -> Result<(), Y::Error>;

    /// From the start of the step to its end.
    fn advance<T: Real, S: State<T>>(rates: &Self::Rates<S::Rate>, state: &mut S, h_s: f64);

    /// The rates that only dense output needs, where the one at the end is known. Returns how many.
    ///
    /// # Errors
    /// Those of the system.
    fn dense_stages<T: Real, S: State<T>, Y: System<S, T> + ?Sized>(
        rates: &mut Self::Rates<S::Rate>,
        stage: &mut S,
        step: Start<'_, S>,
        system: &mut Y,
    ) -> Result<u64, Y::Error>;

    /// From the start of the step to a fraction of it.
    fn interpolate<T: Real, S: State<T>>(rates: &Self::Rates<S::Rate>, state: &mut S, h_s: f64, theta: f64);
}

/// A method that estimates its own error.
pub trait Embedded: Tableau {
    /// The order q of the estimate: the error of a step falls like `h^(q + 1)`.
    const ERROR_ORDER: u32;
    /// The estimate uses the rate at the end of the step.
    const ERROR_AT_END: bool;

    /// The estimated error in units of what is allowed.
    fn error_ratio<T: Real, S: Controlled<T>>(
        rates: &Self::Rates<S::Rate>,
        state: &S,
        next: &S,
        h_s: f64,
        tolerance: Tolerance<T>,
    ) -> f64;
}

/// Where a step starts and how long it is.
#[derive(Clone, Copy, Debug)]
pub struct Start<'a, S> {
    /// The time, s.
    pub t_s: f64,
    /// The state.
    pub state: &'a S,
    /// The step, s.
    pub h_s: f64,
}

/// The table of a method.
#[derive(Clone, Copy, Debug)]
pub struct Coefficients {
    /// Stages 2 to s.
    pub stages: &'static [Stage],
    /// b
    pub weights: &'static [Entry],
    /// e, one list for every estimate; none where the method has no estimate.
    pub errors: &'static [&'static [Entry]],
    /// Stages for dense output only. Their numbers follow that of the end.
    pub dense_stages: &'static [Stage],
    /// What dense output adds to the cubic through both ends and their slopes.
    pub bends: &'static [Bend],
    /// How many rates are kept.
    pub n_rates: usize,
}

/// `k_i`: its time and its state.
#[derive(Clone, Copy, Debug)]
pub struct Stage {
    /// c
    pub c: Number,
    /// a
    pub a: &'static [Entry],
}

/// The index of a rate, from 1, and its coefficient.
#[derive(Clone, Copy, Debug)]
pub struct Entry(pub usize, pub Number);

/// A term `theta^up (1 - theta)^down (whole sum_i b_i k_i + sum_i d_i k_i)` of dense output.
#[derive(Clone, Copy, Debug)]
pub struct Bend {
    /// Power of theta.
    pub up: u32,
    /// Power of 1 - theta.
    pub down: u32,
    /// Multiple of the whole step.
    pub whole: Number,
    /// d
    pub entries: &'static [Entry],
}

/// A coefficient: as it was written, and rounded.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// The expression in the source: decimals, fractions, sums of them.
    pub text: &'static str,
    /// Its value.
    pub value: f64,
}

impl Coefficients {
    /// The index of the rate at the end of the step, from 1.
    #[must_use]
    pub const fn end(&self) -> usize {
        self.stages.len() + 2
    }

    /// `b_i(theta)` of dense output, for all rates: `theta b + theta (1 - theta) (e_1 - b) + theta² (1 - theta) (2 b -
    /// e_1 - e_end)` (the cubic, with unit vectors e) and the bends.
    #[must_use]
    pub fn dense_weights<const N: usize>(&self, theta: f64) -> [f64; N] {
        let rest = 1.0 - theta;
        let mut weights = [0.0; N];
        let (first, second) = (theta * rest, theta * theta * rest);
        let mut whole = theta - first + 2.0 * second;
        weights[0] += first - second;
        weights[self.end() - 1] -= second;
        for bend in self.bends {
            let power = |x: f64, n: u32| (0..n).fold(1.0, |power, _| power * x);
            let shape = power(theta, bend.up) * power(rest, bend.down);
            whole += shape * bend.whole.value;
            for Entry(index, number) in bend.entries {
                weights[index - 1] += shape * number.value;
            }
        }
        for Entry(index, number) in self.weights {
            weights[index - 1] += whole * number.value;
        }
        weights
    }
}

/// A method from its table.
macro_rules! tableau {
    (
        $(#[$meta:meta])*
        $name:ident: order $order:literal, rates $rates:literal;
        $( $i:literal at $c:expr => [$($j:literal: $a:expr),*]; )*
        next => [$($bj:literal: $b:expr),*];
        $( error $error_order:literal, at end $at_end:literal $( => [$($ej:literal: $e:expr),*] )+; )?
        $( dense $di:literal at $dc:expr => [$($dj:literal: $da:expr),*]; )*
        $( bend $up:literal $down:literal => $whole:expr, [$($pj:literal: $p:expr),*]; )*
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl $crate::ode::Tableau for $name {
            const ORDER: u32 = $order;
            const COEFFICIENTS: $crate::ode::tableau::Coefficients = {
                use $crate::ode::tableau as table;
                table::Coefficients {
                    stages: &[$( table::Stage { c: number!($c), a: &[$( table::Entry($j, number!($a)) ),*] } ),*],
                    weights: &[$( table::Entry($bj, number!($b)) ),*],
                    errors: &[$($( &[$( table::Entry($ej, number!($e)) ),*] ),+)?],
                    dense_stages: &[$(
                        table::Stage { c: number!($dc), a: &[$( table::Entry($dj, number!($da)) ),*] }
                    ),*],
                    bends: &[$(
                        table::Bend {
                            up: $up,
                            down: $down,
                            whole: number!($whole),
                            entries: &[$( table::Entry($pj, number!($p)) ),*],
                        }
                    ),*],
                    n_rates: $rates,
                }
            };
            type Rates<R> = [R; $rates];

            fn rates<R: Clone>(rate: R) -> [R; $rates] {
                core::array::from_fn(|_| rate.clone())
            }

            #[inline(always)]
            #[allow(unused_variables, reason = "Euler has one stage")]
            fn stages<T: $crate::algebra::Real, S: $crate::ode::State<T>, Y: $crate::ode::System<S, T> + ?Sized>(
                rates: &mut [S::Rate; $rates],
                stage: &mut S,
                $crate::ode::tableau::Start { t_s, state, h_s }: $crate::ode::tableau::Start<'_, S>,
                system: &mut Y,
            ) -> Result<(), Y::Error> {
                $(
                    stage.assign(state);
                    stage.add_scaled(&[$( (T::from_f64(h_s * ($a)), &rates[$j - 1]) ),*]);
                    system.rate(t_s + h_s * ($c), stage, &mut rates[$i - 1])?;
                )*
                Ok(())
            }

            #[inline(always)]
            fn advance<T: $crate::algebra::Real, S: $crate::ode::State<T>>(
                rates: &[S::Rate; $rates],
                state: &mut S,
                h_s: f64,
            ) {
                state.add_scaled(&[$( (T::from_f64(h_s * ($b)), &rates[$bj - 1]) ),*]);
            }

            #[allow(unused_variables, reason = "few methods have stages for dense output only")]
            fn dense_stages<T: $crate::algebra::Real, S: $crate::ode::State<T>, Y: $crate::ode::System<S, T> + ?Sized>(
                rates: &mut [S::Rate; $rates],
                stage: &mut S,
                $crate::ode::tableau::Start { t_s, state, h_s }: $crate::ode::tableau::Start<'_, S>,
                system: &mut Y,
            ) -> Result<u64, Y::Error> {
                $(
                    stage.assign(state);
                    stage.add_scaled(&[$( (T::from_f64(h_s * ($da)), &rates[$dj - 1]) ),*]);
                    system.rate(t_s + h_s * ($dc), stage, &mut rates[$di - 1])?;
                )*
                Ok(<Self as $crate::ode::Tableau>::COEFFICIENTS.dense_stages.len() as u64)
            }

            fn interpolate<T: $crate::algebra::Real, S: $crate::ode::State<T>>(
                rates: &[S::Rate; $rates],
                state: &mut S,
                h_s: f64,
                theta: f64,
            ) {
                let weights: [f64; $rates] = <Self as $crate::ode::Tableau>::COEFFICIENTS.dense_weights(theta);
                let terms: [(T, &S::Rate); $rates] = core::array::from_fn(|i| (T::from_f64(h_s * weights[i]), &rates[i]));
                state.add_scaled(&terms);
            }
        }

        $(
            impl $crate::ode::Embedded for $name {
                const ERROR_ORDER: u32 = $error_order;
                const ERROR_AT_END: bool = $at_end;

                #[inline(always)]
                fn error_ratio<T: $crate::algebra::Real, S: $crate::ode::Controlled<T>>(
                    rates: &[S::Rate; $rates],
                    state: &S,
                    next: &S,
                    h_s: f64,
                    tolerance: $crate::ode::Tolerance<T>,
                ) -> f64 {
                    $crate::ode::control::joined([$({
                        let terms = [$( (T::from_f64(h_s * ($e)), &rates[$ej - 1]) ),*];
                        state.error_ratio(next, &terms, tolerance).to_f64()
                    }),+])
                }
            }
        )?
    };
}

/// A coefficient with its text.
macro_rules! number {
    ($value:expr) => {
        $crate::ode::tableau::Number { text: stringify!($value), value: $value }
    };
}

use {number, tableau};
