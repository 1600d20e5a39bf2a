//! Ceilings on the operations of the kernels that inner loops are made of.
//!
//! A count above its ceiling is a loss of speed that no other test sees. A count below it is good news: lower the ceiling
//! with it. The counts are read from the ledgers, which another test holds to the code.

use crate::root;
use std::collections::BTreeMap;

/// Ledger, item, multiplications and additions and sign changes together, divisions. None of them takes a square root.
const CEILINGS: [(&str, &str, usize, usize); 22] = [
    ("g3", "Rotor*Rotor", 28, 0),
    ("g3", "Rotor.apply(Vector)", 30, 0),
    ("cga", "Point|Point", 10, 0),
    ("cga", "Motor.apply(Point)", 39, 0),
    ("cga", "Motor*Motor", 88, 0),
    ("cga", "Pose.apply(Point)", 33, 0),
    ("cga", "Pose*Pose", 61, 0),
    ("cga", "ConformalRotor.apply(Point)", 79, 1),
    ("cga", "ConformalRotor*ConformalRotor", 240, 0),
    ("cga", "Even*Even", 496, 0),
    ("cga", "Multivector*Multivector", 2016, 0),
    ("split", "even_product", 280, 0),
    ("split", "multivector_product", 672, 0),
    ("formulas", "circumsphere", 73, 1),
    ("formulas", "circumsphere_relative", 65, 0),
    ("formulas", "circle_sphere", 59, 1),
    ("formulas", "ray_meets_plane", 17, 1),
    ("formulas", "line_blade_meets_plane", 23, 1),
    ("formulas", "ball_reach_and_distance_sq", 10, 0),
    ("formulas", "reflect_in_plane", 15, 0),
    ("pose", "pose_of", 24, 0),
    ("pose", "motor_of", 24, 0),
];

#[test]
fn kernels_stay_below_their_ceilings() {
    let mut ledgers: BTreeMap<&str, String> = BTreeMap::new();
    for (ledger, item, operations, div) in CEILINGS {
        let text = ledgers
            .entry(ledger)
            .or_insert_with(|| std::fs::read_to_string(root().join(format!("ga-gen/ledger/{ledger}.tsv"))).unwrap());
        let line = text.lines().find_map(|line| line.strip_prefix(&format!("{item}\t")));
        let line = line.unwrap_or_else(|| panic!("no item {item} in the ledger {ledger}"));
        let counts: Vec<usize> = line.split('\t').map(|count| count.parse().unwrap()).collect();
        let found = counts[..3].iter().sum::<usize>();
        assert!(found <= operations, "{item}: {found} operations, at most {operations}");
        assert!(counts[3] <= div && counts[4] == 0, "{item}: {line}, at most {div} divisions, no root");
    }
}
