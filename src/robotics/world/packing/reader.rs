//! Reads a value that was written as the difference to an earlier one.

use serde::Deserialize;
use serde::de::value::U32Deserializer;
use serde::de::{self, DeserializeSeed, IntoDeserializer, Visitor};

use super::PackingError;
use super::alignment::{Alignment, Reference};

/// Reads what a [`super::Writer`] has written with the same reference.
pub(crate) struct Reader<'a> {
    bytes: &'a [u8],
    alignment: Alignment<'a>,
    left_out: Option<LeftOut<'a>>,
}

/// What was left out, from another place.
#[derive(Clone, Copy)]
pub(crate) struct LeftOut<'a> {
    /// The name under which the type (an enumeration) is read.
    pub(crate) name: &'static str,
    /// Its values in order, in bytes that stand for themselves.
    pub(crate) bytes: &'a [u8],
}

impl<'a> Reader<'a> {
    pub(crate) fn new(
        bytes: &'a [u8],
        reference: Option<Reference<'a>>,
        left_out: Option<LeftOut<'a>>,
    ) -> Self {
        Self {
            bytes,
            alignment: Alignment::new(reference),
            left_out,
        }
    }

    /// The next bytes as they were before they were written.
    fn take(&mut self, target: &mut [u8]) -> Result<(), PackingError> {
        let (bytes, rest) = self
            .bytes
            .split_at_checked(target.len())
            .ok_or(PackingError::Short)?;
        self.bytes = rest;
        target.copy_from_slice(bytes);
        let earlier = self.alignment.next(target.len());
        for (byte, then) in target.iter_mut().zip(earlier) {
            *byte ^= then;
        }
        Ok(())
    }

    fn number<const N: usize>(&mut self) -> Result<[u8; N], PackingError> {
        let mut bytes = [0; N];
        self.take(&mut bytes)?;
        Ok(bytes)
    }

    fn length(&mut self) -> Result<usize, PackingError> {
        let length = u64::from_le_bytes(self.number()?);
        usize::try_from(length).map_err(|_| PackingError::NotOf("a length"))
    }

    fn text(&mut self) -> Result<Vec<u8>, PackingError> {
        let length = self.length()?;
        if length > self.bytes.len() {
            return Err(PackingError::Short);
        }
        let mut bytes = vec![0; length];
        self.take(&mut bytes)?;
        Ok(bytes)
    }

    fn fields<'r>(&'r mut self, count: usize) -> Fields<'r, 'a> {
        Fields {
            reader: self,
            left: count,
        }
    }

    fn list<'r>(&'r mut self) -> Result<Elements<'r, 'a>, PackingError> {
        let count = self.length()?;
        let is_outermost = self.alignment.enter_list();
        Ok(Elements {
            reader: self,
            count,
            index: 0,
            is_outermost,
        })
    }
}

/// The fields of what has a fixed number of them.
struct Fields<'r, 'a> {
    reader: &'r mut Reader<'a>,
    left: usize,
}

impl<'de> de::SeqAccess<'de> for Fields<'_, '_> {
    type Error = PackingError;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, PackingError> {
        if self.left == 0 {
            return Ok(None);
        }
        self.left -= 1;
        seed.deserialize(&mut *self.reader).map(Some)
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.left)
    }
}

/// The elements of a list.
struct Elements<'r, 'a> {
    reader: &'r mut Reader<'a>,
    count: usize,
    index: usize,
    is_outermost: bool,
}

impl Elements<'_, '_> {
    /// Whether there is one more.
    fn begin_element(&mut self) -> bool {
        if self.index == self.count {
            return false;
        }
        if self.is_outermost {
            self.reader.alignment.enter_element(self.index);
        }
        self.index += 1;
        true
    }
}

impl<'de> de::SeqAccess<'de> for Elements<'_, '_> {
    type Error = PackingError;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, PackingError> {
        match self.begin_element() {
            true => seed.deserialize(&mut *self.reader).map(Some),
            false => Ok(None),
        }
    }

    fn size_hint(&self) -> Option<usize> {
        // A length that is wrong does not fill the memory.
        Some((self.count - self.index).min(self.reader.bytes.len()))
    }
}

impl<'de> de::MapAccess<'de> for Elements<'_, '_> {
    type Error = PackingError;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, PackingError> {
        de::SeqAccess::next_element_seed(self, seed)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(
        &mut self,
        seed: V,
    ) -> Result<V::Value, PackingError> {
        seed.deserialize(&mut *self.reader)
    }

    fn size_hint(&self) -> Option<usize> {
        de::SeqAccess::size_hint(self)
    }
}

macro_rules! numbers {
    ($($method:ident: $type:ty, $visit:ident;)*) => {
        $(fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, PackingError> {
            visitor.$visit(<$type>::from_le_bytes(self.number()?))
        })*
    };
}

impl<'de> de::Deserializer<'de> for &mut Reader<'_> {
    type Error = PackingError;

    numbers! {
        deserialize_i8: i8, visit_i8;
        deserialize_i16: i16, visit_i16;
        deserialize_i32: i32, visit_i32;
        deserialize_i64: i64, visit_i64;
        deserialize_i128: i128, visit_i128;
        deserialize_u8: u8, visit_u8;
        deserialize_u16: u16, visit_u16;
        deserialize_u32: u32, visit_u32;
        deserialize_u64: u64, visit_u64;
        deserialize_u128: u128, visit_u128;
        deserialize_f32: f32, visit_f32;
        deserialize_f64: f64, visit_f64;
    }

    fn is_human_readable(&self) -> bool {
        false
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, PackingError> {
        Err(PackingError::Unsupported("a value of unknown type"))
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, PackingError> {
        Err(PackingError::Unsupported("a value of unknown type"))
    }

    fn deserialize_identifier<V: Visitor<'de>>(self, _: V) -> Result<V::Value, PackingError> {
        Err(PackingError::Unsupported("a name"))
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, PackingError> {
        match self.number()? {
            [0] => visitor.visit_bool(false),
            [1] => visitor.visit_bool(true),
            _ => Err(PackingError::NotOf("true or false")),
        }
    }

    fn deserialize_char<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, PackingError> {
        let code = u32::from_le_bytes(self.number()?);
        visitor.visit_char(char::from_u32(code).ok_or(PackingError::NotOf("a character"))?)
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, PackingError> {
        let text = String::from_utf8(self.text()?);
        visitor.visit_string(text.map_err(|_| PackingError::NotOf("a text"))?)
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, PackingError> {
        self.deserialize_str(visitor)
    }

    fn deserialize_bytes<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, PackingError> {
        visitor.visit_byte_buf(self.text()?)
    }

    fn deserialize_byte_buf<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, PackingError> {
        self.deserialize_bytes(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, PackingError> {
        match self.number()? {
            [0] => visitor.visit_none(),
            [1] => visitor.visit_some(self),
            _ => Err(PackingError::NotOf("whether there is a value")),
        }
    }

    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, PackingError> {
        visitor.visit_unit()
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, PackingError> {
        visitor.visit_unit()
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, PackingError> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, PackingError> {
        let value = visitor.visit_seq(self.list()?)?;
        self.alignment.leave_list();
        Ok(value)
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, PackingError> {
        let value = visitor.visit_map(self.list()?)?;
        self.alignment.leave_list();
        Ok(value)
    }

    fn deserialize_tuple<V: Visitor<'de>>(
        self,
        count: usize,
        visitor: V,
    ) -> Result<V::Value, PackingError> {
        visitor.visit_seq(self.fields(count))
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        count: usize,
        visitor: V,
    ) -> Result<V::Value, PackingError> {
        visitor.visit_seq(self.fields(count))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, PackingError> {
        visitor.visit_seq(self.fields(fields.len()))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, PackingError> {
        let Some(left_out) = self.left_out.as_mut().filter(|left| left.name == name) else {
            return visitor.visit_enum(self);
        };
        let mut elsewhere = Reader::new(left_out.bytes, None, None);
        let value = visitor.visit_enum(&mut elsewhere)?;
        left_out.bytes = elsewhere.bytes;
        Ok(value)
    }
}

impl<'r, 'de, 'a> de::EnumAccess<'de> for &'r mut Reader<'a> {
    type Error = PackingError;
    type Variant = &'r mut Reader<'a>;

    fn variant_seed<V: DeserializeSeed<'de>>(
        self,
        seed: V,
    ) -> Result<(V::Value, Self::Variant), PackingError> {
        let index = u32::deserialize(&mut *self)?;
        let index: U32Deserializer<PackingError> = index.into_deserializer();
        Ok((seed.deserialize(index)?, self))
    }
}

impl<'de> de::VariantAccess<'de> for &mut Reader<'_> {
    type Error = PackingError;

    fn unit_variant(self) -> Result<(), PackingError> {
        Ok(())
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(
        self,
        seed: T,
    ) -> Result<T::Value, PackingError> {
        seed.deserialize(self)
    }

    fn tuple_variant<V: Visitor<'de>>(
        self,
        count: usize,
        visitor: V,
    ) -> Result<V::Value, PackingError> {
        visitor.visit_seq(self.fields(count))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, PackingError> {
        visitor.visit_seq(self.fields(fields.len()))
    }
}
