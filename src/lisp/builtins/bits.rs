//! Bit arrays: the logical operations on all bits.

use crate::value::element_type::ElementType;
use std::rc::Rc;

use super::array_make;
use super::arrays::{bit_array_type, dimensions, element_type};
use crate::builtin::Builtin;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::array::Array;
use crate::value::known;
use crate::value::raise::Raise;

type Outcome = Result<Value, Box<Raise>>;

fn bits(array: &Value) -> Result<Vec<bool>, Box<Raise>> {
    let to_bits = |items: &[Value]| -> Vec<bool> {
        items.iter().map(|v| matches!(v, Value::Int(1))).collect()
    };
    if element_type(array)? != ElementType::Bit {
        return Err(Raise::type_error(array, bit_array_type()));
    }
    Ok(match array {
        Value::Vector(v) => to_bits(&v.to_vec()),
        Value::Array(a) => to_bits(&a.items.to_vec()),
        _ => Vec::new(),
    })
}

/// Puts the bits where the optional result argument says: `NIL` makes an array, `T`
/// changes the first operand.
fn deliver(operand: &Value, result: Option<&Value>, bits: &[bool]) -> Outcome {
    let items: Vec<Value> = bits.iter().map(|b| Value::Int(i64::from(*b))).collect();
    let target = match result {
        None | Some(Value::Symbol(known::NIL, ..)) => {
            if let Value::Array(a) = operand {
                let dimensions = a.dimensions.borrow().clone();
                return Ok(Value::Array(Rc::new(Array::new(
                    ElementType::Bit,
                    dimensions,
                    items,
                ))));
            }
            return array_make::vector(ElementType::Bit, items, None, false);
        }
        Some(Value::Symbol(known::T, ..)) => operand,
        Some(target) => target,
    };
    self::bits(target)?;
    same_shape(operand, target)?;
    let places = match target {
        Value::Vector(v) => &v.items,
        Value::Array(a) => &a.items,
        other => return Err(Raise::type_error(other, bit_array_type())),
    };
    for (index, item) in items.into_iter().enumerate() {
        places.set(index, item);
    }
    Ok(target.clone())
}

fn same_shape(a: &Value, b: &Value) -> Result<(), Box<Raise>> {
    if dimensions(a)? == dimensions(b)? {
        Ok(())
    } else {
        Err(Raise::simple("The bit arrays have different dimensions."))
    }
}

fn combine(
    bits_1: &Value,
    bits_2: &Value,
    result: Option<&Value>,
    operation: impl Fn(bool, bool) -> bool,
) -> Outcome {
    let (a, b) = (bits(bits_1)?, bits(bits_2)?);
    same_shape(bits_1, bits_2)?;
    let combined: Vec<bool> = a.into_iter().zip(b).map(|(a, b)| operation(a, b)).collect();
    deliver(bits_1, result, &combined)
}

/// The inverse of all bits.
///
/// `(bit-not #*1100)` => `#*0011`
#[builtin(_, "bits &optional result")]
fn bit_not(array: &Value, result: Option<&Value>) -> Outcome {
    let inverse: Vec<bool> = bits(array)?.into_iter().map(|b| !b).collect();
    deliver(array, result, &inverse)
}

/// Inversion.
pub(crate) static TABLE: &[Builtin] = builtins![bit_not];

macro_rules! operations {
    ($($function:ident |$a:ident, $b:ident| $result:expr, $doc:literal $example:literal;)*) => {
        $(
            #[doc = $doc]
            #[doc = ""]
            #[doc = $example]
            #[builtin]
            fn $function(bits_1: &Value, bits_2: &Value, result: Option<&Value>) -> Outcome {
                combine(bits_1, bits_2, result, |$a, $b| $result)
            }
        )*

        /// Logical operations on two bit arrays.
        pub(crate) static OPERATIONS: &[Builtin] = builtins![$($function),*];
    };
}

operations! {
    bit_and |a, b| a & b, "Bits that are set in both." "`(bit-and #*1100 #*1010)` => `#*1000`";
    bit_ior |a, b| a | b, "Bits that are set in one or both." "`(bit-ior #*1100 #*1010)` => `#*1110`";
    bit_xor |a, b| a ^ b, "Bits that are set in exactly one." "`(bit-xor #*1100 #*1010)` => `#*0110`";
    bit_eqv |a, b| a == b, "Bits that are the same in both." "`(bit-eqv #*1100 #*1010)` => `#*1001`";
    bit_nand |a, b| !(a & b), "The inverse of `bit-and`." "`(bit-nand #*1100 #*1010)` => `#*0111`";
    bit_nor |a, b| !(a | b), "The inverse of `bit-ior`." "`(bit-nor #*1100 #*1010)` => `#*0001`";
    bit_andc1 |a, b| !a & b, "Bits that are set in the second only." "`(bit-andc1 #*1100 #*1010)` => `#*0010`";
    bit_andc2 |a, b| a & !b, "Bits that are set in the first only." "`(bit-andc2 #*1100 #*1010)` => `#*0100`";
    bit_orc1 |a, b| !a | b, "Bits that are clear in the first or set in the second." "`(bit-orc1 #*1100 #*1010)` => `#*1011`";
    bit_orc2 |a, b| a | !b, "Bits that are set in the first or clear in the second." "`(bit-orc2 #*1100 #*1010)` => `#*1101`";
}
