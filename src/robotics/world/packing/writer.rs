//! Writes a value as the difference to an earlier one.

use serde::{Serialize, ser};

use super::PackingError;
use super::alignment::{Alignment, Places, Reference};

/// Writes values, all with the same number of bytes for each number.
pub(crate) struct Writer<'a> {
    bytes: Vec<u8>,
    alignment: Alignment<'a>,
    /// Where the outermost lists are, unless there is a reference.
    places: Option<Places>,
    /// Where the outermost list begins that is being written, and each of its elements.
    list: (u32, Vec<u32>),
    /// The type (an enumeration) whose values are left out.
    left_out: Option<&'static str>,
}

impl<'a> Writer<'a> {
    /// Writes into the bytes what follows the difference to the reference, and leaves out values of a type with
    /// a name.
    pub(crate) fn new(
        bytes: Vec<u8>,
        reference: Option<Reference<'a>>,
        left_out: Option<&'static str>,
    ) -> Self {
        Self {
            bytes,
            alignment: Alignment::new(reference),
            places: reference.is_none().then(Places::default),
            list: (0, Vec::new()),
            left_out,
        }
    }

    /// What was written; without a reference, it may be one for others, with these places.
    pub(crate) fn finish(self) -> (Vec<u8>, Places) {
        (self.bytes, self.places.unwrap_or_default())
    }

    fn put(&mut self, bytes: &[u8]) {
        let earlier = self.alignment.next(bytes.len());
        let (both, more) = bytes.split_at(earlier.len());
        let differences = both.iter().zip(earlier).map(|(now, then)| now ^ then);
        self.bytes.extend(differences);
        self.bytes.extend_from_slice(more);
    }

    fn put_length(&mut self, length: usize) {
        self.put(&(length as u64).to_le_bytes());
    }

    fn put_variant(&mut self, index: u32) {
        self.put(&index.to_le_bytes());
    }

    /// Where the next byte goes. States are far below 4 GB.
    fn place(&self) -> u32 {
        self.bytes.len() as u32
    }

    fn begin_list<'w>(
        &'w mut self,
        length: Option<usize>,
    ) -> Result<ListWriter<'w, 'a>, PackingError> {
        let length = length.ok_or(PackingError::Unsupported("a list of unknown length"))?;
        self.put_length(length);
        let is_outermost = self.alignment.enter_list();
        if is_outermost {
            self.list.0 = self.place();
            self.list.1.clear();
        }
        Ok(ListWriter {
            writer: self,
            index: 0,
            is_outermost,
        })
    }
}

/// Writes the elements of a list.
pub(crate) struct ListWriter<'w, 'a> {
    writer: &'w mut Writer<'a>,
    index: usize,
    is_outermost: bool,
}

impl ListWriter<'_, '_> {
    fn begin_element(&mut self) {
        if !self.is_outermost {
            return;
        }
        self.writer.alignment.enter_element(self.index);
        self.index += 1;
        if self.writer.places.is_some() {
            let place = self.writer.place();
            self.writer.list.1.push(place);
        }
    }

    fn finish(self) {
        self.writer.alignment.leave_list();
        if self.is_outermost {
            let end = self.writer.place();
            let (begin, starts) = &self.writer.list;
            if let Some(places) = &mut self.writer.places {
                places.add(*begin, starts, end);
            }
        }
    }
}

macro_rules! numbers {
    ($($method:ident: $type:ty,)*) => {
        $(fn $method(self, v: $type) -> Result<(), PackingError> {
            self.put(&v.to_le_bytes());
            Ok(())
        })*
    };
}

impl<'w, 'a> ser::Serializer for &'w mut Writer<'a> {
    type Ok = ();
    type Error = PackingError;
    type SerializeSeq = ListWriter<'w, 'a>;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = ListWriter<'w, 'a>;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    numbers! {
        serialize_i8: i8,
        serialize_i16: i16,
        serialize_i32: i32,
        serialize_i64: i64,
        serialize_i128: i128,
        serialize_u8: u8,
        serialize_u16: u16,
        serialize_u32: u32,
        serialize_u64: u64,
        serialize_u128: u128,
        serialize_f32: f32,
        serialize_f64: f64,
    }

    fn is_human_readable(&self) -> bool {
        false
    }

    fn serialize_bool(self, v: bool) -> Result<(), PackingError> {
        self.put(&[u8::from(v)]);
        Ok(())
    }

    fn serialize_char(self, v: char) -> Result<(), PackingError> {
        self.put(&u32::from(v).to_le_bytes());
        Ok(())
    }

    fn serialize_str(self, v: &str) -> Result<(), PackingError> {
        self.serialize_bytes(v.as_bytes())
    }

    fn serialize_bytes(self, v: &[u8]) -> Result<(), PackingError> {
        self.put_length(v.len());
        self.put(v);
        Ok(())
    }

    fn serialize_none(self) -> Result<(), PackingError> {
        self.put(&[0]);
        Ok(())
    }

    fn serialize_some<T: ?Sized + Serialize>(self, value: &T) -> Result<(), PackingError> {
        self.put(&[1]);
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<(), PackingError> {
        Ok(())
    }

    fn serialize_unit_struct(self, _: &'static str) -> Result<(), PackingError> {
        Ok(())
    }

    fn serialize_unit_variant(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
    ) -> Result<(), PackingError> {
        self.put_variant(index);
        Ok(())
    }

    fn serialize_newtype_struct<T: ?Sized + Serialize>(
        self,
        _: &'static str,
        value: &T,
    ) -> Result<(), PackingError> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: ?Sized + Serialize>(
        self,
        name: &'static str,
        index: u32,
        _: &'static str,
        value: &T,
    ) -> Result<(), PackingError> {
        if self.left_out == Some(name) {
            return Ok(());
        }
        self.put_variant(index);
        value.serialize(self)
    }

    fn serialize_seq(self, length: Option<usize>) -> Result<Self::SerializeSeq, PackingError> {
        self.begin_list(length)
    }

    fn serialize_tuple(self, _: usize) -> Result<Self, PackingError> {
        Ok(self)
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Self, PackingError> {
        Ok(self)
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self, PackingError> {
        self.put_variant(index);
        Ok(self)
    }

    fn serialize_map(self, length: Option<usize>) -> Result<Self::SerializeMap, PackingError> {
        self.begin_list(length)
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Self, PackingError> {
        Ok(self)
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self, PackingError> {
        self.put_variant(index);
        Ok(self)
    }
}

impl ser::SerializeSeq for ListWriter<'_, '_> {
    type Ok = ();
    type Error = PackingError;

    fn serialize_element<T: ?Sized + Serialize>(&mut self, value: &T) -> Result<(), PackingError> {
        self.begin_element();
        value.serialize(&mut *self.writer)
    }

    fn end(self) -> Result<(), PackingError> {
        self.finish();
        Ok(())
    }
}

impl ser::SerializeMap for ListWriter<'_, '_> {
    type Ok = ();
    type Error = PackingError;

    fn serialize_key<T: ?Sized + Serialize>(&mut self, key: &T) -> Result<(), PackingError> {
        self.begin_element();
        key.serialize(&mut *self.writer)
    }

    fn serialize_value<T: ?Sized + Serialize>(&mut self, value: &T) -> Result<(), PackingError> {
        value.serialize(&mut *self.writer)
    }

    fn end(self) -> Result<(), PackingError> {
        self.finish();
        Ok(())
    }
}

/// What consists of a fixed number of fields is those, one after the other.
macro_rules! fields {
    ($($trait:ident::$method:ident $(($key:ty))?,)*) => {
        $(impl ser::$trait for &mut Writer<'_> {
            type Ok = ();
            type Error = PackingError;

            fn $method<T: ?Sized + Serialize>(
                &mut self,
                $(_: $key,)?
                value: &T,
            ) -> Result<(), PackingError> {
                value.serialize(&mut **self)
            }

            fn end(self) -> Result<(), PackingError> {
                Ok(())
            }
        })*
    };
}

fields! {
    SerializeTuple::serialize_element,
    SerializeTupleStruct::serialize_field,
    SerializeTupleVariant::serialize_field,
    SerializeStruct::serialize_field(&'static str),
    SerializeStructVariant::serialize_field(&'static str),
}
