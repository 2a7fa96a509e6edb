//! Messages as values.

use std::borrow::Cow;

/// A message or a part of one. What a record leaves out is zero, empty or false on the wire.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A truth value.
    Bool(bool),
    /// A whole number of any width.
    Integer(i64),
    /// A number of any precision.
    Float(f64),
    /// A text.
    Text(String),
    /// Bytes.
    Bytes(Vec<u8>),
    /// A sequence, or an array.
    List(Vec<Value>),
    /// A message: names of fields and what they hold.
    Record(Vec<(Cow<'static, str>, Value)>),
}

impl Value {
    /// A message of fields.
    pub fn record<const N: usize>(fields: [(&'static str, Value); N]) -> Self {
        let fields = fields.into_iter();
        Self::Record(fields.map(|(name, value)| (name.into(), value)).collect())
    }

    /// A sequence.
    pub fn list(items: impl IntoIterator<Item = Value>) -> Self {
        Self::List(items.into_iter().collect())
    }

    /// A sequence of numbers.
    pub fn floats(items: impl IntoIterator<Item = f64>) -> Self {
        Self::list(items.into_iter().map(Self::Float))
    }

    /// A sequence of texts.
    pub fn texts<T: Into<String>>(items: impl IntoIterator<Item = T>) -> Self {
        Self::list(items.into_iter().map(|text| Self::Text(text.into())))
    }

    /// What a field of a message holds.
    pub fn get(&self, name: &str) -> Option<&Value> {
        match self {
            Self::Record(fields) => {
                let mut fields = fields.iter();
                fields.find(|(known, _)| known == name).map(|(_, v)| v)
            }
            _ => None,
        }
    }

    /// What a field of a field of … a message holds.
    pub fn at(&self, path: &[&str]) -> Option<&Value> {
        path.iter().try_fold(self, |value, name| value.get(name))
    }

    /// A number, whole or not.
    pub fn as_float(&self) -> Option<f64> {
        match self {
            Self::Float(number) => Some(*number),
            Self::Integer(number) => Some(*number as f64),
            _ => None,
        }
    }

    /// A whole number.
    pub fn as_integer(&self) -> Option<i64> {
        match self {
            Self::Integer(number) => Some(*number),
            _ => None,
        }
    }

    /// A text.
    pub fn as_text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Bytes.
    pub fn as_bytes(&self) -> Option<&[u8]> {
        match self {
            Self::Bytes(bytes) => Some(bytes),
            _ => None,
        }
    }

    /// A sequence.
    pub fn as_list(&self) -> Option<&[Value]> {
        match self {
            Self::List(items) => Some(items),
            _ => None,
        }
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Float(number)
    }
}

impl From<i64> for Value {
    fn from(number: i64) -> Self {
        Self::Integer(number)
    }
}

impl From<bool> for Value {
    fn from(value: bool) -> Self {
        Self::Bool(value)
    }
}
