//! Vectors with fill pointers: pushing and popping.

use crate::builtin::{Builtin, pure};
use crate::image::Image;
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

fn has_fill_pointer(_: &mut Image, args: &[Value]) -> Outcome {
    match &args[0] {
        Value::Array(_) => Ok(Value::NIL),
        Value::Vector(_) | Value::Str(_) => Ok(Value::bool(pointer_of(&args[0]).is_ok())),
        other => Err(Raise::type_error(other, known::ARRAY)),
    }
}

fn fill_pointer(_: &mut Image, args: &[Value]) -> Outcome {
    pointer_of(&args[0]).map(Value::from)
}

fn set_fill_pointer(_: &mut Image, args: &[Value]) -> Outcome {
    let vector = &args[1];
    pointer_of(vector)?;
    let pointer = index(&args[0])?;
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
        Ok(args[0].clone())
    } else {
        Err(Raise::new(
            known::SIMPLE_TYPE_ERROR,
            format!("The fill pointer {pointer} is beyond the vector's size {size}."),
        )
        .with(known::K_DATUM, args[0].clone())
        .with(
            known::K_EXPECTED_TYPE,
            Value::list([known::INTEGER.into(), Value::Int(0), size.into()]),
        ))
    }
}

fn vector_push(_: &mut Image, args: &[Value]) -> Outcome {
    push(&args[0], &args[1], None)
}

fn vector_push_extend(_: &mut Image, args: &[Value]) -> Outcome {
    let extension = args.get(2).map_or(Ok(1), index)?;
    push(&args[0], &args[1], Some(extension.max(1)))
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
                v.items.resize(size + extension.max(size), filler);
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

fn vector_pop(_: &mut Image, args: &[Value]) -> Outcome {
    let Some(last) = pointer_of(&args[0])?.checked_sub(1) else {
        return Err(Raise::simple("There is nothing left to pop."));
    };
    match &args[0] {
        Value::Vector(v) => {
            v.fill_pointer.set(Some(last));
            Ok(v.get(last).unwrap_or(Value::NIL))
        }
        Value::Str(s) => Ok(s.pop().map_or(Value::NIL, Value::Char)),
        _ => Ok(Value::NIL),
    }
}

/// Vectors with fill pointers.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "ARRAY-HAS-FILL-POINTER-P",
        "array",
        "Has the array a fill pointer?",
        &["(array-has-fill-pointer-p #(1)) => NIL"],
        has_fill_pointer,
    ),
    pure(
        "FILL-POINTER",
        "vector",
        "The number of active elements.",
        &["(fill-pointer (make-array 3 :fill-pointer 2)) => 2"],
        fill_pointer,
    ),
    pure(
        "VECTOR-PUSH",
        "element vector",
        "Adds an element behind the active ones; its index, or `NIL` if the vector is full.",
        &["(vector-push 'a (make-array 2 :fill-pointer 0)) => 0"],
        vector_push,
    ),
    pure(
        "VECTOR-PUSH-EXTEND",
        "element vector &optional extension",
        "Adds an element behind the active ones, making room if need be; its index.",
        &["(vector-push-extend 'a (make-array 0 :fill-pointer 0 :adjustable t)) => 0"],
        vector_push_extend,
    ),
    pure(
        "VECTOR-POP",
        "vector",
        "Takes the last active element.",
        &["(vector-pop (make-array 1 :fill-pointer 1 :initial-element 'x)) => X"],
        vector_pop,
    ),
];

/// Places for `setf`; the new value is the first argument.
pub(crate) static SETTERS: &[Builtin] = &[pure(
    "FILL-POINTER",
    "value vector",
    "Sets the number of active elements.",
    &[],
    set_fill_pointer,
)];
