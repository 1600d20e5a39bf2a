//! Random elements of declared types: unit ones from their own manifold, as products of `q²/|q|²`.

use crate::dense::{Dense, Oracle, Part, number};
use ga_gen::blade::Blade;
use ga_gen::field::Residue;
use ga_gen::types::Type;

/// A stream of numbers that is not the generator's: xorshift64* (Vigna 2016).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    pub(crate) fn below(&mut self, bound: usize) -> usize {
        usize::try_from(self.next() >> 33).unwrap() % bound
    }

    pub(crate) fn residue(&mut self) -> Residue {
        number(i128::from(self.next() >> 4), 1)
    }
}

/// Random fields of a type.
pub(crate) fn fields(oracle: &Oracle, ty: &Type, random: &mut Random) -> Vec<Residue> {
    if let Some(factors) = &ty.factors {
        return factors.iter().flat_map(|factor| fields(oracle, factor, random)).collect();
    }
    if !ty.unit {
        return ty.fields.iter().map(|_| random.residue()).collect();
    }
    let unit = oracle.coefficients(&unit(oracle, ty, random));
    let readout = |readout: &Option<ga_gen::storage::Readout>| {
        let readout = readout.as_ref().expect("a unit type has linear fields");
        let terms = readout.terms.iter().map(|(blade, factor)| unit[blade.0 as usize].times((*factor).into()));
        terms.fold(readout.constant.into(), Residue::plus)
    };
    let fields: Vec<Residue> = ty.readouts.iter().map(readout).collect();
    let value = oracle.value(ty, &fields);
    assert_eq!(oracle.coefficients(&value), unit, "{} holds its unit elements", ty.name);
    assert_eq!(oracle.product(Part::All, &value, &oracle.reverse(&value)), oracle.scalar(Residue::ONE), "{}", ty.name);
    fields
}

fn unit(oracle: &Oracle, ty: &Type, random: &mut Random) -> Dense {
    let blades: Vec<Blade> = ty.coefficients.keys().copied().collect();
    let vectors = blades.iter().all(|blade| blade.grade() == 1);
    let planes: Vec<Dense> = if vectors {
        let pairs = blades.iter().flat_map(|a| blades.iter().map(move |b| (*a, *b)));
        pairs.filter(|(a, b)| a < b).map(|(a, b)| oracle.blade(Blade(a.0 | b.0)).clone()).collect()
    } else {
        blades.iter().filter(|blade| blade.grade() == 2).map(|blade| oracle.blade(*blade).clone()).collect()
    };
    let mut versor = oracle.scalar(Residue::ONE);
    for plane in planes.iter().chain(&planes) {
        let q = oracle.sum(&oracle.scalar(random.residue()), &oracle.scaled(plane, random.residue()));
        let square = oracle.product(Part::All, &q, &q);
        let factor = oracle.scaled(&square, oracle.norm_sq(&q).inverse());
        versor = oracle.product(Part::All, &versor, &factor);
    }
    if !vectors {
        return versor;
    }
    let starts = blades.iter().map(|blade| oracle.blade(*blade));
    let start = starts.rev().find(|v| oracle.product(Part::All, v, v)[0] == Residue::ONE);
    oracle.sandwich(&versor, start.expect("a unit vector type has a vector with square 1"))
}
