//! Making, copying and joining lists.

use std::rc::Rc;

use crate::builtin::Builtin;
use crate::guard::{MAX_ELEMENTS, Pace, reserve};
use crate::image::Image;
use crate::typed::FromValue;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::cons::Cons;
use crate::value::cycles;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{self, ListBuilder, ListWalk, last_pair};

type Outcome = Result<Value, Box<Raise>>;

/// A fresh list of the arguments.
///
/// `(list 1 2 3)` => `(1 2 3)`
/// `(list)` => `NIL`
#[builtin]
fn list(elements: &[Value]) -> Outcome {
    Ok(Value::list(elements.iter().cloned()))
}

/// A fresh list of all arguments but the last, which becomes its tail.
///
/// `(list* 1 2 '(3 4))` => `(1 2 3 4)`
/// `(list* 1 2)` => `(1 . 2)`
#[builtin("LIST*", "element &rest more")]
fn list_star(more: &[Value]) -> Outcome {
    Ok(match more.split_last() {
        Some((tail, items)) => Value::list_with_tail(items.iter().cloned(), tail.clone()),
        None => Value::NIL,
    })
}

/// A fresh list of `size` equal elements.
///
/// `(make-list 2 :initial-element 'x)` => `(X X)`
#[builtin]
fn make_list(size: Size, #[key] initial_element: Option<Value>) -> Outcome {
    let count = size.0;
    Ok(Value::list(vec![
        initial_element.unwrap_or(Value::NIL);
        count
    ]))
}

/// A number of elements that fits in memory.
pub(crate) struct Size(pub(crate) usize);

impl FromValue<'_> for Size {
    fn from_value(_: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        size(value).map(Size)
    }
}

/// A value as a number of elements that fits in memory.
pub(crate) fn size(value: &Value) -> Result<usize, Box<Raise>> {
    let size = sequence::index(value)?;
    if size > MAX_ELEMENTS {
        return Err(Raise::new(
            known::HEAP_EXHAUSTED_ERROR,
            format!("{size} elements do not fit in memory."),
        ));
    }
    reserve(size.saturating_mul(size_of::<Value>()));
    Ok(size)
}

/// The elements of all lists in one list; the last list is shared, not copied.
///
/// `(append '(1) '(2 3) '(4))` => `(1 2 3 4)`
/// `(append '(1) 2)` => `(1 . 2)`
#[builtin(_, "&rest lists")]
fn append(lists_values: &[Value]) -> Outcome {
    let Some((last, lists)) = lists_values.split_last() else {
        return Ok(Value::NIL);
    };
    let mut builder = ListBuilder::new();
    for list in lists {
        let mut walk = ListWalk::new(list.clone());
        while let Some(item) = walk.next()? {
            builder.push(item);
        }
    }
    Ok(builder.finish_with(last.clone()))
}

/// Joins lists by changing their last pairs.
///
/// `(nconc (list 1) nil (list 2))` => `(1 2)`
#[builtin]
fn nconc(lists: &[Value]) -> Outcome {
    nconc_all(lists)
}

/// Joins lists by changing the last pair of each; the last one may be anything.
pub(crate) fn nconc_all(lists: &[Value]) -> Outcome {
    let mut result = Value::NIL;
    let mut last: Option<Rc<Cons>> = None;
    for (i, list) in lists.iter().enumerate() {
        let is_last = i + 1 == lists.len();
        match list {
            Value::Symbol(known::NIL, ..) if !is_last || last.is_none() => continue,
            Value::Cons(_) => {}
            _ if is_last => {}
            _ => return Err(Raise::type_error(list, known::LIST)),
        }
        match last.take() {
            Some(cons) => {
                cycles::note(&cons, list);
                cons.set_cdr(list.clone());
            }
            None => result = list.clone(),
        }
        if !is_last {
            last = last_pair(list)?;
        }
    }
    Ok(result)
}

/// Reverses the links of a proper list, in front of `tail`.
pub(crate) fn nreverse_onto(list: &Value, tail: Value) -> Outcome {
    let mut conses = sequence::conses(list)?;
    conses.reverse();
    Ok(sequence::relink(&conses, tail))
}

/// Number of elements of a list; `NIL` if it is circular.
///
/// `(list-length '(1 2 3))` => `3`
#[builtin]
fn list_length(list: &Value) -> Outcome {
    let mut slow = list.clone();
    let mut fast = list.clone();
    let mut count = 0_usize;
    loop {
        for _ in 0..2 {
            fast = match &fast {
                Value::Cons(cons) => cons.cdr(),
                Value::Symbol(known::NIL, ..) => return Ok(count.into()),
                other => return Err(Raise::type_error(other, known::LIST)),
            };
            count += 1;
        }
        slow = slow.cdr_or_nil();
        if fast.is_eq(&slow) && !fast.is_nil() {
            return Ok(Value::NIL);
        }
    }
}

/// A copy of a list; the elements are the same.
///
/// `(copy-list '(1 2 . 3))` => `(1 2 . 3)`
#[builtin]
fn copy_list(list: &Value) -> Outcome {
    if !list.is_list() {
        return Err(Raise::type_error(list, known::LIST));
    }
    let mut iter = list.iter_list();
    let mut builder = ListBuilder::new();
    iter.by_ref().for_each(|item| builder.push(item));
    Ok(builder.finish_with(iter.rest))
}

/// The number of pairs beyond which a tree is assumed to be circular.
const MAX_PAIRS: usize = 10_000_000;

/// Counts the pairs of a tree during a walk.
#[derive(Default)]
struct PairCount(usize, Pace);

impl PairCount {
    /// Counts one more pair; an error if there are so many that the tree must be circular.
    fn add_one(&mut self) -> Result<(), Box<Raise>> {
        self.1.step();
        self.0 += 1;
        if self.0 <= MAX_PAIRS {
            return Ok(());
        }
        let text = format!("The tree has more than {MAX_PAIRS} pairs; it must be circular.");
        Err(Raise::simple(text))
    }
}

/// A copy of a tree of pairs.
///
/// `(copy-tree '(1 (2 3)))` => `(1 (2 3))`
#[builtin]
fn copy_tree(tree: &Value) -> Outcome {
    let copy_of = |value: &Value, pending: &mut Vec<Rc<Cons>>| match value {
        Value::Cons(cons) => {
            let copy = Cons::shared(cons.car(), cons.cdr());
            pending.push(copy.clone());
            Value::Cons(copy)
        }
        other => other.clone(),
    };
    // Pairs that are copied while their halves are still the old ones.
    let mut pending = Vec::new();
    let result = copy_of(tree, &mut pending);
    let mut pairs = PairCount::default();
    while let Some(cons) = pending.pop() {
        pairs.add_one()?;
        cons.set_car(copy_of(&cons.car(), &mut pending));
        cons.set_cdr(copy_of(&cons.cdr(), &mut pending));
    }
    Ok(result)
}

/// Is the object a pair?
///
/// `(consp nil)` => `NIL`
#[builtin("CONSP")]
fn is_cons(object: &Value) -> bool {
    matches!(object, Value::Cons(_))
}

/// Is the object a list?
///
/// `(listp nil)` => `T`
#[builtin("LISTP")]
fn is_list(object: &Value) -> bool {
    object.is_list()
}

/// Is the object anything but a pair?
///
/// `(atom nil)` => `T`
#[builtin("ATOM")]
fn is_atom(object: &Value) -> bool {
    !matches!(object, Value::Cons(_))
}

/// Is the object `NIL`?
///
/// `(null '())` => `T`
#[builtin("NULL")]
fn is_null(object: &Value) -> bool {
    object.is_nil()
}

/// Making, copying and joining lists.
pub(crate) static TABLE: &[Builtin] = builtins![
    list,
    list_star,
    make_list,
    append,
    nconc,
    list_length,
    copy_list,
    copy_tree,
    is_cons,
    is_list,
    is_atom,
    is_null,
];
