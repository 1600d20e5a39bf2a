//! Products of even multivectors: by the table of blades and by way of the split basis.

use crate::exact::{Big, Exact, big, distance};
use crate::{Random, Table};
use ga_physics::algebra::cga::Even;
use ga_physics::algebra::split::even_product;
use num_traits::ToPrimitive;

/// The blades of an even multivector, in the order of its numbers.
const EVEN: [&str; 16] = [
    "s",
    "e23",
    "e31",
    "e12",
    "e1_no",
    "e2_no",
    "e3_no",
    "e1_ninf",
    "e2_ninf",
    "e3_ninf",
    "no_ninf",
    "e123_no",
    "e123_ninf",
    "e23_no_ninf",
    "e31_no_ninf",
    "e12_no_ninf",
];

fn exactly(even: Even<f64>) -> Exact {
    Exact::sum(EVEN.into_iter().zip(<[f64; 16]>::from(even).map(big)))
}

/// Errors as parts of the largest number (normwise), and of each number itself (componentwise).
fn errors(found: Even<f64>, exact: &[Big; 16]) -> [f64; 2] {
    let exact_size = exact.iter().map(|x| x.to_f64().unwrap().abs()).fold(0.0, f64::max);
    let mut worst = [0.0_f64; 2];
    for (x, e) in <[f64; 16]>::from(found).into_iter().zip(exact) {
        let error = distance(x, e);
        worst[0] = worst[0].max(error / exact_size);
        worst[1] = worst[1].max(error / e.to_f64().unwrap().abs());
    }
    worst
}

/// Numbers graded over `decades`.
fn graded(decades: f64, random: &mut Random) -> Even<f64> {
    Even::from_fn(|_| random.signed() * 10.0_f64.powf(decades / 2.0 * random.signed()))
}

#[test]
fn even_products_by_the_table_and_in_the_split_basis() {
    let (mut random, mut table) = (Random(5), Table::default());
    for (decades, ceiling, floor) in [(0.0, 6e-13, None), (12.0, 2e-14, Some(1e-10))] {
        let (mut by_table, mut split) = ([0.0_f64; 2], [0.0_f64; 2]);
        for _ in 0..20 {
            let (a, b) = (graded(decades, &mut random), graded(decades, &mut random));
            let exact = exactly(a).times(&exactly(b));
            let exact = EVEN.map(|name| exact.coefficient(name));
            let pairs = [(&mut by_table, a * b), (&mut split, even_product(a, b))];
            for (worst, found) in pairs {
                let found = errors(found, &exact);
                worst.iter_mut().zip(found).for_each(|(worst, error)| *worst = worst.max(error));
            }
        }
        let what = |how: &str| format!("even * even over {decades} decades, {how} number");
        table.good(what("table: of the largest"), by_table[0], 3e-15);
        table.good(what("split: of the largest"), split[0], 3e-15);
        table.good(what("table: of each"), by_table[1], ceiling);
        match floor {
            Some(floor) => table.bad(what("split: of each"), split[1], floor),
            None => table.good(what("split: of each"), split[1], ceiling),
        }
    }
    table.check();
}
