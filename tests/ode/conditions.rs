//! The order conditions of every table, in exact arithmetic of the numbers as they are written.
//!
//! A method is of order p if, for every rooted tree of at most p vertices, `sum_i b_i g_i = 1 / gamma`, where g of a
//! leaf is 1, g of a tree is the product of `A g` over the subtrees at its root, and gamma is the number of vertices
//! times the gammas of the subtrees (Butcher 1963; Hairer, Nørsett, Wanner 1993, II.2). There are 200 trees of at most
//! 8 vertices.

use ga_physics::ode::tableau::{Coefficients, Entry, Number};
use ga_physics::ode::{CashKarp, Dop853, Embedded, Euler, Rk4, Rk4Doubling, Tableau, Tsit5};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// A rooted tree: the indices of the subtrees at its root in the list of all trees.
struct Tree {
    vertices: u32,
    gamma: u32,
    subtrees: Vec<usize>,
}

/// All trees of at most `most` vertices, smaller ones first.
fn trees(most: u32) -> Vec<Tree> {
    let mut all = vec![Tree { vertices: 1, gamma: 1, subtrees: vec![] }];
    for vertices in 2..=most {
        let mut forests = vec![];
        forests_of(&all, vertices - 1, all.len(), &mut vec![], &mut forests);
        for subtrees in forests {
            let gamma = vertices * subtrees.iter().map(|index| all[*index].gamma).product::<u32>();
            all.push(Tree { vertices, gamma, subtrees });
        }
    }
    all
}

/// All multisets of trees below an index with so many vertices together.
fn forests_of(all: &[Tree], left: u32, below: usize, chosen: &mut Vec<usize>, found: &mut Vec<Vec<usize>>) {
    if left == 0 {
        found.push(chosen.clone());
    }
    for index in (0..below).filter(|index| all[*index].vertices <= left) {
        chosen.push(index);
        forests_of(all, left - all[index].vertices, index + 1, chosen, found);
        chosen.pop();
    }
}

#[test]
fn the_trees_are_all() {
    let all = trees(8);
    let count = |n| all.iter().filter(|tree| tree.vertices == n).count();
    assert_eq!([1, 2, 3, 4, 5, 6, 7, 8].map(count), [1, 1, 2, 4, 9, 20, 48, 115]);
}

/// Sums, differences and quotients of decimals.
fn parse(text: &str) -> BigRational {
    let decimal = |text: &str| {
        let (sign, digits) = text.trim().strip_prefix('-').map_or((1, text.trim()), |digits| (-1, digits));
        let (whole, part) = digits.split_once('.').unwrap();
        let numerator: BigInt = format!("{whole}{part}").parse().unwrap();
        BigRational::new(numerator * sign, BigInt::from(10).pow(u32::try_from(part.len()).unwrap()))
    };
    let term = |text: &str| text.split(" / ").map(decimal).reduce(|a, b| a / b).unwrap();
    text.split(" - ").map(term).reduce(|a, b| a - b).unwrap()
}

/// A table in integers: every number times one common denominator.
#[derive(Clone)]
struct Exact {
    scale: BigInt,
    /// Rows of the stages, that of the end, those for dense output.
    a: Vec<Vec<BigInt>>,
    b: Vec<BigInt>,
    errors: Vec<Vec<BigInt>>,
}

impl Exact {
    fn new(table: &Coefficients) -> Self {
        let rational = |entries: &[Entry]| {
            let mut row = vec![BigRational::zero(); table.n_rates];
            entries.iter().for_each(|Entry(index, number)| row[index - 1] = parse(number.text));
            row
        };
        let rows = |stages: &[ga_physics::ode::tableau::Stage]| {
            stages.iter().map(|stage| rational(stage.a)).collect::<Vec<_>>()
        };
        let b = rational(table.weights);
        let mut a = vec![rational(&[])];
        a.extend(rows(table.stages));
        a.push(b.clone());
        a.extend(rows(table.dense_stages));
        Self::scaled(&a, &b, &table.errors.iter().map(|error| rational(error)).collect::<Vec<_>>())
    }

    fn scaled(a: &[Vec<BigRational>], b: &[BigRational], errors: &[Vec<BigRational>]) -> Self {
        let all = a.iter().flatten().chain(b).chain(errors.iter().flatten());
        let scale = all.fold(BigInt::one(), |scale, number| num_lcm(&scale, number.denom()));
        let row = |row: &[BigRational]| row.iter().map(|x| x.numer() * (&scale / x.denom())).collect::<Vec<_>>();
        let rows = |rows: &[Vec<BigRational>]| rows.iter().map(|x| row(x)).collect();
        Self { a: rows(a), b: row(b), errors: rows(errors), scale: scale.clone() }
    }

    /// g of every tree, times `scale^(vertices - 1)`.
    fn stage_weights(&self, trees: &[Tree]) -> Vec<Vec<BigInt>> {
        let mut all: Vec<Vec<BigInt>> = vec![];
        // `A g` of every tree.
        let mut moved: Vec<Vec<BigInt>> = vec![];
        for tree in trees {
            let product = |stage: usize| tree.subtrees.iter().map(|index| &moved[*index][stage]).product::<BigInt>();
            let g: Vec<_> = (0..self.a.len()).map(product).collect();
            moved.push(self.a.iter().map(|row| dot(row, &g)).collect());
            all.push(g);
        }
        all
    }

    /// The same with all signs positive: what rounding is measured against.
    fn absolute(&self) -> Self {
        let abs = |row: &Vec<BigInt>| row.iter().map(Signed::abs).collect::<Vec<_>>();
        let rows = |rows: &[Vec<BigInt>]| rows.iter().map(abs).collect();
        Self { scale: self.scale.clone(), a: rows(&self.a), b: abs(&self.b), errors: rows(&self.errors) }
    }
}

fn num_lcm(a: &BigInt, b: &BigInt) -> BigInt {
    let (mut x, mut y) = (a.clone(), b.clone());
    while !y.is_zero() {
        (x, y) = (y.clone(), x % y);
    }
    a / x * b
}

fn dot(a: &[BigInt], b: &[BigInt]) -> BigInt {
    a.iter().zip(b).filter(|(a, _)| !a.is_zero()).map(|(a, b)| a * b).sum()
}

/// How far a table is from each condition, and what the rounding of every coefficient by one part in `1 / rounding` can
/// make of it: `(vertices, residual, bound)`, in units of the condition. With `error`, the conditions are that an
/// estimate vanishes.
fn residuals(table: &Exact, trees: &[Tree], error: Option<usize>, rounding: f64) -> Vec<(u32, f64, f64)> {
    let (signed, absolute) = (table.stage_weights(trees), table.absolute());
    let sizes = absolute.stage_weights(trees);
    let mut found = vec![];
    for ((tree, g), size) in trees.iter().zip(&signed).zip(&sizes) {
        let (weights, target) = match error {
            Some(index) => (&table.errors[index], BigInt::zero()),
            None => (&table.b, table.scale.pow(tree.vertices)),
        };
        let unit = table.scale.pow(tree.vertices);
        let residual = ratio(&(dot(weights, g) * tree.gamma - target), &unit);
        let size = dot(&weights.iter().map(Signed::abs).collect::<Vec<_>>(), size) * tree.gamma;
        found.push((tree.vertices, residual.abs(), rounding * f64::from(tree.vertices) * ratio(&size, &unit)));
    }
    found
}

fn ratio(a: &BigInt, b: &BigInt) -> f64 {
    BigRational::new(a.clone(), b.clone()).to_f64().unwrap()
}

/// The order of a method or of an estimate: the largest for which all conditions hold within the rounding of the table.
/// The first that fails must fail by far.
fn order_of(table: &Exact, error: Option<usize>, rounding: f64, most: u32) -> u32 {
    let residuals = residuals(table, &trees(most), error, rounding);
    let holds = |n: u32| residuals.iter().filter(|found| found.0 == n).all(|found| found.1 <= found.2);
    let order = (1..=most).take_while(|n| holds(*n)).last().unwrap_or(0);
    let worst = residuals.iter().filter(|found| found.0 <= order && found.2 > 0.0).map(|found| found.1 / found.2);
    println!("order {order}, residual / bound {:e}", worst.fold(0.0, f64::max));
    let next = residuals.iter().filter(|found| found.0 == order + 1).map(|found| found.1).fold(0.0, f64::max);
    assert!(order == most || next > 1e-6, "not far from order {}: {next:e}", order + 1);
    order
}

/// Fractions are exact.
const EXACT: f64 = 0.0;

/// Decimals with 27 significant digits or more.
const DECIMALS: f64 = 1e-27;

#[test]
fn methods_and_estimates_have_exactly_their_order() {
    let check = |name: &str, table: Coefficients, order: u32, errors: &[u32], rounding: f64| {
        let exact = Exact::new(&table);
        assert_eq!(order_of(&exact, None, rounding, 8.min(order + 1)), order, "{name}");
        for (index, order) in errors.iter().enumerate() {
            assert_eq!(order_of(&exact, Some(index), rounding, order + 1), *order, "estimate {index} of {name}");
        }
        assert_eq!(exact.errors.len(), errors.len());
    };
    check("Euler", Euler::COEFFICIENTS, Euler::ORDER, &[], EXACT);
    check("RK4", Rk4::COEFFICIENTS, Rk4::ORDER, &[], EXACT);
    check("RK4 doubling", Rk4Doubling::COEFFICIENTS, Rk4Doubling::ORDER, &[Rk4Doubling::ERROR_ORDER], EXACT);
    check("Cash-Karp", CashKarp::COEFFICIENTS, CashKarp::ORDER, &[CashKarp::ERROR_ORDER], EXACT);
    check("Tsit5", Tsit5::COEFFICIENTS, Tsit5::ORDER, &[Tsit5::ERROR_ORDER], DECIMALS);
    check("DOP853", Dop853::COEFFICIENTS, Dop853::ORDER, &[5, 3], DECIMALS);
}

#[test]
fn times_are_the_sums_of_their_rows_and_numbers_are_their_texts() {
    for table in [
        Rk4::COEFFICIENTS,
        Rk4Doubling::COEFFICIENTS,
        CashKarp::COEFFICIENTS,
        Tsit5::COEFFICIENTS,
        Dop853::COEFFICIENTS,
    ] {
        for stage in table.stages.iter().chain(table.dense_stages) {
            let sum = stage.a.iter().map(|Entry(_, number)| parse(number.text)).fold(BigRational::zero(), |a, b| a + b);
            let off = (sum - parse(stage.c.text)).to_f64().unwrap().abs();
            assert!(off <= 1e-27, "{}: {off:e}", stage.c.text);
        }
        let all = table.stages.iter().flat_map(|stage| stage.a).chain(table.weights);
        let rounded =
            |number: &Number| (number.value - parse(number.text).to_f64().unwrap()).abs() <= 1e-16 * number.value.abs();
        assert!(all.clone().all(|Entry(_, number)| rounded(number)));
    }
}

/// Row 4 of the report's Table 4 lost its first entry; the fractions of row 6 slipped by a column. The printed row sums
/// to 3/10 where its time is 3/5, so that already the second condition fails.
#[test]
fn the_misprinted_table_4_is_of_order_1() {
    let number = |n: i64, d: i64| BigRational::new(n.into(), d.into());
    let printed = |row_4: [(i64, i64); 3]| {
        let good = Exact::new(&CashKarp::COEFFICIENTS);
        let back =
            |row: &Vec<BigInt>| row.iter().map(|x| BigRational::new(x.clone(), good.scale.clone())).collect::<Vec<_>>();
        let mut a: Vec<_> = good.a.iter().map(back).collect();
        for (entry, (n, d)) in a[3].iter_mut().zip(row_4) {
            *entry = number(n, d);
        }
        Exact::scaled(&a, &back(&good.b), &[])
    };
    assert_eq!(order_of(&printed([(3, 10), (-9, 10), (6, 5)]), None, EXACT, 6), 5);
    assert_eq!(order_of(&printed([(-9, 10), (6, 5), (0, 1)]), None, EXACT, 6), 1);
    // c* with 512/1771 as its last entry does not even sum to 1.
    let sum = [(2825, 27648), (18575, 48384), (13525, 55296), (277, 14336), (512, 1771)].map(|(n, d)| number(n, d));
    assert_eq!(sum.into_iter().fold(BigRational::zero(), |a, b| a + b), number(7361, 7084));
}

/// Dense output of order q satisfies `sum_i b_i(theta) g_i = theta^vertices / gamma` for trees of at most q vertices.
#[test]
fn dense_output_has_exactly_its_order() {
    fn check<const N: usize>(name: &str, table: Coefficients, order: u32) {
        let (trees, exact) = (trees(order + 1), Exact::new(&table));
        let g: Vec<Vec<f64>> = {
            let to_float = |(tree, g): (&Tree, Vec<BigInt>)| {
                let unit = exact.scale.pow(tree.vertices - 1);
                g.iter().map(|g| ratio(g, &unit)).collect()
            };
            trees.iter().zip(exact.stage_weights(&trees)).map(to_float).collect()
        };
        let mut next = 0.0_f64;
        for theta in [0.1, 0.37, 0.5, 0.83, 0.99] {
            let weights: [f64; N] = table.dense_weights(theta);
            for (tree, g) in trees.iter().zip(&g) {
                let sum: f64 = weights.iter().zip(g).map(|(b, g)| b * g).sum();
                let size: f64 = weights.iter().zip(g).map(|(b, g)| (b * g).abs()).sum();
                let off = (sum - theta.powi(i32::try_from(tree.vertices).unwrap()) / f64::from(tree.gamma)).abs();
                if tree.vertices > order {
                    next = next.max(off);
                } else {
                    // Weights are sums of a few terms up to hundreds of times their size.
                    assert!(off <= 1e-13 * (1.0 + size), "{name}, theta {theta}, {} vertices: {off:e}", tree.vertices);
                }
            }
        }
        assert!(next > 1e-6, "{name} is of a higher order: {next:e}");
        // The ends and their slopes.
        let near = |theta: f64, index: usize, value: f64| {
            let weights: [f64; N] = table.dense_weights(theta);
            assert!((weights[index] - value).abs() < 1e-14, "{name}: {weights:?}");
        };
        (0..N).for_each(|index| near(0.0, index, 0.0));
        table.weights.iter().for_each(|Entry(index, number)| near(1.0, index - 1, number.value));
    }
    check::<2>("Euler", Euler::COEFFICIENTS, 1);
    check::<5>("RK4", Rk4::COEFFICIENTS, 3);
    check::<12>("RK4 doubling", Rk4Doubling::COEFFICIENTS, 4);
    check::<7>("Cash-Karp", CashKarp::COEFFICIENTS, 3);
    check::<7>("Tsit5", Tsit5::COEFFICIENTS, 4);
    check::<16>("DOP853", Dop853::COEFFICIENTS, 7);
}
