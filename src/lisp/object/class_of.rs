//! The class of a value.

use crate::value::element_type::ElementType;
use std::rc::Rc;

use crate::image::Image;
use crate::value::Value;
use crate::value::class::{Class, ClassKind};
use crate::value::function::Body;
use crate::value::known;
use crate::value::symbol::Sym;

/// Integers of at most this many bits are fixnums, as in SBCL on 64-bit machines.
const FIXNUM_BITS: u32 = 62;

/// Is the integer a fixnum?
pub(crate) fn is_fixnum(n: i64) -> bool {
    let limit = 1_i64 << FIXNUM_BITS;
    (-limit..limit).contains(&n)
}

/// The class of a value.
pub fn class_of(image: &Image, value: &Value) -> Rc<Class> {
    if let Value::Instance(instance) = value {
        return instance.class();
    }
    let name = builtin_class_name(image, value);
    match image.class(name).or_else(|| image.class(known::T)) {
        Some(class) => class.clone(),
        // Happens only in an image whose standard classes are not defined yet.
        None => Rc::new(Class::new(known::T, ClassKind::Builtin)),
    }
}

/// The name of the class of a value that is not an instance. A foreign value names its own.
pub(crate) fn builtin_class_name(image: &Image, value: &Value) -> Sym {
    match value {
        Value::Symbol(known::NIL, ..) => known::NULL,
        Value::Symbol(sym, ..) if image.is_keyword(*sym) => known::KEYWORD,
        Value::Symbol(..) => known::SYMBOL,
        Value::Int(n) if is_fixnum(*n) => known::FIXNUM,
        Value::Int(_) | Value::Big(_) => known::BIGNUM,
        Value::Ratio(_) => known::RATIO,
        Value::Single(_) => known::SINGLE_FLOAT,
        Value::Double(_) => known::DOUBLE_FLOAT,
        Value::Char(_) => known::CHARACTER,
        Value::Cons(_) => known::CONS,
        Value::Str(s) if s.is_simple() => known::SIMPLE_STRING,
        Value::Str(_) => known::STRING,
        Value::Vector(v) => match (v.element_type, v.is_simple()) {
            (ElementType::Bit, true) => known::SIMPLE_BIT_VECTOR,
            (ElementType::Bit, false) => known::BIT_VECTOR,
            (ElementType::T, true) => known::SIMPLE_VECTOR,
            _ => known::VECTOR,
        },
        Value::Array(a) if a.is_simple() => known::SIMPLE_ARRAY,
        Value::Array(_) => known::ARRAY,
        Value::Function(f) => match f.body {
            Body::Generic(_) => known::STANDARD_GENERIC_FUNCTION,
            _ => known::FUNCTION,
        },
        Value::Hash(_) => known::HASH_TABLE,
        Value::Instance(instance) => instance.class.borrow().name,
        Value::Class(class) => metaclass_name(class),
        Value::Package(_) => known::PACKAGE,
        Value::Stream(stream) => stream.class,
        Value::Foreign(foreign) => foreign.object().type_symbol(),
        // Internal values, which user code never has.
        Value::Cell(_) | Value::Multiple(_) | Value::Unbound => known::T,
    }
}

/// The name of the class of a class.
pub(crate) fn metaclass_name(class: &Class) -> Sym {
    match class.kind {
        ClassKind::Builtin => known::BUILT_IN_CLASS,
        ClassKind::Standard => known::STANDARD_CLASS,
        ClassKind::Structure => known::STRUCTURE_CLASS,
        ClassKind::Condition => known::CONDITION_CLASS,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::object::testing;

    #[test]
    fn nil_is_of_class_null_which_is_a_symbol_and_a_list() {
        let image = testing::image();
        let class = class_of(&image, &Value::NIL);
        let order = class.precedence.borrow();
        let names: Vec<&str> = order.iter().map(|c| image.name(c.name)).collect();
        assert_eq!(names, ["NULL", "SYMBOL", "LIST", "SEQUENCE", "T"]);
    }

    #[test]
    fn integers_beyond_62_bits_are_bignums() {
        assert!(is_fixnum((1 << 62) - 1));
        assert!(!is_fixnum(1 << 62));
        assert!(is_fixnum(-(1 << 62)));
    }
}
