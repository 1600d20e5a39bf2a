//! What the code of `algebra!` calls, so that it stays small, and so that a crate that declares an algebra needs no
//! dependency but this one.
//!
//! [`__interop!`](crate::__interop) stands in every expansion, one call a type. It is a macro of *this* crate, so the
//! features that decide are those that this crate was built with: a proc macro could not see them, and one that is
//! told by features of its own is told wrong where a build script and the program it belongs to ask for different ones.
//! Without a feature its part expands to nothing.

mod display;
#[cfg(feature = "serde")]
mod record;
#[cfg(feature = "rand")]
mod sphere;
mod unit;

pub use display::{named, terms};
#[cfg(feature = "serde")]
pub use record::{Record, record};
#[cfg(feature = "rand")]
pub use sphere::on_sphere;
pub use unit::is_unit;

#[cfg(feature = "approx")]
pub use approx;
#[cfg(feature = "bytemuck")]
pub use bytemuck;
#[cfg(feature = "rand")]
pub use rand;
#[cfg(feature = "serde")]
pub use serde;

/// The traits of other crates for one generated type.
///
/// `display` is `terms` (a sum of blades, after the text of what is constant) or `named` (numbers by name); `unit` holds
/// the check of a unit type, or nothing; `sample` says how a random value is drawn.
#[doc(hidden)]
#[macro_export]
macro_rules! __interop {
    // A type without numbers: a constant.
    ($name:ident = $text:literal) => {
        impl ::core::fmt::Display for $name {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                f.pad($text)
            }
        }
        $crate::__interop_serde! { $name }
    };
    (
        $name:ident { $($field:ident $text:literal)* }
        display $form:ident $constants:literal
        unit { $($unit:expr)? }
        sample $($sample:tt)*
    ) => {
        impl<T> ::core::fmt::Display for $name<T>
        where
            T: $crate::algebra::Scalar + ::core::cmp::PartialEq + ::core::fmt::Display,
        {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                $crate::algebra::support::$form(f, $constants, &[$((self.$field, $text)),*])
            }
        }
        $crate::__interop_approx! { $name { $($field)* } }
        $crate::__interop_bytemuck! { $name }
        $crate::__interop_rand! { $name { $($field)* } $($sample)* }
        $crate::__interop_serde! { $name { $($field $text)* } $($unit)? }
    };
}

/// Comparison coefficient by coefficient: a rotor and its negative, which turn alike, differ.
#[cfg(feature = "approx")]
#[doc(hidden)]
#[macro_export]
macro_rules! __interop_approx {
    ($name:ident { $($field:ident)* }) => {
        impl<T: $crate::algebra::support::approx::AbsDiffEq> $crate::algebra::support::approx::AbsDiffEq for $name<T>
        where
            T::Epsilon: ::core::marker::Copy,
        {
            type Epsilon = T::Epsilon;
            fn default_epsilon() -> T::Epsilon {
                T::default_epsilon()
            }
            fn abs_diff_eq(&self, other: &Self, epsilon: T::Epsilon) -> bool {
                $(self.$field.abs_diff_eq(&other.$field, epsilon))&&*
            }
        }
        impl<T: $crate::algebra::support::approx::RelativeEq> $crate::algebra::support::approx::RelativeEq for $name<T>
        where
            T::Epsilon: ::core::marker::Copy,
        {
            fn default_max_relative() -> T::Epsilon {
                T::default_max_relative()
            }
            fn relative_eq(&self, other: &Self, epsilon: T::Epsilon, max_relative: T::Epsilon) -> bool {
                $(self.$field.relative_eq(&other.$field, epsilon, max_relative))&&*
            }
        }
        impl<T: $crate::algebra::support::approx::UlpsEq> $crate::algebra::support::approx::UlpsEq for $name<T>
        where
            T::Epsilon: ::core::marker::Copy,
        {
            fn default_max_ulps() -> u32 {
                T::default_max_ulps()
            }
            fn ulps_eq(&self, other: &Self, epsilon: T::Epsilon, max_ulps: u32) -> bool {
                $(self.$field.ulps_eq(&other.$field, epsilon, max_ulps))&&*
            }
        }
    };
}

/// The one `unsafe` of the library. It carries no `allow`: an expansion in another crate is not linted, and an `allow`
/// would be an error under that crate's `forbid(unsafe_code)`.
#[cfg(feature = "bytemuck")]
#[doc(hidden)]
#[macro_export]
macro_rules! __interop_bytemuck {
    ($name:ident) => {
        // SAFETY: every generated struct is `repr(C)`, and all its fields are of the one type T: so it has no padding,
        // zero bytes are zeros of T, and every pattern of bits is valid where every pattern is a valid T.
        unsafe impl<T: $crate::algebra::support::bytemuck::Zeroable> $crate::algebra::support::bytemuck::Zeroable
            for $name<T>
        {
        }
        // SAFETY: as above.
        unsafe impl<T: $crate::algebra::support::bytemuck::Pod> $crate::algebra::support::bytemuck::Pod for $name<T> {}
    };
}

/// Random values: every number from `StandardUniform`; unit directions evenly over the sphere; or no implementation.
#[cfg(feature = "rand")]
#[doc(hidden)]
#[macro_export]
macro_rules! __interop_rand {
    ($name:ident { $($field:ident)* } none) => {};
    ($name:ident { $($field:ident)* } numbers) => {
        impl<T> $crate::algebra::support::rand::distr::Distribution<$name<T>>
            for $crate::algebra::support::rand::distr::StandardUniform
        where
            Self: $crate::algebra::support::rand::distr::Distribution<T>,
        {
            fn sample<R: $crate::algebra::support::rand::Rng + ?Sized>(&self, rng: &mut R) -> $name<T> {
                $name { $($field: self.sample(rng)),* }
            }
        }
    };
    ($name:ident { $($field:ident)* } sphere { $($unit:ident)* } { $($free:ident)* }) => {
        impl<T: $crate::algebra::Real> $crate::algebra::support::rand::distr::Distribution<$name<T>>
            for $crate::algebra::support::rand::distr::StandardUniform
        where
            Self: $crate::algebra::support::rand::distr::Distribution<T>,
        {
            fn sample<R: $crate::algebra::support::rand::Rng + ?Sized>(&self, rng: &mut R) -> $name<T> {
                let [$($unit),*] = $crate::algebra::support::on_sphere(rng);
                $name { $($unit,)* $($free: self.sample(rng)),* }
            }
        }
    };
}

/// Structs with the names of the fields. What is read into a unit type is held against its invariant.
#[cfg(feature = "serde")]
#[doc(hidden)]
#[macro_export]
macro_rules! __interop_serde {
    ($name:ident) => {
        impl $crate::algebra::support::serde::Serialize for $name {
            fn serialize<S: $crate::algebra::support::serde::Serializer>(
                &self,
                serializer: S,
            ) -> ::core::result::Result<S::Ok, S::Error> {
                serializer.serialize_unit_struct(::core::stringify!($name))
            }
        }
        impl<'de> $crate::algebra::support::serde::Deserialize<'de> for $name {
            fn deserialize<D: $crate::algebra::support::serde::Deserializer<'de>>(
                deserializer: D,
            ) -> ::core::result::Result<Self, D::Error> {
                <() as $crate::algebra::support::serde::Deserialize>::deserialize(deserializer).map(|()| Self)
            }
        }
    };
    ($name:ident { $($field:ident $text:literal)* }) => {
        $crate::__interop_serde! { @write $name { $($field $text)* } }
        impl<'de, T> $crate::algebra::support::serde::Deserialize<'de> for $name<T>
        where
            T: $crate::algebra::support::serde::Deserialize<'de>,
        {
            fn deserialize<D: $crate::algebra::support::serde::Deserializer<'de>>(
                deserializer: D,
            ) -> ::core::result::Result<Self, D::Error> {
                let mut numbers =
                    $crate::algebra::support::record(deserializer, ::core::stringify!($name), &[$($text),*])?;
                ::core::result::Result::Ok(Self { $($field: numbers.number()?),* })
            }
        }
    };
    ($name:ident { $($field:ident $text:literal)* } $unit:expr) => {
        $crate::__interop_serde! { @write $name { $($field $text)* } }
        impl<'de, T> $crate::algebra::support::serde::Deserialize<'de> for $name<T>
        where
            T: $crate::algebra::Real + $crate::algebra::support::serde::Deserialize<'de>,
        {
            fn deserialize<D: $crate::algebra::support::serde::Deserializer<'de>>(
                deserializer: D,
            ) -> ::core::result::Result<Self, D::Error> {
                let mut numbers =
                    $crate::algebra::support::record(deserializer, ::core::stringify!($name), &[$($text),*])?;
                let value = Self { $($field: numbers.number()?),* };
                numbers.unit(value, $unit)
            }
        }
    };
    (@write $name:ident { $($field:ident $text:literal)* }) => {
        impl<T: $crate::algebra::support::serde::Serialize> $crate::algebra::support::serde::Serialize for $name<T> {
            fn serialize<S: $crate::algebra::support::serde::Serializer>(
                &self,
                serializer: S,
            ) -> ::core::result::Result<S::Ok, S::Error> {
                use $crate::algebra::support::serde::ser::SerializeStruct as _;
                let mut numbers = serializer.serialize_struct(::core::stringify!($name), [$($text),*].len())?;
                $(numbers.serialize_field($text, &self.$field)?;)*
                numbers.end()
            }
        }
    };
}

/// Nothing: the feature is off.
#[cfg(not(feature = "approx"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __interop_approx {
    ($($ignored:tt)*) => {};
}
/// Nothing: the feature is off.
#[cfg(not(feature = "bytemuck"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __interop_bytemuck {
    ($($ignored:tt)*) => {};
}
/// Nothing: the feature is off.
#[cfg(not(feature = "rand"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __interop_rand {
    ($($ignored:tt)*) => {};
}
/// Nothing: the feature is off.
#[cfg(not(feature = "serde"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __interop_serde {
    ($($ignored:tt)*) => {};
}
