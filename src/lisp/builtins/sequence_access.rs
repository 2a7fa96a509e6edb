//! Parts of sequences: length, elements, subsequences, copies, filling, joining.

use crate::builtins::lists::Size;
use std::rc::Rc;

use super::array_index;
use super::lists::nreverse_onto;
use super::settled_types::sequence_type;
use crate::builtin::Builtin;
use crate::guard::reserve;
use crate::image::Image;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::array::Vector;
use crate::value::raise::Raise;
use crate::value::sequence::{self, Bounds, Kind, Sequence, index};

type Outcome = Result<Value, Box<Raise>>;

/// The number of elements of a sequence.
///
/// `(length '(1 2 3))` => `3`
/// `(length "naïve")` => `5`
#[builtin]
fn length(sequence: Sequence) -> Outcome {
    Ok(sequence.len()?.into())
}

/// The element of a sequence at an index from 0.
///
/// `(elt '(a b c) 1)` => `B`
/// `(elt "abc" 1)` => `#\b`
#[builtin(_, "sequence index")]
fn elt(sequence_value: &Value, index_value: &Value) -> Outcome {
    let sequence = Sequence::of(sequence_value)?;
    let at = index(index_value)?;
    match &sequence {
        Sequence::List(_) => sequence.get(at),
        _ if at < sequence.len()? => sequence.get(at),
        _ => Err(array_index::invalid(
            sequence_value,
            index_value,
            sequence.len()?,
        )),
    }
}

/// Replaces an element of a sequence.
#[builtin("ELT", "value sequence index")]
fn set_elt(value: &Value, sequence_value: &Value, index_value: &Value) -> Outcome {
    let sequence = Sequence::of(sequence_value)?;
    let at = index(index_value)?;
    if !matches!(sequence, Sequence::List(_)) && at >= sequence.len()? {
        return Err(array_index::invalid(
            sequence_value,
            index_value,
            sequence.len()?,
        ));
    }
    sequence.set(at, value.clone())?;
    Ok(value.clone())
}

/// A copy of a part of a sequence.
///
/// `(subseq '(1 2 3 4) 1 3)` => `(2 3)`
/// `(subseq "hello" 2)` => `"llo"`
#[builtin]
fn subseq(sequence: Sequence, start: &Value, end: Option<&Value>) -> Outcome {
    let bounds = Bounds::new(&sequence, Some(start), end)?;
    if let Sequence::Str(string) = &sequence {
        return Ok(Value::string(string.slice(bounds.start, bounds.end)));
    }
    sequence.kind().make(sequence.items(bounds)?)
}

/// Replaces elements of a sequence.
// `(setf (subseq sequence start end) new)`.
#[builtin("SUBSEQ")]
fn set_subseq(value: &Value, sequence: Sequence, start: &Value, end: Option<&Value>) -> Outcome {
    let bounds = Bounds::new(&sequence, Some(start), end)?;
    let new = Sequence::of(value)?;
    overwrite(&sequence, bounds, new.items(Bounds::ALL)?)?;
    Ok(value.clone())
}

/// Overwrites a part of a sequence with items, as far as both reach.
fn overwrite(target: &Sequence, bounds: Bounds, items: Vec<Value>) -> Result<(), Box<Raise>> {
    let end = bounds.end_of(target.len()?);
    let room = end.saturating_sub(bounds.start).min(items.len());
    match target {
        Sequence::List(list) => {
            let mut rest = list.clone();
            for _ in 0..bounds.start {
                rest = rest.cdr_or_nil();
            }
            for item in items.into_iter().take(room) {
                let Value::Cons(cons) = rest else { break };
                cons.set_car(item);
                rest = cons.cdr();
            }
        }
        Sequence::Vector(vector) => {
            for (i, item) in items.into_iter().take(room).enumerate() {
                let item = sequence::element(vector, item)?;
                vector.set(bounds.start + i, item);
            }
        }
        Sequence::Str(string) => {
            let new = sequence::text_of(items.get(..room).unwrap_or(&items))?;
            string.overwrite(bounds.start, &new);
        }
    }
    Ok(())
}

/// A copy of a sequence; the elements are the same.
///
/// `(copy-seq #(1 2))` => `#(1 2)`
#[builtin]
fn copy_seq(sequence: Sequence) -> Outcome {
    match &sequence {
        Sequence::Str(string) => Ok(Value::string(string.text())),
        _ => sequence.kind().make(sequence.all()?),
    }
}

/// A sequence of the same elements in reverse order.
///
/// `(reverse '(1 2 3))` => `(3 2 1)`
/// `(reverse "abc")` => `"cba"`
#[builtin]
fn reverse(sequence: Sequence) -> Outcome {
    let mut items = sequence.all()?;
    items.reverse();
    sequence.kind().make(items)
}

/// Like `reverse`, but reuses the sequence; use the result.
///
/// `(nreverse (list 1 2 3))` => `(3 2 1)`
#[builtin(_, "sequence")]
fn nreverse(sequence_value: &Value) -> Outcome {
    let sequence = Sequence::of(sequence_value)?;
    if let Sequence::List(list) = &sequence {
        return nreverse_onto(list, Value::NIL);
    }
    let mut items = sequence.all()?;
    items.reverse();
    sequence.set_all(&items)?;
    Ok(sequence_value.clone())
}

/// Replaces all elements of a sequence by an item.
///
/// `(fill (list 1 2 3) 0 :start 1)` => `(1 0 0)`
#[builtin(_, "sequence item &key start end")]
fn fill(
    sequence_value: &Value,
    item: Value,
    #[key] start: Option<Value>,
    #[key] end: Option<Value>,
) -> Outcome {
    let sequence = Sequence::of(sequence_value)?;
    let bounds = Bounds::new(&sequence, start.as_ref(), end.as_ref())?;
    let count = bounds.end_of(sequence.len()?) - bounds.start;
    overwrite(&sequence, bounds, vec![item; count])?;
    Ok(sequence_value.clone())
}

/// Copies elements of one sequence over those of another.
///
/// `(replace (list 1 2 3 4) '(a b) :start1 1)` => `(1 A B 4)`
#[builtin(_, "target source &key start1 end1 start2 end2")]
fn replace(
    _image: &mut Image,
    target_value: &Value,
    source: Sequence,
    #[key] start1: Option<Value>,
    #[key] end1: Option<Value>,
    #[key] start2: Option<Value>,
    #[key] end2: Option<Value>,
) -> Outcome {
    let target = Sequence::of(target_value)?;
    let to = Bounds::new(&target, start1.as_ref(), end1.as_ref())?;
    let from = Bounds::new(&source, start2.as_ref(), end2.as_ref())?;
    overwrite(&target, to, source.items(from)?)?;
    Ok(target_value.clone())
}

/// A sequence of the elements of all sequences.
///
/// `(concatenate 'string "foo" "bar")` => `"foobar"`
/// `(concatenate 'list '(1) #(2))` => `(1 2)`
#[builtin]
fn concatenate(image: &mut Image, result_type: &Value, sequences: &[Value]) -> Outcome {
    let result = sequence_type(image, result_type)?;
    if result.kind == Kind::Str && sequences.iter().all(|s| matches!(s, Value::Str(_))) {
        let strings = || sequences.iter().filter_map(Value::as_string);
        let bytes = strings().map(|string| string.borrow().len()).sum();
        reserve(bytes);
        let mut text = String::with_capacity(bytes);
        for string in strings() {
            text.push_str(&string.borrow());
        }
        result.check_length(text.chars().count())?;
        return Ok(Value::string(text));
    }
    let mut items = Vec::new();
    for part in sequences {
        items.extend(Sequence::of(part)?.all()?);
    }
    result.make(items)
}

/// A sequence of equal elements.
///
/// `(make-sequence 'list 2 :initial-element 0)` => `(0 0)`
#[builtin]
fn make_sequence(
    image: &mut Image,
    result_type: &Value,
    size: Size,
    #[key] initial_element: Option<Value>,
) -> Outcome {
    let result = sequence_type(image, result_type)?;
    let count = size.0;
    let initial_element = initial_element.unwrap_or_else(|| default_element(result.kind));
    result.make(vec![initial_element; count])
}

/// The default element of a sequence that is made without elements.
pub(crate) fn default_element(kind: Kind) -> Value {
    match kind {
        Kind::List => Value::NIL,
        Kind::Str => Value::Char('\0'),
        Kind::Vector(element_type) => element_type.default_element(),
    }
}

/// A fresh vector of the arguments.
///
/// `(vector 1 2)` => `#(1 2)`
#[builtin]
fn vector(elements: &[Value]) -> Outcome {
    Ok(Value::Vector(Rc::new(Vector::simple(elements.to_vec()))))
}

/// Parts of sequences.
pub(crate) static TABLE: &[Builtin] = builtins![
    length,
    elt,
    subseq,
    copy_seq,
    reverse,
    nreverse,
    fill,
    replace,
    concatenate,
    make_sequence,
    vector,
];

/// Places for `setf`; the new value is the first argument.
pub(crate) static SETTERS: &[Builtin] = builtins![set_elt, set_subseq,];
