//! `typep`.

use super::compare;
use super::complex_numbers;
use super::parse::{is_plain_class, parse};
use super::specifier::{Answers, Bound, RealKind, Stop, Type};
use crate::image::Image;
use crate::object::class_of;
use crate::value::Value;
use crate::value::element_type::ElementType;
use crate::value::function::Body;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// Whether a value is of a type, as far as can be decided without calling a function.
pub enum TypeCheck {
    /// It is.
    Yes,
    /// It is not.
    No,
    /// The value of a call is needed first; [`typep_with`] asks for that call.
    NeedsCall,
}

/// Is the value of the type?
pub fn typep(image: &Image, value: &Value, specifier: &Value) -> Result<TypeCheck, Box<Raise>> {
    match typep_with(image, value, specifier, &mut Answers::default()) {
        Ok(true) => Ok(TypeCheck::Yes),
        Ok(false) => Ok(TypeCheck::No),
        Err(Stop::Call { .. }) => Ok(TypeCheck::NeedsCall),
        Err(Stop::Raise(raise) | Stop::UnknownType(raise)) => Err(raise),
    }
}

/// Like [`typep`], with the values of the calls that were needed before.
pub(crate) fn typep_with(
    image: &Image,
    value: &Value,
    specifier: &Value,
    answers: &mut Answers,
) -> Result<bool, Stop> {
    if let Value::Symbol(name, ..) = specifier
        && let Some(answer) = quickly(image, value, *name)
    {
        return Ok(answer);
    }
    let parsed = parse(image, specifier, answers)?;
    contains(image, &parsed, value, answers)
}

/// The most common types, tested without parsing the specifier.
fn quickly(image: &Image, value: &Value, name: Sym) -> Option<bool> {
    Some(match name {
        known::T => true,
        known::NIL => false,
        known::INTEGER => matches!(value, Value::Int(_) | Value::Big(_)),
        known::NUMBER | known::REAL => match value {
            Value::Int(_) | Value::Big(_) | Value::Ratio(_) => true,
            Value::Single(_) | Value::Double(_) => true,
            _ => return None,
        },
        known::FLOAT => matches!(value, Value::Single(_) | Value::Double(_)),
        known::SINGLE_FLOAT => matches!(value, Value::Single(_)),
        known::DOUBLE_FLOAT => matches!(value, Value::Double(_)),
        known::STRING => matches!(value, Value::Str(_)),
        known::SYMBOL => matches!(value, Value::Symbol(..)),
        known::LIST => value.is_list(),
        known::CONS => matches!(value, Value::Cons(_)),
        known::NULL => value.is_nil(),
        known::FUNCTION => matches!(value, Value::Function(_)),
        known::CHARACTER => matches!(value, Value::Char(_)),
        known::HASH_TABLE => matches!(value, Value::Hash(_)),
        _ if is_plain_class(image, name) => {
            let class = class_of(image, value);
            class.is_within(image.class(name)?)
        }
        _ => return None,
    })
}

/// Is the value in the set?
pub fn contains(
    image: &Image,
    set: &Type,
    value: &Value,
    answers: &mut Answers,
) -> Result<bool, Stop> {
    Ok(match set {
        Type::Any => true,
        Type::Nothing => false,
        Type::Class(class) => {
            let own = class_of(image, value);
            own.precedence
                .borrow()
                .iter()
                .any(|c| std::rc::Rc::ptr_eq(c, class))
        }
        Type::Member(values) => values.iter().any(|v| v.is_eql(value)),
        Type::Real(kind, low, high) => {
            is_of_kind(value, *kind) && is_above(value, low) && is_below(value, high)
        }
        Type::Complex(part) => complex_numbers::has_parts(image, value, part, answers)?,
        Type::And(types) => {
            for each in types {
                if !contains(image, each, value, answers)? {
                    return Ok(false);
                }
            }
            true
        }
        Type::Or(types) => {
            for each in types {
                if contains(image, each, value, answers)? {
                    return Ok(true);
                }
            }
            false
        }
        Type::Not(of) => !contains(image, of, value, answers)?,
        Type::Cons(car, cdr) => match value {
            Value::Cons(cons) => {
                contains(image, car, &cons.car(), answers)?
                    && contains(image, cdr, &cons.cdr(), answers)?
            }
            _ => false,
        },
        Type::Array {
            simple,
            element,
            dimensions,
        } => is_array(value, *simple, *element, dimensions.as_deref()),
        Type::StandardCharacters => matches!(value, Value::Char(c) if is_standard_char(*c)),
        Type::CompiledFunction => {
            matches!(value, Value::Function(f) if !matches!(f.body, Body::Generic(_)))
        }
        Type::Satisfies(function) => answers.ask(function, vec![value.clone()])?.is_true(),
    })
}

fn is_of_kind(value: &Value, kind: RealKind) -> bool {
    match kind {
        RealKind::Integer => matches!(value, Value::Int(_) | Value::Big(_)),
        RealKind::Ratio => matches!(value, Value::Ratio(_)),
        RealKind::Single => matches!(value, Value::Single(_)),
        RealKind::Double => matches!(value, Value::Double(_)),
    }
}

fn is_above(value: &Value, low: &Bound) -> bool {
    match low {
        Bound::None => true,
        Bound::Inclusive(bound) => compare(value, bound).is_some_and(|o| o.is_ge()),
        Bound::Exclusive(bound) => compare(value, bound).is_some_and(|o| o.is_gt()),
    }
}

fn is_below(value: &Value, high: &Bound) -> bool {
    match high {
        Bound::None => true,
        Bound::Inclusive(bound) => compare(value, bound).is_some_and(|o| o.is_le()),
        Bound::Exclusive(bound) => compare(value, bound).is_some_and(|o| o.is_lt()),
    }
}

fn is_array(
    value: &Value,
    simple: bool,
    element: Option<ElementType>,
    dimensions: Option<&[Option<usize>]>,
) -> bool {
    let (own_simple, own_element, sizes) = match value {
        Value::Str(s) => (s.is_simple(), ElementType::Character, vec![s.capacity()]),
        Value::Vector(v) => (v.is_simple(), v.element_type, vec![v.items.len()]),
        Value::Array(a) => (a.is_simple(), a.element_type, a.dimensions.borrow().clone()),
        _ => return false,
    };
    (own_simple || !simple)
        && element.is_none_or(|wanted| wanted == own_element)
        && dimensions.is_none_or(|wanted| {
            wanted.len() == sizes.len()
                && wanted
                    .iter()
                    .zip(&sizes)
                    .all(|(wanted, size)| wanted.is_none_or(|w| w == *size))
        })
}

/// Is the character one of the 96 of the standard?
pub(crate) fn is_standard_char(c: char) -> bool {
    c == '\n' || matches!(c, ' '..='~')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::object::testing;

    fn symbols(names: &[Sym]) -> Value {
        Value::list(names.iter().map(|n| Value::symbol(*n)))
    }

    fn is(image: &Image, value: &Value, specifier: &Value) -> bool {
        matches!(typep(image, value, specifier), Ok(TypeCheck::Yes))
    }

    fn range(name: Sym, bounds: &[Value]) -> Value {
        Value::list_with_tail([Value::symbol(name)], Value::list(bounds.to_vec()))
    }

    #[test]
    fn an_exclusive_bound_excludes_the_number_itself() {
        let image = testing::image();
        let bounds = [Value::Int(0), Value::list([Value::Int(10)])];
        let specifier = range(known::INTEGER, &bounds);
        assert!(is(&image, &Value::Int(9), &specifier));
        assert!(!is(&image, &Value::Int(10), &specifier));
    }

    #[test]
    fn a_byte_of_eight_bits_ends_at_255() {
        let image = testing::image();
        let specifier = range(known::UNSIGNED_BYTE, &[Value::Int(8)]);
        assert!(is(&image, &Value::Int(255), &specifier));
        assert!(!is(&image, &Value::Int(256), &specifier));
        assert!(!is(&image, &Value::Int(-1), &specifier));
    }

    #[test]
    fn conditions_and_builtin_classes_are_types() {
        let image = testing::image();
        let raise = Raise::simple("x");
        let condition = crate::condition::make(&image, &raise).ok().expect("made");
        assert!(is(&image, &condition, &known::ERROR.into()));
        assert!(!is(&image, &condition, &known::WARNING.into()));
        assert!(is(&image, &Value::string("s"), &known::SEQUENCE.into()));
        assert!(is(&image, &Value::NIL, &known::SYMBOL.into()));
    }

    #[test]
    fn satisfies_asks_for_a_call() {
        let image = testing::image();
        let specifier = symbols(&[known::SATISFIES, known::NULL]);
        let unasked = typep(&image, &Value::Int(1), &specifier);
        assert!(matches!(unasked, Ok(TypeCheck::NeedsCall)));
        let mut answers = Answers::default();
        answers.add(Value::T);
        let answer = typep_with(&image, &Value::Int(1), &specifier, &mut answers);
        assert!(matches!(answer, Ok(true)));
    }

    #[test]
    fn a_vector_of_given_length_is_a_type() {
        let image = testing::image();
        let value = Value::vector(vec![Value::Int(1), Value::Int(2)]);
        let any = range(known::VECTOR, &[known::TIMES.into(), Value::Int(2)]);
        let three = range(known::VECTOR, &[Value::T, Value::Int(3)]);
        assert!(is(&image, &value, &any));
        assert!(!is(&image, &value, &three));
    }
}
