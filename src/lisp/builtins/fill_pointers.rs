//! Vectors with fill pointers: pushing and popping.

use crate::builtin::Builtin;
use crate::guard::reserve;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::cycles;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{character, element, index};

type Outcome = Result<Value, Box<Raise>>;

/// The fill pointer of a vector; an error if it has none.
fn pointer_of(vector: &Value) -> Result<usize, Box<Raise>> {
    let pointer = match vector {
        Value::Vector(v) => v.fill_pointer.get(),
        Value::Str(s) => s.has_fill_pointer.get().then(|| s.len()),
        _ => None,
    };
    pointer.ok_or_else(|| {
        let not_simple = Value::list([known::NOT.into(), known::SIMPLE_ARRAY.into()]);
        Raise::type_error(
            vector,
            Value::list([known::AND.into(), known::VECTOR.into(), not_simple]),
        )
    })
}

/// Has the array a fill pointer?
///
/// `(array-has-fill-pointer-p #(1))` => `NIL`
#[builtin("ARRAY-HAS-FILL-POINTER-P")]
fn has_fill_pointer(array: &Value) -> Outcome {
    match array {
        Value::Array(_) => Ok(Value::NIL),
        Value::Vector(_) | Value::Str(_) => Ok(Value::bool(pointer_of(array).is_ok())),
        other => Err(Raise::type_error(other, known::ARRAY)),
    }
}

/// The number of active elements.
///
/// `(fill-pointer (make-array 3 :fill-pointer 2))` => `2`
#[builtin]
fn fill_pointer(vector: &Value) -> Outcome {
    pointer_of(vector).map(Value::from)
}

/// Sets the number of active elements.
#[builtin("FILL-POINTER")]
fn set_fill_pointer(value: &Value, vector: &Value) -> Outcome {
    pointer_of(vector)?;
    let pointer = index(value)?;
    let (done, size) = match vector {
        Value::Vector(v) => {
            let size = v.items.len();
            if pointer <= size {
                v.fill_pointer.set(Some(pointer));
            }
            (pointer <= size, size)
        }
        Value::Str(s) => (s.set_fill_pointer(pointer), s.capacity()),
        _ => (false, 0),
    };
    if done {
        Ok(value.clone())
    } else {
        Err(Raise::new(
            known::SIMPLE_TYPE_ERROR,
            format!("The fill pointer {pointer} is beyond the vector's size {size}."),
        )
        .with(known::K_DATUM, value.clone())
        .with(
            known::K_EXPECTED_TYPE,
            Value::list([known::INTEGER.into(), Value::Int(0), size.into()]),
        ))
    }
}

/// Adds an element behind the active ones; its index, or `NIL` if the vector is full.
///
/// `(vector-push 'a (make-array 2 :fill-pointer 0))` => `0`
#[builtin]
fn vector_push(element: &Value, vector: &Value) -> Outcome {
    push(element, vector, None)
}

/// Adds an element behind the active ones, making room if need be; its index.
///
/// `(vector-push-extend 'a (make-array 0 :fill-pointer 0 :adjustable t))` => `0`
#[builtin]
fn vector_push_extend(element: &Value, vector: &Value, #[default(1)] extension: usize) -> Outcome {
    push(element, vector, Some(extension.max(1)))
}

/// Adds an element; returns its index, or `NIL` if there is no room and the vector must not grow.
fn push(value: &Value, vector: &Value, extension: Option<usize>) -> Outcome {
    let pointer = pointer_of(vector)?;
    match vector {
        Value::Vector(v) => {
            let value = element(v, value.clone())?;
            cycles::note(v, &value);
            let size = v.items.len();
            if pointer >= size {
                let Some(extension) = extension else {
                    return Ok(Value::NIL);
                };
                let filler = super::array_make::filler(v.element_type);
                let more = extension.max(size);
                reserve(more.saturating_mul(size_of::<Value>()));
                v.items.resize(size.saturating_add(more), filler);
            }
            v.set(pointer, value);
            v.fill_pointer.set(Some(pointer + 1));
        }
        Value::Str(s) => {
            let c = character(value)?;
            if pointer >= s.capacity() && extension.is_none() {
                return Ok(Value::NIL);
            }
            s.push(c);
        }
        _ => {}
    }
    Ok(pointer.into())
}

/// Takes the last active element.
///
/// `(vector-pop (make-array 1 :fill-pointer 1 :initial-element 'x))` => `X`
#[builtin]
fn vector_pop(vector: &Value) -> Outcome {
    let Some(last) = pointer_of(vector)?.checked_sub(1) else {
        return Err(Raise::simple("There is nothing left to pop."));
    };
    match vector {
        Value::Vector(v) => {
            v.fill_pointer.set(Some(last));
            Ok(v.get(last).unwrap_or(Value::NIL))
        }
        Value::Str(s) => Ok(s.pop().map_or(Value::NIL, Value::Char)),
        _ => Ok(Value::NIL),
    }
}

/// Vectors with fill pointers.
pub(crate) static TABLE: &[Builtin] = builtins![
    has_fill_pointer,
    fill_pointer,
    vector_push,
    vector_push_extend,
    vector_pop,
];

/// Places for `setf`; the new value is the first argument.
pub(crate) static SETTERS: &[Builtin] = builtins![set_fill_pointer,];
