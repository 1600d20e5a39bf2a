//! Euler's method, the classical Runge-Kutta method, and that with steps taken twice.

use super::{number, tableau};

tableau! {
    /// Euler's method (report, equation 55): order 1, one evaluation a step.
    Euler: order 1, rates 2;
    next => [1: 1.0];
}

tableau! {
    /// The classical method of order 4 (Kutta 1901; report, equation 56): four evaluations a step.
    Rk4: order 4, rates 5;
    2 at 1.0 / 2.0 => [1: 1.0 / 2.0];
    3 at 1.0 / 2.0 => [2: 1.0 / 2.0];
    4 at 1.0 => [3: 1.0];
    next => [1: 1.0 / 6.0, 2: 1.0 / 3.0, 3: 1.0 / 3.0, 4: 1.0 / 6.0];
}

tableau! {
    /// The classical method with every step taken once whole and once in halves (report, B.3.1), as the one method of
    /// eleven stages that this is: 1 to 4 the whole step, 1, 5, 6, 7 the first half, 8 to 11 the second.
    ///
    /// The result is `two + (two - one) / 15`, of order 5 (Richardson; local extrapolation), and the estimate `(two -
    /// one) / 15` that of the error of the halves, of order 4 (Hairer, Nørsett, Wanner 1993, II.4). Dense output is the
    /// quartic that also goes through the middle.
    Rk4Doubling: order 5, rates 12;
    2 at 1.0 / 2.0 => [1: 1.0 / 2.0];
    3 at 1.0 / 2.0 => [2: 1.0 / 2.0];
    4 at 1.0 => [3: 1.0];
    5 at 1.0 / 4.0 => [1: 1.0 / 4.0];
    6 at 1.0 / 4.0 => [5: 1.0 / 4.0];
    7 at 1.0 / 2.0 => [6: 1.0 / 2.0];
    8 at 1.0 / 2.0 => [1: 1.0 / 12.0, 5: 1.0 / 6.0, 6: 1.0 / 6.0, 7: 1.0 / 12.0];
    9 at 3.0 / 4.0 => [1: 1.0 / 12.0, 5: 1.0 / 6.0, 6: 1.0 / 6.0, 7: 1.0 / 12.0, 8: 1.0 / 4.0];
    10 at 3.0 / 4.0 => [1: 1.0 / 12.0, 5: 1.0 / 6.0, 6: 1.0 / 6.0, 7: 1.0 / 12.0, 9: 1.0 / 4.0];
    11 at 1.0 => [1: 1.0 / 12.0, 5: 1.0 / 6.0, 6: 1.0 / 6.0, 7: 1.0 / 12.0, 10: 1.0 / 2.0];
    next => [
        1: 7.0 / 90.0, 2: -1.0 / 45.0, 3: -1.0 / 45.0, 4: -1.0 / 90.0,
        5: 8.0 / 45.0, 6: 8.0 / 45.0, 7: 4.0 / 45.0,
        8: 4.0 / 45.0, 9: 8.0 / 45.0, 10: 8.0 / 45.0, 11: 4.0 / 45.0
    ];
    error 4, at end false => [
        1: -1.0 / 180.0, 2: -1.0 / 45.0, 3: -1.0 / 45.0, 4: -1.0 / 90.0,
        5: 1.0 / 90.0, 6: 1.0 / 90.0, 7: 1.0 / 180.0,
        8: 1.0 / 180.0, 9: 1.0 / 90.0, 10: 1.0 / 90.0, 11: 1.0 / 180.0
    ];
    bend 2 2 => -8.0, [1: -2.0 / 3.0, 5: 8.0 / 3.0, 6: 8.0 / 3.0, 7: 4.0 / 3.0, 12: 2.0];
}
