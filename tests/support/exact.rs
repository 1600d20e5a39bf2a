//! Mass properties in exact rational arithmetic on the given f64 coordinates.
//!
//! About the world origin, without a shift, and with the second moments as a sum over pairs of corners, so that nothing
//! but the divergence theorem is shared with the library: for the tetrahedron (0, v1, v2, v3) with d = v1.(v2 x v3),
//! ∫ x_i x_j = d/120 sum_kl (1 + delta_kl) v_k,i v_l,j.

use ga_physics::geometry::mesh::Mesh;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

pub(crate) struct ExactMass {
    pub(crate) volume: BigRational,
    pub(crate) centre: [BigRational; 3],
    pub(crate) inertia: [[BigRational; 3]; 3],
}

/// An f64 as an integer multiple of 2^-1074.
fn integer(x: f64, shift: i64) -> BigInt {
    let bits = x.to_bits();
    let exponent = i64::try_from(bits >> 52 & 0x7ff).expect("eleven bits");
    let fraction = bits & ((1 << 52) - 1);
    let (mantissa, exponent) = if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) };
    let magnitude =
        BigInt::from(mantissa) << usize::try_from(exponent + shift).expect("the shift clears all exponents");
    if x < 0.0 { -magnitude } else { magnitude }
}

/// Coordinates count in units of 2^-SHIFT, which suffices for numbers above 1e-16 or so, and zero.
const SHIFT: i64 = 110;

pub(crate) fn exact_mass(mesh: &Mesh) -> ExactMass {
    let v: Vec<[BigInt; 3]> = mesh
        .vertices
        .iter()
        .map(|p| [p.x, p.y, p.z].map(|x| if x == 0.0 { BigInt::zero() } else { integer(x, SHIFT) }))
        .collect();
    let mut volume_6 = BigInt::zero();
    let mut first_24: [BigInt; 3] = Default::default();
    let mut second_120: [[BigInt; 3]; 3] = Default::default();
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|i| &v[i as usize]);
        let d = &a[0] * (&b[1] * &c[2] - &b[2] * &c[1])
            + &a[1] * (&b[2] * &c[0] - &b[0] * &c[2])
            + &a[2] * (&b[0] * &c[1] - &b[1] * &c[0]);
        for i in 0..3 {
            first_24[i] += &d * (&a[i] + &b[i] + &c[i]);
            for j in 0..3 {
                let mut pairs = BigInt::zero();
                for (k, p) in [a, b, c].iter().enumerate() {
                    for (l, q) in [a, b, c].iter().enumerate() {
                        pairs += &p[i] * &q[j] * if k == l { 2 } else { 1 };
                    }
                }
                second_120[i][j] += &d * pairs;
            }
        }
        volume_6 += d;
    }
    let unit = |power: usize| BigInt::from(1) << (usize::try_from(SHIFT).expect("positive") * power);
    let volume = BigRational::new(volume_6, unit(3) * 6);
    let centre = first_24.map(|f| BigRational::new(f, unit(4) * 24) / &volume);
    let central = |i: usize, j: usize| {
        BigRational::new(second_120[i][j].clone(), unit(5) * 120) - &volume * &centre[i] * &centre[j]
    };
    let trace = central(0, 0) + central(1, 1) + central(2, 2);
    let inertia = [0, 1, 2].map(|i| [0, 1, 2].map(|j| if i == j { &trace - central(i, j) } else { -central(i, j) }));
    ExactMass { volume, centre, inertia }
}

/// `value - exact`, rounded once.
pub(crate) fn error(value: f64, exact: &BigRational) -> f64 {
    (BigRational::from_float(value).expect("finite") - exact).to_f64().expect("in range")
}
