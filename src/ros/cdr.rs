//! The encoding of messages on the wire: CDR, in which every number stands at a multiple of its size.

use thiserror::Error;

use crate::layout::{Field, FieldType, Layouts, Multiplicity, Scalar};
use crate::value::Value;

/// The order of the bytes of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ByteOrder {
    /// The lowest first.
    Little,
    /// The highest first.
    Big,
}

/// Why a message cannot be encoded or decoded.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum CdrError {
    /// The layouts do not have the message.
    #[error("there is no message {0}")]
    Unknown(String),
    /// A field holds something else.
    #[error("{field} should be {wanted}")]
    Unfit {
        /// The field.
        field: String,
        /// What it should be.
        wanted: String,
    },
    /// The message ends too early.
    #[error("the message ends in the midst of {0}")]
    Short(String),
}

/// The little-endian bytes of a message, without the header of the encapsulation. What the value leaves out is
/// zero, empty or false; what the distribution has no field for is left out.
pub fn encode(layouts: &Layouts, message: &str, value: &Value) -> Result<Vec<u8>, CdrError> {
    let mut writer = Writer {
        layouts,
        bytes: Vec::new(),
    };
    writer.message(message, value)?;
    Ok(writer.bytes)
}

/// The message in bytes, without the header of the encapsulation. Texts that are no UTF-8 are read as far as
/// they are.
pub fn decode(
    layouts: &Layouts,
    message: &str,
    bytes: &[u8],
    order: ByteOrder,
) -> Result<Value, CdrError> {
    let mut reader = Reader {
        layouts,
        bytes,
        at: 0,
        order,
    };
    reader.message(message)
}

struct Writer<'a> {
    layouts: &'a Layouts,
    bytes: Vec<u8>,
}

/// What stands for a field that a value leaves out.
const NOTHING: Value = Value::Record(Vec::new());

impl Writer<'_> {
    fn message(&mut self, message: &str, value: &Value) -> Result<(), CdrError> {
        let fields = fields(self.layouts, message)?;
        if !matches!(value, Value::Record(_)) {
            return Err(unfit(message, format!("a {message}")));
        }
        for field in fields {
            self.field(field, value.get(&field.name))?;
        }
        if fields.is_empty() {
            self.bytes.push(0);
        }
        Ok(())
    }

    fn field(&mut self, field: &Field, value: Option<&Value>) -> Result<(), CdrError> {
        match (field.multiplicity, value) {
            (Multiplicity::One, value) => self.one(field, value),
            (Multiplicity::Array(length), None) => {
                (0..length).try_for_each(|_| self.one(field, None))
            }
            (Multiplicity::Sequence, None) => self.length(field, 0),
            (multiplicity, Some(value)) => {
                let length = match (value, is_byte(&field.kind)) {
                    (Value::Bytes(bytes), true) => bytes.len(),
                    (Value::List(items), _) => items.len(),
                    _ => return Err(unfit(&field.name, "a list".to_owned())),
                };
                match multiplicity {
                    Multiplicity::Array(wanted) if wanted != length => {
                        return Err(unfit(&field.name, format!("{wanted} of its kind")));
                    }
                    Multiplicity::Array(_) => {}
                    _ => self.length(field, length)?,
                }
                match value {
                    Value::Bytes(bytes) => self.bytes.extend_from_slice(bytes),
                    Value::List(items) => {
                        for item in items {
                            self.one(field, Some(item))?;
                        }
                    }
                    _ => {}
                }
                Ok(())
            }
        }
    }

    fn one(&mut self, field: &Field, value: Option<&Value>) -> Result<(), CdrError> {
        match &field.kind {
            FieldType::Message(message) => self.message(message, value.unwrap_or(&NOTHING)),
            FieldType::Text => match value {
                None => self.text(field, ""),
                Some(Value::Text(text)) => self.text(field, text),
                Some(_) => Err(unfit(&field.name, "a text".to_owned())),
            },
            FieldType::Scalar(scalar) => self.scalar(field, *scalar, value),
        }
    }

    fn scalar(
        &mut self,
        field: &Field,
        scalar: Scalar,
        value: Option<&Value>,
    ) -> Result<(), CdrError> {
        self.align(scalar.bytes());
        match (scalar, value) {
            (scalar, None) => {
                let length = self.bytes.len() + scalar.bytes();
                self.bytes.resize(length, 0);
            }
            (Scalar::Bool, Some(Value::Bool(value))) => self.bytes.push(u8::from(*value)),
            (Scalar::Double, Some(Value::Float(number))) => {
                self.bytes.extend_from_slice(&number.to_le_bytes());
            }
            (Scalar::Single, Some(Value::Float(number))) => {
                let number = *number as f32;
                self.bytes.extend_from_slice(&number.to_le_bytes());
            }
            (Scalar::Integer { bytes, signed }, Some(Value::Integer(number))) => {
                let bits = 8 * bytes as u32;
                let (least, greatest) = match signed {
                    true => (-(1i128 << (bits - 1)), (1i128 << (bits - 1)) - 1),
                    false => (0, (1i128 << bits) - 1),
                };
                if !(least..=greatest).contains(&i128::from(*number)) {
                    return Err(unfit(
                        &field.name,
                        format!("a whole number from {least} to {greatest}"),
                    ));
                }
                let number = number.to_le_bytes();
                self.bytes
                    .extend_from_slice(number.get(..bytes).unwrap_or(&number));
            }
            (scalar, Some(_)) => return Err(unfit(&field.name, kind_of(scalar).to_owned())),
        }
        Ok(())
    }

    fn text(&mut self, field: &Field, text: &str) -> Result<(), CdrError> {
        // A text ends with a byte 0, so it contains none.
        let text: String = text.chars().filter(|c| *c != '\0').collect();
        self.length(field, text.len() + 1)?;
        self.bytes.extend_from_slice(text.as_bytes());
        self.bytes.push(0);
        Ok(())
    }

    fn length(&mut self, field: &Field, length: usize) -> Result<(), CdrError> {
        let length = u32::try_from(length);
        let length = length.map_err(|_| unfit(&field.name, "shorter".to_owned()))?;
        self.align(4);
        self.bytes.extend_from_slice(&length.to_le_bytes());
        Ok(())
    }

    fn align(&mut self, size: usize) {
        self.bytes
            .resize(self.bytes.len().next_multiple_of(size), 0);
    }
}

struct Reader<'a> {
    layouts: &'a Layouts,
    bytes: &'a [u8],
    at: usize,
    order: ByteOrder,
}

impl<'a> Reader<'a> {
    fn message(&mut self, message: &str) -> Result<Value, CdrError> {
        let layouts = self.layouts;
        let fields = fields(layouts, message)?;
        let mut values = Vec::with_capacity(fields.len());
        for field in fields {
            values.push((field.name.to_string().into(), self.field(field)?));
        }
        if fields.is_empty() {
            self.take(message, 1)?;
        }
        Ok(Value::Record(values))
    }

    fn field(&mut self, field: &Field) -> Result<Value, CdrError> {
        let length = match field.multiplicity {
            Multiplicity::One => return self.one(field),
            Multiplicity::Array(length) => length,
            Multiplicity::Sequence => self.length(field)?,
        };
        if is_byte(&field.kind) {
            return Ok(Value::Bytes(self.take(&field.name, length)?.to_vec()));
        }
        // Each takes at least a byte, so a length that is too great ends soon.
        let mut items = Vec::new();
        for _ in 0..length {
            items.push(self.one(field)?);
        }
        Ok(Value::List(items))
    }

    fn one(&mut self, field: &Field) -> Result<Value, CdrError> {
        match &field.kind {
            FieldType::Message(message) => self.message(message),
            FieldType::Text => {
                let length = self.length(field)?;
                let bytes = self.take(&field.name, length)?;
                let bytes = bytes.strip_suffix(&[0]).unwrap_or(bytes);
                Ok(Value::Text(String::from_utf8_lossy(bytes).into_owned()))
            }
            FieldType::Scalar(scalar) => self.scalar(field, *scalar),
        }
    }

    fn scalar(&mut self, field: &Field, scalar: Scalar) -> Result<Value, CdrError> {
        let size = scalar.bytes();
        let bits = self.bits(&field.name, size)?;
        Ok(match scalar {
            Scalar::Bool => Value::Bool(bits != 0),
            Scalar::Double => Value::Float(f64::from_bits(bits)),
            Scalar::Single => Value::Float(f64::from(f32::from_bits(bits as u32))),
            Scalar::Integer { signed, .. } => {
                let spare = 64 - 8 * size as u32;
                Value::Integer(match signed {
                    true => ((bits << spare) as i64) >> spare,
                    false => bits as i64,
                })
            }
        })
    }

    fn length(&mut self, field: &Field) -> Result<usize, CdrError> {
        let length = self.bits(&field.name, 4)?;
        usize::try_from(length).map_err(|_| CdrError::Short(field.name.to_string()))
    }

    /// A number of so many bytes, which stands at a multiple of its size.
    fn bits(&mut self, field: &str, size: usize) -> Result<u64, CdrError> {
        self.at = self.at.next_multiple_of(size);
        let order = self.order;
        let bytes = self.take(field, size)?;
        let join = |bits: u64, byte: &u8| bits << 8 | u64::from(*byte);
        Ok(match order {
            ByteOrder::Little => bytes.iter().rev().fold(0, join),
            ByteOrder::Big => bytes.iter().fold(0, join),
        })
    }

    fn take(&mut self, field: &str, length: usize) -> Result<&'a [u8], CdrError> {
        let end = self.at.checked_add(length);
        let bytes = end.and_then(|end| self.bytes.get(self.at..end));
        let bytes = bytes.ok_or_else(|| CdrError::Short(field.to_owned()))?;
        self.at += length;
        Ok(bytes)
    }
}

fn fields<'a>(layouts: &'a Layouts, message: &str) -> Result<&'a [Field], CdrError> {
    let fields = layouts.fields(message);
    fields.ok_or_else(|| CdrError::Unknown(message.to_owned()))
}

fn unfit(field: &str, wanted: String) -> CdrError {
    CdrError::Unfit {
        field: field.to_owned(),
        wanted,
    }
}

fn is_byte(kind: &FieldType) -> bool {
    let byte = Scalar::Integer {
        bytes: 1,
        signed: false,
    };
    *kind == FieldType::Scalar(byte)
}

fn kind_of(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::Bool => "true or false",
        Scalar::Integer { .. } => "a whole number",
        Scalar::Single | Scalar::Double => "a number",
    }
}
