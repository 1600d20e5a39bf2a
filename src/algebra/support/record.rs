//! Reading of generated structs, once for all of them: N numbers by name, by index, or in order.
//!
//! Written out instead of derived, because a derive for each of some thirty types an algebra costs more time to compile
//! than all of their products.

use core::fmt;
use core::marker::PhantomData;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Unexpected, Visitor};

/// The numbers of a struct, to be taken in order.
#[derive(Debug)]
pub struct Record<T, E, const N: usize> {
    type_name: &'static str,
    names: &'static [&'static str; N],
    values: [Option<T>; N],
    taken: usize,
    error: PhantomData<E>,
}

impl<T, E: Error, const N: usize> Record<T, E, N> {
    fn new(type_name: &'static str, names: &'static [&'static str; N]) -> Self {
        Self { type_name, names, values: [const { None }; N], taken: 0, error: PhantomData }
    }

    /// The next number.
    ///
    /// # Errors
    /// It was not in the input.
    pub fn number(&mut self) -> Result<T, E> {
        let index = self.taken;
        self.taken += 1;
        let value = self.values.get_mut(index).and_then(Option::take);
        value.ok_or_else(|| E::missing_field(self.names.get(index).copied().unwrap_or("")))
    }

    /// A value that satisfies the invariant of its type.
    ///
    /// # Errors
    /// It does not.
    pub fn unit<U: Copy>(&self, value: U, is_unit: fn(U) -> bool) -> Result<U, E> {
        if is_unit(value) {
            return Ok(value);
        }
        let name = self.type_name;
        Err(E::custom(format_args!("this {name} is not unit: `a ~a` is not 1; normalise it before it is written")))
    }
}

/// Reads the numbers of a struct.
///
/// # Errors
/// What the format finds; a name that is unknown or stands twice; too few numbers. A name that is unknown is refused,
/// because a multivector without one of its blades is another multivector.
pub fn record<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(
    deserializer: D,
    type_name: &'static str,
    names: &'static [&'static str; N],
) -> Result<Record<T, D::Error, N>, D::Error> {
    let values =
        deserializer.deserialize_struct(type_name, names, Numbers { type_name, names, number: PhantomData })?;
    Ok(Record { values, ..Record::new(type_name, names) })
}

struct Numbers<T, const N: usize> {
    type_name: &'static str,
    names: &'static [&'static str; N],
    number: PhantomData<T>,
}

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Numbers<T, N> {
    type Value = [Option<T>; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} with {N} numbers", self.type_name)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Self::Value, A::Error> {
        let mut values = [const { None }; N];
        for (index, value) in values.iter_mut().enumerate() {
            *value = sequence.next_element()?;
            if value.is_none() {
                return Err(A::Error::invalid_length(index, &self));
            }
        }
        Ok(values)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut values = [const { None }; N];
        while let Some(index) = map.next_key_seed(Name(self.names))? {
            // The seed gives indices of names only.
            let Some(value) = values.get_mut(index) else { continue };
            if value.is_some() {
                return Err(A::Error::duplicate_field(self.names[index]));
            }
            *value = Some(map.next_value()?);
        }
        Ok(values)
    }
}

/// A field by its name or index.
struct Name(&'static [&'static str]);

impl<'de> DeserializeSeed<'de> for Name {
    type Value = usize;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<usize, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for Name {
    type Value = usize;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a field")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<usize, E> {
        let found = self.0.iter().position(|known| *known == name);
        found.ok_or_else(|| E::unknown_field(name, self.0))
    }

    fn visit_bytes<E: Error>(self, name: &[u8]) -> Result<usize, E> {
        let name = core::str::from_utf8(name).map_err(|_| E::invalid_value(Unexpected::Bytes(name), &self))?;
        self.visit_str(name)
    }

    fn visit_u64<E: Error>(self, index: u64) -> Result<usize, E> {
        let found = usize::try_from(index).ok().filter(|index| *index < self.0.len());
        found.ok_or_else(|| E::invalid_value(Unexpected::Unsigned(index), &self))
    }
}
