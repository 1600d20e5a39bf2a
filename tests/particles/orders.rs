//! Halving the step of a constrained motion divides the error by two to the order of the method.

use crate::cases::{adaptive, chain, distance, fixed, position_after};
use ga_physics::particle::Method;

#[test]
fn methods_keep_their_order_under_constraints() {
    let time_s = 1.0;
    let reference = position_after(chain(2, 0.9), &adaptive(Method::Dop853, 1e-13), 2, time_s);
    // A step at which the error is far above rounding and the next is far below.
    let cases = [
        (Method::Euler, 1.0, 1e-3),
        (Method::Rk4, 4.0, 1e-2),
        (Method::CashKarp, 5.0, 2e-2),
        (Method::Tsit5, 5.0, 2e-2),
        (Method::Verlet, 2.0, 5e-3),
        (Method::Yoshida4, 4.0, 1e-2),
        (Method::Yoshida6, 6.0, 2.5e-2),
        (Method::Dop853, 8.0, 0.1),
        (Method::Xpbd, 1.0, 1e-3),
    ];
    for (method, order, dt_s) in cases {
        let error = |dt_s: f64| distance(position_after(chain(2, 0.9), &fixed(method, dt_s), 2, time_s), reference);
        let (coarse, fine) = (error(dt_s), error(0.5 * dt_s));
        let observed = (coarse / fine).log2();
        println!("{}: {observed:.2} of {order} ({coarse:.1e}, {fine:.1e})", method.name());
        // A step is no limit: a tenth is for the error of the next order. More is better: a leading
        // term may be small.
        assert!(observed > order - 0.25 && observed < order + 2.0, "{}: {observed} of {order}", method.name());
    }
}
