//! Every operation of a generated algebra against the dynamic multivector, in exact arithmetic: macros that take the
//! list which the algebra's `__operations!` hands out.
//!
//! A module that uses them names the algebra's module `algebra`, every type by its own name over `Rational`, implements
//! `Sample` for each, and has `image(versor, x, type name)`: the expected result of `apply`.

use crate::rational::Rational;

/// SplitMix64: small integers, zero included.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn integer(&mut self) -> i128 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        i128::from((z ^ (z >> 31)) % 7) - 3
    }

    pub(crate) fn rational(&mut self) -> Rational {
        Rational::new(self.integer(), 1)
    }
}

/// A random value of a type, on the manifold of its facts.
pub(crate) trait Sample: Sized {
    fn sample(random: &mut Random) -> Self;
}

macro_rules! integers {
    ($($name:ident)*) => {$(
        impl Sample for $name {
            fn sample(random: &mut Random) -> Self { Self::from_fn(|_| random.rational()) }
        }
    )*};
}

/// Comparison of results, bare scalars included.
macro_rules! checks {
    ($algebra:ty) => {
        type Multi = Dynamic<$algebra, Rational>;

        impl ToDynamic<$algebra, Rational> for Rational {
            fn to_dynamic(&self) -> Multi {
                Dynamic::from_terms(&[(0, *self)])
            }
        }

        fn binary<A, B, C>(name: &str, op: impl Fn(A, B) -> C, expected: impl Fn(&Multi, &Multi) -> Multi)
        where
            A: Sample + Copy + ToDynamic<$algebra, Rational>,
            B: Sample + Copy + ToDynamic<$algebra, Rational>,
            C: ToDynamic<$algebra, Rational>,
        {
            let mut random = Random(name.bytes().map(u64::from).sum());
            for _ in 0..4 {
                let (a, b) = (A::sample(&mut random), B::sample(&mut random));
                let (x, y) = (a.to_dynamic(), b.to_dynamic());
                let (actual, expected) = (op(a, b).to_dynamic(), expected(&x, &y));
                assert!(actual == expected, "{name}: {x:?} and {y:?} give {actual:?}, expected {expected:?}");
            }
        }

        fn unary<A, C>(name: &str, op: impl Fn(A) -> C, expected: impl Fn(&Multi) -> Multi)
        where
            A: Sample + Copy + ToDynamic<$algebra, Rational>,
            C: ToDynamic<$algebra, Rational>,
        {
            let mut random = Random(name.bytes().map(u64::from).sum());
            for _ in 0..4 {
                let a = A::sample(&mut random);
                let x = a.to_dynamic();
                let (actual, expected) = (op(a).to_dynamic(), expected(&x));
                assert!(actual == expected, "{name}: {x:?} gives {actual:?}, expected {expected:?}");
            }
        }
    };
}

macro_rules! check {
    ($(($($entry:tt)*))*) => {
        /// How many operations of each kind were compared.
        fn compare_all() -> usize {
            let mut count = 0;
            $( count += 1; one!($($entry)*); )*
            count
        }
    };
}

macro_rules! one {
    (mul $a:ident $b:ident) => {
        binary::<$a, $b, _>(concat!(stringify!($a), " * ", stringify!($b)), |a, b| a * b, |x, y| x * y)
    };
    (bitxor $a:ident $b:ident) => {
        binary::<$a, $b, _>(concat!(stringify!($a), " ^ ", stringify!($b)), |a, b| a ^ b, |x, y| x ^ y)
    };
    (bitor $a:ident $b:ident) => {
        binary::<$a, $b, _>(concat!(stringify!($a), " | ", stringify!($b)), |a, b| a | b, |x, y| x | y)
    };
    (meet $a:ident $b:ident) => {
        binary::<$a, $b, _>(
            concat!(stringify!($a), " & ", stringify!($b)),
            |a, b| algebra::meet(a, b),
            |x, y| x.meet(y).unwrap(),
        )
    };
    (apply $a:ident $b:ident) => {
        binary::<$a, $b, _>(
            concat!(stringify!($a), ".apply(", stringify!($b), ")"),
            |a, b| a.apply(b),
            |x, y| image(x, y, stringify!($b)),
        )
    };
    (embed $a:ident $b:ident) => {
        unary::<$a, $b>(concat!(stringify!($b), "::from(", stringify!($a), ")"), |a| $b::from(a), |x| x.clone())
    };
    (rev $a:ident) => {
        unary::<$a, _>(concat!(stringify!($a), ".rev()"), |a| a.rev(), |x| x.rev())
    };
    (dual $a:ident) => {
        unary::<$a, _>(concat!("dual ", stringify!($a)), |a| algebra::dual(a), |x| x.dual().unwrap())
    };
    (undual $a:ident) => {
        unary::<$a, _>(concat!("undual ", stringify!($a)), |a| algebra::undual(a), |x| x.undual().unwrap())
    };
    (norm_sq $a:ident) => {
        unary::<$a, _>(concat!(stringify!($a), ".norm_sq()"), |a| a.norm_sq(), |x| (x * &x.rev()).grade(0))
    };
    (grade $a:ident $method:ident $grade:literal) => {
        unary::<$a, _>(concat!(stringify!($a), " grade ", $grade), |a| a.$method(), |x| x.grade($grade))
    };
}
