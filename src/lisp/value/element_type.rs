//! The element types that arrays have: those to which all other types are upgraded.

use num_traits::ToPrimitive;

use super::Value;
use super::symbol::{Sym, known};

/// An element type that arrays can have.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ElementType {
    /// Anything.
    T,
    /// Nothing.
    Nil,
    /// `BIT`.
    Bit,
    /// `(UNSIGNED-BYTE n)`.
    Unsigned(u8),
    /// `(SIGNED-BYTE n)`.
    Signed(u8),
    /// `FIXNUM`.
    Fixnum,
    /// `SINGLE-FLOAT`.
    Single,
    /// `DOUBLE-FLOAT`.
    Double,
    /// `CHARACTER`; one-dimensional arrays of this type are strings.
    Character,
}

use ElementType::{Bit, Character, Double, Fixnum, Nil, Signed, Single, T, Unsigned};

/// Number of bits of a fixnum without its sign.
const FIXNUM_BITS: u8 = 62;

/// The types of integers. Each comes after those that it contains, and the intersection of any two is
/// among them: so, of two types of which one contains the other, the upgraded types do so, too.
const INTEGERS: [ElementType; 17] = [
    Bit,
    Unsigned(2),
    Unsigned(4),
    Unsigned(7),
    Unsigned(8),
    Signed(8),
    Unsigned(15),
    Unsigned(16),
    Signed(16),
    Unsigned(31),
    Unsigned(32),
    Signed(32),
    Unsigned(FIXNUM_BITS),
    Fixnum,
    Unsigned(63),
    Unsigned(64),
    Signed(64),
];

impl ElementType {
    /// All types but `T`, each after those that it contains.
    pub(crate) fn specialized() -> impl Iterator<Item = ElementType> {
        let others = [Single, Double, Character];
        std::iter::once(Nil).chain(INTEGERS).chain(others)
    }

    /// The smallest type that has all integers from a lowest to a highest one; `T` if none has.
    pub(crate) fn of_integers(low: &Value, high: &Value) -> ElementType {
        match (whole(low), whole(high)) {
            (Some(low), Some(high)) => INTEGERS
                .into_iter()
                .find(|kind| kind.has_integer(low) && kind.has_integer(high))
                .unwrap_or(T),
            _ => T,
        }
    }

    /// `(UNSIGNED-BYTE n)` or the smallest type that contains it.
    pub(crate) fn of_unsigned_bytes(bits: i64) -> ElementType {
        INTEGERS
            .into_iter()
            .find(|kind| match kind {
                Bit => bits <= 1,
                Unsigned(own) => bits <= i64::from(*own),
                _ => false,
            })
            .unwrap_or(T)
    }

    /// `(SIGNED-BYTE n)` or the smallest type that contains it.
    pub(crate) fn of_signed_bytes(bits: i64) -> ElementType {
        INTEGERS
            .into_iter()
            .find(|kind| match kind {
                Signed(own) => bits <= i64::from(*own),
                Fixnum => bits <= i64::from(FIXNUM_BITS) + 1,
                _ => false,
            })
            .unwrap_or(T)
    }

    fn has_integer(self, n: i128) -> bool {
        match self {
            Bit => (0..=1).contains(&n),
            Unsigned(bits) => (0..1_i128 << bits).contains(&n),
            Signed(bits) => (-(1_i128 << (bits - 1))..1_i128 << (bits - 1)).contains(&n),
            Fixnum => (-(1_i128 << FIXNUM_BITS)..1_i128 << FIXNUM_BITS).contains(&n),
            _ => false,
        }
    }

    /// Can an array of this type hold the value?
    pub fn holds(self, value: &Value) -> bool {
        match self {
            T => true,
            Nil => false,
            Single => matches!(value, Value::Single(_)),
            Double => matches!(value, Value::Double(_)),
            Character => matches!(value, Value::Char(_)),
            Bit => matches!(value, Value::Int(0 | 1)),
            Unsigned(bits @ ..=FIXNUM_BITS) => matches!(value, Value::Int(n) if n >> bits == 0),
            integers => whole(value).is_some_and(|n| integers.has_integer(n)),
        }
    }

    /// The element that arrays hold if they are made without any.
    pub(crate) fn default_element(self) -> Value {
        match self {
            Single => Value::Single(0.0),
            Double => Value::Double(0.0),
            Character => Value::Char('\0'),
            _ => Value::Int(0),
        }
    }

    /// The type specifier.
    pub(crate) fn specifier(self) -> Value {
        let bytes = |name: Sym, bits: u8| Value::list([name.into(), Value::Int(bits.into())]);
        match self {
            T => Value::T,
            Nil => Value::NIL,
            Bit => known::BIT.into(),
            Unsigned(bits) => bytes(known::UNSIGNED_BYTE, bits),
            Signed(bits) => bytes(known::SIGNED_BYTE, bits),
            Fixnum => known::FIXNUM.into(),
            Single => known::SINGLE_FLOAT.into(),
            Double => known::DOUBLE_FLOAT.into(),
            Character => known::CHARACTER.into(),
        }
    }
}

impl std::fmt::Display for ElementType {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            T => f.write_str("T"),
            Nil => f.write_str("NIL"),
            Bit => f.write_str("BIT"),
            Unsigned(bits) => write!(f, "(UNSIGNED-BYTE {bits})"),
            Signed(bits) => write!(f, "(SIGNED-BYTE {bits})"),
            Fixnum => f.write_str("FIXNUM"),
            Single => f.write_str("SINGLE-FLOAT"),
            Double => f.write_str("DOUBLE-FLOAT"),
            Character => f.write_str("CHARACTER"),
        }
    }
}

/// An integer, unless it is too large for any type but `T`.
fn whole(value: &Value) -> Option<i128> {
    match value {
        Value::Int(n) => Some(i128::from(*n)),
        Value::Big(n) => n.to_i128(),
        _ => None,
    }
}
