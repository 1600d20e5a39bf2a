//! Cash and Karp 1990 (ACM Transactions on Mathematical Software 16, 201-222); report, equations 57, 58 and Table 4.

use super::{number, tableau};

tableau! {
    /// The pair of orders 5(4) of Cash and Karp: six evaluations a step.
    ///
    /// Two rows of the report's Table 4 are misprinted: row 4 lost its first entry (its times and rows then disagree,
    /// and the method is of order 1), and the last weights slipped by a column. These are the ones of the paper.
    CashKarp: order 5, rates 7;
    2 at 1.0 / 5.0 => [1: 1.0 / 5.0];
    3 at 3.0 / 10.0 => [1: 3.0 / 40.0, 2: 9.0 / 40.0];
    4 at 3.0 / 5.0 => [1: 3.0 / 10.0, 2: -9.0 / 10.0, 3: 6.0 / 5.0];
    5 at 1.0 => [1: -11.0 / 54.0, 2: 5.0 / 2.0, 3: -70.0 / 27.0, 4: 35.0 / 27.0];
    6 at 7.0 / 8.0 => [
        1: 1631.0 / 55296.0, 2: 175.0 / 512.0, 3: 575.0 / 13824.0, 4: 44275.0 / 110592.0, 5: 253.0 / 4096.0
    ];
    next => [1: 37.0 / 378.0, 3: 250.0 / 621.0, 4: 125.0 / 594.0, 6: 512.0 / 1771.0];
    error 4, at end false => [
        1: 37.0 / 378.0 - 2825.0 / 27648.0,
        3: 250.0 / 621.0 - 18575.0 / 48384.0,
        4: 125.0 / 594.0 - 13525.0 / 55296.0,
        5: -277.0 / 14336.0,
        6: 512.0 / 1771.0 - 1.0 / 4.0
    ];
}
