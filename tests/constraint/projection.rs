//! Projections of positions and velocities.

use crate::systems::{Dice, System};
use ga_physics::constraint::{Method, Multipliers};

#[test]
fn shaken_systems_come_back() {
    for mut system in [System::chain(1), System::chain(20), System::net(6, 0.3)] {
        let mut rows = system.rows();
        let w = system.inv_mass.clone();
        let mut multipliers = Multipliers::new(&rows, w.as_slice(), Method::Direct);
        system.shake(0.05, &mut Dice(5));
        assert!(system.stretch() > 1e-3);
        let projected = multipliers.project(&mut rows, w.as_slice(), &mut system, 1e-13).unwrap();
        assert!(system.stretch() < 2e-13 && projected.evaluations < 10, "{projected:?}");
    }
}
